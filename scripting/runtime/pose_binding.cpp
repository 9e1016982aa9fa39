#include "scripting/runtime/pose_binding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <lua.hpp>

#include "scripting/lua/binding.h"
#include "scripting/runtime/evaluate.h"

namespace stampede {
namespace {

constexpr const char* kPose = "stampede.pose";

// Lua aligns userdata to 8 bytes only, Eigen's matrices want 16: so plain numbers are kept.
using Stored = std::array<double, 16>;

Vector3 vector_arguments(lua_State* state, int first) {
  const double x = luaL_checknumber(state, first), y = luaL_optnumber(state, first + 1, 0);
  return Vector3(x, y, luaL_optnumber(state, first + 2, 0));
}

int push_vector(lua_State* state, const Vector3& vector) {
  for (int i = 0; i < 3; ++i) lua_pushnumber(state, vector[i]);
  return 3;
}

int make_pose(lua_State* state) {
  if (lua_istable(state, 1)) {
    push_pose(state, transform_from(read_value(state, 1, {RandomKey("draw"), 0, "pose", {}}, "")));
    return 1;
  }
  const Vector3 origin = vector_arguments(state, 1);
  const double roll = luaL_optnumber(state, 4, 0), pitch = luaL_optnumber(state, 5, 0);
  push_pose(state, translation(origin) * rotation_rpy(roll, pitch, luaL_optnumber(state, 6, 0)));
  return 1;
}

int position(lua_State* state) { return push_vector(state, check_pose(state, 1).translation()); }

int rpy(lua_State* state) {
  const Matrix3 m = check_pose(state, 1).linear();
  const double pitch = std::atan2(-m(2, 0), std::hypot(m(2, 1), m(2, 2)));
  // At the pole only roll - yaw is defined: all of it goes to yaw.
  const bool pole = std::hypot(m(2, 1), m(2, 2)) < 1e-9;
  const double roll = pole ? 0 : std::atan2(m(2, 1), m(2, 2));
  return push_vector(state, Vector3(roll, pitch, pole ? std::atan2(-m(0, 1), m(1, 1)) : std::atan2(m(1, 0), m(0, 0))));
}

int quaternion(lua_State* state) {
  const Pose pose = to_pose(check_pose(state, 1));
  for (const double component : pose.quaternion) lua_pushnumber(state, component);
  return 4;
}

int offset(lua_State* state) {
  Transform pose = check_pose(state, 1);
  pose.translation() += vector_arguments(state, 2);
  push_pose(state, pose);
  return 1;
}

int along(lua_State* state) {
  push_pose(state, check_pose(state, 1) * translation(vector_arguments(state, 2)));
  return 1;
}

int with_position(lua_State* state) {
  Transform pose = check_pose(state, 1);
  pose.translation() = vector_arguments(state, 2);
  push_pose(state, pose);
  return 1;
}

int rotated(lua_State* state) {
  const Vector3 angles = vector_arguments(state, 2);
  push_pose(state, check_pose(state, 1) * rotation_rpy(angles.x(), angles.y(), angles.z()));
  return 1;
}

int turned(lua_State* state) {
  Transform pose = check_pose(state, 1);
  pose.linear() = rotation_rpy(0, 0, luaL_checknumber(state, 2)).linear() * pose.linear();
  push_pose(state, pose);
  return 1;
}

int times(lua_State* state) {
  push_pose(state, check_pose(state, 1) * check_pose(state, 2));
  return 1;
}

int inverse(lua_State* state) {
  push_pose(state, check_pose(state, 1).inverse());
  return 1;
}

}  // namespace

void push_pose(lua_State* state, const Transform& pose) {
  auto* stored = static_cast<Stored*>(lua_newuserdatauv(state, sizeof(Stored), 0));
  std::copy_n(pose.matrix().data(), stored->size(), stored->data());
  luaL_setmetatable(state, kPose);
}

std::optional<Transform> pose_at(lua_State* state, int index) {
  const auto* stored = static_cast<const Stored*>(luaL_testudata(state, index, kPose));
  if (stored == nullptr) return std::nullopt;
  Transform pose;
  std::copy_n(stored->data(), stored->size(), pose.matrix().data());
  return pose;
}

Transform check_pose(lua_State* state, int index) {
  luaL_checkudata(state, index, kPose);
  return *pose_at(state, index);
}

void register_poses(lua_State* state) {
  if (luaL_newmetatable(state, kPose) == 0) {
    lua_pop(state, 1);
    return;
  }
  const luaL_Reg methods[] = {{"position", lua_function<position>},
                              {"rpy", lua_function<rpy>},
                              {"offset", lua_function<offset>},
                              {"quaternion", lua_function<quaternion>},
                              {"along", lua_function<along>},
                              {"rotated", lua_function<rotated>},
                              {"turned", lua_function<turned>},
                              {"times", lua_function<times>},
                              {"inverse", lua_function<inverse>},
                              {"with_position", lua_function<with_position>},
                              {nullptr, nullptr}};
  luaL_newlib(state, methods);
  lua_setfield(state, -2, "__index");
  lua_pushcfunction(state, lua_function<times>);
  lua_setfield(state, -2, "__mul");
  lua_pushboolean(state, 0);
  lua_setfield(state, -2, "__metatable");
  lua_pop(state, 1);
  lua_pushcfunction(state, lua_function<make_pose>);
  lua_setglobal(state, "pose");
}

}  // namespace stampede
