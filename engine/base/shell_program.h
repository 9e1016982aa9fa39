// Programs of others that are started: without our user's keys, and ended with all that they have started.
#pragma once

#include <sys/types.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stampede {

// This process's environment as NAME=VALUE, without what opens doors: names that end in KEY, TOKEN, SECRET, PASSWORD,
// PASSWD, PASSPHRASE or CREDENTIALS, after nothing or a `_`, in letters of any size.
std::vector<std::string> environment_without_keys();

// As one word of a command line of sh, whatever is in it.
std::string shell_word(const std::string& text);

// A command line that /bin/sh runs. Lifetime: the program's. When this object goes, whatever is left of it is killed:
// the shell, its group, its descendants, and what has left both behind by forking twice.
class ShellProgram {
 public:
  enum class Group { own, ours };  // a terminal's Ctrl-C reaches ours
  // Descendants that have lost their parent become children of this process while it lives, and any child that it did
  // not start itself counts as one: for programs whose process is all ours.
  enum class Orphans { adopted, searched };

  // `input`, `output`: its standard input and output; -1: ours. Throws std::system_error where it cannot be started.
  ShellProgram(const std::string& command, int input, int output, Group group, Orphans orphans);
  ~ShellProgram();
  ShellProgram(const ShellProgram&) = delete;
  ShellProgram& operator=(const ShellProgram&) = delete;

  pid_t process() const { return process_; }  // of the shell, which is not waited for before the end
  int wait() const;                           // until the shell ends: as waitpid says it. Heeds a stop

 private:
  struct Process;
  std::vector<Process> victims() const;
  void end();

  Group group_;
  Orphans orphans_;
  std::string mark_;                                // in the environment of all that it starts
  std::set<std::pair<pid_t, std::string>> before_;  // children that this process had, with the times of their starts
  pid_t process_ = -1;
};

// While it lives, a child that this process has started otherwise is not taken for an orphan.
class OwnChild {
 public:
  explicit OwnChild(pid_t process);
  ~OwnChild();
  OwnChild(const OwnChild&) = delete;
  OwnChild& operator=(const OwnChild&) = delete;

 private:
  pid_t process_;
};

}  // namespace stampede
