#include "scripting/session/bddl_task_file.h"

#include <algorithm>
#include <cmath>
#include <lua.hpp>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/symbolic/pddl.h"
#include "scripting/library/definitions.h"
#include "scripting/library/lua_value.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "scripting/runtime/object_scene.h"

namespace stampede {
namespace {

constexpr double kEdge = 0.03;          // m, kept free at the edges of a surface
constexpr double kLeastSpot = 0.01;     // m
constexpr double kRegionHeight = 0.10;  // m

// A text of several lines, in brackets that it does not hold itself.
std::string long_text(const std::string& text) {
  std::string level;
  while (text.find("]" + level + "]") != std::string::npos) level += "=";
  return "[" + level + "[\n" + text + (text.empty() || text.back() == '\n' ? "" : "\n") + "]" + level + "]";
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

std::string drawn(const std::array<double, 2>& range) {
  if (range[0] == range[1]) return number(range[0]);
  return "between(" + number(range[0]) + ", " + number(range[1]) + ")";
}

// What an object file of ours is, by the names that predicates ask for.
struct Class {
  bool exists = false;
  bool stands = false;  // a body that nothing moves
  double lower_m = 0;   // of the body, below its frame
  std::string type;
  std::vector<std::string> traits;
  std::map<std::string, Class> parts;  // regions too
};

Class class_of(const std::shared_ptr<const Library>& library, const std::string& name) {
  Class result;
  if (library->file(DefinitionKind::object, name) == nullptr) return result;
  const Scene scene = object_scene(library, name);
  if (const int body = scene.body_index(name); body >= 0) {
    const auto has = [&](const Object& object) {
      return object.name == name && std::ranges::find(object.traits, "movable") != object.traits.end();
    };
    result.stands = std::ranges::none_of(scene.objects, has);
    result.lower_m = bounding_box(scene.bodies[static_cast<std::size_t>(body)].parts.at(0))[0].z();
  }
  for (const Object& object : scene.objects) {
    const Class one{true, false, 0, object.type, object.traits, {}};
    if (object.name == name) {
      result.type = one.type;
      result.traits = one.traits;
    } else if (object.name.starts_with(name + ".")) {
      result.parts[object.name.substr(name.size() + 1)] = one;
    }
  }
  result.exists = true;
  return result;
}

bool fits(const Class& thing, const Parameter& parameter, const Domain& domain) {
  const auto has = [&](const std::string& trait) {
    return std::ranges::find(thing.traits, trait) != thing.traits.end();
  };
  return (parameter.type.empty() || domain.is_a(thing.type, parameter.type)) &&
         std::all_of(parameter.traits.begin(), parameter.traits.end(), has);
}

// With its choices: what a predicate of ours asks for and a class has not, its parts may have.
BddlMapping with_choices(const std::shared_ptr<const Library>& library, const BddlProblem& problem,
                         BddlMapping mapping) {
  std::set<std::string> classes;
  for (const auto* groups : {&problem.fixtures, &problem.objects})
    for (const BddlGroup& group : *groups)
      if (const std::string* ours = mapping.class_of(group.category)) classes.insert(*ours);
  for (const std::string& name : classes) {
    const Class thing = class_of(library, name);
    for (const BddlPredicateRule& rule : mapping.predicates) {
      const Predicate* declared = thing.exists ? library->domain().predicate(rule.ours) : nullptr;
      for (std::size_t i = 0; declared != nullptr && i < declared->parameters.size(); ++i) {
        if (fits(thing, declared->parameters[i], library->domain())) continue;
        std::vector<std::string> parts;
        for (const auto& [part, has] : thing.parts)
          if (fits(has, declared->parameters[i], library->domain())) parts.push_back(part);
        if (!parts.empty()) mapping.choices[{name, rule.ours, i}] = std::move(parts);
      }
    }
  }
  return mapping;
}

struct Top {
  Transform world_from_body = Transform::Identity();
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
};

class TaskWriter {
 public:
  TaskWriter(const std::shared_ptr<const Library>& library, const BddlProblem& problem, const NamedMapping& mapping,
             const Scene& scene, const std::string& origin)
      : library_(library),
        problem_(problem),
        mapping_(with_choices(library, problem, mapping.mapping)),
        mapping_file_(mapping.file),
        scene_(scene),
        origin_(origin) {
    plain_ = from_bddl(problem, mapping_);
  }

  ImportedTask write() {
    result_.warnings = plain_.warnings;
    result_.notes.assign(plain_.notes.begin(), plain_.notes.end());
    if (refuse(plain_.refusal)) return std::move(result_);
    name_fixtures();
    for (const BddlMadeRegion& region : plain_.regions) names_[region.name] = flat(region.name);
    if (!result_.refusal.empty()) return std::move(result_);
    task_ = with_scene_names(plain_, names_);
    know_classes();
    leave_standing();
    leave_out_unplaced();
    check_literals();
    if (!result_.refusal.empty()) return std::move(result_);
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

  void know_classes() {
    for (const auto* things : {&task_.objects, &task_.fixtures})
      for (const BddlObject& thing : *things) {
        if (classes_.contains(thing.class_name)) continue;
        const Class& found = classes_[thing.class_name] = class_of(library_, thing.class_name);
        if (!found.exists)
          refuse("`" + thing.theirs + "` is mapped to `" + thing.class_name +
                 "`, which is a type and no object file: map its category to an object");
      }
  }

  // What they can carry and we cannot stands where :init puts it: nothing is said of what bears it.
  void leave_standing() {
    for (const BddlObject& object : task_.objects) {
      if (!classes_[object.class_name].stands) continue;
      standing_.insert(object.name);
      std::erase_if(task_.init, [&](const BddlLiteral& literal) {
        return literal.atom.predicate == mapping_.support && literal.atom.arguments.front() == object.name;
      });
    }
  }

  static bool names_thing(const Formula& formula, const std::string& name) {
    const auto is = [&](const Term& term) { return term.name.substr(0, term.name.find('.')) == name; };
    const auto in = [&](const Formula& part) { return names_thing(part, name); };
    return std::ranges::any_of(formula.terms, is) || std::ranges::any_of(formula.parts, in);
  }

  // Of a thing that nothing puts anywhere and nothing asks for nobody knows more than that it exists.
  void leave_out_unplaced() {
    std::erase_if(task_.objects, [&](const BddlObject& object) {
      const auto placed = [&](const BddlPlacement& one) { return one.object == object.name; };
      const auto spoken_of = [&](const BddlLiteral& literal) {
        return std::ranges::any_of(literal.atom.arguments, [&](const std::string& argument) {
          return argument.substr(0, argument.find('.')) == object.name;
        });
      };
      if (std::ranges::any_of(task_.placements, placed) || std::ranges::any_of(task_.init, spoken_of) ||
          std::ranges::any_of(task_.goal_parts, [&](const Formula& part) { return names_thing(part, object.name); }))
        return false;
      result_.warnings.push_back("`" + object.theirs +
                                 "` is left out: nothing says where it is, and nothing asks for it");
      return true;
    });
  }

  void stand(const BddlObject& object) {
    const auto place = std::find_if(task_.placements.begin(), task_.placements.end(),
                                    [&](const BddlPlacement& one) { return one.object == object.name; });
    const auto top = place == task_.placements.end() ? std::nullopt : surface(place->on);
    if (!top) {
      refuse("nothing in :init says where `" + object.theirs +
             "` stands, which nothing moves here; put it on a region " + "of a table that has a rectangle");
      return;
    }
    const BddlRectangle area = fitted(place->ranges.at(0), *top, "`" + object.name + "`");
    const Vector3 middle = top->world_from_body * Vector3((area.x_min_m + area.x_max_m) / 2,
                                                          (area.y_min_m + area.y_max_m) / 2, top->upper.z());
    objects_ += "    " + object.name + " = { " + lua_text(object.class_name) + ", at = { " + number(middle.x()) + ", " +
                number(middle.y()) + ", " + number(middle.z() - classes_[object.class_name].lower_m) + " } },\n";
    result_.warnings.push_back("`" + object.theirs + "` stands where it is: nothing moves ours");
  }

  // What is known of a thing of ours by its name in the task; null where only the checker knows.
  const Class* known(const std::string& name) const {
    const std::size_t dot = name.find('.');
    for (const auto* things : {&task_.objects, &task_.fixtures})
      for (const BddlObject& thing : *things) {
        if (thing.name != name.substr(0, dot)) continue;
        const Class& found = classes_.at(thing.class_name);
        if (dot == std::string::npos) return &found;
        const auto part = found.parts.find(name.substr(dot + 1));
        return part == found.parts.end() ? nullptr : &part->second;
      }
    return nullptr;
  }

  // Why things of these classes cannot stand in that atom; empty: they can.
  std::string misfit(const std::string& predicate, const std::vector<std::string>& names) const {
    const Predicate* declared = library_->domain().predicate(predicate);
    if (declared == nullptr) return "we have no predicate `" + predicate + "`";
    if (declared->parameters.size() != names.size())
      return "our `" + predicate + "` takes " + std::to_string(declared->parameters.size()) + " arguments";
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Parameter& parameter = declared->parameters[i];
      const Class* thing = known(names[i]);
      if (thing == nullptr) continue;
      if (!parameter.type.empty() && !library_->domain().is_a(thing->type, parameter.type))
        return "`" + names[i] + "` is a " + thing->type + ", and the " + parameter.name + " of our `" + predicate +
               "` is a " + parameter.type;
      for (const std::string& trait : parameter.traits)
        if (std::find(thing->traits.begin(), thing->traits.end(), trait) == thing->traits.end())
          return "`" + names[i] + "` has not the trait `" + trait + "`, which the " + parameter.name + " of our `" +
                 predicate + "` must have";
    }
    return {};
  }

  std::string misfit(const Formula& formula) const {
    if (formula.kind == Formula::Kind::atom) return misfit(formula.predicate, names_of(formula.terms));
    for (const Formula& part : formula.parts)
      if (std::string why = misfit(part); !why.empty()) return why;
    return {};
  }

  // A mapping can bring things together that our predicates do not take: said here, with their literal.
  void check_literals() {
    const auto cure = [](const std::string& why) { return why + "; map its category or the predicate otherwise"; };
    for (const auto& [theirs, ours] : task_.literals)
      if (const std::string why = misfit(ours); !why.empty()) {
        refuse("the goal's " + std::string(theirs.second ? "(not " : "") + to_text(theirs.first) +
               (theirs.second ? ")" : "") + ": " + cure(why));
      }
    for (const BddlLiteral& literal : task_.init)
      if (const std::string why = misfit(literal.atom.predicate, literal.atom.arguments); !why.empty())
        refuse(":init, " + in_their_words(literal.atom) + ": " + cure(why));
  }

  // Our atom with the names that the problem has for its things.
  std::string in_their_words(const Fact& atom) const {
    const BddlPredicateRule* rule = mapping_.from_ours(atom.predicate, false);
    Fact theirs{rule == nullptr ? atom.predicate : rule->theirs, {}};
    for (const std::string& ours : atom.arguments) {
      const auto named =
          std::find_if(task_.names.begin(), task_.names.end(), [&](const auto& pair) { return pair.second == ours; });
      theirs.arguments.push_back(named == task_.names.end() ? ours : named->first);
    }
    return to_text(theirs);
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
    objects_ += "    " + name + " = { " + lua_text(mapping_.zone) + ", traits = { " + traits + " }, at = { " +
                number(centre.x()) + ", " + number(centre.y()) + ", " + number(centre.z()) +
                " }, yaw = " + number(std::atan2(turn(1, 0), turn(0, 0))) + ", region = { size = { " +
                number(area.x_max_m - area.x_min_m) + ", " + number(area.y_max_m - area.y_min_m) + ", " +
                number(kRegionHeight) + " } } },\n";
  }

  void objects() {
    for (const BddlObject& fixture : task_.fixtures) {
      if (here_.contains(fixture.name)) continue;
      const auto stand = mapping_.stands.find(fixture.class_name);
      if (stand == mapping_.stands.end()) {
        refuse("`" + fixture.theirs + "`: it is not known where a `" + fixture.class_name +
               "` stands here; say it in the mapping's `stands`");
        return;
      }
      if (!stands_.insert(fixture.class_name).second) {
        refuse("`" + fixture.theirs + "`: there is room for one `" + fixture.class_name + "` only");
        return;
      }
      const BddlStand& place = stand->second;
      objects_ += "    " + fixture.name + " = { " + lua_text(fixture.class_name) + ", at = { " + drawn(place.x_m) +
                  ", " + drawn(place.y_m) + ", " + number(place.z_m) + " } },\n";
      result_.warnings.push_back("`" + fixture.theirs + "` stands where the arm reaches it");
    }
    for (const BddlObject& object : task_.objects)
      if (standing_.contains(object.name))
        stand(object);
      else
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
      if (!is_object(placement.object) || standing_.contains(placement.object)) continue;
      const std::string spot = placement.object + "_spot";
      add_region(spot, placement.on, placement.ranges, "\"container\"");
      init_ += "    is." + mapping_.within + "(" + lua_text(placement.object) + ", " + lua_text(spot) + "),\n";
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
      if (!placed.contains(object.name) && !standing_.contains(object.name))
        refuse("nothing in :init says where `" + object.theirs + "` is; add an atom such as (on " + object.theirs +
               " TABLE)");
  }

  void assemble() {
    std::string instruction = task_.instruction;
    if (instruction.empty()) {
      instruction = task_.name;
      std::replace(instruction.begin(), instruction.end(), '_', ' ');
    }
    std::string& text = result_.text;
    text = "-- Imported from " + origin_ + ": " + instruction + ".\n";
    std::replace(text.begin(), text.end() - 1, '\n', ' ');
    text += "return task {\n  world = " + lua_text(scene_.world) + ",\n  objects = {\n" + objects_ +
            "  },\n  init = {\n" + init_ + "  },\n  goal = pddl [[" + to_pddl(task_.goal) + "]],\n  instructions = { " +
            lua_text(instruction) + " },\n  problem = {\n    dialect = " + lua_text(dialect_name(problem_.dialect)) +
            ",\n";
    if (!mapping_file_.empty()) text += "    mapping = " + lua_text(mapping_file_) + ",\n";
    std::string names;
    for (const auto& [theirs, ours] : names_) names += "      [" + lua_text(theirs) + "] = " + lua_text(ours) + ",\n";
    if (!names.empty()) text += "    names = {\n" + names + "    },\n";
    text += "    text = " + long_text(to_bddl(problem_)) + ",\n  },\n}\n";
  }

  const std::shared_ptr<const Library>& library_;
  const BddlProblem& problem_;
  BddlMapping mapping_;
  const std::string& mapping_file_;
  const Scene& scene_;
  const std::string& origin_;
  BddlTask plain_, task_;
  std::map<std::string, std::string> names_;  // of plain_ -> of the scene
  std::map<std::string, Class> classes_;
  std::set<std::string> here_, stands_, standing_;
  std::string objects_, init_;
  ImportedTask result_;
};

}  // namespace

ImportedTask task_file_from(const std::shared_ptr<const Library>& library, const BddlProblem& problem,
                            const NamedMapping& mapping, const Scene& scene, const std::string& origin) {
  return TaskWriter(library, problem, mapping, scene, origin).write();
}

std::optional<ImportedProblem> imported_problem(const std::shared_ptr<const Library>& library,
                                                const std::string& task) {
  const ScriptFile* file = library->file(DefinitionKind::task, task);
  if (file == nullptr || file->source.find("problem") == std::string::npos) return std::nullopt;
  DefinitionState state(library);
  state.push(DefinitionKind::task, task);
  lua_getfield(state.state(), -1, "problem");
  const Value field = value_as_written(state.state(), -1, file->shown_path);
  if (!field.present()) return std::nullopt;
  ImportedProblem imported;
  imported.problem = read_bddl(field["text"].text, file->shown_path + ": problem.text").problem;
  imported.mapping = field["mapping"].is_text() ? read_bddl_mapping(*library, field["mapping"].text)
                                                : bddl_mapping_of(*library, imported.problem.dialect);
  imported.mapping.add_namesakes(imported.problem, [](const std::string&) { return true; });  // import has looked
  std::map<std::string, std::string> names;
  for (const auto& [theirs, ours] : field["names"].fields) names[theirs] = ours.text;
  imported.mapping = with_choices(library, imported.problem, std::move(imported.mapping));
  imported.task = with_scene_names(from_bddl(imported.problem, imported.mapping), names);
  return imported;
}

}  // namespace stampede
