#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
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

TEST_CASE("whatever a command is at, Ctrl-C ends it at once, and what it has started") {
  const Folder folder;
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  REQUIRE(say({"run", "reach_target", "--root", kRoot, "--out", folder / "one.db"}).code == kDone);
  const std::string out = folder / "out.db", mark = "7354" + std::to_string(getpid() % 10'000);
  const std::vector<std::vector<std::string>> commands = {
      {"run", "stack_blocks", "--episodes", "300", "--workers", "1", "--images", "all", "--size", "512x512"},
      {"run", "stack_blocks", "--planner", "sh -c 'sleep " + mark + "' {domain} {problem} {plan}"},
      {"run", "reach_target", "--policy", "sleep " + mark},
      {"run", "reach_target", "--policy", "sh -c 'trap : INT TERM; sleep " + mark + "; sleep " + mark + "'"},
      {"evaluate", "reach_target", "--policy", "sleep " + mark},
      {"questions", folder / "one.db", "--out", folder / "pipe"}};
  for (std::vector<std::string> words : commands) {
    INFO(words[0] << " " << words[1] << " … " << words.back());
    if (words[0] != "questions")
      for (const std::string& word : {std::string("--out"), out, std::string("--root"), std::string(kRoot)})
        words.push_back(word);
    words.insert(words.begin(), "stampede");
    std::vector<char*> list;
    for (std::string& word : words) list.push_back(word.data());
    list.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      if (!std::freopen("/dev/null", "w", stderr) || !std::freopen("/dev/null", "w", stdout)) _exit(126);
      execv(STAMPEDE_PROGRAM, list.data());
      _exit(127);
    }
    std::this_thread::sleep_for(std::chrono::seconds(3));
    const auto began = std::chrono::steady_clock::now();
    kill(child, SIGINT);
    int status = 0;
    waitpid(child, &status, 0);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    CHECK((WIFEXITED(status) && WEXITSTATUS(status) == kInterrupted));
    CHECK(took.count() < 0.6);  // 0.2 s where nobody else wants the processor
    CHECK(std::system(("pgrep -f 'slee[p] " + mark + "' >/dev/null").c_str()) != 0);
    if (std::filesystem::exists(out)) CHECK(say({"replay", out}).code != kBug);
    CHECK_FALSE(std::filesystem::exists(out + "-wal"));
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
