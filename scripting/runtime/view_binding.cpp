#include "scripting/runtime/view_binding.h"

#include <algorithm>
#include <lua.hpp>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"
#include "engine/start/part_questions.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/whitelist.h"
#include "scripting/runtime/pose_binding.h"
#include "scripting/runtime/sampling_binding.h"

namespace stampede {

namespace {
constexpr std::int64_t kCallCost = 100;  // instructions that take as long as looking something up
}

const ViewContext& check_context(lua_State* state) {
  charge(state, kCallCost);
  auto** stored = static_cast<ViewContext**>(luaL_checkudata(state, 1, kViewType));
  if ((*stored)->view == nullptr) luaL_error(state, "w is kept beyond its call: use the w that is handed in");
  return **stored;
}

namespace {

const WorldView& view_of(lua_State* state) { return *check_context(state).view; }

int push_vector(lua_State* state, const Vector3& vector) {
  for (int i = 0; i < 3; ++i) lua_pushnumber(state, vector[i]);
  return 3;
}

// Three shapes of getter cover most methods.
template <auto getter>
int number_of(lua_State* state) {
  lua_pushnumber(state, (view_of(state).*getter)(check_text(state, 2)));
  return 1;
}
// How far a thing reaches below its frame when it is upright, whatever way it is turned now.
int below(lua_State* state) {
  const WorldView& view = view_of(state);
  const PartRef ref = view.part_of(check_text(state, 2));
  const Body& body = view.scene().body_at(ref.body);
  lua_pushnumber(state, -bounding_box(body.parts[static_cast<std::size_t>(ref.part)])[0].z());
  return 1;
}
template <auto getter>
int vector_of(lua_State* state) {
  return push_vector(state, (view_of(state).*getter)(check_text(state, 2)));
}
// Whether it holds, and its margin.
int push_judged(lua_State* state, const WorldView::Judged& judged) {
  lua_pushboolean(state, judged.holds ? 1 : 0);
  lua_pushnumber(state, judged.margin);
  return 2;
}
template <auto test>
int judged(lua_State* state) {
  return push_judged(state, (view_of(state).*test)(check_text(state, 2)));
}
template <auto test>
int pair_test(lua_State* state) {
  lua_pushboolean(state, (view_of(state).*test)(check_text(state, 2), check_text(state, 3)) ? 1 : 0);
  return 1;
}
template <auto test>
int single_test(lua_State* state) {
  lua_pushboolean(state, (view_of(state).*test)(check_text(state, 2)) ? 1 : 0);
  return 1;
}

// The name of a thing, which may be left out.
std::string optional_name(lua_State* state, int index) {
  return lua_isnoneornil(state, index) ? std::string() : std::string(check_text(state, index));
}

// Notes that the arm is asked. Result: where to add what it is kept from; null: nobody wants to know.
std::vector<Looked>* ask_arm(lua_State* state) {
  ViewContext& context = **static_cast<ViewContext**>(luaL_checkudata(state, 1, kViewType));
  context.asked_arm = true;
  return context.space == nullptr ? context.turned_down : nullptr;  // a sample tells of places
}

int can_grasp(lua_State* state) {
  const WorldView& view = view_of(state);
  const std::string thing(check_text(state, 2)), before = optional_name(state, 3);
  lua_pushboolean(state, stampede::can_grasp(view, thing, before, ask_arm(state)) ? 1 : 0);
  return 1;
}

int can_move(lua_State* state) {
  const WorldView& view = view_of(state);
  const std::string part(check_text(state, 2)), to(check_text(state, 3));
  const std::string before = optional_name(state, 4), enough = optional_name(state, 5);
  lua_pushboolean(state, stampede::can_move(view, part, to, before, enough, ask_arm(state)) ? 1 : 0);
  return 1;
}

int supports(lua_State* state) {
  return push_judged(state, view_of(state).supports(check_text(state, 2), check_text(state, 3)));
}

int position(lua_State* state) {
  return push_vector(state, view_of(state).world_from(check_text(state, 2)).translation());
}

int pose(lua_State* state) {
  push_pose(state, view_of(state).world_from(check_text(state, 2)));
  return 1;
}

int part_at(lua_State* state) {
  push_pose(state, view_of(state).part_at(check_text(state, 2), luaL_checknumber(state, 3)));
  return 1;
}

int speed(lua_State* state) {
  lua_pushnumber(state, view_of(state).velocity(check_text(state, 2)).norm());
  return 1;
}

int distance(lua_State* state) {
  const WorldView& view = view_of(state);
  const Vector3 a = view.world_from(check_text(state, 2)).translation();
  lua_pushnumber(state, (view.world_from(check_text(state, 3)).translation() - a).norm());
  return 1;
}

int joined(lua_State* state) {
  const WorldView& view = view_of(state);
  lua_pushboolean(state, view.world().joined(view.part_of(check_text(state, 2))));
  return 1;
}

int joint_range(lua_State* state) {
  const auto [lower, upper] = view_of(state).joint_range(check_text(state, 2));
  lua_pushnumber(state, lower);
  lua_pushnumber(state, upper);
  return 2;
}

int force(lua_State* state) {
  lua_pushnumber(state, view_of(state).contact_force(check_text(state, 2), check_text(state, 3)));
  return 1;
}

int grasped_object(lua_State* state) {
  const std::string name = view_of(state).grasped_object();
  if (name.empty()) {
    lua_pushnil(state);
  } else {
    lua_pushlstring(state, name.data(), name.size());
  }
  return 1;
}

int opening(lua_State* state) {
  lua_pushnumber(state, view_of(state).opening());
  return 1;
}

int time(lua_State* state) {
  lua_pushnumber(state, view_of(state).time_s());
  return 1;
}

int inside(lua_State* state) {
  const std::string_view region = check_text(state, 2), object = check_text(state, 3);
  lua_pushboolean(state, view_of(state).inside(region, object, lua_toboolean(state, 4) != 0) ? 1 : 0);
  return 1;
}

// A point: a named thing's origin, a pose's, or x, y, z.
Vector3 check_point(lua_State* state, const WorldView& view, int index) {
  if (lua_type(state, index) == LUA_TSTRING) return view.world_from(check_text(state, index)).translation();
  if (const auto pose = pose_at(state, index)) return pose->translation();
  const double x = luaL_checknumber(state, index), y = luaL_checknumber(state, index + 1);
  return Vector3(x, y, luaL_checknumber(state, index + 2));
}

int region_distance(lua_State* state) {
  const WorldView& view = view_of(state);
  const std::string_view region = check_text(state, 2);
  lua_pushnumber(state, view.box_distance(region, check_point(state, view, 3)));
  return 1;
}

// A declared number of a thing; of one that does not have it the default, or nil where that is no mistake.
int number(lua_State* state) {
  const std::string name(check_text(state, 3));
  const ViewContext& context = check_context(state);
  const Object& object = context.view->object(check_text(state, 2));
  const auto declared = context.numbers->find(name);
  if (declared == context.numbers->end()) throw unknown_number("w:number", name, keys_of(*context.numbers));
  if (!lua_isnoneornil(state, 4))
    throw Error("w:number", "takes a thing and the name of a number: what is read of things without it is declared",
                name + " is declared in " + declared->second.place + ": default = …, or optional = true");
  const auto found = object.numbers.find(name);
  if (found != object.numbers.end()) {
    lua_pushnumber(state, found->second);
  } else if (declared->second.otherwise) {
    lua_pushnumber(state, *declared->second.otherwise);
  } else if (declared->second.optional) {
    lua_pushnil(state);
  } else {
    throw Error(object.name, "has no number '" + name + "': " + declared->second.description,
                "add numbers = { " + name + " = … } to its file, or a default where it is declared (" +
                    declared->second.place + ")");
  }
  return 1;
}

int attribute(lua_State* state) {
  const Object& object = view_of(state).object(check_text(state, 2));
  const auto found = object.attributes.find(std::string(check_text(state, 3)));
  if (found == object.attributes.end()) return 0;
  lua_pushlstring(state, found->second.data(), found->second.size());
  return 1;
}

int type(lua_State* state) {
  lua_pushstring(state, view_of(state).object(check_text(state, 2)).type.c_str());
  return 1;
}

bool has(const Object& object, std::string_view trait) {
  for (const std::string& one : object.traits) {
    if (one == trait) return true;
  }
  return false;
}

int has_trait(lua_State* state) {
  lua_pushboolean(state, has(view_of(state).object(check_text(state, 2)), check_text(state, 3)) ? 1 : 0);
  return 1;
}

int exists(lua_State* state) {
  lua_pushboolean(state, view_of(state).scene().object(check_text(state, 2)) != nullptr ? 1 : 0);
  return 1;
}

// Names in order: all, or those with a trait.
int objects(lua_State* state) {
  const WorldView& view = view_of(state);
  const std::string_view trait = lua_isnoneornil(state, 2) ? std::string_view() : check_text(state, 2);
  lua_newtable(state);
  lua_Integer count = 0;
  for (const Object& object : view.scene().objects) {
    if (!trait.empty() && !has(object, trait)) continue;
    lua_pushlstring(state, object.name.data(), object.name.size());
    lua_rawseti(state, -2, ++count);
  }
  return 1;
}

int hand(lua_State* state) {
  const ViewContext& context = check_context(state);
  lua_pushlstring(state, context.hand.data(), context.hand.size());
  return 1;
}

// Where the robot stands: x ahead of it, y to its left.
int base(lua_State* state) {
  push_pose(state, view_of(state).scene().robot.body.world_from_body);
  return 1;
}

int tip(lua_State* state) {
  const ViewContext& context = check_context(state);
  push_pose(state, context.view->world_from(context.hand));
  return 1;
}

const FactTracker& facts_of(lua_State* state) {
  const ViewContext& context = check_context(state);
  if (!context.facts) luaL_error(state, "facts are made of predicates: a predicate reads the world, not the facts");
  if (context.view->facts() == nullptr) luaL_error(state, "there are no facts here: nothing is being run");
  return *context.view->facts();
}

// The fact named by the arguments from `index` on. A hand that is left out is filled in, as in formulas.
Fact check_fact(lua_State* state, int index, const FactTracker& facts) {
  const ViewContext& context = check_context(state);
  Fact fact{std::string(check_text(state, index)), {}};
  const Domain& domain = facts.domain();
  const Predicate* predicate = domain.predicate(fact.predicate);
  for (int i = index + 1; i <= lua_gettop(state); ++i) fact.arguments.emplace_back(check_text(state, i));
  const bool trait = std::find(domain.traits.begin(), domain.traits.end(), fact.predicate) != domain.traits.end();
  if (predicate == nullptr && !trait) {
    std::vector<std::string> names = domain.traits;
    for (const Predicate& one : domain.predicates) names.push_back(one.name);
    throw Error("w", "there is no predicate '" + fact.predicate + "'", did_you_mean(fact.predicate, names));
  }
  const std::size_t wanted = predicate == nullptr ? 1 : predicate->parameters.size();
  for (std::size_t i = 0; predicate != nullptr && i < wanted && fact.arguments.size() + 1 == wanted; ++i) {
    if (predicate->parameters[i].type == "hand")
      fact.arguments.insert(fact.arguments.begin() + static_cast<std::ptrdiff_t>(i), context.hand);
  }
  if (predicate != nullptr && facts.symbols().traits(fact.predicate).only_named && !facts.follows(fact.predicate)) {
    throw Error("w", "facts of '" + fact.predicate + "' are kept only in tasks that name it",
                "name it in the task's own file, as is." + fact.predicate + "(…) or \"" + fact.predicate + "\"");
  }
  if (fact.arguments.size() != wanted) {
    throw Error("w", "'" + fact.predicate + "' is about " + std::to_string(wanted) + " things, not " +
                         std::to_string(fact.arguments.size()));
  }
  return fact;
}

int fact(lua_State* state) {
  const FactTracker& facts = facts_of(state);
  lua_pushboolean(state, facts.facts().contains(check_fact(state, 2, facts)) ? 1 : 0);
  return 1;
}

int observed(lua_State* state) {
  const FactTracker& facts = facts_of(state);
  lua_pushboolean(state, facts.known(check_fact(state, 2, facts)) ? 1 : 0);
  return 1;
}

// { { "on", "cup", "table" }, … } in order; with a predicate's name only its facts.
int facts(lua_State* state) {
  const FactTracker& tracker = facts_of(state);
  const std::string_view only = lua_isnoneornil(state, 2) ? std::string_view() : check_text(state, 2);
  lua_newtable(state);
  lua_Integer count = 0;
  for (const Fact& one : tracker.facts()) {
    if (!only.empty() && one.predicate != only) continue;
    charge(state, 1);
    lua_createtable(state, static_cast<int>(one.arguments.size()) + 1, 0);
    lua_Integer place = 0;
    lua_pushlstring(state, one.predicate.data(), one.predicate.size());
    lua_rawseti(state, -2, ++place);
    for (const std::string& argument : one.arguments) {
      lua_pushlstring(state, argument.data(), argument.size());
      lua_rawseti(state, -2, ++place);
    }
    lua_rawseti(state, -2, ++count);
  }
  return 1;
}

constexpr luaL_Reg kMethods[] = {
    {"position", lua_function<position>},
    {"pose", lua_function<pose>},
    {"velocity", lua_function<vector_of<&WorldView::velocity>>},
    {"speed", lua_function<speed>},
    {"size", lua_function<vector_of<&WorldView::size>>},
    {"bottom", lua_function<number_of<&WorldView::bottom>>},
    {"top", lua_function<number_of<&WorldView::top>>},
    {"below", lua_function<below>},
    {"distance", lua_function<distance>},
    {"joint", lua_function<number_of<&WorldView::joint>>},
    {"joint_fraction", lua_function<number_of<&WorldView::joint_fraction>>},
    {"joint_velocity", lua_function<number_of<&WorldView::joint_velocity>>},
    {"joint_range", lua_function<joint_range>},
    {"joined", lua_function<joined>},
    {"part_at", lua_function<part_at>},
    {"touching", lua_function<pair_test<&WorldView::touching>>},
    {"force", lua_function<force>},
    {"supports", lua_function<supports>},
    {"at_rest", lua_function<single_test<&WorldView::at_rest>>},
    {"grasped", lua_function<judged<&WorldView::grasped>>},
    {"carried", lua_function<judged<&WorldView::carried>>},
    {"can_grasp", lua_function<can_grasp>},
    {"can_move", lua_function<can_move>},
    {"grasped_object", lua_function<grasped_object>},
    {"opening", lua_function<opening>},
    {"inside", lua_function<inside>},
    {"region_distance", lua_function<region_distance>},
    {"number", lua_function<number>},
    {"attribute", lua_function<attribute>},
    {"type", lua_function<type>},
    {"has_trait", lua_function<has_trait>},
    {"exists", lua_function<exists>},
    {"objects", lua_function<objects>},
    {"hand", lua_function<hand>},
    {"base", lua_function<base>},
    {"tip", lua_function<tip>},
    {"time", lua_function<time>},
    {"fact", lua_function<fact>},
    {"observed", lua_function<observed>},
    {"facts", lua_function<facts>},
    {nullptr, nullptr},
};

}  // namespace

void push_view(lua_State* state, ViewContext& context) {
  auto** stored = static_cast<ViewContext**>(lua_newuserdatauv(state, sizeof(ViewContext*), 0));
  *stored = &context;
  if (luaL_newmetatable(state, kViewType) != 0) {
    luaL_newlib(state, kMethods);
    add_sampling_methods(state);
    lua_setfield(state, -2, "__index");
    lua_pushboolean(state, 0);
    lua_setfield(state, -2, "__metatable");
  }
  lua_setmetatable(state, -2);
}

}  // namespace stampede
