#include "scripting/runtime/sampling_binding.h"

#include <lua.hpp>

#include "engine/base/error.h"
#include "engine/motion/candidates.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/whitelist.h"
#include "scripting/runtime/pose_binding.h"

namespace stampede {
namespace {

constexpr std::int64_t kSpotsCost = 200'000;  // instructions that take as long as testing places for collisions

const ViewContext& sampling_context(lua_State* state) {
  const ViewContext& context = check_context(state);
  if (context.space == nullptr) luaL_error(state, "places can be drawn in a predicate's sample only");
  return context;
}

// Each call of a sample gets a stream of its own.
RandomKey spots_key(Random& random) { return RandomKey("spots").with(static_cast<std::int64_t>(random.bits())); }

int push_poses(lua_State* state, const std::vector<Transform>& poses) {
  lua_createtable(state, static_cast<int>(poses.size()), 0);
  lua_Integer i = 0;
  for (const Transform& pose : poses) {
    push_pose(state, pose);
    lua_rawseti(state, -2, ++i);
  }
  return 1;
}

// `centre, x, y`: only spots that are at most so far from the centre along its axes.
std::optional<SpotWindow> window_at(lua_State* state, int index) {
  if (lua_isnoneornil(state, index)) return std::nullopt;
  return SpotWindow{check_pose(state, index), luaL_checknumber(state, index + 1), luaL_checknumber(state, index + 2)};
}

template <auto spots>
int spots_on(lua_State* state) {
  const ViewContext& context = sampling_context(state);
  charge(state, kSpotsCost);
  const std::string_view below = check_text(state, 2), object = check_text(state, 3);
  const RandomKey key = spots_key(check_random(state, 4));
  const WorldView& view = *context.view;
  const Object &thing = view.object(object), &place = view.object(below);
  return push_poses(
      state,
      spots({*context.space, view.world(), thing, key, context.most, context.turned_down, window_at(state, 5)}, place));
}

const Region& region_of(const WorldView& view, std::string_view name) {
  const int index = view.scene().region_index(name);
  if (index < 0) throw Error(std::string(name), "is not a region");
  return view.scene().regions[static_cast<std::size_t>(index)];
}

// A region needs no room: its centre lies anywhere in the other region such that its box stays inside, upright.
std::vector<Transform> region_in_region(const WorldView& view, const Region& outer, const Region& inner, RandomKey key,
                                        int most) {
  Random random(key);
  const Vector3 room = 0.5 * (outer.size - inner.size).cwiseMax(0);
  std::vector<Transform> poses;
  for (int i = 0; i < most; ++i) {
    const double x = random.between(-room.x(), room.x()), y = random.between(-room.y(), room.y());
    poses.push_back(view.world_from(outer.name) * translation(x, y, random.between(-room.z(), room.z())));
  }
  return poses;
}

int spots_in_region(lua_State* state) {
  const ViewContext& context = sampling_context(state);
  charge(state, kSpotsCost);
  const std::string_view name = check_text(state, 2), object_name = check_text(state, 3);
  const RandomKey key = spots_key(check_random(state, 4));
  const bool floating = lua_toboolean(state, 5) != 0;
  const WorldView& view = *context.view;
  const Region& region = region_of(view, name);
  const Object& object = view.object(object_name);
  if (object.kind == ObjectKind::region) {
    return push_poses(state, region_in_region(view, region, region_of(view, object_name), key, context.most));
  }
  if (floating) throw Error(std::string(object_name), "a body cannot float", "place it on something, or use a region");
  return push_poses(
      state, region_spots({*context.space, view.world(), object, key, context.most, context.turned_down}, region));
}

void push_placement(lua_State* state, std::string_view object, const char* field) {  // value on top, replaced
  lua_createtable(state, 0, 2);
  lua_insert(state, -2);
  lua_setfield(state, -2, field);
  lua_pushlstring(state, object.data(), object.size());
  lua_setfield(state, -2, "object");
}

int joint_at(lua_State* state) {
  const std::string_view part = check_text(state, 2);
  const double position = luaL_checknumber(state, 3);
  const auto [lower, upper] = sampling_context(state).view->joint_range(part);
  if (!(position >= lower - 1e-9 && position <= upper + 1e-9)) {
    throw Error(std::string(part), "position " + std::to_string(position) + " is outside its range " +
                                       std::to_string(lower) + " … " + std::to_string(upper));
  }
  lua_pushnumber(state, position);
  push_placement(state, part, "position");
  return 1;
}

int joint_between(lua_State* state) {
  const ViewContext& context = sampling_context(state);
  const std::string_view part = check_text(state, 2);
  const double low = luaL_checknumber(state, 3), high = luaL_checknumber(state, 4);
  Random& random = check_random(state, 5);
  context.view->joint_range(part);  // is it one with a joint?
  lua_createtable(state, context.most, 0);
  for (int i = 1; i <= context.most; ++i) {
    lua_pushnumber(state, random.between(low, high));
    push_placement(state, part, "position");
    lua_rawseti(state, -2, i);
  }
  return 1;
}

int place(lua_State* state) {
  const std::string_view object = check_text(state, 2);
  push_pose(state, check_pose(state, 3));
  push_placement(state, object, "pose");
  return 1;
}

constexpr luaL_Reg kMethods[] = {
    {"free_spots", lua_function<spots_on<&free_spots>>},
    {"stack_spots", lua_function<spots_on<&stack_spots>>},
    {"region_spots", lua_function<spots_in_region>},
    {"joint_at", lua_function<joint_at>},
    {"joint_between", lua_function<joint_between>},
    {"place", lua_function<place>},
    {nullptr, nullptr},
};

// One pose, number or { object = …, pose | position = … }.
std::optional<Placement> placement_at(lua_State* state, int index, const std::string& object) {
  if (const auto pose = pose_at(state, index)) return Placement{object, *pose};
  if (lua_type(state, index) == LUA_TNUMBER) return Placement{object, lua_tonumber(state, index)};
  if (!lua_istable(state, index)) return std::nullopt;
  lua_getfield(state, index, "object");
  lua_getfield(state, index, "pose");
  lua_getfield(state, index, "position");
  std::optional<Placement> placement;
  if (lua_type(state, -3) == LUA_TSTRING) {
    if (const auto pose = pose_at(state, -2)) placement = Placement{lua_tostring(state, -3), *pose};
    if (lua_isnumber(state, -1)) placement = Placement{lua_tostring(state, -3), lua_tonumber(state, -1)};
  }
  lua_pop(state, 3);
  return placement;
}

}  // namespace

void add_sampling_methods(lua_State* state) { luaL_setfuncs(state, kMethods, 0); }

std::vector<Placement> placements_at(lua_State* state, int index, const std::string& object, const std::string& place) {
  index = lua_absindex(state, index);
  if (lua_isnil(state, index)) return {};
  if (const auto single = placement_at(state, index, object)) return {*single};
  std::vector<Placement> placements;
  const auto count = lua_istable(state, index) ? static_cast<lua_Integer>(lua_rawlen(state, index)) : 0;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(state, index, i);
    const auto placement = placement_at(state, lua_gettop(state), object);
    if (!placement) throw Error(place, "sample returned something that is neither a pose nor a joint position");
    placements.push_back(*placement);
    lua_pop(state, 1);
  }
  if (!lua_istable(state, index)) throw Error(place, "sample must return a list of poses or joint positions");
  return placements;
}

}  // namespace stampede
