#include "engine/rollout/blockers.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "engine/start/relations.h"

namespace stampede {
namespace {

constexpr double kNear = 0.35;  // m, between middles
constexpr std::size_t kMost = 5;

// Near things come first; names decide between equals.
using Candidate = std::tuple<double, std::string, PartRef>;

// A free body, or what moves on a joint: a drawer, a door.
std::optional<PartRef> movable_part(const Scene& scene, const Object& thing) {
  if (thing.kind != ObjectKind::body && thing.kind != ObjectKind::part) return std::nullopt;
  const int index = scene.body_index(thing.body);
  if (index < 0) return std::nullopt;
  const Body& body = scene.bodies[static_cast<std::size_t>(index)];
  const bool jointed =
      thing.kind == ObjectKind::part && body.parts[static_cast<std::size_t>(thing.part)].joint.kind != JointKind::fixed;
  if (!body.free && !jointed) return std::nullopt;
  return PartRef{index, thing.part};
}

// The parts that the arguments are, are on, or hang on: what a skill is about is not in its way.
std::set<PartRef> parts_of(const std::vector<std::string>& arguments, const Scene& scene) {
  std::set<PartRef> parts;
  for (const std::string& name : arguments) {
    const Object* thing = scene.object(name);
    if (thing == nullptr || thing->kind == ObjectKind::hand || thing->body.empty()) continue;
    const int body = scene.body_index(thing->body);
    for (int part = thing->part; body >= 0 && part >= 0;) {
      parts.insert({body, part});
      part = scene.bodies[static_cast<std::size_t>(body)].parts[static_cast<std::size_t>(part)].parent;
    }
  }
  return parts;
}

// `places`: what they are near to.
std::vector<Candidate> candidates(const std::vector<std::string>& arguments, const std::vector<std::string>& places,
                                  const WorldView& view, int held) {
  const Scene& scene = view.scene();
  const std::set<PartRef> about = parts_of(arguments, scene);
  std::vector<Candidate> near;
  for (const Object& thing : scene.objects) {
    const std::optional<PartRef> part = movable_part(scene, thing);
    if (!part || part->body == held || about.contains(*part)) continue;
    double distance = kNear;
    for (const std::string& name : places) {
      const Object* other = scene.object(name);
      if (other == nullptr || other->kind == ObjectKind::hand) continue;
      distance =
          std::min(distance, (view.world_from(name).translation() - view.world_from(thing.name).translation()).norm());
    }
    if (distance < kNear) near.emplace_back(distance, thing.name, *part);
  }
  std::sort(near.begin(), near.end());
  if (near.size() > kMost) near.resize(kMost);
  return near;
}

// Puts back what need not be away, the farthest first.
template <typename Works>
std::vector<Candidate> fewest(std::vector<Candidate> away, const Works& works_without) {
  for (std::size_t i = away.size(); i-- > 0;) {
    std::vector<Candidate> fewer = away;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (works_without(fewer)) away = std::move(fewer);
  }
  return away;
}

}  // namespace

void name_blockers(Rollout& rollout, const SkillContext& context, SkillResult& result,
                   const std::function<bool()>& works) {
  if (!context.mode.find_blockers || context.arguments.empty()) return;
  const int held = rollout.keep ? rollout.keep->body : -1;
  std::vector<std::string> places = context.arguments;
  for (const Literal& literal : relations_asked(rollout.task(), rollout.facts()))
    if (const auto& names = literal.fact.arguments; names.front() == places.front())
      places.insert(places.end(), names.begin() + 1, names.end());
  const std::vector<Candidate> near = candidates(context.arguments, places, rollout.view(), held);
  const auto works_without = [&](const std::vector<Candidate>& things) {
    rollout.imagined_away.clear();
    for (const auto& [distance, name, part] : things) rollout.imagined_away.push_back(part);
    return works();
  };
  for (const Candidate& one : near)
    if (works_without({one})) result.blockers.push_back({std::get<std::string>(one)});
  if (result.blockers.empty() && near.size() > 1 && works_without(near)) {
    std::vector<std::string>& all = result.blockers.emplace_back();
    for (const auto& [distance, name, part] : fewest(near, works_without)) all.push_back(name);
  }
  rollout.imagined_away.clear();
  for (std::size_t way = 0; way < result.blockers.size(); ++way)
    for (std::size_t i = 0; i < result.blockers[way].size(); ++i)
      result.detail += (i > 0 ? ", " : way > 0 ? " or " : "; in the way: ") + result.blockers[way][i];
}

}  // namespace stampede
