#include "scripting/session/stored_symbols.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/model/scene.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr double kSpot = 0.01;  // m, half the edge of the square in which an object is said to stand

bool is_derived(const Domain& domain, const std::string& predicate) {
  const Predicate* found = domain.predicate(predicate);
  return found != nullptr && found->kind == PredicateKind::derived;
}

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

// The box that the shapes of its base fill, seen from above, in the frame of the body.
std::vector<BddlRectangle> top_of(const Body& body) {
  if (body.parts.empty() || body.parts[0].shapes.empty()) return {};
  const auto [lower, upper] = bounding_box(body.parts[0]);
  return {{rounded(lower.x()), rounded(lower.y()), rounded(upper.x()), rounded(upper.y())}};
}

bool has_trait(const Object& thing, const char* trait) {
  return std::find(thing.traits.begin(), thing.traits.end(), trait) != thing.traits.end();
}

BddlThing thing_of(const Object& object, const Scene& scene) {
  BddlThing thing{BddlThing::Kind::object, object.name, object.class_name, object.type, {}, {}};
  if (object.kind == ObjectKind::hand) thing.kind = BddlThing::Kind::hand;
  if (object.kind == ObjectKind::part) {
    thing.kind = BddlThing::Kind::part;
    thing.owner = object.body;
  }
  if (object.kind == ObjectKind::region) {
    thing.kind = BddlThing::Kind::region;
    thing.owner = object.body;
    const int index = scene.region_index(object.name);
    if (index >= 0) {
      const Region& region = scene.regions[static_cast<std::size_t>(index)];
      thing.owner = region.body;
      const double x = region.part_from_region.translation().x(), y = region.part_from_region.translation().y();
      if (region.part == 0 && !region.body.empty())
        thing.area = {{rounded(x - region.size.x() / 2), rounded(y - region.size.y() / 2),
                       rounded(x + region.size.x() / 2), rounded(y + region.size.y() / 2)}};
    }
  }
  if (object.kind == ObjectKind::body) {
    const int index = scene.body_index(object.body);
    if (index >= 0 && !scene.bodies[static_cast<std::size_t>(index)].free) {
      thing.kind = BddlThing::Kind::fixture;
      if (has_trait(object, "surface")) thing.area = top_of(scene.bodies[static_cast<std::size_t>(index)]);
    }
  }
  return thing;
}

// Where the object stands on the fixture at that moment, in the fixture's frame.
std::optional<BddlPlacement> placement_of(const Fact& fact, const Scene& scene, const AbstractState& state,
                                          const std::string& support) {
  if (fact.predicate != support || fact.arguments.size() != 2) return std::nullopt;
  const Object* below = scene.object(fact.arguments[1]);
  const auto pose = state.poses.find(fact.arguments[0]);
  if (below == nullptr || below->kind != ObjectKind::body || pose == state.poses.end()) return std::nullopt;
  const int index = scene.body_index(below->body);
  if (index < 0 || scene.bodies[static_cast<std::size_t>(index)].free) return std::nullopt;
  const Transform below_from_object =
      scene.bodies[static_cast<std::size_t>(index)].world_from_body.inverse() * to_transform(pose->second);
  const double x = rounded(below_from_object.translation().x());
  const double y = rounded(below_from_object.translation().y());
  const Matrix3 turn = below_from_object.linear();
  const double yaw = rounded(std::atan2(turn(1, 0), turn(0, 0)));
  return BddlPlacement{fact.arguments[0],
                       below->name,
                       {{rounded(x - kSpot), rounded(y - kSpot), rounded(x + kSpot), rounded(y + kSpot)}},
                       {yaw, yaw}};
}

