// Objects, worlds, and the names that a scene will have.
#include <algorithm>
#include <array>

#include "scripting/library/builder.h"
#include "scripting/library/naming.h"

namespace stampede {
namespace {

std::vector<std::string> texts(const Value& list) {
  std::vector<std::string> result;
  for (const Value& item : list.items) result.push_back(item.text);
  return result;
}

std::vector<std::string> names_in(const Value& table) {
  std::vector<std::string> result;
  for (const auto& [name, value] : table.fields) result.push_back(name);
  return result;
}

constexpr std::array kMovingJoints{"slider", "hinge", "screw"};
constexpr double kOpening = 0.08;  // m, of a robot that says nothing else

std::string type_or(const Value& node, const std::string& otherwise) {
  return node["type"].is_text() ? node["type"].text : otherwise;
}

}  // namespace

void LibraryBuilder::check_body(const Definition& definition, const Value& body, const std::string& path) {
  const std::string prefix = path.empty() ? "" : path + ".";
  const Domain& domain = library_->domain_;
  if (body["type"].is_text() && !domain.types.contains(body["type"].text)) {
    std::vector<std::string> known;
    for (const auto& [name, parent] : domain.types) known.push_back(name);
    complain(definition, prefix + "type", "there is no type '" + body["type"].text + "'",
             did_you_mean(body["type"].text, known));
  }
  for (const std::string& trait : texts(body["traits"])) {
    if (!listed(domain.traits, trait)) {
      complain(definition, prefix + "traits", "there is no trait '" + trait + "'", did_you_mean(trait, domain.traits));
    }
  }
  for (const char* table : {"numbers", "attributes"}) {
    for (const auto& [name, value] : body[table].fields) {
      const std::string where = prefix + table + "." + name;
      if (const auto fault = name_fault(name))
        complain(definition, where, "the name '" + name + "' " + *fault, "such as '" + proposed_name(name) + "'");
      const std::string_view wanted = std::string_view(table) == "numbers" ? "number" : "string|number|boolean";
      if (!has_type(value, wanted)) complain(definition, where, "this is " + value.type_name());
    }
  }
  numbers_.check_values(body["numbers"], prefix + "numbers.", complainer(definition));
  for (const char* number : {"mass", "friction", "restitution"}) {
    if (body[number].is_number() && body[number].number < 0) complain(definition, prefix + number, "is negative");
  }
  check_sizes(definition, body, path);
  if (body["colour"].is_text()) {
    const auto colours = of(DefinitionKind::colours).find("colours");
    if (colours == of(DefinitionKind::colours).end() || colours->second.node[body["colour"].text].present()) return;
    std::vector<std::string> known;
    for (const auto& [name, rgb] : colours->second.node.fields) known.push_back(name);
    complain(definition, prefix + "colour", "there is no colour '" + body["colour"].text + "'",
             did_you_mean(body["colour"].text, known));
  }
}

// What a screw needs, and a joint that lets go of its part.
void LibraryBuilder::check_thread(const Definition& definition, const Value& joint, const std::string& where) {
  if (!joint.present()) return;
  const bool screw = where.ends_with("screw");
  const Value& pitch = joint["pitch"];
  if (screw && (!pitch.present() || (pitch.is_number() && pitch.number == 0)))
    complain(definition, where, "a screw without pitch does not travel",
             "pitch = mm(4): metres along the axis in a whole turn; one that only turns is a hinge");
  if (!screw && pitch.present())
    complain(definition, where + ".pitch", "only a screw has a pitch", "write screw = { … }");
  const Value& lets_go = joint["lets_go"];
  if (!lets_go.present()) return;
  const std::vector<Value>& range = joint["range"].items;
  const double initial = joint.number_or("initial", 0);
  if (lets_go.is_number() && range.size() == 2 && range[0].is_number() && range[1].is_number() &&
      (lets_go.number < range[0].number || lets_go.number > range[1].number || lets_go.number == initial))
    complain(definition, where + ".lets_go", "the joint never gets there",
             "a position within range that is not the first");
  for (const char* other : {"damping", "spring", "stiffness", "detent", "latch", "follows"})
    if (joint[other].present())
      complain(definition, where + "." + other, "a joint that lets go of its part has friction alone",
               "leave it out, or leave out lets_go");
}

// Numbers that no scene can be built with, and grasps that no hand can make.
void LibraryBuilder::check_sizes(const Definition& definition, const Value& body, const std::string& path) {
  const std::string prefix = path.empty() ? "" : path + ".";
  for (const char* kind : kMovingJoints) {
    const Value& joint = body[kind];
    const std::vector<Value>& range = joint["range"].items;
    const std::string where = prefix + kind;
    if (range.size() == 2 && range[0].is_number() && range[1].is_number()) {
      const double low = range[0].number, high = range[1].number, initial = joint.number_or("initial", 0);
      if (low >= high) complain(definition, where + ".range", "ends before it begins", "range = { lower, upper }");
      if (low < high && (initial < low || initial > high))
        complain(definition, where + ".initial", "the position at the start is outside range", "move one of them");
    }
    for (const char* number : {"damping", "friction", "spring", "detent"})
      if (joint[number].is_number() && joint[number].number < 0)
        complain(definition, where + "." + number, "is negative");
    check_thread(definition, joint, where);
  }
  std::vector<const Value*> shapes;
  if (body["shape"].is_table()) shapes.push_back(&body["shape"]);
  for (const Value& shape : body["shapes"].items) shapes.push_back(&shape);
  for (const Value* shape : shapes) {
    const std::string& kind = (*shape)["shape"].text;
    if (kind != "box" && kind != "sphere" && kind != "cylinder" && kind != "capsule" && kind != "cone") continue;
    for (const Value& length : shape->items)
      if (length.is_number() && length.number <= 0)
        add(Error(definition.file->shown_path + ":" + std::to_string(shape->line()),
                  "a " + kind + " has an edge of " + plain_text(length), "lengths are positive, in metres"));
  }
  double widest = 0;
  for (const auto& [name, robot] : of(DefinitionKind::robot))
    widest = std::max(widest, robot.node.number_or("opening", kOpening));
  for (std::size_t i = 0; widest > 0 && i < body["grasps"].items.size(); ++i) {
    const Value& width = body["grasps"].items[i]["width"];
    if (width.is_number() && width.number > widest)
      complain(definition, prefix + "grasps",
               "grasp " + std::to_string(i + 1) + " is " + plain_text(width) + " m wide, no hand opens further than " +
                   std::to_string(widest).substr(0, 5) + " m",
               "grasp it where it is narrower");
  }
}

// A tip is the one thing of its name. Whether it lies on its tool is known when that is built.
void LibraryBuilder::check_tip(const Definition& definition, const Value& node, const std::string& path) {
  const Value& tip = node["tip"];
  if (!tip.present()) return;
  const std::string where = path.empty() ? "tip" : path + ".tip";
  if (node["region"].present())
    return complain(definition, where, "a region has no tip", "give it to an object with shapes");
  if (node["regions"]["tip"].present())
    complain(definition, where, "there is a region 'tip' too, and both are called OBJECT.tip", "rename the region");
  if (node["parts"]["tip"].present())
    complain(definition, where, "there is a part 'tip' too, and both are called OBJECT.tip", "rename the part");
}

// A shape follows one fact of one thing of its object.
void LibraryBuilder::check_shows(const Definition& definition, const Value& body) {
  std::vector<std::string> known = {"self"};
  const Value& node = definition.node;
  if (node["tip"].present()) known.push_back("tip");
  for (const auto& [region, unused] : node["regions"].fields) known.push_back(region);
  for (const auto& [part, fields] : node["parts"].fields) {
    known.push_back(part);
    for (const auto& [region, unused] : fields["regions"].fields) known.push_back(part + "." + region);
  }
  for (const char* list : {"shapes", "visual"}) {
    for (const Value& shape : body[list].items) {
      const Value& shows = shape["shows"];
      if (!shows.present()) continue;
      const int line = shows.line() > 0 ? shows.line() : shape.line();
      const std::string place = definition.file->shown_path + ":" + std::to_string(line);
      const auto say = [&](const std::string& what, const std::string& hint) {
        add(Error(place, "shows: " + what, hint));
      };
      const std::string example = "such as is.pressed(\"button\") or is_not.open(\"self\")";
      if (shows.tag() != "literal") {
        say("what a shape is shown by is one fact, this is " + shows.type_name(), example);
        continue;
      }
      const std::string& name = shows["predicate"].text;
      const Predicate* predicate = library_->domain_.predicate(name);
      std::vector<std::string> predicates;
      for (const Predicate& one : library_->domain_.predicates) predicates.push_back(one.name);
      if (predicate == nullptr)
        say("there is no predicate '" + name + "'", did_you_mean(name, predicates));
      else if (predicate->parameters.size() != 1 || shows.items.size() != 1)
        say("'" + name + "' is no fact of one thing", example);
      else if (!listed(known, shows.items[0].text))
        say("the object has no part or region '" + shows.items[0].text + "'", did_you_mean(shows.items[0].text, known));
    }
  }
}

// Latches and couplings name other moving parts, and couplings come to an end.
void LibraryBuilder::check_links(const Definition& definition, const Value& parts, const std::string& name) {
  const auto joint_of = [&](const std::string& part) -> const Value& {
    const auto kind = std::find_if(kMovingJoints.begin(), kMovingJoints.end(),
                                   [&](const char* one) { return parts[part][one].present(); });
    return parts[part][kind == kMovingJoints.end() ? "hinge" : *kind];
  };
  std::string path = "parts." + name;
  for (const char* kind : kMovingJoints)
    if (parts[name][kind].present()) path += std::string(".") + kind;
  std::vector<std::string> moving;
  for (const auto& [other, unused] : parts.fields)
    if (other != name && joint_of(other).present()) moving.push_back(other);
  for (const auto& [field, word] : {std::pair{"latch", "key"}, std::pair{"follows", "part"}}) {
    const Value& target = joint_of(name)[field][word];
    if (!target.is_text() || std::find(moving.begin(), moving.end(), target.text) != moving.end()) continue;
    complain(definition, path + "." + field,
             target.text == name ? "it names its own part" : "there is no other part '" + target.text + "' that moves",
             target.text == name ? "name another moving part" : did_you_mean(target.text, moving));
  }
  std::string chain = name, at = name;
  for (std::size_t step = 0; step <= parts.fields.size(); ++step) {
    const Value& next = joint_of(at)["follows"]["part"];
    if (!next.is_text() || next.text == at) return;
    at = next.text;
    chain += " -> " + at;
    if (at == name)
      return complain(definition, path + ".follows", "couplings in a circle: " + chain, "one of them moves by itself");
  }
}

void LibraryBuilder::check_objects() {
  for (const auto& [name, definition] : of(DefinitionKind::object)) {
    const Value& node = definition.node;
    const auto check_thing = [&](const Value& thing, const std::string& path) {
      check_body(definition, thing, path);
      numbers_.check_needed(texts(thing["traits"]), names_in(thing["numbers"]), path, complainer(definition));
    };
    check_thing(node, {});
    check_shows(definition, node);
    check_tip(definition, node, {});
    check_assets(definition);
    if (!node["region"].present() && !node["type"].is_text()) {
      complain(definition, {}, "an object needs the field 'type'", "one of worlds/types.lua");
    }
    if (!node["shape"].present() && !node["shapes"].present() && !node["urdf"].present() && !node["region"].present()) {
      complain(definition, {}, "an object needs shapes, a region or a urdf", "shape = box { 0.04, 0.04, 0.04 }");
    }
    for (const auto& [part_name, part] : node["parts"].fields) {
      const std::string path = "parts." + part_name;
      check_thing(part, path);
      check_shows(definition, part);
      int joints = part["fixed"].present();
      for (const char* kind : kMovingJoints) joints += part[kind].present();
      if (joints != 1 && !node["urdf"].present())
        complain(definition, path, "a part needs one of slider, hinge, screw and fixed");
      if (part["parent"].is_text() && !node["parts"][part["parent"].text].present() && !node["urdf"].present()) {
        std::vector<std::string> known;
        for (const auto& [other, unused] : node["parts"].fields) known.push_back(other);
        complain(definition, path + ".parent", "there is no part '" + part["parent"].text + "'",
                 did_you_mean(part["parent"].text, known));
      }
      check_links(definition, node["parts"], part_name);
      for (const auto& [region_name, region] : part["regions"].fields)
        check_thing(region, path + ".regions." + region_name);
    }
    for (const auto& [region_name, region] : node["regions"].fields) check_thing(region, "regions." + region_name);
  }
}

void LibraryBuilder::check_entry(const Definition& definition, const Value& entry, const std::string& path,
                                 const char* what) {
  if (!entry.is_table() || entry.items.empty() || !entry.items[0].is_text()) {
    if (entry.is_table() && !entry.items.empty() && !entry.items[0].tag().empty()) return;  // a drawn class
    return complain(definition, path, std::string("an entry begins with the name of its ") + what,
                    "such as { \"cube\" }");
  }
  const std::string& class_name = entry.items[0].text;
  const bool robot = std::string_view(what) == "robot";
  const Definitions& classes = of(robot ? DefinitionKind::robot : DefinitionKind::object);
  const auto found = classes.find(class_name);
  const auto kind = robot ? DefinitionKind::robot : DefinitionKind::object;
  if (found == classes.end()) {
    if (library_->file(kind, class_name) != nullptr) return;  // its own file has complaints
    std::vector<std::string> known;
    for (const auto& [name, unused] : classes) known.push_back(name);
    std::string hint = did_you_mean(class_name, known);
    if (hint.empty() && !robot)
      hint = "`stampede list objects` names those that there are, `stampede new object` makes one";
    return complain(definition, path, std::string("there is no ") + what + " '" + class_name + "'", hint);
  }
  std::vector<std::string> known = field_names(*record(robot ? "robot" : "object"));
  for (const char* table : {"numbers", "attributes"}) {
    for (const auto& [name, unused] : found->second.node[table].fields) known.push_back(name);
  }
  check_record(*record("entry"), entry, path, complainer(definition), known);
  Value replaced;  // fields of its file
  replaced.kind = Value::Kind::table;
  for (const std::string& name : field_names(*record("object")))
    if (const Value& value = entry[name]; value.present()) replaced.fields[name] = value;
  if (!robot) check_record(*record("object"), replaced, path, complainer(definition));
  check_body(definition, entry, path);
  check_entry_numbers(definition, entry, found->second.node, path);
  check_tip(definition, entry, path);
  if (entry.items.size() > 1) complain(definition, path, "an entry has one class, this one lists more");
  if (robot) return check_start(definition, entry["joints"], found->second.node["arm"], path + ".joints");
  for (const auto& [part, position] : entry["joints"].fields) {
    const Value& parts = found->second.node["parts"];
    if (parts[part].present() || found->second.node["urdf"].present()) continue;
    std::vector<std::string> names;
    for (const auto& [name, unused] : parts.fields) names.push_back(name);
    complain(definition, path + ".joints", "'" + class_name + "' has no part '" + part + "'",
             did_you_mean(part, names));
  }
}

// What an entry sets of its file's numbers, by their names; and what traits of its own need.
void LibraryBuilder::check_entry_numbers(const Definition& definition, const Value& entry, const Value& node,
                                         const std::string& path) {
  Value own;
  own.kind = Value::Kind::table;
  for (const auto& [name, value] : node["numbers"].fields)
    if (entry[name].present()) own.fields[name] = entry[name];
  numbers_.check_values(own, path + ".", complainer(definition));
  std::vector<std::string> has = names_in(node["numbers"]);
  for (const std::string& name : names_in(entry["numbers"])) has.push_back(name);
  numbers_.check_needed(texts(entry["traits"]), has, path, complainer(definition));
}

// Where an arm starts: its own joints, each once.
void LibraryBuilder::check_start(const Definition& definition, const Value& joints, const Value& arm,
                                 const std::string& path) {
  std::vector<std::string> names;
  for (const Value& joint : arm.items) names.push_back(joint.text);
  for (const auto& [joint, position] : joints.fields) {
    if (std::find(names.begin(), names.end(), joint) == names.end())
      complain(definition, path, "the arm has no joint '" + joint + "'", did_you_mean(joint, names));
    if (!has_type(position, "number"))
      complain(definition, path + "." + joint, "expects a number, this is " + position.type_name(),
               "such as " + joint + " = between(-0.2, 0.2)");
  }
}

// The object with its parts (name.part) and regions (name.region, name.part.region).
void LibraryBuilder::add_object(SceneObjects& objects, const std::string& name, const Value& entry) const {
  SceneObject object;
  const std::string class_name = entry.items.empty() ? "" : entry.items[0].text;
  const auto kind = definitions_.find(DefinitionKind::object);
  const Definition* found = nullptr;
  if (kind != definitions_.end()) {
    const auto at = kind->second.find(class_name);
    if (at != kind->second.end()) found = &at->second;
  }
  object.known = found != nullptr;
  static const Value kEmpty;
  const Value& node = found == nullptr ? kEmpty : found->node;
  const auto either = [&](const char* field) -> const Value& {
    return entry[field].present() ? entry[field] : node[field];
  };
  const bool region = either("region").present();
  object.type = either("type").is_text() ? either("type").text : region ? "region" : "";
  object.traits = texts(either("traits"));
  object.positioned = entry["at"].present() || entry["place"].present();
  const bool fixed =
      either("fixed").kind == Value::Kind::boolean ? either("fixed").boolean : !listed(object.traits, "movable");
  object.free = found != nullptr && !fixed && !region;
  objects[name] = object;
  const auto add_regions = [&](const std::string& owner, const Value& regions) {
    for (const auto& [region_name, one] : regions.fields) {
      objects[owner + "." + region_name] = {type_or(one, "region"), texts(one["traits"]), false, false};
    }
  };
  add_regions(name, either("regions"));
  if (either("tip").present() && !region) objects[name + ".tip"] = {"region", {}, false, false};
  for (const auto& [part_name, part] : either("parts").fields) {
    const bool loose = std::any_of(kMovingJoints.begin(), kMovingJoints.end(),
                                   [&](const char* joint) { return part[joint]["lets_go"].present(); });
    objects[name + "." + part_name] = {type_or(part, ""), texts(part["traits"]), loose, true};
    add_regions(name + "." + part_name, part["regions"]);
  }
}

std::string LibraryBuilder::hand_of(const std::string& world) const {
  const auto worlds = definitions_.find(DefinitionKind::world);
  const auto found = worlds == definitions_.end() ? Definitions::const_iterator{} : worlds->second.find(world);
  if (worlds == definitions_.end() || found == worlds->second.end()) return "panda.hand";
  const Value& entry = found->second.node["robot"];
  const std::string robot = entry.items.empty() ? "robot" : entry.items[0].text;
  std::string hand = "hand";
  const auto robots = definitions_.find(DefinitionKind::robot);
  if (robots != definitions_.end()) {
    const auto definition = robots->second.find(robot);
    if (definition != robots->second.end() && definition->second.node["hand"].is_text())
      hand = definition->second.node["hand"].text;
  }
  return robot + "." + hand;
}

SceneObjects LibraryBuilder::world_objects(const std::string& world) const {
  SceneObjects objects;
  objects[hand_of(world)] = {"hand", {}, false, false};
  const auto worlds = definitions_.find(DefinitionKind::world);
  if (worlds == definitions_.end()) return objects;
  const auto found = worlds->second.find(world);
  if (found == worlds->second.end()) return objects;
  for (const auto& [name, entry] : found->second.node["fixtures"].fields) add_object(objects, name, entry);
  for (const auto& [name, region] : found->second.node["regions"].fields) {
    objects[name] = {type_or(region, "region"), texts(region["traits"]), false, false};
  }
  return objects;
}

}  // namespace stampede
