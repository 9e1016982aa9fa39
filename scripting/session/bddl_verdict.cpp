#include "scripting/session/bddl_verdict.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/model/scene_poses.h"
#include "engine/record/observation.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "scripting/session/stored_symbols.h"

namespace stampede {
namespace {

using Names = std::map<std::string, std::string>;

void rename(std::string& name, const Names& names) {
  if (const auto found = names.find(name); found != names.end()) {
    name = found->second;
    return;
  }
  const std::size_t dot = name.find('.');  // parts go by their owner
  const auto owner = dot == std::string::npos ? names.end() : names.find(name.substr(0, dot));
  if (owner != names.end()) name = owner->second + name.substr(dot);
}

void rename(Formula& formula, const Names& names) {
  for (Term& term : formula.terms)
    if (!term.variable) rename(term.name, names);
  for (Formula& part : formula.parts) rename(part, names);
}

std::array<double, 3> numbers(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

double number_of(const Object& object, const char* name, double otherwise) {
  const auto found = object.numbers.find(name);
  return found == object.numbers.end() ? otherwise : found->second;
}

class Geometry {
 public:
  Geometry(const EpisodeRecord& episode, const Scene& scene, const ImportedProblem& imported)
      : episode_(episode),
        scene_(scene),
        last_(static_cast<std::int64_t>(episode.frames.size()) - 1),
        state_(state_at(scene, episode, last_)),
        poses_(scene_poses(scene, state_)) {
    for (const auto& [theirs, ours] : imported.task.names) theirs_[ours].push_back(theirs);
    for (const BddlRegion& region : imported.problem.regions) targets_[region.key()] = region.target;
  }

  std::map<std::string, BddlGeometry> all() const {
    std::map<std::string, BddlGeometry> things;
    for (const auto& [ours, names] : theirs_)
      for (const std::string& theirs : names) things[theirs] = of(ours, theirs);
    return things;
  }

 private:
  BddlGeometry of(const std::string& ours, const std::string& theirs) const {
    BddlGeometry geometry;
    const Object* object = scene_.object(ours);
    const auto target = targets_.find(theirs);
    geometry.region = target != targets_.end();
    if (geometry.region) geometry.parent = target->second;
    if (object == nullptr) return geometry;
    if (object->kind == ObjectKind::region) {
      put_region(scene_.region_index(ours), geometry);
    } else if (object->kind == ObjectKind::part) {
      geometry.joints = {joint_of(*object)};
      if (const int inside = scene_.region_index(ours + ".inside"); inside >= 0) {
        put_region(inside, geometry);
      } else {
        put_box(poses_.world_from_part.at(index(object->body)).at(static_cast<std::size_t>(object->part)), object->size,
                geometry);
      }
    } else if (object->kind == ObjectKind::body) {
      put_box(poses_.world_from_part.at(index(object->body)).at(0), object->size, geometry);
      for (const Object& part : scene_.objects)
        if (part.kind == ObjectKind::part && part.body == ours) geometry.joints.push_back(joint_of(part));
    }
    if (!geometry.region) geometry.touching = touching(ours);
    return geometry;
  }

  std::size_t index(const std::string& body) const { return static_cast<std::size_t>(scene_.body_index(body)); }

  static void put_box(const Transform& world_from_box, const Vector3& size, BddlGeometry& geometry) {
    geometry.centre_m = numbers(world_from_box.translation());
    geometry.half_size_m = numbers(size / 2);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column)
        geometry.world_from_box[static_cast<std::size_t>(3 * row + column)] = world_from_box.linear()(row, column);
  }

  void put_region(int region, BddlGeometry& geometry) const {
    const auto i = static_cast<std::size_t>(region);
    put_box(poses_.world_from_region.at(i), scene_.regions.at(i).size, geometry);
  }

  BddlJoint joint_of(const Object& part) const {
    const double position = state_.joint_position.at(index(part.body)).at(static_cast<std::size_t>(part.part));
    BddlJoint joint;
    if (part.numbers.contains("open_at")) joint.open = position >= number_of(part, "open_at", 0);
    if (part.numbers.contains("closed_at")) joint.closed = position <= number_of(part, "closed_at", 0);
    if (part.numbers.contains("on_at")) {
      joint.on = position >= number_of(part, "on_at", 0);
      joint.off = !joint.on;
    }
    return joint;
  }

  std::set<std::string> touching(const std::string& body) const {
    std::set<std::string> names;
    for (const ContactRecord& contact : episode_.labels.contacts) {
      // Contacts are summed over the steps up to a frame: that of the last one is the one that ends there.
      if (contact.end_frame < last_) continue;
      const std::string* other = contact.object_a == body   ? &contact.object_b
                                 : contact.object_b == body ? &contact.object_a
                                                            : nullptr;
      if (other == nullptr) continue;
      if (const auto found = theirs_.find(*other); found != theirs_.end())
        names.insert(found->second.begin(), found->second.end());
    }
    return names;
  }

  const EpisodeRecord& episode_;
  const Scene& scene_;
  std::int64_t last_;
  SceneState state_;
  ScenePoses poses_;
  std::map<std::string, std::vector<std::string>> theirs_;  // by our name
  Names targets_;                                           // of their regions
};

// Atoms as our words say them.
class OurAtoms : public BddlValues {
 public:
  OurAtoms(const BddlTask& task, const Facts& facts, const Domain& domain, const std::vector<TypedObject>& objects)
      : task_(task), facts_(facts), domain_(domain), objects_(objects) {}
  bool value(const Fact& atom) const override {
    for (const bool negated : {false, true})
      if (const auto found = task_.literals.find({atom, negated}); found != task_.literals.end())
        return holds(found->second, facts_, domain_, objects_) != negated;
    return false;
  }

