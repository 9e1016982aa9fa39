#include "engine/rollout/skill_draws.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/planner.h"
#include "engine/rollout/call_motion.h"
#include "engine/start/part_questions.h"

namespace stampede {
namespace {

// The argument bound to a parameter's name; a name that is no parameter stands for itself.
std::string argument(const std::vector<Parameter>& parameters, const std::vector<std::string>& arguments,
                     const std::string& name) {
  for (std::size_t i = 0; i < parameters.size() && i < arguments.size(); ++i)
    if (parameters[i].name == name) return arguments[i];
  return name;
}

std::vector<double> seven(const Transform& transform) {
  const Pose pose = to_pose(transform);
  std::vector<double> values(pose.position.begin(), pose.position.end());
  values.insert(values.end(), pose.quaternion.begin(), pose.quaternion.end());
  return values;
}

// Uniform where both bounds are finite; else it stays at its default.
void draw_within(const ContinuousInfo& info, RandomKey key, ParameterRecord& record) {
  if (info.source != ContinuousInfo::Source::value) return;
  Random random(key);
  for (std::size_t i = 0; i < record.values.size(); ++i) {
    if (!std::isfinite(info.lower[i]) || !std::isfinite(info.upper[i])) continue;
    record.values[i] = random.between(info.lower[i], info.upper[i]);
    record.chosen_by = ChosenBy::agent;
  }
}

Reason draw_grasp(Rollout& rollout, const SkillContext& context, const ContinuousInfo& info, ContinuousValue& value,
                  std::string& detail, Impasse* impasse) {
  const std::string name = argument(context.info->parameters, context.arguments, info.object);
  const auto space = planning_space(rollout, touchable(rollout, context));
  const int wanted = context.attempt % kGraspCandidates;  // those behind it need not be looked for
  const auto grasps = [&](const std::optional<PartWay>& follow, double from, double to) {
    return grasps_to_go(rollout.view(), *space, name, follow, from, to, context.key.with(info.name), wanted + 1);
  };
  const std::optional<PartWay> way = way_to(rollout.view(), name, info.to);
  auto candidates =
      way ? grasps(way, rollout.view().joint(name), rollout.view().object(name).numbers.at(info.to)) : grasps({}, 0, 0);
  if (candidates.empty() && way) candidates = grasps({}, 0, 0);  // perhaps it moves a little all the same
  if (candidates.empty()) {
    detail = "no grasp of " + name + " is reachable and free";
    if (context.mode.explain || impasse != nullptr) {
      std::vector<Looked> looked =
          look_at_grasps(*space, rollout.world(), rollout.view().object(name), planning_start(rollout.world()),
                         context.key.with(info.name), impasse != nullptr);
      detail += ": " + why_no_grasp(looked);
      if (impasse != nullptr) impasse->subject = name, impasse->looked = std::move(looked);
    }
    return Reason::no_grasp;
  }
  if (impasse != nullptr) {  // whatever becomes of it
    impasse->subject = name;
    impasse->looked = look_at_grasps(*space, rollout.world(), rollout.view().object(name),
                                     planning_start(rollout.world()), context.key.with(info.name), false);
  }
  const GraspCandidate& grasp = candidates[static_cast<std::size_t>(wanted) % candidates.size()];
  value.grasp = grasp;
  value.record.values = seven(grasp.object_from_tip);
  value.record.values.push_back(grasp.width);
  value.record.frame = name;
  value.record.chosen_by = ChosenBy::stream;
  return Reason::none;
}

// Where the hand must be to put the held object to a place, and what keeps the arm from it.
class PlaceTrial {
 public:
  PlaceTrial(const Rollout& rollout, const CollisionState& space, RandomKey key)
      : world_(rollout.world()), space_(space), letting_go_(space), key_(key) {
    letting_go_.set_opening(space.opening() + kRoomToLetGo_m);
  }
  struct Answer {
    bool free = false, free_but_tight = false;  // tight: the fingers have no room to open
    std::vector<JointVector> ways;
    Transform world_from_tip;
  };
  Answer ask(const Transform& place, const Transform& object_from_tip) const {
    Answer answer;
    answer.world_from_tip = place * object_from_tip;
    // As many as a grasp is given: the nearest one may touch something.
    answer.ways = world_.arm().solutions(answer.world_from_tip, planning_start(world_), key_, 3, 12);
    const auto free_in = [&](const CollisionState& state) {
      return std::any_of(answer.ways.begin(), answer.ways.end(), [&](const JointVector& q) { return state.free(q); });
    };
    answer.free = free_in(letting_go_);
    answer.free_but_tight = !answer.free && free_in(space_);
    return answer;
  }
  // For people, of what is not free. `measured`: also by how much.
  Looked judged(const Transform& place, const Answer& answer, bool measured) const {
    Looked looked{answer.ways.empty() ? Looked::Fate::out_of_reach : Looked::Fate::touches, place};
    if (!answer.ways.empty()) looked.touched = touched_in_all(letting_go_, answer.ways);
    if (!measured) return looked;
    if (answer.ways.empty()) {
      measure_reach(world_.arm(), world_.scene().robot, answer.world_from_tip, planning_start(world_), key_, looked);
      return looked;
    }
    const Transform tip_from_place = answer.world_from_tip.inverse() * place;
    const auto free = [&](const Transform& tip) {
      return letting_go_.hand_free(tip) && letting_go_.body_free(*letting_go_.held(), tip * tip_from_place, 0);
    };
    if (!free(answer.world_from_tip)) looked.missed_m = way_to_free(answer.world_from_tip, level_directions(), free);
    return looked;
  }

