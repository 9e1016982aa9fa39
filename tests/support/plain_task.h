// A task, its predicates and its skills in plain C++: what an embedder without Lua would write.
#pragma once

#include <algorithm>

#include "engine/episode/runner.h"
#include "engine/motion/candidates.h"
#include "engine/start/declared.h"
#include "engine/start/predicates.h"
#include "engine/start/skills.h"
#include "engine/start/task.h"
#include "engine/start/world_view.h"
#include "tests/support/panda.h"

namespace stampede::plain {

inline Term var(const char* name) { return {true, name}; }

inline Domain domain() {
  Domain domain;
  domain.name = "plain";
  domain.types = {{"cube", "object"}, {"table", "object"}, {"hand", "object"}};
  domain.traits = {"graspable", "movable", "surface"};
  const Parameter hand{"hand", "hand", {}}, obj{"obj", "", {"movable"}}, below{"below", "", {"surface"}};
  domain.predicates = {{"hand_empty", {hand}, PredicateKind::basic, {}, "the hand is empty"},
                       {"holding", {hand, obj}, PredicateKind::basic, {}, "the hand holds the {obj}"},
                       {"on", {obj, below}, PredicateKind::basic, {}, "the {obj} is on the {below}"}};
  Action pick;
  pick.name = pick.skill = "pick";
  pick.parameters = {obj, below, hand};
  pick.precondition = conjunction({atom("on", {var("obj"), var("below")}), atom("hand_empty", {var("hand")})});
  pick.effects = {{{}, {}, "holding", {var("hand"), var("obj")}, false},
                  {{}, {}, "hand_empty", {var("hand")}, true},
                  {{}, {}, "on", {var("obj"), var("below")}, true}};
  Action place;
  place.name = place.skill = "place";
  place.parameters = {obj, below, hand};
  place.precondition = atom("holding", {var("hand"), var("obj")});
  place.effects = {{{}, {}, "on", {var("obj"), var("below")}, false},
                   {{}, {}, "hand_empty", {var("hand")}, false},
                   {{}, {}, "holding", {var("hand"), var("obj")}, true}};
  domain.actions = {pick, place};
  return domain;
}

class PlainSymbols : public Symbols {
 public:
  const Domain& domain() const override { return domain_; }
  PredicateTraits traits(const std::string& predicate) const override {
    PredicateTraits traits;
    traits.settle_s = 0.1;
    if (predicate == "holding") traits.functional = 1, traits.mutex = {"hand_empty"};
    return traits;
  }
  Value value(const Fact& fact, const WorldView& view) override {
    if (fact.predicate == "on") return {view.supports(fact.arguments[1], fact.arguments[0]).holds, {}};
    if (fact.predicate == "holding") return {view.grasped(fact.arguments[1]).holds, {}};
    return {view.grasped_object().empty(), {}};
  }
  std::vector<Placement> sample(const Fact& fact, const WorldView& view, const CollisionState& state, RandomKey key,
                                int most) override {
    if (fact.predicate != "on") return {};
    const Object &obj = view.object(fact.arguments[0]), &below = view.object(fact.arguments[1]);
    std::vector<Placement> placements;
    for (const Transform& pose : below.type == "cube" ? stack_spots({state, view.world(), obj, key, most}, below)
                                                      : free_spots({state, view.world(), obj, key, most}, below))
      placements.push_back({obj.name, pose});
    return placements;
  }

 private:
  Domain domain_ = plain::domain();
};

// Runs a fixed list of calls that is made when the skill starts.
class CallList : public SkillRun {
 public:
  explicit CallList(std::vector<RobotCall> calls) : calls_(std::move(calls)) {}
  RobotCall next(const WorldView& view) override {
    if (next_ >= calls_.size()) return robot_call::Done{};
    RobotCall call = calls_[next_++];
    if (auto* line = std::get_if<robot_call::MoveLine>(&call))  // offsets from where the tip is by then
      line->target = translation(line->target.translation()) * view.world().world_from_tip();
    return call;
  }

 private:
  std::vector<RobotCall> calls_;
  std::size_t next_ = 0;
};

class PlainSkills : public SkillLibrary {
 public:
  PlainSkills() {
    const Domain vocabulary = plain::domain();
    pick_ = {"pick",
             vocabulary.actions[0].parameters,
             {{"grasp", ContinuousInfo::Source::grasps, {}, {}, {}, "", "", "obj", {}},
              {"height", ContinuousInfo::Source::value, {0.1}, {0.02}, {0.3}, "m", "world", "", {}}},
             ControllerKind::joint_position,
             0,
             "pick up the {obj}",
             {},
             {"pick"}};
    place_ = {"place",
              vocabulary.actions[1].parameters,
              {{"spot", ContinuousInfo::Source::sample, {}, {}, {}, "", "", "", {"on", {"obj", "below"}}}},
              ControllerKind::joint_position,
              0,
              "put the {obj} on the {below}",
              {},
              {"place"}};
  }
  const SkillInfo* skill(const std::string& name) const override {
    return name == "pick" ? &pick_ : name == "place" ? &place_ : nullptr;
  }
  std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) override {
    using namespace robot_call;
    const double wide = view.scene().robot.opening_max;
    if (call.skill == "pick") {
      const GraspCandidate& grasp = *call.continuous[0].grasp;
      return std::make_unique<CallList>(std::vector<RobotCall>{
          Hand{wide, 20, ""}, MoveThrough{{{"approach", grasp.world_from_approach}, {"grasp", grasp.world_from_tip}}},
          Hand{0, grasp.force, call.arguments[0]}, MoveLine{translation(0, 0, call.continuous[1].record.values[0])}});
    }
    const Transform object_from_tip = view.world_from(call.arguments[0]).inverse() * view.world().world_from_tip();
    const Transform down = translation(0, 0, 0.001) * *call.continuous[0].pose * object_from_tip;
    return std::make_unique<CallList>(
        std::vector<RobotCall>{MoveThrough{{{"approach", translation(0, 0, 0.08) * down}, {"place", down}}}, Wait{0.2},
                               Hand{wide, 20, ""}, MoveLine{translation(0, 0, 0.08)}});
  }

 private:
  SkillInfo pick_, place_;
};

// Stack cube1 on cube2, among others.
inline Task stack_task(int cubes = 3) {
  Task task;
  task.name = "plain_stack";
  task.scene = table_scene(cubes);
  for (Body& body : task.scene.bodies)
    if (body.name == "table") body.parts[0].shapes[0].size = {0.36, 0.6, 0.05};
  for (int i = 1; i <= cubes; ++i) {
    task.unplaced.push_back("cube" + std::to_string(i));
    task.init.push_back({{"on", {task.unplaced.back(), "table"}}, false});
  }
  task.goal = atom("on", {{false, "cube1"}, {false, "cube2"}});
  task.instructions = {"stack the first cube on the second"};
  return task;
}

inline TaskDraw stack_draw(int cubes = 3) {
  return [cubes](int) { return stack_task(cubes); };
}

}  // namespace stampede::plain
