// Work on files that nobody vouches for: done in a child process, so that nothing in them can harm this one.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace stampede {

struct ChildLimits {
  int cpu_s = 5;  // of its processor, not of the clock: a busy machine changes nothing
  std::size_t memory_bytes = std::size_t{1} << 30;  // above what this process has
  std::size_t output_bytes = std::size_t{1} << 29;
};

// Runs `work` in a child of this process and returns what it returns. The child writes no files and dies with us;
// what it changes in memory is lost. Ctrl-C ends it. Works from any thread, since the child calls nothing but `work`:
// that must not wait for other threads' locks, and must not start threads.
// Throws the Error that `work` throws; and Error(where, …, hint) when it crashes, passes a limit or is interrupted.
// A limit of memory is not set in builds with sanitizers, which take it all for themselves.
std::string in_child(const std::string& where, const std::string& hint, const ChildLimits& limits,
                     const std::function<std::string()>& work);

}  // namespace stampede
