#include "scripting/commands/check_built.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "engine/model/kinematics.h"
#include "engine/motion/looked.h"
#include "engine/sim/overlap.h"
#include "engine/sim/world.h"
#include "engine/start/standing.h"
#include "engine/symbolic/pddl.h"
#include "scripting/library/source_lines.h"
#include "scripting/runtime/assets.h"
#include "scripting/runtime/episode_scripts.h"
#include "scripting/runtime/object_scene.h"
#include "scripting/runtime/stage.h"
#include "scripting/session/episode_job.h"

namespace stampede::program {
namespace {

std::string place_in(const ScriptFile& file, const std::string& field) {
  return fmt::format("{}:{}: {}", file.shown_path, line_of(field_lines(file.source), field), field);
}

// The field as its own file has it: `objects.stick.tip` of a task's stick is `tip` of stick.lua.
std::string field_in(const ScriptFile& file, std::string field) {
  if (file.kind != DefinitionKind::object) return field;
  if (field.starts_with(file.name + ".")) field.erase(0, file.name.size() + 1);  // an object by itself
  for (const char* list : {"objects.", "fixtures."})
    if (const std::size_t dot = field.find('.', std::string_view(list).size());
        field.starts_with(list) && dot != std::string::npos)
      return field.substr(dot + 1);
  return field;
}

// `worlds/objects/stick.lua: tip: …` with its line. What has no place of a file that can be opened is said to be of
// `otherwise`.
Error with_line(const Library& library, const Error& error, const ScriptFile* otherwise) {
  const std::string text = error.where().empty() ? error.message() : error.where() + ": " + error.message();
  for (const ScriptFile* file : library.all_files()) {
    const std::string start = file->shown_path + ": ";
    if (is_about(error, *file) && error.where() != file->shown_path && !error.where().starts_with(start)) return error;
    const std::size_t end = text.find(": ", start.size());
    if (!text.starts_with(start) || end == std::string::npos) continue;
    const std::string field = field_in(*file, text.substr(start.size(), end - start.size()));
    if (field.find(' ') != std::string::npos) return error;  // no field
    return Error(place_in(*file, field), text.substr(end + 2), error.hint());
  }
  if (otherwise == nullptr || text.starts_with("/") || text.starts_with("worlds/") || text.starts_with("skills/"))
    return error;
  return Error(otherwise->shown_path, text, error.hint());
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

// All that a run would build of these files, and in the way in which it would.
class Builds {
 public:
  Builds(std::shared_ptr<const Library> library, const BuiltCheck& asked, std::vector<Error>& complaints)
      : library_(std::move(library)), asked_(asked), complaints_(complaints), assets_(assets_of(*library_)) {}

  // As people call these files: with their lines.
  std::vector<Error> remarks() const {
    std::vector<Error> all;
    for (const Error& one : assets_->remarks()) all.push_back(with_line(*library_, one, nullptr));
    return all;
  }

  void check(const ScriptFile& file) {
    switch (file.kind) {
      case DefinitionKind::object:
        return guarded(&file, [&] { simulate(object_scene(library_, file.name, assets_)); });
      case DefinitionKind::robot:
        return guarded(&file, [&] { simulate(stage_of(library_, robot_alone(file), assets_).scene); });
      case DefinitionKind::world:
        return guarded(&file, [&] { simulate(world_scene(library_, file.name, assets_)); });
      case DefinitionKind::task:
        return guarded(&file, [&] { check_task(task_info(*library_, file.name), file); });
      default:
        return;  // only tasks build what these speak of
    }
  }

 private:
  // Robots that are named by no task are built too: what `import` and recordings ask for.
  static StageRequest robot_alone(const ScriptFile& file) {
    StageRequest request;
    request.robot = file.name;
    request.driven = true;
    request.where = file.shown_path;
    return request;
  }

  // The least that a world has to have.
  static Robot some_robot() {
    Robot robot;
    Part link;
    link.parent = 0;
    link.mass = 1;
    link.inertia = Matrix3::Identity();
    link.joint.kind = JointKind::hinge;
    link.joint.lower = -1;
    link.joint.upper = 1;
    robot.name = "none";
    robot.body.parts = {Part{}, link};
    robot.arm = {1};
    robot.limits = {{-1, 1, 1, 1, 1, 1}};
    robot.home = {0};
    robot.tip_part = 1;
    return robot;
  }

  template <typename Work>
  void guarded(const ScriptFile* file, const Work& work) {
    try {
      work();
    } catch (const LibraryError& all) {
      for (const Error& error : all.errors()) add(error);
    } catch (const Error& error) {
      add(with_line(*library_, error, file));
    }
  }

  void add(const Error& error) {
    const auto same = [&](const Error& other) { return std::string_view(other.what()) == error.what(); };
    if (std::none_of(complaints_.begin(), complaints_.end(), same)) complaints_.push_back(error);
  }

  // Bodies, joints and motors as an episode has them. What is wrong is of the file that describes the thing.
  void simulate(Scene scene) {
    const bool lone = scene.robot.body.parts.empty();  // an object by itself
    if (lone) scene.robot = some_robot();
    const auto shared = std::make_shared<const Scene>(std::move(scene));
    try {
      const World world(shared);
      if (!lone) const Arm arm(shared->robot);
    } catch (const Error& error) {
      throw placed(*shared, error);
    }
  }

  Error placed(const Scene& scene, const Error& error) const {
    const ScriptFile* file = library_->file(DefinitionKind::robot, scene.robot.name);
    if (error.where() != scene.robot.name) {
      const auto of_body = [&](const Object& object) { return error.where().starts_with(object.body); };
      const auto object = std::find_if(scene.objects.begin(), scene.objects.end(), of_body);
      if (object == scene.objects.end()) return error;
      file = library_->file(DefinitionKind::object, object->class_name);
    }
    return file == nullptr ? error : Error(file->shown_path, error.message(), error.hint());
  }

  void check_task(const Library::TaskInfo& task, const ScriptFile& file) {
    const std::size_t count = std::max<std::size_t>(task.variation_texts.size(), 1);
    const std::size_t stride = (count + asked_.most_variations - 1) / asked_.most_variations;
    const std::size_t before = complaints_.size();
    for (std::size_t i = 0; i < count && complaints_.size() == before; i += stride) {
      if (asked_.stop != nullptr && *asked_.stop) return;
      const std::string variation = task.variation_texts.empty() ? "" : task.variation_texts[i];
      EpisodeScripts scripts(library_, {task.name, variation, 0}, 0, assets_);
      const Task drawn = scripts.task()(0);
      if (i == 0) check_fits(scripts, drawn, file, complaints_);
      if (i == 0) simulate(drawn.scene);
      if (complaints_.size() == before) check_apart(scripts, drawn, file);
    }
  }

  // Things that do not move, each of which lies in the other in all of some draws: no start is made of that.
  void check_apart(EpisodeScripts& scripts, const Task& drawn, const ScriptFile& file) {
    std::vector<Overlap> always = fixed_overlaps(drawn.scene);
    for (int draw = 1; draw < kDrawsApart && !always.empty(); ++draw) {
      const std::vector<Overlap> now = fixed_overlaps(scripts.task()(draw).scene);
      std::erase_if(always, [&](const Overlap& one) {
        return std::ranges::none_of(now, [&](const Overlap& other) { return of_same(one, other); });
      });
    }
    for (const Overlap& one : always) {
      const Body *first = &drawn.scene.body_at(one.one.body), *second = &drawn.scene.body_at(one.other.body);
      if (second->fixture) std::swap(first, second);
      add(Error(place_in(file, "objects." + second->name),
                fmt::format("'{}' and '{}' stand in one place, {:.0f} mm deep in each other, and neither moves",
                            second->name, first->name, 1000 * one.depth),
                "no start can be made of that: move one of them, at = on_table { x, y }"));
    }
  }

  static std::vector<Overlap> fixed_overlaps(const Scene& scene) {
    if (std::ranges::none_of(scene.bodies, [](const Body& body) { return !body.free && !body.fixture; })) return {};
    const auto shared = std::make_shared<const Scene>(scene);
    const std::vector<Overlap> found = overlapping_bodies(World(shared).collision_state(), kPlacedDepth_m);
    std::vector<Overlap> kept;  // of the parts of two bodies the deepest, which comes first
    for (const Overlap& pair : found) {
      const bool moves = shared->body_at(pair.one.body).free || shared->body_at(pair.other.body).free;
      if (!moves && std::ranges::none_of(kept, [&](const Overlap& other) { return of_same(pair, other); }))
        kept.push_back(pair);
    }
    return kept;
  }

  static bool of_same(const Overlap& one, const Overlap& other) {
    return one.one.body == other.one.body && one.other.body == other.other.body;
  }

  static constexpr int kDrawsApart = 8;

  std::shared_ptr<const Library> library_;
  const BuiltCheck& asked_;
  std::vector<Error>& complaints_;
  std::shared_ptr<Assets> assets_;
};

}  // namespace

std::vector<Error> check_built(const std::shared_ptr<const Library>& library, const BuiltCheck& asked,
                               std::vector<Error>& complaints) {
  Builds builds(library, asked, complaints);
  for (const ScriptFile* file : asked.files) {
    if (asked.stop != nullptr && *asked.stop) break;
    builds.check(*file);
  }
  return builds.remarks();
}

}  // namespace stampede::program