 private:
  const World& world_;
  const CollisionState& space_;
  CollisionState letting_go_;
  RandomKey key_;
};

Reason draw_sample(Rollout& rollout, Symbols& symbols, const SkillContext& context, const ContinuousInfo& info,
                   ContinuousValue& value, std::string& detail, Impasse* impasse) {
  constexpr int kSamples = 64, kMostMeasured = 12;
  Fact fact{info.literal.predicate, {}};
  for (const std::string& name : info.literal.arguments)
    fact.arguments.push_back(argument(context.info->parameters, context.arguments, name));
  const auto space = planning_space(rollout, touchable(rollout, context));
  const PlaceTrial trial(rollout, *space, context.key.with("ik"));
  int wanted = context.attempt % kPlaceCandidates;
  std::optional<Transform> tight;
  std::vector<Looked> looked, turned_down;
  const bool explain = context.mode.explain || impasse != nullptr;
  int tried = 0;
  const Symbols::Watching watching(symbols, impasse != nullptr ? &turned_down : nullptr);
  const auto placements = symbols.sample(fact, rollout.view(), *space, context.key.with(info.name), kSamples);
  for (const Placement& placement : placements) {
    const Transform* pose = std::get_if<Transform>(&placement.value);
    if (pose == nullptr) continue;
    ++tried;
    if (space->held() && rollout.view().part_of(placement.object).body == *space->held()) {
      const Transform object_from_tip =
          rollout.view().world_from(placement.object).inverse() * rollout.world().world_from_tip();
      const PlaceTrial::Answer answer = trial.ask(*pose, object_from_tip);
      if (!answer.free) {
        if (!tight && answer.free_but_tight) tight = *pose;
        if (explain) looked.push_back(trial.judged(*pose, answer, impasse != nullptr && tried <= kMostMeasured));
        continue;
      }
    }
    if (impasse != nullptr) looked.push_back({Looked::Fate::usable, *pose});
    if (!value.pose || wanted-- > 0) value.pose = *pose;
    if (wanted < 0 || context.attempt == 0) break;
  }
  if (!value.pose) value.pose = tight;
  if (impasse != nullptr) {
    impasse->subject = fact.arguments.empty() ? "" : fact.arguments.front();
    impasse->looked = looked;
    impasse->looked.insert(impasse->looked.end(), turned_down.begin(), turned_down.end());
  }
  if (!value.pose) {
    detail = "no reachable and free pose makes " + to_text(fact) + " true";
    if (tried == 0) detail += ": there is no room for any";
    if (tried > 0 && explain) detail += ": of " + std::to_string(tried) + " " + causes_of(looked).text();
    return Reason::no_placement;
  }
  value.record.values = seven(*value.pose);
  value.record.frame = "world";
  value.record.chosen_by = ChosenBy::stream;
  return Reason::none;
}

Transform pose_of(const std::vector<double>& values) {
  Pose pose;
  std::copy_n(values.begin(), 3, pose.position.begin());
  std::copy_n(values.begin() + 3, 4, pose.quaternion.begin());
  return to_transform(pose);
}

// The grasp that somebody wants, seen from where the object is now.
GraspCandidate wanted_grasp(const Rollout& rollout, const std::string& name, const std::vector<double>& values) {
  constexpr double kApproach_m = 0.1, kRoom_m = 0.04;
  const Robot& robot = rollout.view().scene().robot;
  GraspCandidate grasp;
  grasp.object_from_tip = pose_of(values);
  grasp.world_from_tip = rollout.view().world_from(name) * grasp.object_from_tip;
  grasp.world_from_approach = grasp.world_from_tip * translation(0, 0, -kApproach_m);
  if (values.size() > 7) grasp.width = values[7];
  grasp.opening = std::min(robot.opening_max, grasp.width + kRoom_m);
  grasp.force = robot.grip_force;
  return grasp;
}

// What was set goes over what is there; false: nothing was.
bool set_value(const Rollout& rollout, const SkillContext& context, const ContinuousInfo& info,
               ContinuousValue& value) {
  bool found = false;
  for (const GivenSettings& given : context.given)
    for (const CallSettings::Value& one : given.set.values) {
      if (one.parameter != info.name) continue;
      found = true;
      value.record.chosen_by = given.by;
      if (one.component > 0)
        value.record.values[static_cast<std::size_t>(one.component) - 1] = one.values[0];
      else
        value.record.values = one.values;
    }
  if (!found || info.source == ContinuousInfo::Source::value) return found;
  if (info.source == ContinuousInfo::Source::sample) {
    value.pose = pose_of(value.record.values);
    value.record.frame = "world";
    return true;
  }
  const std::string name = argument(context.info->parameters, context.arguments, info.object);
  value.grasp = wanted_grasp(rollout, name, value.record.values);
  value.record.values = seven(value.grasp->object_from_tip);
  value.record.values.push_back(value.grasp->width);
  value.record.frame = name;
  return true;
}

}  // namespace

std::vector<PartRef> touchable(const Rollout& rollout, const SkillContext& context) {
  std::vector<std::string> names;
  if (rollout.keep) {
    names = context.arguments;
  } else {
    for (const ContinuousInfo& info : context.info->continuous)
      if (info.source == ContinuousInfo::Source::grasps)
        names.push_back(argument(context.info->parameters, context.arguments, info.object));
  }
  std::vector<PartRef> parts;
  for (const std::string& name : names) {
    const Object* thing = rollout.view().scene().object(name);
    if (thing == nullptr || thing->body.empty()) continue;
    const Scene& scene = rollout.view().scene();
    if (thing->kind == ObjectKind::part) {
      const std::vector<PartRef> all = with_mounted(scene, rollout.view().part_of(name));
      parts.insert(parts.end(), all.begin(), all.end());
    } else if (thing->kind == ObjectKind::region) {  // the part that it is fixed to
      parts.push_back({scene.body_index(thing->body), thing->part});
    } else {
      parts.push_back(rollout.view().part_of(name));
    }
  }
  return parts;
}

Reason draw_continuous(Rollout& rollout, Symbols& symbols, const SkillContext& context, SkillCall& call,
                       std::string& detail, Impasse* impasse) {
  for (const ContinuousInfo& info : context.info->continuous) {
    ContinuousValue value;
    value.record = {info.name, info.initial, {}, info.unit, info.frame, ChosenBy::default_value};
    if (context.mode.random_parameters) draw_within(info, context.key.with(info.name), value.record);
    Reason reason = Reason::none;
    if (!set_value(rollout, context, info, value)) {
      if (info.source == ContinuousInfo::Source::grasps)
        reason = draw_grasp(rollout, context, info, value, detail, impasse);
      if (info.source == ContinuousInfo::Source::sample)
        reason = draw_sample(rollout, symbols, context, info, value, detail, impasse);
    }
    if (reason != Reason::none) return reason;
    call.continuous.push_back(std::move(value));
  }
  return Reason::none;
}

}  // namespace stampede