// Fixtures have no fact that says what they stand on: what is below their origin, at its height.
std::optional<BddlPlacement> stand_of(const Object& object, const Scene& scene) {
  constexpr double kGap = 0.02;  // m
  const int own = object.kind == ObjectKind::body ? scene.body_index(object.body) : -1;
  if (own < 0 || scene.bodies[static_cast<std::size_t>(own)].free) return std::nullopt;
  const Transform& world_from_own = scene.bodies[static_cast<std::size_t>(own)].world_from_body;
  for (const Object& below : scene.objects) {
    const int index = below.kind == ObjectKind::body && has_trait(below, "surface") ? scene.body_index(below.body) : -1;
    if (index < 0 || index == own || scene.bodies[static_cast<std::size_t>(index)].free) continue;
    const Body& body = scene.bodies[static_cast<std::size_t>(index)];
    if (body.parts.empty() || body.parts[0].shapes.empty()) continue;
    const auto [lower, upper] = bounding_box(body.parts[0]);
    const Transform below_from_own = body.world_from_body.inverse() * world_from_own;
    const Vector3 at = below_from_own.translation();
    const bool over = at.x() > lower.x() && at.x() < upper.x() && at.y() > lower.y() && at.y() < upper.y();
    if (!over || std::abs(at.z() - upper.z()) > kGap) continue;
    const double x = rounded(at.x()), y = rounded(at.y());
    const Matrix3 turn = below_from_own.linear();
    const double yaw = rounded(std::atan2(turn(1, 0), turn(0, 0)));
    return BddlPlacement{object.name, below.name, {{x, y, x, y}}, {yaw, yaw}};
  }
  return std::nullopt;
}

void collect_names(const Formula& formula, std::vector<std::string>& names) {
  for (const Term& term : formula.terms)
    if (!term.variable && std::find(names.begin(), names.end(), term.name) == names.end()) names.push_back(term.name);
  for (const Formula& part : formula.parts) collect_names(part, names);
}

// The moment in BDDL's terms: things, where they stand, what holds, the goal.
BddlScene bddl_scene(const EpisodeMoment& moment, const std::string& support) {
  const auto& [episode, scene, symbols, state] = moment;
  BddlScene result;
  result.task = episode.task;
  for (const LanguageRecord& sentence : episode.labels.language)
    if (sentence.level == LanguageLevel::task && result.instruction.empty()) result.instruction = sentence.text;
  for (const Object& object : scene.objects) result.things.push_back(thing_of(object, scene));
  for (const Object& object : scene.objects)
    if (const auto placement = stand_of(object, scene)) result.placements.push_back(*placement);
  for (const Fact& fact : state.facts)
    if (const auto placement = placement_of(fact, scene, state, support)) result.placements.push_back(*placement);
  result.facts = state.facts;
  result.goal = symbols.problem.goal;
  collect_names(result.goal, result.interest);
  std::erase_if(result.interest, [&](const std::string& name) {
    const Object* object = moment.scene.object(name);
    return object == nullptr || object->kind == ObjectKind::hand;
  });
  return result;
}

// The parts of a conjunction without literals of these predicates, which are named in `remarks`.
Formula without(const Formula& goal, const std::vector<std::string>& predicates, std::vector<std::string>& remarks) {
  std::vector<Formula> parts = goal.kind == Formula::Kind::conjunction ? goal.parts : std::vector<Formula>{goal};
  std::erase_if(parts, [&](const Formula& part) {
    const Formula& inner = part.kind == Formula::Kind::negation ? part.parts[0] : part;
    if (inner.kind != Formula::Kind::atom) return false;
    if (std::find(predicates.begin(), predicates.end(), inner.predicate) == predicates.end()) return false;
    remarks.push_back("the goal is weaker than ours: " + to_pddl(part) + " is left out");
    return true;
  });
  return conjunction(std::move(parts));
}

}  // namespace

StoredSymbols read_symbols(const EpisodeRecord& episode) {
  const std::string* domain = document_of(episode, DocumentKind::pddl_domain);
  const std::string* problem = document_of(episode, DocumentKind::pddl_problem);
  if (domain == nullptr || problem == nullptr)
    throw Error(episode.task, "the episode has no PDDL problem: no start was found, or it was recorded",
                "choose a simulated one");
  StoredSymbols symbols;
  symbols.domain = domain_from_pddl(*domain, "pddl_domain");
  symbols.problem = problem_from_pddl(*problem, "pddl_problem", symbols.domain);
  return symbols;
}