 private:
  const BddlTask& task_;
  const Facts& facts_;
  const Domain& domain_;
  const std::vector<TypedObject>& objects_;
};

}  // namespace

BddlTask with_scene_names(BddlTask task, const Names& names) {
  for (auto* things : {&task.objects, &task.fixtures})
    for (BddlObject& thing : *things) rename(thing.name, names);
  for (BddlMadeRegion& region : task.regions) {
    rename(region.name, names);
    rename(region.on, names);
  }
  for (BddlPlacement& placement : task.placements) {
    rename(placement.object, names);
    rename(placement.on, names);
  }
  for (BddlLiteral& literal : task.init)
    for (std::string& argument : literal.atom.arguments) rename(argument, names);
  for (Formula& part : task.goal_parts) rename(part, names);
  rename(task.goal, names);
  for (std::string& name : task.interest) rename(name, names);
  for (auto& [theirs, ours] : task.names) rename(ours, names);
  for (auto& [theirs, ours] : task.literals) rename(ours, names);
  return task;
}

std::map<std::string, BddlGeometry> libero_geometry(const EpisodeRecord& episode, const Scene& scene,
                                                    const ImportedProblem& imported) {
  return Geometry(episode, scene, imported).all();
}

VerdictRecord bddl_verdict(const EpisodeRecord& episode, const ImportedProblem& imported) {
  if (episode.frames.empty()) throw Error(episode.task, "an episode without frames has no end to judge");
  const StoredSymbols symbols = read_symbols(episode);
  const AbstractState state = abstract_state(episode, static_cast<std::int64_t>(episode.frames.size()) - 1);
  const symbolic::View ours{state.facts, symbols.domain, symbols.problem.objects};
  BddlVerdicts verdicts;
  if (imported.problem.dialect == BddlDialect::libero) {
    const Scene scene = scene_from_document(episode.scene.document);
    const LiberoGeometry geometry(libero_geometry(episode, scene, imported));
    verdicts = judge_both(imported.problem, geometry, imported.task, ours);
  } else {
    const OurAtoms atoms(imported.task, state.facts, symbols.domain, symbols.problem.objects);
    verdicts = judge_both(imported.problem, atoms, imported.task, ours);
  }
  std::vector<std::string>& texts = verdicts.disagreements;  // a part that is one literal is listed as both
  std::set<std::string> seen;
  std::erase_if(texts, [&](const std::string& text) { return !seen.insert(text).second; });
  return {dialect_name(imported.problem.dialect), verdicts.theirs, verdicts.ours, verdicts.disagreements};
}

}  // namespace stampede
