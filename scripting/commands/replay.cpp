#include <fmt/format.h>

#include <ostream>

#include "db/catalogue.h"
#include "engine/episode/runner.h"
#include "engine/record/observation.h"
#include "engine/sim/numerics.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"

namespace stampede::program {

std::int64_t episode_number(const std::string& text);

namespace {

std::vector<std::int64_t> wanted_episodes(const Catalogue& catalogue, const Arguments& arguments) {
  std::vector<std::int64_t> wanted;
  for (const std::string& text : arguments.list("EPISODE")) wanted.push_back(episode_number(text));
  if (!wanted.empty()) return wanted;
  for (const EpisodeSummary& episode : catalogue.episodes()) wanted.push_back(episode.id);
  return wanted;
}

// Said first, because it explains every difference that follows.
bool numerics_agree(const Catalogue& catalogue, Console& console) {
  const std::string here = numerics_probe();
  const QueryResult others =
      catalogue.query("SELECT DISTINCT numerics FROM episodes WHERE numerics <> ?1", {.parameters = {here}});
  if (others.rows.empty()) return true;
  console.err << "numerics differ: the catalogue was made by another build or on another class of processor;\n"
                 "    a difference below says that, and nothing about the episodes\n";
  return false;
}

ExitCode do_replay(const Arguments& arguments, Console& console) {
  const Catalogue catalogue = Catalogue::open(arguments.text("FILE"));
  const bool json = arguments.flag("--json");
  const bool agree = numerics_agree(catalogue, console);
  std::int64_t same = 0, different = 0, real = 0;
  JsonText text;
  text.object().field("numerics_agree", agree).key("episodes").array();
  for (const std::int64_t id : wanted_episodes(catalogue, arguments)) {
    if (console.stopped()) return kInterrupted;
    const EpisodeRecord episode = catalogue.read_episode(id);
    if (episode.real) {
      ++real;
      console.err << fmt::format("{:>5}  {}: a real episode was recorded, not simulated: there is nothing to replay\n",
                                 id, episode.task);
      continue;
    }
    const std::string difference = replay_episode(episode);
    ++(difference.empty() ? same : different);
    text.object().field("episode", id).field("same", difference.empty()).field("difference", difference);
    text.key("not_replayed").array();
    for (const std::string& sensor : not_replayed(episode)) text.value(sensor);
    text.end().end();
    if (json) continue;
    std::string verdict =
        difference.empty() ? fmt::format("same, {} frames", episode.frames.size()) : "DIFFERENT: " + difference;
    for (const std::string& sensor : not_replayed(episode))
      verdict += sensor == kMargins
                     ? "; margins left out: scripts measure them"
                     : fmt::format("; sensor {} left out: only the program that recorded it can read it", sensor);
    console.out << fmt::format("{:>5}  {} {} seed {}: {}", id, episode.task, episode.variation, episode.seed, verdict)
                << std::endl;
  }
  if (json) {
    console.out << text.end().field("same", same).field("different", different).field("real", real).end().text();
  } else {
    console.out << fmt::format("{} replayed bit for bit, {} different\n", same, different);
  }
  return different == 0 && same + different > 0 ? kDone : kNo;
}

}  // namespace

CommandRow replay_command() {
  return {"replay",
          "Simulate stored episodes again and compare every frame, bit for bit",
          "Needs the catalogue only: no scripts and no planner. Without EPISODE it replays all. The first value that "
          "differs is named, and the exit code is then 1. The promise holds for one build on one class of processor; "
          "where that does not hold it is said first. Real episodes are left out, with a line that says so. Sensors of "
          "a program that recorded episodes cannot be read here, nor the channel margins, which scripts measure; each "
          "is named and left out.",
          {{"FILE", "the catalogue", true, false}, {"EPISODE", "numbers of episodes; default: all", false, true}},
          {},
          {"stampede replay demos.db", "stampede replay demos.db 3 5"},
          do_replay};
}

}  // namespace stampede::program
