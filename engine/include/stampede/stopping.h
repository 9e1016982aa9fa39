// An end that is asked for from another thread, or in a signal's handler: what runs long looks, however deep it lies.
#pragma once

#include <atomic>
#include <exception>

#include "stampede/visibility.h"

namespace stampede {

// What a call throws that was ended so: nothing half done is kept. Not an Error: nothing is wrong with what was being
// read, so nobody who collects mistakes may collect it.
class STAMPEDE_EXPORT Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// While it lives, this flag is the one that the calls of this thread look at (of a Session, an Environment, a
// CatalogueReader …); null: none.
class STAMPEDE_EXPORT StopScope {
 public:
  explicit StopScope(const std::atomic<bool>* stop);
  ~StopScope();
  StopScope(const StopScope&) = delete;
  StopScope& operator=(const StopScope&) = delete;

 private:
  const std::atomic<bool>* before_;
};

}  // namespace stampede
