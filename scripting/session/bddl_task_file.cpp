#include "scripting/session/bddl_task_file.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"
#include "scripting/session/bddl_mapping_file.h"

namespace stampede {
namespace {

constexpr double kEdge = 0.03;          // m, kept free at the edges of a surface
constexpr double kLeastSpot = 0.01;     // m
constexpr double kRegionHeight = 0.10;  // m

// Furniture that opens towards the robot stands where the arm reaches it, not where their robot would.
struct Stand {
  const char *class_name, *fields;
};
constexpr Stand kStands[] = {{"chest", "at = { between(0.52, 0.55), between(0.12, 0.16), 0.75 }"},
                             {"push_button", "at = { between(0.10, 0.30), between(-0.28, -0.10), 0.75 }"}};

std::string block(const char* name, const std::string& text) {
  if (text.find("]==]") != std::string::npos)
    throw Error("import", "the text has ']==]' in it, which ends a comment in Lua", "take it out");
  return std::string("--[==[ ") + name + "\n" + text + (text.empty() || text.back() == '\n' ? "" : "\n") + "]==]\n";
}

std::optional<std::string> block_in(const std::string& source, const char* name) {
  const std::string opening = std::string("--[==[ ") + name + "\n";
  const std::size_t start = source.find(opening);
  if (start == std::string::npos) return std::nullopt;
  const std::size_t from = start + opening.size(), end = source.find("]==]", from);
  if (end == std::string::npos) return std::nullopt;
  return source.substr(from, end - from);
}

std::string lua_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '\n' ? ' ' : c;
  }
  return result + "\"";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4f", value);
  return text;
}

struct Top {
  Transform world_from_body = Transform::Identity();
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
};

class TaskWriter {
 public:
  TaskWriter(const BddlProblem& problem, const BddlMapping& mapping, const std::string& mapping_source,
             const std::string& world, const Scene& scene, const std::string& origin)
      : problem_(problem), mapping_source_(mapping_source), world_(world), scene_(scene), origin_(origin) {
    plain_ = from_bddl(problem, mapping);
  }

  ImportedTask write() {
    result_.warnings = plain_.warnings;
    result_.notes.assign(plain_.notes.begin(), plain_.notes.end());
    if (refuse(plain_.refusal)) return std::move(result_);
    name_fixtures();
    for (const BddlMadeRegion& region : plain_.regions) names_[region.name] = flat(region.name);
    if (!result_.refusal.empty()) return std::move(result_);
    task_ = with_scene_names(plain_, names_);
    objects();
    init();
    if (!result_.refusal.empty()) return std::move(result_);
    assemble();
    return std::move(result_);
  }

 private:
  bool refuse(const std::string& why) {
    if (result_.refusal.empty()) result_.refusal = why;
    return !why.empty();
  }

  static std::string flat(std::string name) {
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
  }

  // By what the world has in each of its tasks.
  bool taken(const std::string& name) const {
    const Object* object = scene_.object(name);
    return object != nullptr && (object->kind == ObjectKind::hand || stands_in_world(*object));
  }
  bool stands_in_world(const Object& object) const {
    const int body = object.kind == ObjectKind::body ? scene_.body_index(object.body) : -1;
    return body >= 0 && scene_.bodies[static_cast<std::size_t>(body)].fixture;
  }

  // A fixture of theirs is that of our world of the same class; other things keep their names where they are free.
  void name_fixtures() {
    std::set<std::string> used;
    for (const BddlObject& fixture : plain_.fixtures) {
      for (const Object& object : scene_.objects) {
        if (object.class_name != fixture.class_name || !stands_in_world(object)) continue;
        if (!used.insert(object.name).second) {
          refuse("two fixtures stand for the world's one `" + object.name + "`: `" + fixture.theirs +
                 "` is one too many; map its category to another class");
          return;
        }
        names_[fixture.name] = object.name;
        here_.insert(object.name);
      }
    }
    for (const auto* things : {&plain_.objects, &plain_.fixtures})
      for (const BddlObject& thing : *things)
        if (!names_.contains(thing.name) && taken(thing.name)) names_[thing.name] = thing.name + "_here";
  }

