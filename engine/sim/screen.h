// Which configurations surely touch nothing, and which surely touch something: eight at a time, in single precision.
// Whoever asks decides the rest exactly, so that answers depend on neither rounding nor the processor. Room-internal.
#pragma once

#include <cstdint>

namespace stampede {

constexpr int kScreenLanes = 8;
constexpr int kScreenJoints = 16;
constexpr int kScreenDoubts = 64;

// A box or an upright cylinder, rounded or not, that contains a convex shape, in a frame: of the robot's base or of one
// of its joints. Its core is a row of balls that the shape contains.
struct ScreenShape {
  float turn[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // frame from shape, row by row
  float at[3] = {0, 0, 0};
  float half[3] = {0, 0, 0};  // of the box; of a cylinder the third alone
  float radius = 0;           // of the cylinder
  float rounding = 0;
  float ball = 0;      // radius of the ball around it
  bool exact = false;  // it is the shape and not just around it
  bool turned = false;
  bool excused = false;  // of a body's: does not count for the hand
  int core_axis = 0, core_count = 0;
  float core_reach = 0, core_radius = 0;  // centres of the outermost balls; of each ball
};

struct ScreenJoint {     // turns or slides along z
  float turn[9], at[3];  // frame before it from frame behind it, in its zero position
  bool slides = false;
};

struct ScreenLump {  // what moves as one: a part of the robot, or what it holds
  int frame = 0;     // of the joint that moves it, counted from 1; 0: stands still
  float middle[3] = {0, 0, 0}, ball = 0;
  int begin = 0, end = 0;  // its shapes
  bool hand = false;       // excused bodies do not count
};

struct ScreenMeeting {  // two lumps that must not meet
  int one = 0, other = 0;
};

struct ScreenDoubt {  // between a shape of a lump and one of a body or, other_lump, of another lump
  int shape = 0, other = 0;
  bool of_body = true;
  std::uint8_t lanes = 0;
};

struct alignas(32) ScreenBoxes {  // around eight obstacles; where there are fewer, empty ones
  float lower[3][kScreenLanes], upper[3][kScreenLanes];
};

struct ScreenTables {
  const ScreenJoint* joints = nullptr;
  const ScreenLump* lumps = nullptr;       // the hand first: it is what meets things
  const ScreenShape* shapes = nullptr;     // of the lumps
  const ScreenShape* obstacles = nullptr;  // of bodies within reach, in the frame of the base
  const ScreenBoxes* boxes = nullptr;      // of the obstacles, in their order
  const ScreenMeeting* meetings = nullptr;
  int joint_count = 0, lump_count = 0, obstacle_count = 0, meeting_count = 0;
  float slack = 0;  // m, more than all rounding
};

struct ScreenBatch {
  alignas(32) float positions[kScreenJoints][kScreenLanes];  // revolute: from -pi to pi
  alignas(32) float padding[kScreenLanes];
  // What is to be decided exactly, of lanes that do not surely touch; and the lanes of which there is more of it.
  ScreenDoubt doubts[kScreenDoubts];
  int doubt_count = 0;
  std::uint8_t overflowing = 0;
};

// The lanes that surely touch. With `any`, returns as soon as there is one; doubts are then of no use.
using Screen = std::uint8_t (*)(const ScreenTables& tables, ScreenBatch& batch, bool any);
std::uint8_t screen_plain(const ScreenTables& tables, ScreenBatch& batch, bool any);
Screen screen_avx2();     // null where the processor has none
Screen fastest_screen();  // that may be used, see may_use_avx2

}  // namespace stampede
