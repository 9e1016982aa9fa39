// What an episode needs from outside. episode implements none of these: scripting does for Lua, tests do in C++.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/randomise.h"
#include "engine/motion/candidates.h"
#include "engine/record/observation.h"
#include "engine/record/record.h"
#include "engine/start/world_view.h"
#include "engine/symbolic/symbols.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {

struct Literal {
  Fact fact;
  bool negated = false;
};

// A way to make a fact true when a scene is made: a pose of a body or region, or a joint position.
struct Placement {
  std::string object;
  std::variant<Transform, double> value;  // world_from_object, or position of the part's joint
};

// What a caller sets of a skill's call instead of leaving it to be drawn.
struct CallSettings {
  struct Value {
    std::string parameter;  // a declared continuous one
    int component = 0;      // from 1; 0: all of it
    std::vector<double> values;
    friend bool operator==(const Value&, const Value&) = default;
  };
  std::vector<Value> values;  // later ones win
  std::optional<ControllerKind> controller;
  bool empty() const { return values.empty() && !controller; }
  friend bool operator==(const CallSettings&, const CallSettings&) = default;
};

struct TaskStep {
  PlanStep step;  // action or skill; trailing arguments may be missing or empty
  CallSettings set;
};

// A part of a task that an episode's frames are told apart by.
struct Subgoal {
  std::string name;
  Formula formula;
  std::string sentence;  // of the author, filled in for this variation; may be empty
};

// One draw of a task: all that is decided before physics runs. What a run asks for changes these values (altered_task).
struct Task {
  std::string name;
  std::string variation;  // canonical text
  std::map<std::string, std::string> axes;
  Scene scene;                                 // all drawn values in it; literals of init then place what has no pose
  std::optional<Randomisation> randomisation;  // of the world
  ObservationChoice observation;               // what the run asks for goes before it
  std::vector<std::string> unplaced;           // free objects that a literal of init must place
  std::vector<std::string> clutter;            // of these, things that have no part in the task and keep out of its way
  std::vector<Literal> init;                   // in the order in which they are made true
  // Must hold at the start too; bindings and alternatives are drawn, and go before a literal of init about the same.
  std::optional<Formula> where;
  std::set<std::string> named;  // predicates that its functions, below, read by name
  std::vector<Fact> told;       // of what nobody can see at the start, that which the instructions tell
  Formula goal;
  std::vector<Formula> stages;  // in_order { … }; goal is their conjunction
  std::optional<std::vector<TaskStep>> steps;
  std::vector<Subgoal> subgoals;  // in the order in which they come true
  bool empty_hand = false;        // the goal asks for it because all do, not by a word of its own
  double hold_s = 1.0;            // the goal must stay true for this long at the end
  double horizon_s = 120;
  std::string motion_planner;             // of the world; empty: our own. What the run asks for goes before it
  std::vector<std::string> instructions;  // filled in for this variation

  // What only the running world tells. Empty: asks for nothing, never, 0.
  std::function<bool(const WorldView&)> also;      // a further test beside the goal
  std::function<bool(const WorldView&)> fails;     // ends the episode as failed
  std::function<double(const WorldView&)> reward;  // shaped, added to 1 at success
};

// Draw number `draw` of one task, variation and seed. Repeatable; other draws may be asked for in between.
using TaskDraw = std::function<Task(int draw)>;

// Of which arguments a predicate can hold at all: pairs that touch or are near each other; held: the last argument is
// what the pads grasp.
enum class Pairs { all, touching, near, held };

struct PredicateTraits {
  double settle_s = 0;           // a shorter change is noise
  bool momentary = false;        // read at every physics step, no settle time
  bool remember = false;         // stays true once true
  bool ends_when_moved = false;  // every action that moves one of its things deletes it
  Pairs requires_pairs = Pairs::all;
  int functional = -1;             // index of the parameter that has at most one value for given others; -1: none
  std::vector<std::string> mutex;  // predicates that cannot hold of the same first argument
  // Of its margins: `m`, `rad`, or kUnitOfJoint; empty: it has none, or does not say.
  std::string margin_unit = {};
  bool only_named = false;  // followed in those tasks alone that name it
  // Of a relation that no skill declares, such as left_of: skills that make it by where they put its first thing, and
  // all that end it, with the parameter that they move.
  std::vector<std::string> made_by = {};
  std::vector<std::pair<std::string, std::string>> moved_by = {};
  bool sampled = true;  // it has a `sample`, which makes it
};
inline constexpr const char* kUnitOfJoint = "m or rad";  // that of the joint of the first argument

