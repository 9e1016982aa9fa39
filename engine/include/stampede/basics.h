// What the other public headers stand on.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <utility>

#include "stampede/error.h"

// What the shared libraries show to programs; everything else stays hidden.
#define STAMPEDE_EXPORT __attribute__((visibility("default")))

namespace stampede {

// As a unique_ptr, but asked for what was moved away it throws Error, so that an object that was moved from is a
// mistake with a name.
template <typename T>
class Own {
 public:
  explicit Own(std::unique_ptr<T> own) : own_(std::move(own)) {}
  T* operator->() const { return &**this; }
  T& operator*() const {
    if (!own_) throw Error("an object of stampede", "it was moved from", "use the one that it was moved to");
    return *own_;
  }

 private:
  std::unique_ptr<T> own_;
};

// What a call throws that was ended by a StopScope's flag: nothing half done is kept. Not an Error: nothing is wrong
// with what was being read, so nobody who collects mistakes may collect it.
class STAMPEDE_EXPORT Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// While it lives, the calls of this thread (of a Session, an Environment, a CatalogueReader …) look at this flag,
// however deep in what runs long, and end once it is true; it may be set from another thread, or in a signal's handler.
// Null: none.
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
