// The story of a long run: one bar that redraws itself on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "scripting/program/console.h"

namespace stampede::program {

struct ProgressState {
  std::int64_t total = 0, done = 0;
  std::int64_t finished = 0, succeeded = 0;  // of those that this run made
  double elapsed_s = 0;
};

// `12/40 [██████▌·····] 92 % success, 2.1 episodes/s, 13 s left`. Repeatable.
std::string progress_line(const ProgressState& state, int width);

class Progress {
 public:
  explicit Progress(Console& console) : console_(console), start_(std::chrono::steady_clock::now()) {}
  ~Progress() { finish(); }
  // Called after each episode; `line` says what it was, for plain lines.
  void update(ProgressState state, const std::string& line);
  void finish();  // leaves the bar on its line

 private:
  Console& console_;
  std::chrono::steady_clock::time_point start_;
  bool drawn_ = false;
};

std::string duration_text(double seconds);  // `4 s`, `2 min 05 s`, `1 h 20 min`

}  // namespace stampede::program
