// The operations that a world has been given, so kept that a snapshot need not copy them.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/sim/world.h"

namespace stampede {

class CommandLog {
  struct Part;

 public:
  void add(Command command) { recent_.push_back(std::move(command)); }
  void clear() { back_to(nullptr); }
  std::size_t size() const;
  std::vector<Command> commands() const;

  // All that has been added, whatever comes later; null: nothing. Made and gone back to in a time that does not depend
  // on how much that is. Lifetime: its own; worlds share it.
  using Mark = std::shared_ptr<const Part>;
  Mark mark();
  void back_to(Mark mark);

 private:
  struct Part {
    Part(Mark before, std::vector<Command> commands);
    ~Part();  // of any number of parts, without recursion
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    mutable Mark before;
    std::vector<Command> commands;
    std::size_t size = 0;  // with all before
  };
  Mark marked_;
  std::vector<Command> recent_;  // added since
};

}  // namespace stampede
