// A run that tells how far it is and can be ended at any time: Ctrl-C, or here when three episodes are there.
#include <atomic>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <stampede/session.h>
#include <stdexcept>

namespace {

std::atomic<bool> stop = false;

}  // namespace

int main() {
  std::filesystem::remove("cancel.db");
  stampede::Session session({.catalogue = "cancel.db"});
  std::signal(SIGINT, [](int) { stop = true; });
  stampede::RunRequest request = {.tasks = {"reach_target"}, .episodes = 30, .workers = 2, .stop = &stop};
  request.progress = [](const stampede::RunProgress& now) {
    std::printf("%d of %d: %s, %s\n", static_cast<int>(now.done), static_cast<int>(now.total),
                now.episode.variation.c_str(), now.episode.reason.c_str());
    if (now.done == 3) std::raise(SIGINT);
  };
  const stampede::RunTally first = session.run_all(request);
  const auto stored = [&] { return session.query("SELECT count(*) AS n FROM episodes").integer(0, "n"); };
  std::printf("%s, %d stored\n", first.interrupted ? "interrupted" : "done", static_cast<int>(stored()));
  if (!first.interrupted || first.finished < 3 || first.finished > 20 || stored() != first.finished) return 1;

  // What a callback throws ends a run too, and comes out here; what was finished is kept.
  stop = false;
  request.progress = [](const stampede::RunProgress&) { throw std::runtime_error("that is enough"); };
  try {
    session.run_all(request);
    return 2;
  } catch (const std::runtime_error& error) {
    std::printf("%s, %d stored\n", error.what(), static_cast<int>(stored()));
  }
  if (stored() <= first.finished) return 3;

  // The same request goes on from there.
  request.episodes = 10;
  request.progress = {};
  const stampede::RunTally rest = session.run_all(request);
  std::printf("%d were there, %d are new\n", static_cast<int>(rest.existing), static_cast<int>(rest.finished));
  return rest.done() == 10 && !rest.interrupted ? 0 : 4;
}
