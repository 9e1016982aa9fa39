#include "engine/base/shell_program.h"

#include <dirent.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <memory>
#include <mutex>
#include <sstream>
#include <system_error>
#include <thread>

#include "engine/base/stopping.h"

namespace stampede {
namespace {

// Of this process: its children that it waits for itself, and how many programs' orphans come to it.
struct Household {
  std::mutex mutex;
  std::multiset<pid_t> own;
  int adopting = 0, adopted_before = 0;
};
Household& household() {
  static Household one;
  return one;
}

void start_adopting() {
  Household& house = household();
  const std::lock_guard lock(house.mutex);
  if (house.adopting++ > 0) return;
  prctl(PR_GET_CHILD_SUBREAPER, &house.adopted_before);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
}

void stop_adopting() {
  Household& house = household();
  const std::lock_guard lock(house.mutex);
  if (--house.adopting == 0) prctl(PR_SET_CHILD_SUBREAPER, house.adopted_before);
}

bool opens_doors(std::string name) {
  for (char& c : name)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  for (const std::string_view word : {"KEY", "TOKEN", "SECRET", "PASSWORD", "PASSWD", "PASSPHRASE", "CREDENTIALS"})
    if (name == word || name.ends_with("_" + std::string(word))) return true;
  return false;
}

std::string file_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

struct CloseFolder {
  void operator()(DIR* folder) const { closedir(folder); }
};

constexpr const char* kStartedBy = "STAMPEDE_STARTED";

// Signals as a program expects them.
pid_t start(const std::string& command, int input, int output, bool own_group, const std::string& mark) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  if (input >= 0) posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
  if (output >= 0) posix_spawn_file_actions_adddup2(&files, output, STDOUT_FILENO);
  posix_spawnattr_t how;
  posix_spawnattr_init(&how);
  sigset_t usual, none;
  sigemptyset(&none);
  sigemptyset(&usual);
  for (const int one : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) sigaddset(&usual, one);
  posix_spawnattr_setsigdefault(&how, &usual);
  posix_spawnattr_setsigmask(&how, &none);
  posix_spawnattr_setpgroup(&how, 0);
  const int group = own_group ? POSIX_SPAWN_SETPGROUP : 0;
  posix_spawnattr_setflags(&how, static_cast<short>(group | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK));
  std::array<std::string, 3> words = {"sh", "-c", command};
  std::array<char*, 4> list = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  std::vector<std::string> variables = environment_without_keys();
  variables.push_back(std::string(kStartedBy) + "=" + mark);
  std::vector<char*> environment;
  for (std::string& one : variables) environment.push_back(one.data());
  environment.push_back(nullptr);
  pid_t process = -1;
  const int number = posix_spawn(&process, "/bin/sh", &files, &how, list.data(), environment.data());
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&how);
  if (number != 0) throw std::system_error(number, std::generic_category());
  return process;
}

}  // namespace

struct ShellProgram::Process {
  pid_t number = 0, parent = 0, group = 0;
  bool dead = false;    // waits to be waited for
  std::string started;  // clock ticks: with the number it tells a process from all others
};

