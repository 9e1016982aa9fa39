#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "db/catalogue.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

// Starts a long run, sends the signal once two episodes are stored, and waits for the end.
int signalled_run(const std::string& out, const std::string& story, int signal_number) {
  const pid_t child = fork();
  if (child == 0) {
    if (!std::freopen(story.c_str(), "w", stderr) || !std::freopen("/dev/null", "w", stdout)) _exit(126);
    execl(STAMPEDE_PROGRAM, "stampede", "run", "reach_target", "--episodes", "2000", "--root", STAMPEDE_SOURCE_DIR,
          "--variation", "colour=red", "--workers", "2", "--out", out.c_str(), nullptr);
    _exit(127);
  }
  const auto stored = [&] {
    const Said said = say({"query", out, "SELECT iif(count(*) >= 2, 'enough', '') AS stored FROM episodes"});
    return said.code == kDone && says(said.out, "enough");  // no catalogue is there at first
  };
  bool begun = false;
  for (int i = 0; i < 5000 && !begun; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    begun = stored();
  }
  kill(child, signal_number);
  int status = 0;
  waitpid(child, &status, 0);
  INFO(file_text(story).substr(0, 2000));
  REQUIRE(begun);
  return status;
}

}  // namespace

TEST_CASE("Ctrl-C and SIGTERM end a run cleanly: what is finished stays whole, the rest leaves no trace") {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const Folder folder;
    const int status = signalled_run(folder / "demos.db", folder / "story.txt", signal_number);
    INFO(file_text(folder / "story.txt").substr(0, 2000));
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == kInterrupted);
    CHECK_FALSE(std::filesystem::exists(folder / "demos.db-wal"));
    const auto episodes = Catalogue::open(folder / "demos.db").episodes();
    CHECK(episodes.size() >= 2);
    for (const EpisodeSummary& episode : episodes) CHECK(episode.reason != Reason::interrupted);
    CHECK(say({"replay", folder / "demos.db", "1"}).code == kDone);
  }
}

TEST_CASE("kill -9 during a run leaves whole episodes only") {
  const Folder folder;
  const int status = signalled_run(folder / "demos.db", folder / "story.txt", SIGKILL);
  REQUIRE(WIFSIGNALED(status));
  Catalogue::write(folder / "demos.db").close();  // recovers what the dead writer left
  const Said replayed = say({"replay", folder / "demos.db"});
  INFO(replayed.out + replayed.err);
  CHECK(replayed.code == kDone);
  CHECK(Catalogue::open(folder / "demos.db").episodes().size() >= 2);  // what was stored stays
}

TEST_CASE("a reader that has seen enough, such as head, is no error, a full disk is") {
  const Folder folder;
  const auto code_of = [&](int output) {
    const pid_t child = fork();
    if (child == 0) {
      if (dup2(output, STDOUT_FILENO) < 0 || !std::freopen((folder / "story.txt").c_str(), "w", stderr)) _exit(126);
      execl(STAMPEDE_PROGRAM, "stampede", "--help", nullptr);
      _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  int ends[2] = {};
  REQUIRE(pipe(ends) == 0);
  close(ends[0]);  // nobody reads
  CHECK(code_of(ends[1]) == kDone);
  CHECK(file_text(folder / "story.txt").empty());
  close(ends[1]);
  const int full = open("/dev/full", O_WRONLY);
  CHECK(code_of(full) == kBadInput);
  CHECK(says(file_text(folder / "story.txt"), "could not be written"));
  close(full);
}

}  // namespace stampede::program
