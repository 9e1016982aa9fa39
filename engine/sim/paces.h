// How fast an arm that an agent steers is where it touches things: shares of the speeds that it may have.
#pragma once

namespace stampede {

constexpr double kMeetingPace = 0.04;  // towards what it will touch, and against what it touches: 6 cm/s of the tip
constexpr double kHoldingPace = 0.15;  // while what it touches, such as a handle, is in its hand
constexpr double kYieldingPace = 0.2;  // of its fastest point, where that is in its hand or gives way, as a door does

}  // namespace stampede
