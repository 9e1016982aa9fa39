// A program that is spoken with line by line, on its standard input and output.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/shell_program.h"

namespace stampede {

inline constexpr std::size_t kLongestPolicyLine = 1'000'000;  // bytes

// Lifetime: the program's. It is started by /bin/sh -c in a process group of its own, which a terminal's Ctrl-C does
// not reach; its standard error is ours. When this object goes its input is closed, and what is left of it after
// a second is killed, whatever it has started included. Keys are not in its environment (shell_program.h).
// Throws Error, with the command's last word and a cure, when it cannot be started, ends while an answer is awaited,
// says nothing or does not listen for `patience`, writes a line that is too long, or one that nobody asked for.
class PolicyProgram {
 public:
  // `stop`: looked at while an answer is awaited; may be null.
  PolicyProgram(std::string command, std::chrono::milliseconds patience, const std::atomic<bool>* stop);
  ~PolicyProgram();
  PolicyProgram(const PolicyProgram&) = delete;
  PolicyProgram& operator=(const PolicyProgram&) = delete;

  // Sends a line and waits for one, which comes without its end. `awaited`: what it should hold, for complaints.
  // Nothing: `stop` was set.
  std::optional<std::string> ask(const std::string& line, std::string_view awaited);
  // Sends a line that has no answer. A program that has ended meanwhile is no error before the next `ask`.
  void tell(const std::string& line);

  [[noreturn]] void fail(const std::string& what, const std::string& cure) const;
  std::int64_t answers() const { return answers_; }  // lines taken so far

 private:
  enum class Progress { done, stopped };
  Progress exchange(bool answered);
  void read_some();
  void write_some();
  bool take_line();
  [[noreturn]] void complain_of_end();
  std::optional<int> wait_for_end(std::chrono::milliseconds patience) const;  // status of the shell, which stays

  std::string command_, awaited_;
  std::chrono::milliseconds patience_;
  bool stopped() const { return stop_ != nullptr && stop_->load(); }
  const std::atomic<bool>* stop_;
  std::optional<ShellProgram> program_;
  int in_ = -1, out_ = -1;       // its standard input and output; -1: closed
  std::string unsent_, unread_;  // what is on its way; what has come beyond the last line taken
  std::string line_;
  std::int64_t answers_ = 0;
};

// A line as a complaint shows it: in quotes, its beginning where it is long.
std::string shown_line(std::string_view line);

}  // namespace stampede