Problem problem_at(const StoredSymbols& symbols, const AbstractState& state, bool known) {
  Problem problem = symbols.problem;
  problem.name += "_frame_" + std::to_string(state.frame);
  problem.init.clear();
  for (const Fact& fact : known ? state.observed : state.facts)
    if (!is_derived(symbols.domain, fact.predicate)) problem.init.insert(fact);
  return problem;
}

std::string unknown_facts(const AbstractState& state, const Domain& domain) {
  std::string text;
  for (const Fact& fact : state.facts)
    if (!state.observed.contains(fact) && !is_derived(domain, fact.predicate))
      text += "; not known: " + to_text(fact) + "\n";
  for (const Fact& fact : state.observed)
    if (!state.facts.contains(fact) && !is_derived(domain, fact.predicate))
      text += "; believed, not so: " + to_text(fact) + "\n";
  return text;
}

BddlExport bddl_at(const EpisodeMoment& moment, const BddlMapping& mapping, const std::vector<std::string>& leave_out) {
  BddlScene scene = bddl_scene(moment, mapping.support);
  std::vector<std::string> remarks;
  scene.goal = without(scene.goal, leave_out, remarks);
  BddlExport result = export_bddl(scene, mapping, moment.symbols.domain);
  result.remarks.insert(result.remarks.begin(), remarks.begin(), remarks.end());
  return result;
}

std::string with_notes(const BddlExport& result) {
  std::string text;
  for (const BddlNote& note : result.notes) text += "; " + to_text(note) + "\n";
  for (const std::string& remark : result.remarks) text += "; remark: " + remark + "\n";
  return text + result.text;
}

std::string bddl_text(const EpisodeMoment& moment, const std::vector<BddlMapping>& mappings,
                      const std::vector<std::string>& leave_out, std::string& refusals) {
  std::string text;
  for (const BddlMapping& mapping : mappings) {
    const BddlExport result = bddl_at(moment, mapping, leave_out);
    if (result.refusal.empty()) {
      text += (text.empty() ? "" : "\n") + with_notes(result);
    } else {
      refusals += std::string(to_string(mapping.dialect)) + " cannot say it: " + result.refusal + "\n";
    }
  }
  return text;
}

std::vector<Boundary> skill_boundaries(const EpisodeRecord& episode, const Domain& domain) {
  std::vector<Boundary> boundaries;
  if (episode.frames.empty()) return boundaries;
  struct Done {
    std::int64_t begin, end;
    PlanStep step;
  };
  std::vector<Done> skills;  // children of skills are part of them
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.kind != SegmentKind::skill) continue;
    const bool child = segment.parent >= 0 &&
                       static_cast<std::size_t>(segment.parent) < episode.labels.segments.size() &&
                       episode.labels.segments[static_cast<std::size_t>(segment.parent)].kind == SegmentKind::skill;
    const std::string name = segment.case_name.empty() ? segment.skill : segment.skill + "_" + segment.case_name;
    if (child || domain.action(name) == nullptr) continue;  // `wait` changes nothing
    skills.push_back({segment.span.first_frame, segment.span.end_frame, {name, segment.arguments}});
  }
  const auto last = static_cast<std::int64_t>(episode.frames.size()) - 1;
  std::vector<std::int64_t> frames = {0};
  for (const Done& skill : skills) {
    frames.push_back(std::min(skill.begin, last));
    frames.push_back(std::min(skill.end, last));
  }
  frames.push_back(last);
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  for (const std::int64_t frame : frames) {
    Boundary boundary{frame, {}};
    for (const Done& skill : skills)
      if (skill.begin >= frame && skill.end > frame) boundary.rest.push_back(skill.step);
    boundaries.push_back(std::move(boundary));
  }
  return boundaries;
}

}  // namespace stampede
