#include "scripting/commands/check_built.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/motion/looked.h"
#include "engine/symbolic/pddl.h"
#include "scripting/library/source_lines.h"
#include "scripting/runtime/episode_scripts.h"
#include "scripting/runtime/object_scene.h"
#include "scripting/session/episode_job.h"

namespace stampede::program {
namespace {

std::string place_in(const ScriptFile& file, const std::string& field) {
  return fmt::format("{}:{}: {}", file.shown_path, line_of(field_lines(file.source), field), field);
}

// `worlds/objects/stick.lua: tip: …` with its line. What has gone through Lua is all message.
Error with_line(const Library& library, const Error& error) {
  const std::string text = error.where().empty() ? error.message() : error.where() + ": " + error.message();
  for (const ScriptFile* file : library.all_files()) {
    const std::string start = file->shown_path + ": ";
    const std::size_t end = text.find(": ", start.size());
    if (!text.starts_with(start) || end == std::string::npos) continue;
    std::string field = text.substr(start.size(), end - start.size());
    if (field.starts_with(file->name + ".")) field.erase(0, file->name.size() + 1);  // an object by itself
    return Error(place_in(*file, field), text.substr(end + 2), error.hint());
  }
  return error;
}

// All but the two stand far away, each by itself.
Scene alone(Scene scene, const std::string& thing, const std::string& owner) {
  double offset = 100;
  for (Body& body : scene.bodies) {
    if (body.name == thing || body.name == owner) continue;
    body.world_from_body = translation(offset += 10, 0, 0);
  }
  return scene;
}

// What must go into or onto a region of a body, and does not fit at any of the poses that would make the fact true.
class Fits {
 public:
  Fits(Symbols& symbols, const Task& task) : symbols_(symbols), task_(task) {}

  // Result: empty, or what it touches, and by how much, in words.
  std::string fault(const Fact& fact) const {
    if (fact.arguments.size() < 2) return {};
    const Scene& scene = task_.scene;
    const Object* thing = scene.object(fact.arguments[0]);
    const int region = scene.region_index(fact.arguments[1]);
    if (thing == nullptr || thing->kind != ObjectKind::body || region < 0) return {};
    const std::string& owner = scene.regions[static_cast<std::size_t>(region)].body;
    const int body = scene.body_index(thing->body);
    if (body < 0 || owner.empty() || !scene.bodies[static_cast<std::size_t>(body)].free) return {};
    World world(std::make_shared<const Scene>(alone(scene, thing->body, owner)));
    const WorldView view(world);
    const CollisionState state = world.collision_state();
    const auto places = symbols_.sample(fact, view, state, RandomKey("fits"), kSamples);
    if (places.empty()) return {};
    const int other = scene.body_index(owner);
    double least = kNowhere;
    for (const Placement& placement : places) {
      const Transform* place = std::get_if<Transform>(&placement.value);
      if (place == nullptr || placement.object != thing->name) return {};
      least = std::min(least, overlap(state, body, other, *place));
      if (least <= kTouching) return {};
    }
    return fmt::format("'{}' does not fit: it would touch '{}'{} at each of the {} poses that make {} true",
                       thing->name, owner, least < kNowhere ? fmt::format(" by {:.0f} mm", 1000 * least) : "",
                       places.size(), to_text(fact));
  }

 private:
  static constexpr int kSamples = 8;
  static constexpr double kTouching = 0.0025;  // m: what is too large is not free so near
  static constexpr double kTestedAbove = 0.001;
  static constexpr double kNowhere = 1;

  // How far a thing would have to be moved from a place to touch nothing of what it goes into. Places are tested a
  // little above where they are, which may be too much in a port, and too little on a floor: either will do.
  static double overlap(const CollisionState& state, int body, int other, const Transform& place) {
    const auto touches = [&](const Transform& at) {
      const auto touched = state.body_contact(body, at, 0);
      return touched && touched->body == other;
    };
    const auto free = [&](const Transform& at) {
      return !touches(at) || !touches(translation(0, 0, -kTestedAbove) * at);
    };
    if (free(place)) return 0;
    std::vector<Vector3> directions = level_directions();
    for (const double sign : {1.0, -1.0}) directions.push_back(sign * Vector3::UnitZ());
    const double way = way_to_free(place, directions, free);
    return way < 0 ? kNowhere : way;
  }

  Symbols& symbols_;
  const Task& task_;
};

// Facts that a formula asks for, one way or another.
void collect(const Formula& formula, std::vector<Fact>& facts) {
  if (formula.kind == Formula::Kind::negation) return;
  for (const Formula& part : formula.parts) collect(part, facts);
  if (formula.kind != Formula::Kind::atom) return;
  Fact fact{formula.predicate, {}};
  for (const Term& term : formula.terms) {
    if (term.variable) return;
    fact.arguments.push_back(term.name);
  }
  facts.push_back(std::move(fact));
}

void check_fits(EpisodeScripts& scripts, const Task& task, const ScriptFile& file, std::vector<Error>& complaints) {
  const Fits fits(scripts.symbols(), task);
  std::vector<Fact> init, goal;
  for (const Literal& literal : task.init)
    if (!literal.negated) init.push_back(literal.fact);
  collect(task.goal, goal);
  std::set<Fact> seen;
  for (const auto& [field, facts] : {std::pair{"init", &init}, std::pair{"goal", &goal}})
    for (const Fact& fact : *facts) {
      if (!seen.insert(fact).second) continue;
      if (const std::string fault = fits.fault(fact); !fault.empty())
        complaints.emplace_back(place_in(file, field), fault, "make the place wider, or the thing smaller");
    }
}

}  // namespace

void check_built(const std::shared_ptr<const Library>& library, std::vector<Error>& complaints) {
  std::set<std::string> said;
  const auto guarded = [&](const auto& work) {
    try {
      work();
    } catch (const LibraryError&) {  // said already
    } catch (const Error& error) {
      if (said.insert(error.what()).second) complaints.push_back(with_line(*library, error));
    }
  };
  for (const ScriptFile* file : library->files(DefinitionKind::object))
    if (field_lines(file->source).contains("tip")) guarded([&] { object_scene(library, file->name); });
  for (const ScriptFile* file : library->files(DefinitionKind::task))
    guarded([&] {
      const Library::TaskInfo& task = task_info(*library, file->name);
      const std::string variation = task.variation_texts.empty() ? "" : task.variation_texts.front();
      EpisodeScripts scripts(library, task.name, variation, 0);
      check_fits(scripts, scripts.task()(0), *file, complaints);
    });
}

}  // namespace stampede::program
