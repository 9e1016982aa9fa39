#include "scripting/runtime/task_reader.h"

#include <algorithm>
#include <lua.hpp>
#include <set>

#include "engine/model/camera.h"
#include "engine/start/constraints.h"
#include "engine/symbolic/instances.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/runtime/variation.h"
#include "scripting/runtime/world_reader.h"

namespace stampede {
namespace {

// An entry's fields replace the file's; its attributes and numbers are added to the file's. What `place` holds, the
// entry's or else the file's, goes where the entry's own at, yaw, rpy and quaternion would be: so one draw can choose
// all of them.
Value overlaid(Value file, const Value& entry) {
  const Value place = entry["place"].present() ? entry["place"] : file["place"];
  file.fields.erase("place");
  for (const auto& [key, value] : place.fields) {
    if (entry[key].present())
      throw Error(value.place, "place says '" + key + "', and the entry says it too", "leave one out");
    file.fields[key] = value;
  }
  for (const auto& [key, value] : entry.fields) {
    if (key == "count" || key == "name" || key == "place") continue;
    const bool adds = (key == "attributes" || key == "numbers") && file[key].kind == Value::Kind::table;
    if (!adds) {
      file.fields[key] = value;
      continue;
    }
    for (const auto& [name, one] : value.fields) file.fields[key].fields[name] = one;
  }
  file.place = entry.place;
  return file;
}

// What is written out for the members of groups was counted as it was read.
void limit_formulas(const Task& task, const Domain& domain, const std::string& file) {
  const StaticFacts known = static_facts(task.scene, domain);
  const auto limit = [&](const Formula& formula, const std::string& field) {
    symbolic::limit_instances(formula, {known.facts, domain, known.objects}, file + ": " + field);
  };
  if (task.where) limit(*task.where, "init");
  limit(task.goal, "goal");
  for (const Subgoal& subgoal : task.subgoals) limit(subgoal.formula, "subgoals." + subgoal.name);
}

}  // namespace

TaskReader::TaskReader(ScriptState& scripts, const ScriptFile& file, const std::map<std::string, std::string>& axes,
                       RandomKey key, Assets& assets)
    : scripts_(scripts), file_(file), axes_(axes), key_(key), assets_(assets) {}

LuaTask::Drawn TaskReader::read(lua_State* state, int further_things) {
  state_ = state;
  luaL_checkstack(state, 64, "task");
  scripts_.definitions().push(DefinitionKind::task, file_.name);
  task_ = lua_gettop(state);
  drawn_.files.push_back(&file_);
  push_variation(state, task_, axes_, file_.shown_path);
  variation_ = lua_gettop(state);
  drawn_.task.hold_s = field("hold").present() ? field("hold").as_number() : drawn_.task.hold_s;
  drawn_.task.horizon_s = field("horizon").present() ? field("horizon").as_number() : drawn_.task.horizon_s;
  const Value name = field("world");
  const Value world = definition(DefinitionKind::world, name.as_text(), "", name);
  const std::filesystem::path folder = used(DefinitionKind::world, name.text, name).path.parent_path();
  read_world(name.text, world);
  read_objects();
  add_clutter(further_things);
  read_looks(world, folder);
  if (world["motion"]["planner"].present()) drawn_.task.motion_planner = world["motion"]["planner"].as_text();
  drawn_.task.observation = before(observation_from(field("observe")), observation_from(world["observe"]));
  drawn_.task.unplaced = builder_->unplaced();
  drawn_.task.scene = builder_->build();
  if (world["calibration"].present()) read_calibration(world["calibration"], folder);
  forget_absent_classes();
  read_init();
  read_told();
  place_clutter();
  read_goal();
  read_subgoals();
  limit_formulas(drawn_.task, scripts_.library().domain(), file_.shown_path);
  read_steps();
  read_instructions();
  drawn_.also = has_function("also");
  drawn_.fails = has_function("fails");
  drawn_.reward = has_function("reward");
  return std::move(drawn_);
}

bool TaskReader::push_field(const char* name) {
  lua_getfield(state_, task_, name);
  if (lua_isfunction(state_, -1)) {
    lua_pushvalue(state_, variation_);
    lua_call(state_, 1, 1);
  }
  if (!lua_isnil(state_, -1)) return true;
  lua_pop(state_, 1);
  return false;
}

bool TaskReader::has_function(const char* name) {
  const bool found = lua_getfield(state_, task_, name) == LUA_TFUNCTION;
  lua_pop(state_, 1);
  return found;
}

Value TaskReader::field(const char* name) {
  lua_getfield(state_, task_, name);
  const Value value = read_value(state_, -1, {key_, variation_, file_.shown_path, {}}, name);
  lua_pop(state_, 1);
  return value;
}

const ScriptFile& TaskReader::used(DefinitionKind kind, const std::string& name, const Value& where) {
  const ScriptFile* file = scripts_.library().file(kind, name);
  if (file == nullptr) throw Error(where.place, "there is no " + std::string(to_string(kind)) + " '" + name + "'");
  if (std::find(drawn_.files.begin(), drawn_.files.end(), file) == drawn_.files.end()) drawn_.files.push_back(file);
  return *file;
}

Value TaskReader::definition(DefinitionKind kind, const std::string& name, const std::string& path, const Value& where,
                             std::vector<std::string> skip) {
  const ScriptFile& file = used(kind, name, where);
  scripts_.definitions().push(kind, name);
  Value value = read_value(state_, -1, {key_, variation_, file.shown_path, std::move(skip), table_top_}, path);
  lua_pop(state_, 1);
  for (const char* reserved : {"kind", "name", "tag", "line"}) value.fields.erase(reserved);
  return value;
}

ObjectSource TaskReader::source_of(const Value& spec, const std::string& name, const std::string& path) {
  const Value& class_value = spec.kind == Value::Kind::text ? spec
                             : spec.items.empty()           ? spec["object"]
                                                            : spec.items[0];
  ObjectSource source{name, class_value.as_text(), {}, {}, &assets_};
  const bool stands =
      spec["at"].present() || spec["place"].present() || !table_top_;  // where the file says is not asked
  const std::vector<std::string> skip = stands ? std::vector<std::string>{"place"} : std::vector<std::string>();
  source.fields = overlaid(definition(DefinitionKind::object, source.class_name, path, class_value, skip), spec);
  source.folder = used(DefinitionKind::object, source.class_name, class_value).path.parent_path();
  return source;
}

void TaskReader::read_world(const std::string& name, const Value& world) {
  colours_ = read_colours(state_, key_);
  builder_ = std::make_unique<SceneBuilder>(name, colours_);
  read_robot(world["robot"], true);
  for (const auto& [key, spec] : world["fixtures"].fields)
    builder_->add_fixture(source_of(spec, key, "fixtures." + key));
  table_top_ = builder_->top_of("table");
  for (const auto& [key, region] : world["regions"].fields) builder_->add_region(key, region);
  for (const auto& [key, camera] : world["cameras"].fields) builder_->add_camera(key, camera);
  builder_->set_rates(static_cast<int>(world.number_or("physics_hz", 240)),
                      static_cast<int>(world.number_or("frame_hz", 20)),
                      world.vector_or("gravity", Vector3(0, 0, -9.81)));
  for (const auto& [key, sensor] : world["sensors"].fields) builder_->add_sensor(key, sensor);
}

void TaskReader::read_robot(const Value& robot, bool driven) {
  const std::string name =
      robot.kind == Value::Kind::text || robot.items.empty() ? robot.as_text() : robot.items[0].as_text();
  const ScriptFile& file = used(DefinitionKind::robot, name, robot);
  const Value fields = definition(DefinitionKind::robot, name, "", robot);
  const UrdfBody& urdf = assets_.urdf(file.path.parent_path() / fields.text_or("urdf", name + ".urdf"));
  builder_->add_drawn(urdf.drawn);
  Robot built = build_robot(name, fields, urdf.body, transform_from(robot), colours_);
  if (driven) check_fingers(fields["fingers"], built);
  set_start(robot["joints"], built);
  builder_->set_robot(std::move(built));
  drawn_.hand = builder_->hand();
}

void TaskReader::read_looks(const Value& world, const std::filesystem::path& folder) {
  builder_->set_light(world["light"]);
  if (world["randomise"].present()) {
    DrawnAssets drawn;
    drawn_.task.randomisation = randomisation_from(world["randomise"], {colours_, folder, assets_, drawn, {}});
    builder_->add_drawn(drawn);
  }
  set_classes();
}

Stage TaskReader::read_stage(lua_State* state, const StageRequest& request) {
  state_ = state;
  luaL_checkstack(state_, 64, "stage");
  colours_ = read_colours(state_, key_);
  builder_ = std::make_unique<SceneBuilder>(request.world.empty() ? "none" : request.world, colours_);
  Value name;
  name.kind = Value::Kind::text, name.text = request.robot, name.place = request.where;
  if (request.urdf.empty()) {
    read_robot(name, request.driven);
  } else {
    const UrdfBody& urdf = assets_.urdf(request.urdf);
    builder_->add_drawn(urdf.drawn);
    builder_->set_robot(build_robot(request.robot, request.robot_fields, urdf.body, Transform::Identity(), colours_));
  }
  if (!request.world.empty()) {
    name.text = request.world;
    const Value world = definition(DefinitionKind::world, name.text, "", name);
    for (const auto& [key, spec] : world["fixtures"].fields)
      builder_->add_fixture(source_of(spec, key, "fixtures." + key));
    for (const auto& [key, region] : world["regions"].fields) builder_->add_region(key, region);
    builder_->set_light(world["light"]);
  }
  set_classes();
  builder_->add_class(request.robot);  // no file of the library's may be of it
  Stage stage{builder_->build(), drawn_.files};
  stage.scene.robot.body.world_from_body = request.world_from_base;
  return stage;
}

Scene TaskReader::read_world_alone(lua_State* state) {
  state_ = state;
  luaL_checkstack(state_, 64, "world");
  Value where;
  where.place = file_.shown_path;
  const Value world = definition(DefinitionKind::world, file_.name, "", where);
  const std::filesystem::path folder = file_.path.parent_path();
  read_world(file_.name, world);
  read_looks(world, folder);
  observation_from(world["observe"]);
  drawn_.task.scene = builder_->build();
  if (world["calibration"].present()) read_calibration(world["calibration"], folder);
  return std::move(drawn_.task.scene);
}

void TaskReader::set_classes() {
  // All that a scene of this library could have, so that a class has one number in all of its tasks.
  const Library& library = scripts_.library();
  std::vector<std::string> classes = {"hand", "region", "part"};
  for (const DefinitionKind kind : {DefinitionKind::object, DefinitionKind::robot})
    for (const ScriptFile* file : library.files(kind)) classes.push_back(file->name);
  for (const auto& [type, parent] : library.domain().types) classes.push_back(type);
  builder_->set_classes(std::move(classes));
}

void TaskReader::read_calibration(const Value& file, const std::filesystem::path& folder) {
  try {
    FileScope(scripts_.library().roots().folders).check(folder / file.as_text());
    put_cameras(drawn_.task.scene, load_calibration(folder / file.as_text(), drawn_.task.scene));
  } catch (const Error& error) {
    throw Error(file.place, (error.where().empty() ? "" : error.where() + ": ") + error.message(), error.hint());
  }
}

// A world may randomise things that only some of its tasks have.
void TaskReader::forget_absent_classes() {
  if (!drawn_.task.randomisation) return;
  const auto absent = [&](const std::string& name) {
    return scripts_.library().file(DefinitionKind::object, name) != nullptr &&
           drawn_.task.scene.object(name) == nullptr &&
           std::none_of(drawn_.task.scene.objects.begin(), drawn_.task.scene.objects.end(),
                        [&](const Object& object) { return object.class_name == name; });
  };
  std::erase_if(drawn_.task.randomisation->looks, absent);
  std::erase_if(drawn_.task.randomisation->dynamics, absent);
}

void TaskReader::read_objects() {
  if (!push_field("objects")) return;
  const int objects = lua_gettop(state_);
  std::vector<std::string> names;
  lua_pushnil(state_);
  while (lua_next(state_, objects) != 0) {
    lua_pop(state_, 1);
    if (lua_type(state_, -1) != LUA_TSTRING) throw Error(file_.shown_path + ": objects", "expected names as keys");
    names.emplace_back(lua_tostring(state_, -1));
  }
  std::sort(names.begin(), names.end());
  for (const std::string& name : names) {
    lua_getfield(state_, objects, name.c_str());
    add_group(name, lua_gettop(state_));
    lua_pop(state_, 1);
  }
  lua_pop(state_, 1);
}

// One thing, or with `count` a group of them, each with draws of its own. What sample_of drew for a field of a group
// is dealt out: one value to each member.
void TaskReader::add_group(const std::string& name, int index) {
  const Evaluation how{key_, variation_, file_.shown_path, {}, table_top_};
  const Value shared = read_value(state_, index, how, "objects." + name);
  if (!shared["count"].present()) {
    builder_->add_object(source_of(shared, name, "objects." + name));
    return;
  }
  const double count = shared["count"].as_number();
  if (count < 0 || count > 1000 || count != static_cast<int>(count)) shared["count"].expected("a whole number");
  std::vector<std::string>& group = drawn_.groups[name];
  for (int i = 1; i <= static_cast<int>(count); ++i) {
    const std::string member = name + std::to_string(i);
    Value spec = read_value(state_, index, how, "objects." + member);
    for (auto& [key, value] : spec.fields) {
      const Value& drawn = shared[key];
      if (!drawn["sampled"].present()) continue;
      if (drawn.items.size() != static_cast<std::size_t>(count)) {
        throw Error(drawn.place, "sample_of draws " + std::to_string(drawn.items.size()) + " values for a group of " +
                                     plain_text(shared["count"]));
      }
      value = drawn.items[static_cast<std::size_t>(i) - 1];
    }
    builder_->add_object(source_of(spec, member, "objects." + member));
    group.push_back(member);
  }
}

// Drawn from all classes of the library that can pass unnoticed.
void TaskReader::add_clutter(int further_things) {
  if (further_things <= 0) return;
  std::set<std::string> classes;
  for (const ScriptFile* file : scripts_.library().files(DefinitionKind::object)) classes.insert(file->name);
  std::vector<std::string> order(classes.begin(), classes.end());
  Random(key_.with("clutter")).shuffle(order);
  std::vector<std::string>& clutter = drawn_.task.clutter;
  for (const std::string& name : order) {
    if (static_cast<int>(clutter.size()) == further_things) return;
    Value spec;
    spec.kind = Value::Kind::text;
    spec.text = name;
    spec.place = file_.shown_path;
    const std::vector<const ScriptFile*> files = drawn_.files;
    const std::string member = "clutter" + std::to_string(clutter.size() + 1);
    if (builder_->add_clutter(source_of(spec, member, "objects." + member), scripts_.library().domain()))
      clutter.push_back(member);
    else
      drawn_.files = files;
  }
}

// On the largest surface that stays where it is.
void TaskReader::place_clutter() {
  if (drawn_.task.clutter.empty()) return;
  const Scene& scene = drawn_.task.scene;
  const auto area = [](const Object& object) { return object.size.x() * object.size.y(); };
  const Object* widest = nullptr;
  for (const Object& object : scene.objects) {
    const int body = object.kind == ObjectKind::body ? scene.body_index(object.body) : -1;
    if (body < 0 || scene.bodies[static_cast<std::size_t>(body)].free) continue;
    if (std::find(object.traits.begin(), object.traits.end(), "surface") == object.traits.end()) continue;
    if (widest == nullptr || area(object) > area(*widest)) widest = &object;
  }
  if (widest == nullptr || scripts_.library().domain().predicate("on") == nullptr)
    throw Error(file_.shown_path,
                "a layout with further things needs a fixture with the trait `surface`, and predicate `on`",
                "leave `layout` out");
  for (const std::string& name : drawn_.task.clutter) drawn_.task.init.push_back({{"on", {name, widest->name}}, false});
}

// `stack {height} {colour} blocks` with the axes' values for their names.
std::string TaskReader::filled(const std::string& text) const {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = text[i] == '{' ? text.find('}', i) : std::string::npos;
    const auto axis = end == std::string::npos ? axes_.end() : axes_.find(text.substr(i + 1, end - i - 1));
    if (axis == axes_.end()) {
      result += text[i++];
      continue;
    }
    for (const char c : axis->second) result += c == '_' ? ' ' : c;
    i = end + 1;
  }
  return result;
}

void TaskReader::read_instructions() {
  const Value value = field("instructions");
  if (!value.present()) return;
  for (const std::string& text : value.as_texts()) drawn_.task.instructions.push_back(filled(text));
}

}  // namespace stampede
