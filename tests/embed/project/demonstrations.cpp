// Demonstrations of two tasks into a catalogue, by two workers; then what it has to say of them.
#include <cstdio>
#include <filesystem>
#include <stampede/session.h>

int main() {
  std::filesystem::remove("demonstrations.db");
  stampede::Session session({.catalogue = "demonstrations.db"});
  const stampede::RunRequest request = {
      .tasks = {"reach_target", "push_buttons"},
      .episodes = 6,  // of each; their variations in turn
      .workers = 2,
      .each = {.seed = 40, .on_failure = stampede::OnFailure::recover},
  };
  const stampede::RunTally tally = session.run_all(request);
  for (const auto& [task, of] : tally.tasks) {
    std::printf("%s: %d of %d succeeded, %.1f s simulated\n", task.c_str(), static_cast<int>(of.succeeded),
                static_cast<int>(of.episodes), 1e-6 * static_cast<double>(of.simulated_us));
    for (const auto& [reason, count] : of.reasons) std::printf("  %d %s\n", static_cast<int>(count), reason.c_str());
  }
  if (tally.total != 12 || tally.finished != 12 || tally.existing != 0 || tally.interrupted) return 1;

  // The catalogue answers in SQL: the skills of all that succeeded, and how long each took.
  const stampede::Rows skills = session.query(
      "SELECT s.skill, count(*) AS n, avg(s.duration_s) AS seconds FROM segments s JOIN demos d USING (episode) "
      "WHERE s.kind = 'skill' GROUP BY s.skill ORDER BY s.skill");
  for (std::size_t i = 0; i < skills.size(); ++i)
    std::printf("%s: %d times, %.2f s\n", skills.text(i, "skill").c_str(), static_cast<int>(skills.integer(i, "n")),
                skills.real(i, "seconds"));
  if (skills.size() < 2) return 2;

  // They are stored by task, variation and seed, whoever was done first.
  const stampede::Rows order = session.query(
      "SELECT count(*) AS n FROM episodes a JOIN episodes b ON b.episode = a.episode + 1 "
      "WHERE (a.task, a.variation, a.seed) > (b.task, b.variation, b.seed)");
  if (order.integer(0, "n") != 0) return 3;

  // The same again runs nothing, and more goes on from there.
  stampede::RunRequest more = request;
  more.tasks = {"reach_target"};
  more.episodes = 8;
  const stampede::RunTally rest = session.run_all(more);
  std::printf("%d were there, %d are new\n", static_cast<int>(rest.existing), static_cast<int>(rest.finished));
  return rest.existing == 6 && rest.finished == 2 ? 0 : 4;
}
