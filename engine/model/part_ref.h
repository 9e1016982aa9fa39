// How bodies and their parts are named in numbers.
#pragma once

#include <compare>

namespace stampede {

// A body and one of its parts. Bodies of robots are negative: -1 is robot 0, -2 robot 1 …
struct PartRef {
  int body = 0;
  int part = 0;
  static constexpr PartRef of_robot(int part, int robot = 0) { return {-1 - robot, part}; }
  constexpr bool on_robot() const { return body < 0; }
  constexpr int robot() const { return -1 - body; }  // of a part that is on one
  friend auto operator<=>(const PartRef&, const PartRef&) = default;
};

}  // namespace stampede
