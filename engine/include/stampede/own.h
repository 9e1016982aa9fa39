// What an object is made of.
#pragma once

#include <memory>
#include <utility>

#include "stampede/error.h"

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

}  // namespace stampede