  std::optional<Top> surface(const std::string& name) const {
    const Object* object = scene_.object(name);
    const int body = object == nullptr ? -1 : scene_.body_index(object->body);
    if (body < 0) return std::nullopt;
    const Body& found = scene_.bodies[static_cast<std::size_t>(body)];
    const auto [lower, upper] = bounding_box(found.parts.at(0));
    return Top{found.world_from_body, lower, upper};
  }

  // Moved and cut to fit the surface; their tables are larger than the arm's reach.
  BddlRectangle fitted(const BddlRectangle& wanted, const Top& top, const std::string& what) {
    const auto fit = [](double low, double high, double least, double most, bool& moved) {
      double half = std::max((high - low) / 2, kLeastSpot / 2);
      half = std::min(half, (most - least) / 2);
      const double middle = std::clamp((low + high) / 2, least + half, most - half);
      moved = moved || std::abs(middle - (low + high) / 2) > 1e-9 || half < (high - low) / 2 - 1e-9;
      return std::pair{middle - half, middle + half};
    };
    bool moved = false;
    const auto [x0, x1] = fit(wanted.x_min_m, wanted.x_max_m, top.lower.x() + kEdge, top.upper.x() - kEdge, moved);
    const auto [y0, y1] = fit(wanted.y_min_m, wanted.y_max_m, top.lower.y() + kEdge, top.upper.y() - kEdge, moved);
    if (moved) result_.warnings.push_back(what + " is moved onto the surface, which is smaller here");
    return {x0, y0, x1, y1};
  }

  void add_region(const std::string& name, const std::string& on, const std::vector<BddlRectangle>& ranges,
                  const char* traits) {
    const auto top = surface(on);
    if (!top) {
      refuse("`" + name + "` is a region of `" + on + "`, which is no fixture of the world; place it by a mapping");
      return;
    }
    if (ranges.size() > 1) result_.warnings.push_back("`" + name + "`: only the first of its rectangles is used");
    const BddlRectangle area = fitted(ranges.at(0), *top, "`" + name + "`");
    const Vector3 centre =
        top->world_from_body * Vector3((area.x_min_m + area.x_max_m) / 2, (area.y_min_m + area.y_max_m) / 2,
                                       top->upper.z() + kRegionHeight / 2);
    const Matrix3 turn = top->world_from_body.linear();
    objects_ += "    " + name + " = { \"air_zone\", traits = { " + traits + " }, at = { " + number(centre.x()) + ", " +
                number(centre.y()) + ", " + number(centre.z()) +
                " }, yaw = " + number(std::atan2(turn(1, 0), turn(0, 0))) + ", region = { size = { " +
                number(area.x_max_m - area.x_min_m) + ", " + number(area.y_max_m - area.y_min_m) + ", " +
                number(kRegionHeight) + " } } },\n";
  }

  void objects() {
    for (const BddlObject& fixture : task_.fixtures) {
      if (here_.contains(fixture.name)) continue;
      const auto stand = std::find_if(std::begin(kStands), std::end(kStands),
                                      [&](const Stand& one) { return fixture.class_name == one.class_name; });
      if (stand == std::end(kStands)) {
        refuse("`" + fixture.theirs + "`: it is not known where a `" + fixture.class_name + "` stands here");
        return;
      }
      if (!stands_.insert(fixture.class_name).second) {
        refuse("`" + fixture.theirs + "`: there is room for one `" + fixture.class_name + "` only");
        return;
      }
      objects_ += "    " + fixture.name + " = { " + lua_text(fixture.class_name) + ", " + stand->fields + " },\n";
      result_.warnings.push_back("`" + fixture.theirs + "` stands where the arm reaches it");
    }
    for (const BddlObject& object : task_.objects)
      objects_ += "    " + object.name + " = { " + lua_text(object.class_name) + " },\n";
    for (const BddlMadeRegion& region : task_.regions)
      if (region.ranges.empty()) {
        refuse("`" + region.theirs + "` is a site of their model and no part of ours; map it, see `sites` and `parts`");
      } else {
        add_region(region.name, region.on, region.ranges, "\"container\", \"marked\"");  // can be pushed into
      }
  }

