// The operations that a world has been given, so kept that a snapshot need not copy them.
#pragma once

#include <memory>
#include <vector>

#include "engine/sim/world.h"

namespace stampede {

// A value: copies share what was added before, and what is added to one is not in the others. mark() makes copying
// cheap whatever the length; without it what was added since the last mark is copied.
class CommandLog {
 public:
  void add(Command command) { recent_.push_back(std::move(command)); }
  void mark();
  std::size_t size() const { return (marked_ ? marked_->size : 0) + recent_.size(); }
  std::vector<Command> commands() const;

 private:
  struct Part {
    Part(std::shared_ptr<Part> before, std::vector<Command> commands);
    ~Part();  // of any number of parts, without recursion
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    std::shared_ptr<Part> before;
    std::vector<Command> commands;
    std::size_t size = 0;  // with all before
  };
  std::shared_ptr<Part> marked_;
  std::vector<Command> recent_;
};

}  // namespace stampede