class Symbols {
 public:
  virtual ~Symbols() = default;
  virtual const Domain& domain() const = 0;
  virtual PredicateTraits traits(const std::string& predicate) const = 0;
  struct Value {
    bool holds = false;
    std::optional<double> margin;
    bool asked_arm = false;  // what the arm can do was asked for, which takes long
  };
  // Of a basic or fixed predicate. Repeatable: reads the view only.
  virtual Value value(const Fact& fact, const WorldView& view) = 0;
  // Can facts of this predicate be hidden from everybody's eyes, and is this one to be seen now?
  virtual bool can_hide(const std::string&) const { return false; }
  virtual bool observable(const Fact&, const WorldView&) { return true; }
  // Ways to make the fact true, best or random first, at most `most`; empty when the predicate has no sample.
  virtual std::vector<Placement> sample(const Fact& fact, const WorldView& view, const CollisionState& state,
                                        RandomKey key, int most) = 0;
  // From now on places that sampling turns down, and grasps that keep a fact from holding, are added there, for people:
  // that takes longer; null: nobody asks.
  virtual void watch(std::vector<Looked>* /*turned_down*/) {}
  // Where the author asks for the fact: `tasks/stack.lua:8`; empty: not known.
  virtual std::string asked_at(const Fact&) const { return {}; }
  class Watching {  // for a scope
   public:
    Watching(Symbols& symbols, std::vector<Looked>* turned_down) : symbols_(symbols) { symbols.watch(turned_down); }
    ~Watching() { symbols_.watch(nullptr); }
    Watching(const Watching&) = delete;
    Watching& operator=(const Watching&) = delete;

   private:
    Symbols& symbols_;
  };
};

// A declared continuous parameter of a skill.
struct ContinuousInfo {
  enum class Source { value, grasps, sample };
  std::string name;
  Source source = Source::value;
  std::vector<double> initial, lower, upper;  // value: equal lengths (lower, upper may be infinite)
  std::string unit, frame;
  std::string object;   // grasps: the parameter that names the object
  Fact literal;         // sample: predicate and parameter names whose sample gives poses of its first argument
  std::string to = {};  // grasps: the number of the object that says up to where it must be taken; or empty
};

struct SkillInfo {
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<ContinuousInfo> continuous;
  ControllerKind controller = ControllerKind::joint_position;
  double stiffness = 0;
  std::string label;                    // "pick up the {obj}"
  std::vector<std::string> forgets;     // predicates whose facts contact leaves uncertain
  std::vector<std::string> actions;     // names in the domain, one per case
  std::vector<std::string> moves = {};  // parameters that it moves
  std::vector<std::string> verbs = {};  // that tell of it in sentences, the first its own
  std::string replaces = {};            // the skill whose place it takes where a task or world asks for it; empty: none
};

struct ContinuousValue {
  ParameterRecord record;
  std::optional<GraspCandidate> grasp;  // source grasps
  std::optional<Transform> pose;        // source sample: world_from_object
};

struct SkillCall {
  std::string skill, case_name;
  std::vector<std::string> arguments;       // names of objects, one per parameter
  std::vector<ContinuousValue> continuous;  // one per declared parameter, in order
  ControllerKind controller = ControllerKind::joint_position;
  double stiffness = 0;
};

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

// One run of a skill. next() is called with the view as it is when the previous call has ended well; a call that
// failed ends the run. Never copied: undo starts a new one.
class SkillRun {
 public:
  virtual ~SkillRun() = default;
  virtual RobotCall next(const WorldView& view) = 0;
  virtual void answer(const RobotAnswer&) {}  // to the question that the last call was
};

class SkillLibrary {
 public:
  virtual ~SkillLibrary() = default;
  virtual const SkillInfo* skill(const std::string& name) const = 0;
  virtual std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) = 0;
};

}  // namespace stampede
