// How fast an arm that an agent steers is where it touches things: shares of the speeds that it may have.
#pragma once

namespace stampede {

constexpr double kPushingPace = 0.06;  // against what it touches
constexpr double kHoldingPace = 0.15;  // while what it touches, such as a handle, is in its hand

}  // namespace stampede
