#include "engine/base/shell_program.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "engine/base/temporary_folder.h"

namespace stampede {
namespace {

using Group = ShellProgram::Group;
using Orphans = ShellProgram::Orphans;

// The number that a process has written of itself; waits for it.
pid_t number_in(const std::filesystem::path& file) {
  for (int tries = 0; tries < 2000; ++tries) {
    pid_t number = 0;
    if (std::ifstream(file) >> number && number > 0) return number;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return 0;
}

bool lives(pid_t process) {
  std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
  std::string text{std::istreambuf_iterator<char>(stat), {}};
  const std::size_t end = text.rfind(')');
  return end != std::string::npos && text[end + 2] != 'Z' && text[end + 2] != 'X';
}

// A shell's words for a process that writes its number and stays.
std::string staying(const std::string& file) { return "sh -c 'echo $$ >" + file + "; exec sleep 300'"; }

}  // namespace

TEST_CASE("what a program has started ends with it: children, other sessions, what forks twice, with any environment") {
  for (const Orphans orphans : {Orphans::adopted, Orphans::searched}) {
    const TemporaryFolder folder;
    const std::string at = folder.path().string() + "/";
    std::vector<pid_t> all;
    std::vector<std::string> commands = {
        staying(at + "child") + " &", "setsid " + staying(at + "session") + " &",
        "(setsid " + staying(at + "daemon") + " &)",
        "(setsid sh -c '(setsid " + std::string("sh -c \"echo \\$\\$ >") + at + "twice; exec sleep 300\" &)' &)"};
    if (orphans == Orphans::adopted) commands.push_back("(env -i setsid " + staying(at + "bare") + " &)");
    std::string line;
    for (const std::string& command : commands) line += command + "\n";
    {
      const ShellProgram program(line + "sleep 300", -1, -1, Group::own, orphans);
      all.push_back(program.process());
      for (const char* name : {"child", "session", "daemon", "twice"}) all.push_back(number_in(at + name));
      if (orphans == Orphans::adopted) all.push_back(number_in(at + "bare"));
      for (const pid_t process : all) CHECK(lives(process));
    }
    for (const pid_t process : all) CHECK_FALSE(lives(process));
    CHECK(waitpid(-1, nullptr, WNOHANG) == -1);  // and none waits to be waited for
  }
}

TEST_CASE("what leaves the shell behind is ended when that has ended already") {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "daemon").string();
  pid_t daemon = 0;
  {
    const ShellProgram program("(setsid " + staying(file) + " &) ; exit 3", -1, -1, Group::own, Orphans::adopted);
    CHECK(WEXITSTATUS(program.wait()) == 3);
    daemon = number_in(file);
    CHECK(lives(daemon));
  }
  CHECK_FALSE(lives(daemon));
}

TEST_CASE("children that this process has of its own stay") {
  const auto sleeper = [] {
    const pid_t child = fork();
    if (child == 0) {
      execlp("sleep", "sleep", "300", nullptr);
      _exit(1);
    }
    return child;
  };
  const pid_t before = sleeper();
  pid_t during = 0;
  {
    const ShellProgram program("sleep 300", -1, -1, Group::own, Orphans::adopted);
    int adopts = 0;
    prctl(PR_GET_CHILD_SUBREAPER, &adopts);
    CHECK(adopts == 1);
    during = sleeper();
    const OwnChild known(during);
    const ShellProgram other("sleep 300", -1, -1, Group::own, Orphans::adopted);
  }
  int adopts = 1;
  prctl(PR_GET_CHILD_SUBREAPER, &adopts);
  CHECK(adopts == 0);
  CHECK(lives(before));
  for (const pid_t child : {before, during}) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
}

TEST_CASE("keys stay with us: a program has the environment without them") {
  for (const char* name : {"STAMPEDE_LLM_KEY", "OPENAI_API_KEY", "hf_token", "Db_Password", "TOKEN"})
    setenv(name, "opens doors", 1);
  for (const char* name : {"STAMPEDE_LLM_URL", "KEYBOARD", "MONKEY", "TOKENIZERS_PARALLELISM"})
    setenv(name, "usual", 1);
  std::array<int, 2> ends{};
  REQUIRE(pipe2(ends.data(), O_CLOEXEC) == 0);
  std::string said;
  {
    const ShellProgram program("env", -1, ends[1], Group::ours, Orphans::searched);
    close(ends[1]);
    std::array<char, 4096> piece;
    for (ssize_t count; (count = read(ends[0], piece.data(), piece.size())) > 0;)
      said.append(piece.data(), static_cast<std::size_t>(count));
    CHECK(program.wait() == 0);
  }
  close(ends[0]);
  CHECK(said.find("opens doors") == std::string::npos);
  for (const char* name : {"STAMPEDE_LLM_URL", "KEYBOARD", "MONKEY", "TOKENIZERS_PARALLELISM"})
    CHECK(said.find(name + std::string("=usual")) != std::string::npos);
  CHECK(said.find("PATH=") != std::string::npos);
  for (const char* name : {"STAMPEDE_LLM_KEY", "OPENAI_API_KEY", "hf_token", "Db_Password", "TOKEN"}) unsetenv(name);
}

}  // namespace stampede
