// What a skill asks of a robot, one thing at a time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/reason.h"
#include "engine/geometry/transform.h"
#include "engine/model/kinematics.h"
#include "engine/motion/targets.h"
#include "engine/start/call_settings.h"

namespace stampede {

// A skill as a task's steps or another skill's script ask for it.
struct AskedCall {
  std::string skill, case_name;
  std::vector<std::string> arguments;  // one per parameter; empty: left open
  CallSettings set;
};

// What a skill asks of a robot of the scene, one at a time. Frames: poses are of the tip in the world.
namespace robot_call {
// Ways that a Follow travels. Poses and points are of the world, but for what a Tilt says.
namespace piece {
struct Offset {
  Vector3 by = Vector3::Zero();  // straight, from where the piece begins
};
struct Line {
  Transform target = Transform::Identity();  // straight to there, turning evenly
};
struct Arc {  // around a line of the world
  double angle = 0;
  Vector3 axis = Vector3::UnitZ(), point = Vector3::Zero();
  bool turn = true;  // the tool turns with it, else it keeps its orientation
};
struct PartArc {  // as a part moves while its joint turns by the angle
  double angle = 0;
  std::string part;
  bool turn = true;
};
struct Tilt {  // about an axis of the tool's own frame, as it is when the piece begins
  double angle = 0;
  Vector3 axis = Vector3::UnitZ();
  Vector3 point = Vector3::Zero();  // in the tool's frame, or
  bool in_world = false;            // in the world
};
}  // namespace piece
struct Piece {
  std::variant<piece::Offset, piece::Line, piece::Arc, piece::PartArc, piece::Tilt> way;
  double speed = 0.25, turn_speed = 1.0;  // m/s of the tip and rad/s of the tool, at most
  bool stop = false;                      // rests at its end; the last one does
  std::string name = {};                  // of the via at its end; empty: none
  std::optional<double> opening = {};     // m, to which the hand begins to open or close as the piece begins
};
struct MoveThrough {
  std::vector<ToolTarget> targets;
  int robot = 0;
  // From the last target the arm must be able to take this part to `position`, its hand as wide as `opening`, m.
  std::string then_part = {};
  double position = 0, pivot = 0, opening = 0, retreat = 0;
  std::vector<Piece> then_follow = {};  // or to travel these, with nothing touched but the skill's own objects
};                                      // planned; stops at the last only
struct MoveLine {
  Transform target;
  double speed = 0.25;  // m/s
  bool stop_on_contact = false;
  double force = 3;                // N, that stops it
  bool tolerate = false;           // falling short is no failure
  bool keep_clear = false;         // refused where anything is touched but the skill's own objects
  bool as_far_as_it_goes = false;  // where the arm cannot follow to the end: at least half of it
  double most_force = 0;           // N: the arm gives way, and stops where contact asks for more; 0: it does not
  double press = 0;                // as of Follow
  Vector3 press_along = Vector3::Zero();
  double search = 0;             // m around the line in which it looks for a way on where contact of `force` stops it
  double search_pitch = 0.0008;  // m from one turn of the spiral to the next
  std::optional<double> opening = {};  // m, to which the hand begins to open or close as the line begins
  std::string kind = "move_line";
  int robot = 0;
};
struct Follow {
  std::vector<Piece> pieces;
  double blend = 0.01;    // m, see PiecesOptions
  double most_force = 0;  // as of MoveLine
  double press = 0;       // N along the tool's z, or along `press_along` where that is not zero, while it moves:
  Vector3 press_along = Vector3::Zero();      // world
  bool keep_clear = false, tolerate = false;  // as of MoveLine
  int robot = 0;
};
struct MoveJoints {
  JointVector target;
  int robot = 0;
};  // planned
struct Hand {
  double opening = 0;
  double force = 20;
  std::string expect;
  int robot = 0;
};  // expect: object to be grasped
struct MovePart {
  std::string object;
  double position = 0;
  double speed = 0.1;
  int robot = 0;
  double most_force = 0;           // as of MoveLine
  double retreat = 0;              // m that the hand must be able to go straight back at the end
  double pivot = 0;                // rad either way that the handle may turn in the hand, about the joint's axis
  bool as_far_as_it_goes = false;  // where the arm cannot follow the whole way: as much of it as it can
  std::optional<double> then_to;   // on to which another one takes it: the arm is to be able to follow until there
};                                 // the held handle's joint; arcs too
// Questions: planned from here and now, nothing moves. The run is told the answer before it is asked for its next call.
struct ReachOfPart {  // the position nearest to `position` that the arm can take the held part to
  std::string object;
  double position = 0, pivot = 0, retreat = 0;
};
struct FindGrasp {  // of a part: from which the arm can take it to `position`, or else as far as possible
  std::string object;
  double position = 0, pivot = 0, retreat = 0;
};
struct Wait {
  double seconds = 0;
};
struct Policy {  // acts frame by frame, until it is done, the skill's effect holds, or time is up
  std::string name;
  double seconds = 10;
  bool until_effect = true;
  std::map<std::string, std::vector<double>> with;
};
struct RunSkill {
  AskedCall call;
};  // a child skill segment
struct Done {};
struct Fail {
  Reason reason = Reason::script_error;
  std::string detail;
};
}  // namespace robot_call
using RobotCall =
    std::variant<robot_call::MoveThrough, robot_call::MoveLine, robot_call::MoveJoints, robot_call::Hand,
                 robot_call::MovePart, robot_call::Wait, robot_call::Policy, robot_call::RunSkill, robot_call::Done,
                 robot_call::Fail, robot_call::Follow, robot_call::ReachOfPart, robot_call::FindGrasp>;

// To a question. Nothing of what was asked for: there is none.
struct RobotAnswer {
  std::optional<double> reach;
  std::optional<GraspCandidate> grasp;
};

}  // namespace stampede
