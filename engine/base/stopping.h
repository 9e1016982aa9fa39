// Whether somebody asked for an end: what runs long looks, however deep it lies.
#pragma once

#include <atomic>
#include <exception>

namespace stampede {

// Not an Error: nothing is wrong with what was being read, so nobody who collects mistakes may collect it.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// While it lives, this flag is the one that this thread looks at; null: none.
class StopScope {
 public:
  explicit StopScope(const std::atomic<bool>* stop);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const std::atomic<bool>* before_;
};

const std::atomic<bool>* stop_of_this_thread();  // for a thread that it starts
bool stop_asked();
void heed_stop();  // throws Interrupted where an end was asked for

}  // namespace stampede