  bool is_object(const std::string& name) const {
    return std::any_of(task_.objects.begin(), task_.objects.end(), [&](const BddlObject& o) { return o.name == name; });
  }

  // Where a rectangle says where a thing starts, a region of ours does, and places it.
  void init() {
    std::set<std::string> placed;
    for (const BddlPlacement& placement : task_.placements) {
      if (!is_object(placement.object)) continue;
      const std::string spot = placement.object + "_spot";
      add_region(spot, placement.on, placement.ranges, "\"container\"");
      init_ += "    is.inside(" + lua_text(placement.object) + ", " + lua_text(spot) + "),\n";
      if (placement.yaw_rad != std::array<double, 2>{0, 0})
        result_.warnings.push_back("`" + placement.object + "` starts at any angle");
      placed.insert(placement.object);
    }
    for (const BddlLiteral& literal : task_.init) {
      init_ += std::string("    ") + (literal.negated ? "is_not." : "is.") + literal.atom.predicate + "(";
      for (std::size_t i = 0; i < literal.atom.arguments.size(); ++i)
        init_ += (i == 0 ? "" : ", ") + lua_text(literal.atom.arguments[i]);
      init_ += "),\n";
      if (!literal.negated && !literal.atom.arguments.empty()) placed.insert(literal.atom.arguments[0]);
    }
    for (const BddlObject& object : task_.objects)
      if (!placed.contains(object.name))
        refuse("nothing in :init says where `" + object.theirs + "` is; add an atom such as (on " + object.theirs +
               " TABLE)");
  }

  void assemble() {
    std::string instruction = task_.instruction;
    if (instruction.empty()) {
      instruction = task_.name;
      std::replace(instruction.begin(), instruction.end(), '_', ' ');
    }
    std::string names;
    for (const auto& [theirs, ours] : names_) names += theirs + " " + ours + "\n";
    std::string& text = result_.text;
    text = "-- Imported from " + origin_ + ": " + instruction + ".\n";
    std::replace(text.begin(), text.end() - 1, '\n', ' ');
    text += "return task {\n  world = " + lua_text(world_) + ",\n  objects = {\n" + objects_ + "  },\n  init = {\n" +
            init_ + "  },\n  goal = pddl [[" + to_pddl(task_.goal) + "]],\n  instructions = { " +
            lua_text(instruction) + " },\n}\n\n";
    text += "-- What it was imported from: its episodes are judged by the dialect's own rule too.\n";
    text += block("bddl", to_bddl(problem_));
    if (!mapping_source_.empty()) text += block("mapping", mapping_source_);
    text += block("names", names);
  }

  const BddlProblem& problem_;
  const std::string& mapping_source_;
  const std::string& world_;
  const Scene& scene_;
  const std::string& origin_;
  BddlTask plain_, task_;
  std::map<std::string, std::string> names_;  // of plain_ -> of the scene
  std::set<std::string> here_, stands_;
  std::string objects_, init_;
  ImportedTask result_;
};

}  // namespace

ImportedTask task_file_from(const BddlProblem& problem, const BddlMapping& mapping, const std::string& mapping_source,
                            const std::string& world, const Scene& scene, const std::string& origin) {
  return TaskWriter(problem, mapping, mapping_source, world, scene, origin).write();
}

std::optional<ImportedProblem> imported_problem(const std::string& task_source, const std::string& place) {
  const auto bddl = block_in(task_source, "bddl");
  if (!bddl) return std::nullopt;
  ImportedProblem imported;
  imported.problem = read_bddl(*bddl, place).problem;
  imported.mapping =
      imported.problem.dialect == BddlDialect::libero ? default_libero_mapping() : default_behavior_mapping();
  if (const auto mapping = block_in(task_source, "mapping")) imported.mapping = bddl_mapping_from_lua(*mapping, place);
  imported.mapping.add_namesakes(imported.problem, [](const std::string&) { return true; });  // import has looked
  std::map<std::string, std::string> names;
  std::istringstream lines(block_in(task_source, "names").value_or(""));
  for (std::string theirs, ours; lines >> theirs >> ours;) names[theirs] = ours;
  imported.task = with_scene_names(from_bddl(imported.problem, imported.mapping), names);
  return imported;
}

}  // namespace stampede
