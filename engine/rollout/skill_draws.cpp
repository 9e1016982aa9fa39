#include "engine/rollout/skill_draws.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/candidates.h"
#include "engine/motion/planner.h"
#include "engine/rollout/call_motion.h"
#include "engine/start/part_questions.h"
#include "engine/start/relations.h"

namespace stampede {
namespace {

// The argument bound to a parameter's name; a name that is no parameter stands for itself.
std::string argument(const SkillContext& context, const std::string& name) {
  const std::vector<Parameter>& parameters = context.info->parameters;
  for (std::size_t i = 0; i < parameters.size() && i < context.arguments.size(); ++i)
    if (parameters[i].name == name) return context.arguments[i];
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
      note_shortfall(world_.arm().shortfall(answer.world_from_tip, planning_start(world_), key_), world_.scene().robot,
                     looked);
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

Transform from_seven(const std::vector<double>& values) {
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
  grasp.object_from_tip = from_seven(values);
  grasp.world_from_tip = rollout.view().world_from(name) * grasp.object_from_tip;
  grasp.world_from_approach = grasp.world_from_tip * translation(0, 0, -kApproach_m);
  if (values.size() > 7) grasp.width = values[7];
  grasp.opening = std::min(robot.opening_max, grasp.width + kRoom_m);
  grasp.force = robot.grip_force;
  return grasp;
}

// Draws for one call: what its streams have, and where somebody asks what was looked at.
class StreamDraws {
 public:
  StreamDraws(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const SkillContext& context, Impasse* impasse)
      : rollout_(rollout), symbols_(symbols), skills_(skills), context_(context), impasse_(impasse) {}
  bool set(const ContinuousInfo& info, ContinuousValue& value) const;
  Reason grasp(const ContinuousInfo& info, ContinuousValue& value);
  Reason place(const ContinuousInfo& info, ContinuousValue& value);
  const std::string& detail() const { return detail_; }  // of a reason

 private:
  // What became of the places that were drawn.
  struct Places {
    std::optional<Transform> chosen, tight;
    std::vector<Looked> looked;
    int tried = 0;
  };
  std::vector<GraspCandidate> candidates(GraspQuery query, int most, const std::optional<PartMove>& follow) const;
  std::optional<SkillContext> next_place_of(const std::string& object) const;
  bool finds_place(SkillContext next, const std::string& object, const GraspCandidate& grasp) const;
  bool first_motion_possible(const SkillContext& next, std::vector<ContinuousValue> drawn) const;
  std::vector<Placement> ways(const ContinuousInfo& info, const Fact& fact, const CollisionState& space) const;
  Places look_at(const std::vector<Placement>& placements, const CollisionState& space) const;
  bool explains() const { return context_.mode.explain || impasse_ != nullptr; }

  Rollout& rollout_;
  Symbols& symbols_;
  SkillLibrary& skills_;
  const SkillContext& context_;
  Impasse* impasse_;
  std::string detail_;
};

// What was set goes over what is there; false: nothing was.
bool StreamDraws::set(const ContinuousInfo& info, ContinuousValue& value) const {
  bool found = false;
  for (const GivenSettings& given : context_.given)
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
    value.pose = from_seven(value.record.values);
    value.record.frame = "world";
    return true;
  }
  const std::string name = argument(context_, info.object);
  value.grasp = wanted_grasp(rollout_, name, value.record.values);
  value.record.values = seven(value.grasp->object_from_tip);
  value.record.values.push_back(value.grasp->width);
  value.record.frame = name;
  return true;
}

// The plan's next step that draws where the object goes, as a call.
std::optional<SkillContext> StreamDraws::next_place_of(const std::string& object) const {
  for (const PlanStep& step : context_.mode.then) {
    const Action* action = rollout_.domain().action(step.action);
    const SkillInfo* info = action == nullptr ? nullptr : skills_.skill(action->skill);
    if (info == nullptr || std::ranges::count(step.arguments, "") > 0) continue;  // what is left open is not known yet
    SkillContext next{action, info, step.arguments, context_.key.with("next")};
    const bool places = std::ranges::any_of(info->continuous, [&](const ContinuousInfo& one) {
      return one.source == ContinuousInfo::Source::sample && argument(next, one.literal.arguments.front()) == object;
    });
    if (places) return next;
  }
  return std::nullopt;
}

bool StreamDraws::finds_place(SkillContext next, const std::string& object, const GraspCandidate& grasp) const {
  constexpr int kPlacesTried = 4;
  const Rollout::Imagining held(rollout_, {rollout_.view().part_of(object), grasp.world_from_tip, grasp.width});
  for (next.attempt = 0; next.attempt < kPlacesTried; ++next.attempt) {
    DrawnParameters drawn = draw_continuous(rollout_, symbols_, skills_, next);
    if (drawn.reason != Reason::none) return false;
    if (first_motion_possible(next, std::move(drawn.values))) return true;
  }
  return false;
}

// The first that the call would ask for; fingers may be asked to move before.
bool StreamDraws::first_motion_possible(const SkillContext& next, std::vector<ContinuousValue> drawn) const {
  constexpr int kMostCalls = 8;
  const auto run =
      skills_.start({next.info->name, next.action->case_name, next.arguments, std::move(drawn)}, rollout_.view());
  for (int i = 0; i < kMostCalls; ++i) {
    const RobotCall call = run->next(rollout_.view());
    if (std::holds_alternative<robot_call::Hand>(call) || std::holds_alternative<robot_call::Wait>(call)) continue;
    return may_be_possible(rollout_, call, touchable(rollout_, next), next.key.with("motion"));
  }
  return true;
}

std::vector<GraspCandidate> StreamDraws::candidates(GraspQuery query, int most,
                                                    const std::optional<PartMove>& follow) const {
  constexpr int kMostLookedAt = 16;
  const std::string& object = query.object.name;
  if (const std::optional<SkillContext> next = next_place_of(object)) {
    int left = kMostLookedAt;
    query.wanted = [&](const GraspCandidate& grasp) { return left-- > 0 && finds_place(*next, object, grasp); };
    std::vector<GraspCandidate> found = grasps_to_go(query, most, follow);
    if (!found.empty()) return found;
    query.wanted = {};
  }
  return grasps_to_go(query, most, follow);
}

Reason StreamDraws::grasp(const ContinuousInfo& info, ContinuousValue& value) {
  const std::string name = argument(context_, info.object);
  const auto space = planning_space(rollout_, touchable(rollout_, context_));
  const int wanted = context_.attempt % kGraspCandidates;  // those behind it need not be looked for
  const GraspQuery query = grasp_query(rollout_.view(), *space, name, context_.key.with(info.name));
  const std::optional<PartMove> follow = part_move_to(rollout_.view(), name, info.to);
  std::vector<GraspCandidate> found = candidates(query, wanted + 1, follow);
  if (found.empty() && follow) found = candidates(query, wanted + 1, {});  // perhaps it moves a little
  if (found.empty()) {
    detail_ = "no grasp of " + name + " is reachable and free";
    if (explains()) {
      std::vector<Looked> looked = look_at_grasps(query, impasse_ != nullptr);
      detail_ += ": " + why_no_grasp(looked);
      if (impasse_ != nullptr) impasse_->subject = name, impasse_->looked = std::move(looked);
    }
    return Reason::no_grasp;
  }
  if (impasse_ != nullptr) {  // whatever becomes of it
    impasse_->subject = name;
    impasse_->looked = look_at_grasps(query, false);
  }
  const GraspCandidate& candidate = found[static_cast<std::size_t>(wanted) % found.size()];
  value.grasp = candidate;
  value.record.values = seven(candidate.object_from_tip);
  value.record.values.push_back(candidate.width);
  value.record.frame = name;
  value.record.chosen_by = ChosenBy::stream;
  return Reason::none;
}

// What the predicate samples; where the goal asks for relations that this skill makes, of these and more what meets
// them.
std::vector<Placement> StreamDraws::ways(const ContinuousInfo& info, const Fact& fact,
                                         const CollisionState& space) const {
  constexpr int kSamples = 64;
  const RandomKey key = context_.key.with(info.name);
  std::vector<Literal> asked = relations_asked(rollout_.task(), rollout_.facts());
  const auto gone = [&](const std::string& name) {  // imagined elsewhere: what is asked beside it is not in the way
    return std::ranges::find(rollout_.imagined_away, rollout_.view().part_of(name)) != rollout_.imagined_away.end();
  };
  std::erase_if(asked, [&](const Literal& literal) {
    const std::vector<std::string> makers = symbols_.traits(literal.fact.predicate).made_by;
    const auto& names = literal.fact.arguments;
    return std::ranges::find(makers, context_.info->name) == makers.end() || std::ranges::any_of(names, gone);
  });
  const bool about = std::ranges::any_of(asked, [&](const Literal& literal) {
    const auto& names = literal.fact.arguments;
    return std::ranges::find(names, fact.arguments.front()) != names.end();
  });
  if (!about) return symbols_.sample(fact, rollout_.view(), space, key, kSamples);
  return related_placements(asked, fact, rollout_.view(), space, symbols_, key, kSamples);
}

StreamDraws::Places StreamDraws::look_at(const std::vector<Placement>& placements, const CollisionState& space) const {
  constexpr int kMostMeasured = 12;
  const PlaceTrial trial(rollout_, space, context_.key.with("ik"));
  int wanted = context_.attempt % kPlaceCandidates;
  Places places;
  for (const Placement& placement : placements) {
    const Transform* pose = std::get_if<Transform>(&placement.value);
    if (pose == nullptr) continue;
    ++places.tried;
    if (space.held() && rollout_.view().part_of(placement.object).body == *space.held()) {
      const Transform object_from_tip =
          rollout_.view().world_from(placement.object).inverse() * rollout_.view().world_from_tip();
      const PlaceTrial::Answer answer = trial.ask(*pose, object_from_tip);
      if (!answer.free) {
        if (!places.tight && answer.free_but_tight) places.tight = *pose;
        const bool measured = impasse_ != nullptr && places.tried <= kMostMeasured;
        if (explains()) places.looked.push_back(trial.judged(*pose, answer, measured));
        continue;
      }
    }
    if (impasse_ != nullptr) places.looked.push_back({Looked::Fate::usable, *pose});
    if (!places.chosen || wanted-- > 0) places.chosen = *pose;
    if (wanted < 0 || context_.attempt == 0) break;
  }
  return places;
}

Reason StreamDraws::place(const ContinuousInfo& info, ContinuousValue& value) {
  Fact fact{info.literal.predicate, {}};
  for (const std::string& name : info.literal.arguments) fact.arguments.push_back(argument(context_, name));
  const auto space = planning_space(rollout_, touchable(rollout_, context_));
  std::vector<Looked> turned_down;
  const Symbols::Watching watching(symbols_, impasse_ != nullptr ? &turned_down : nullptr);
  const Places places = look_at(ways(info, fact, *space), *space);
  value.pose = places.chosen ? places.chosen : places.tight;
  if (impasse_ != nullptr) {
    impasse_->subject = fact.arguments.empty() ? "" : fact.arguments.front();
    impasse_->looked = places.looked;
    impasse_->looked.insert(impasse_->looked.end(), turned_down.begin(), turned_down.end());
  }
  if (!value.pose) {
    detail_ = "no reachable and free pose makes " + to_text(fact) + " true";
    if (places.tried == 0) detail_ += ": there is no room for any";
    if (places.tried > 0 && explains())
      detail_ += ": of " + std::to_string(places.tried) + " " + causes_of(places.looked).text();
    return Reason::no_placement;
  }
  value.record.values = seven(*value.pose);
  value.record.frame = "world";
  value.record.chosen_by = ChosenBy::stream;
  return Reason::none;
}

}  // namespace

std::vector<PartRef> touchable(const Rollout& rollout, const SkillContext& context) {
  std::vector<std::string> names;
  if (rollout.keep) {
    names = context.arguments;
  } else {
    for (const ContinuousInfo& info : context.info->continuous)
      if (info.source == ContinuousInfo::Source::grasps) names.push_back(argument(context, info.object));
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
  if (rollout.keep && std::ranges::find(parts, rollout.keep->body, &PartRef::body) == parts.end()) return {};
  return parts;
}

DrawnParameters draw_continuous(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const SkillContext& context,
                                Impasse* impasse) {
  StreamDraws draws(rollout, symbols, skills, context, impasse);
  DrawnParameters drawn;
  for (const ContinuousInfo& info : context.info->continuous) {
    ContinuousValue value;
    value.record = {info.name, info.initial, {}, info.unit, info.frame, ChosenBy::default_value};
    if (context.mode.random_parameters) draw_within(info, context.key.with(info.name), value.record);
    if (!draws.set(info, value)) {
      if (info.source == ContinuousInfo::Source::grasps) drawn.reason = draws.grasp(info, value);
      if (info.source == ContinuousInfo::Source::sample) drawn.reason = draws.place(info, value);
    }
    if (drawn.reason != Reason::none) break;
    drawn.values.push_back(std::move(value));
  }
  drawn.detail = draws.detail();
  return drawn;
}

}  // namespace stampede