namespace {

// All that /proc shows.
template <typename Process>
std::vector<Process> all_processes() {
  std::vector<Process> all;
  const std::unique_ptr<DIR, CloseFolder> folder(opendir("/proc"));
  if (!folder) return all;
  while (const dirent* entry = readdir(folder.get())) {
    if (entry->d_name[0] < '1' || entry->d_name[0] > '9') continue;
    const std::string text = file_text(std::string("/proc/") + entry->d_name + "/stat");
    const std::size_t name_end = text.rfind(')');  // a name may hold anything
    if (name_end == std::string::npos) continue;
    std::istringstream fields(text.substr(name_end + 1));
    Process one;
    std::string state, skipped;
    fields >> state >> one.parent >> one.group;
    for (int i = 0; i < 16; ++i) fields >> skipped;
    fields >> one.started;
    one.number = static_cast<pid_t>(std::stol(entry->d_name));
    one.dead = state == "Z" || state == "X";
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::vector<std::string> environment_without_keys() {
  std::vector<std::string> kept;
  for (char** one = environ; one != nullptr && *one != nullptr; ++one) {
    const std::string variable = *one;
    if (!opens_doors(variable.substr(0, variable.find('=')))) kept.push_back(variable);
  }
  return kept;
}

ShellProgram::ShellProgram(const std::string& command, int input, int output, Group group, Orphans orphans)
    : group_(group), orphans_(orphans) {
  static std::atomic<unsigned> count = 0;
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  mark_ = std::to_string(getpid()) + "-" + std::to_string(++count) + "-" + std::to_string(now);
  if (orphans_ == Orphans::adopted) {
    for (const Process& one : all_processes<Process>())
      if (one.parent == getpid()) before_.emplace(one.number, one.started);
    start_adopting();
  }
  Household& house = household();
  try {
    const std::lock_guard lock(house.mutex);
    process_ = start(command, input, output, group_ == Group::own, mark_);
    house.own.insert(process_);
  } catch (...) {
    if (orphans_ == Orphans::adopted) stop_adopting();
    throw;
  }
}

ShellProgram::~ShellProgram() {
  end();
  if (orphans_ == Orphans::adopted) stop_adopting();
}

int ShellProgram::wait() const {
  siginfo_t about{};
  for (int look = 1;; ++look) {
    const int failed = waitid(P_PID, static_cast<id_t>(process_), &about, WEXITED | WNOWAIT | WNOHANG);
    if (failed != 0 && errno != EINTR) break;
    if (failed == 0 && about.si_pid != 0) break;
    heed_stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(look, 20)));
  }
  return about.si_code == CLD_EXITED ? about.si_status << 8 : about.si_status;
}

// What is left of it, the shell apart once that is dead. Called with the household's lock.
std::vector<ShellProgram::Process> ShellProgram::victims() const {
  const std::vector<Process> all = all_processes<Process>();
  const std::multiset<pid_t>& own = household().own;
  const std::string mark = std::string(kStartedBy) + "=" + mark_;
  const auto belongs = [&](const Process& one) {
    if (one.number == process_ || (group_ == Group::own && one.group == process_)) return true;
    if (one.number == getpid() || own.contains(one.number)) return false;
    if (orphans_ == Orphans::adopted && one.parent == getpid() && !before_.contains({one.number, one.started}))
      return true;
    return !one.dead && file_text("/proc/" + std::to_string(one.number) + "/environ").find(mark) != std::string::npos;
  };
  std::set<pid_t> found;
  for (const Process& one : all)
    if (belongs(one)) found.insert(one.number);
  for (bool more = true; more;) {
    more = false;
    for (const Process& one : all)
      if (found.contains(one.parent) && !own.contains(one.number)) more |= found.insert(one.number).second;
  }
  std::vector<Process> left;
  for (const Process& one : all)
    if (found.contains(one.number) && !(one.dead && (one.number == process_ || one.parent != getpid())))
      left.push_back(one);
  return left;
}

// Killed until nothing is found any more: what dies leaves children, and those may have forked meanwhile. The shell is
// waited for last, so that the number of its group stays its own.
void ShellProgram::end() {
  Household& house = household();
  const std::lock_guard lock(house.mutex);
  constexpr int kMostRounds = 2000;
  for (int round = 0; round < kMostRounds; ++round) {
    if (group_ == Group::own) kill(-process_, SIGKILL);
    const std::vector<Process> left = victims();
    if (left.empty()) break;
    for (const Process& one : left) {
      if (!one.dead) kill(one.number, SIGKILL);
      if (one.number != process_ && one.parent == getpid()) waitpid(one.number, nullptr, WNOHANG);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(round < 20 ? 1 : 5));
  }
  kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  house.own.erase(house.own.find(process_));
}

OwnChild::OwnChild(pid_t process) : process_(process) {
  const std::lock_guard lock(household().mutex);
  household().own.insert(process_);
}

OwnChild::~OwnChild() {
  const std::lock_guard lock(household().mutex);
  household().own.erase(household().own.find(process_));
}

}  // namespace stampede
