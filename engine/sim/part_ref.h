// How bodies and their parts are named in numbers.
#pragma once

#include <compare>

namespace stampede {

// A body and one of its parts; body -1 is the robot.
struct PartRef {
  int body = 0;
  int part = 0;
  friend auto operator<=>(const PartRef&, const PartRef&) = default;
};

}  // namespace stampede
