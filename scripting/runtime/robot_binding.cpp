#include "scripting/runtime/robot_binding.h"

#include <algorithm>
#include <lua.hpp>

#include "engine/base/error.h"
#include "engine/sim/world.h"
#include "scripting/lua/binding.h"
#include "scripting/runtime/options.h"
#include "scripting/runtime/piece_reader.h"
#include "scripting/runtime/sampling_binding.h"

namespace stampede {
namespace {

constexpr const char* kRobotType = "stampede.robot";

RobotContext& context_of(lua_State* state) {
  return **static_cast<RobotContext**>(luaL_checkudata(state, 1, kRobotType));
}

const WorldView& view_of(lua_State* state) {
  const RobotContext& context = context_of(state);
  if (context.running != state || context.view->view == nullptr) {
    luaL_error(state, "the robot can be used inside a skill's run only");
  }
  return *context.view->view;
}

const Robot& robot_of(lua_State* state) { return view_of(state).scene().robot; }

// The last act of every method that acts: run() stops here until the engine has done the call.
int ask(lua_State* state, RobotCall call) {
  view_of(state);
  context_of(state).call = std::move(call);
  return lua_yield(state, 0);
}

Transform tip_of(lua_State* state) { return view_of(state).world_from(context_of(state).view->hand); }

// { tool = "stick" } in an options table: poses are of the held tool's tip. Result: tool_tip_from_hand_tip, which turns
// such a pose into one of the hand; without the option nothing changes.
Transform hand_seen_from_tool(lua_State* state, int options) {
  if (!lua_istable(state, options)) return Transform::Identity();
  lua_getfield(state, options, "tool");
  const bool given = !lua_isnil(state, -1);
  const std::string tool = given ? std::string(check_text(state, -1)) : std::string();
  lua_pop(state, 1);
  if (!given) return Transform::Identity();
  const WorldView& view = view_of(state);
  view.object(tool);
  const std::string tip = tool + ".tip";
  if (view.scene().object(tip) == nullptr)
    throw Error(tool, "has no tip to move", "give its object file one: tip = { at = { x, y, z }, rpy = { r, p, y } }");
  if (view.grasped_object() != tool)
    throw Error(tool, "is not in the hand, so its tip cannot be moved", "pick it first");
  return view.world_from(tip).inverse() * tip_of(state);
}

int open_hand(lua_State* state) {
  const Robot& robot = robot_of(state);
  const double opening = lua_isnoneornil(state, 2) ? robot.opening_max : finite(state, 2);
  return ask(state, robot_call::Hand{std::clamp(opening, 0.0, robot.opening_max), robot.grip_force, ""});
}

// robot:close_hand() shuts it; with an object it must end up holding that object.
int close_hand(lua_State* state) {
  const Robot& robot = robot_of(state);
  only_fields(state, 3, {"force"});
  const double force = number_field(state, 3, "force", robot.grip_force);
  std::string expect;
  if (!lua_isnoneornil(state, 2)) expect = view_of(state).object(check_text(state, 2)).name;
  return ask(state, robot_call::Hand{0, force, std::move(expect)});
}

// { { "approach", pose }, { "grasp", pose } }: in the order written.
void listed_targets(lua_State* state, std::vector<ToolTarget>& targets) {
  const auto count = static_cast<lua_Integer>(lua_rawlen(state, 2));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_rawgeti(state, 2, i);
    luaL_argcheck(state, lua_istable(state, -1), 2, "expected { name, pose } in the list");
    lua_rawgeti(state, -1, 1);
    lua_rawgeti(state, -2, 2);
    luaL_argcheck(state, lua_type(state, -2) == LUA_TSTRING, 2, "expected { name, pose } in the list");
    targets.push_back({lua_tostring(state, -2), finite_pose(state, lua_gettop(state))});
    lua_pop(state, 3);
  }
}

// A table with names has no order of its own: approach first, then the others by name, then grasp, goal or place.
// `ahead` is where the arm must be able to go on to.
int rank(const std::string& name) {
  if (name == "approach") return 0;
  if (name == "ahead") return 3;
  return name == "grasp" || name == "goal" || name == "place" || name == "target" ? 2 : 1;
}

void named_targets(lua_State* state, std::vector<ToolTarget>& targets) {
  lua_pushnil(state);
  while (lua_next(state, 2) != 0) {
    if (lua_type(state, -2) == LUA_TSTRING) {
      targets.push_back({lua_tostring(state, -2), finite_pose(state, lua_gettop(state))});
    }
    lua_pop(state, 1);
  }
  std::sort(targets.begin(), targets.end(), [](const ToolTarget& a, const ToolTarget& b) {
    return std::pair(rank(a.name), a.name) < std::pair(rank(b.name), b.name);
  });
}

int move_through(lua_State* state) {
  luaL_checktype(state, 2, LUA_TTABLE);
  robot_call::MoveThrough call;
  const bool listed = lua_rawlen(state, 2) > 0;
  listed ? listed_targets(state, call.targets) : named_targets(state, call.targets);
  for (ToolTarget& target : call.targets) target.ahead = target.name == "ahead";
  luaL_argcheck(state, !call.targets.empty() && !call.targets[0].ahead, 2, "expected at least one named pose");
  only_fields(state, 3, {"then_part", "to", "pivot", "opening", "retreat", "then_follow", "tool"});
  const Transform from_tool = hand_seen_from_tool(state, 3);
  for (ToolTarget& target : call.targets) target.world_from_tip = target.world_from_tip * from_tool;
  if (lua_istable(state, 3) && lua_getfield(state, 3, "then_part") == LUA_TNIL) {
    lua_pop(state, 1);
    only_fields(state, 3, {"then_follow", "tool"});  // the others belong to a part
    if (has_field(state, 3, "then_follow")) {
      lua_getfield(state, 3, "then_follow");
      call.then_follow = pieces_at(state, lua_gettop(state), view_of(state));
      lua_pop(state, 1);
    }
  } else if (lua_istable(state, 3)) {
    const std::string_view part = check_text(state, -1);
    view_of(state).joint_range(part);
    call.then_part = std::string(part);
    lua_pop(state, 1);
    call.position = number_field(state, 3, "to", 0);
    call.pivot = number_field(state, 3, "pivot", 0);
    call.opening = number_field(state, 3, "opening", 0);
    call.retreat = number_field(state, 3, "retreat", 0);
    luaL_argcheck(state, !has_field(state, 3, "then_follow"), 3, "expected then_part or then_follow, not both");
  }
  return ask(state, std::move(call));
}

int move_to(lua_State* state) {
  only_fields(state, 3, {"tool"});
  return ask(state, robot_call::MoveThrough{{{"goal", finite_pose(state, 2) * hand_seen_from_tool(state, 3)}}});
}

robot_call::MoveLine line(lua_State* state, const Transform& target, int options, const char* kind) {
  if (std::string_view(kind) == "move_line")
    only_fields(state, options,
                {"speed", "force", "most_force", "stop_on_contact", "tolerate", "keep_clear", "press", "press_along",
                 "search", "pitch", "open", "as_far_as_it_goes", "tool"});
  else
    only_fields(state, options,
                {"speed", "force", "most_force", "stop_on_contact", "tolerate", "keep_clear", "press", "press_along",
                 "search", "pitch", "open", "as_far_as_it_goes"});
  robot_call::MoveLine call{target};
  call.search = number_field(state, options, "search", 0);
  call.speed = number_field(state, options, "speed", call.speed);
  call.force = number_field(state, options, "force", call.search > 0 ? 6 : call.force);
  call.most_force = number_field(state, options, "most_force", call.most_force);
  call.press = number_field(state, options, "press", 0);
  call.press_along = direction_field(state, options, "press_along");
  call.search_pitch = number_field(state, options, "pitch", call.search_pitch);
  call.opening = opening_field(state, options, robot_of(state).opening_max);
  call.stop_on_contact = flag_field(state, options, "stop_on_contact");
  call.tolerate = flag_field(state, options, "tolerate");
  call.keep_clear = flag_field(state, options, "keep_clear");
  call.as_far_as_it_goes = flag_field(state, options, "as_far_as_it_goes");
  call.kind = kind;
  luaL_argcheck(state, call.speed > 0, options, "speed must be positive");
  luaL_argcheck(state, call.most_force >= 0 && call.press >= 0 && call.search >= 0, options,
                "most_force, press and search must not be negative");
  luaL_argcheck(state, call.search == 0 || (call.press == 0 && !call.stop_on_contact), options,
                "search goes neither with press nor with stop_on_contact");
  luaL_argcheck(state, call.search_pitch > 0 && (call.search == 0 || call.force > 0), options,
                "pitch and force must be positive");
  return call;
}

// To a pose, or by an offset { x, y, z } along the world's axes, which is the same for the hand and what it holds.
int move_line(lua_State* state) {
  const Transform from_tool = hand_seen_from_tool(state, 3);
  if (!lua_istable(state, 2)) return ask(state, line(state, finite_pose(state, 2) * from_tool, 3, "move_line"));
  Transform target = tip_of(state);
  for (int i = 0; i < 3; ++i) {
    lua_rawgeti(state, 2, i + 1);
    luaL_argcheck(state, lua_type(state, -1) == LUA_TNUMBER, 2, "expected a pose or an offset { x, y, z }");
    target.translation()[i] += finite(state, lua_gettop(state));
    lua_pop(state, 1);
  }
  return ask(state, line(state, target, 3, "move_line"));
}

int lift(lua_State* state) {
  Transform target = tip_of(state);
  target.translation().z() += finite(state, 2);
  return ask(state, line(state, target, 3, "lift"));
}

int retreat(lua_State* state) {
  return ask(state, line(state, tip_of(state) * translation(0, 0, -finite(state, 2)), 3, "retreat"));
}

// robot:policy("grasp_net", { seconds = 5, with = { force = 3, offset = { 0, 0, 0.1 } } })
int policy(lua_State* state) {
  robot_call::Policy call;
  call.name = check_text(state, 2);
  only_fields(state, 3, {"seconds", "until_effect", "with"});
  call.seconds = number_field(state, 3, "seconds", call.seconds);
  luaL_argcheck(state, call.seconds > 0, 3, "seconds must be positive");
  if (lua_istable(state, 3)) {
    lua_getfield(state, 3, "until_effect");
    if (!lua_isnil(state, -1)) call.until_effect = lua_toboolean(state, -1) != 0;
    lua_getfield(state, 3, "with");
    const int with = lua_gettop(state);
    if (!lua_isnil(state, with)) luaL_argcheck(state, lua_istable(state, with), 3, "with must be a table of numbers");
    if (lua_istable(state, with)) {
      lua_pushnil(state);
      while (lua_next(state, with) != 0) {
        luaL_argcheck(state, lua_type(state, -2) == LUA_TSTRING, 3, "with must name its numbers");
        std::vector<double>& values = call.with[lua_tostring(state, -2)];
        if (lua_type(state, -1) == LUA_TNUMBER) values.push_back(finite(state, lua_gettop(state)));
        const auto count = lua_istable(state, -1) ? static_cast<lua_Integer>(lua_rawlen(state, -1)) : 0;
        for (lua_Integer i = 1; i <= count; ++i) {
          lua_rawgeti(state, -1, i);
          values.push_back(finite(state, lua_gettop(state)));
          lua_pop(state, 1);
        }
        luaL_argcheck(state, !values.empty(), 3, "with holds numbers, or lists of them");
        lua_pop(state, 1);
      }
    }
  }
  return ask(state, std::move(call));
}

int move_home(lua_State* state) {
  const Robot& robot = robot_of(state);
  robot_call::MoveJoints call;
  call.target = Eigen::Map<const Eigen::VectorXd>(robot.home.data(), static_cast<Eigen::Index>(robot.home.size()));
  return ask(state, std::move(call));
}

int move_joints(lua_State* state) {
  const std::size_t joints = robot_of(state).arm.size();
  luaL_checktype(state, 2, LUA_TTABLE);
  luaL_argcheck(state, lua_rawlen(state, 2) == joints, 2, "expected one position for each joint of the arm");
  robot_call::MoveJoints call;
  call.target.resize(static_cast<Eigen::Index>(joints));
  for (std::size_t i = 0; i < joints; ++i) {
    lua_rawgeti(state, 2, static_cast<lua_Integer>(i) + 1);
    call.target[static_cast<Eigen::Index>(i)] = finite(state, lua_gettop(state));
    lua_pop(state, 1);
  }
  return ask(state, std::move(call));
}

// The held or touched part's joint to a position, along its line or arc.
int move_part(lua_State* state) {
  only_fields(state, 4, {"speed", "most_force", "pivot", "retreat", "as_far_as_it_goes", "then_to"});
  robot_call::MovePart call;
  call.as_far_as_it_goes = flag_field(state, 4, "as_far_as_it_goes");
  call.speed = number_field(state, 4, "speed", call.speed);
  call.most_force = number_field(state, 4, "most_force", call.most_force);
  luaL_argcheck(state, call.most_force >= 0, 4, "most_force must not be negative");
  call.pivot = number_field(state, 4, "pivot", call.pivot);
  call.retreat = number_field(state, 4, "retreat", call.retreat);
  luaL_argcheck(state, call.pivot >= 0 && call.pivot <= 3.2, 4, "pivot must be 0 … pi rad");
  call.position = finite(state, 3);
  if (has_field(state, 4, "then_to")) call.then_to = number_field(state, 4, "then_to", 0);
  const std::string_view part = check_text(state, 2);
  view_of(state).joint_range(part);
  call.object = std::string(part);
  return ask(state, std::move(call));
}

// The part, the position and the options of a question about it.
template <typename Question>
Question question_about(lua_State* state) {
  only_fields(state, 4, {"pivot", "retreat"});
  Question question;
  question.pivot = number_field(state, 4, "pivot", 0);
  question.retreat = number_field(state, 4, "retreat", 0);
  luaL_argcheck(state, question.pivot >= 0 && question.pivot <= 3.2, 4, "pivot must be 0 … pi rad");
  question.position = finite(state, 3);
  question.object = check_text(state, 2);
  joint_of(view_of(state), question.object);
  return question;
}

// How far the arm can take the held part: run() goes on with the answer.
int reach_of_part(lua_State* state) { return ask(state, question_about<robot_call::ReachOfPart>(state)); }

int find_grasp(lua_State* state) { return ask(state, question_about<robot_call::FindGrasp>(state)); }

int follow(lua_State* state) { return ask(state, follow_at(state, view_of(state))); }

int tilt(lua_State* state) { return ask(state, tilt_at(state, view_of(state))); }

int wait(lua_State* state) {
  const double seconds = finite(state, 2);
  luaL_argcheck(state, seconds >= 0 && seconds <= 60, 2, "expected 0 … 60 s");
  return ask(state, robot_call::Wait{seconds});
}

// Another skill as a part of this one. All its arguments are named, but for the hand.
int run(lua_State* state) {
  const RobotContext& context = context_of(state);
  AskedCall call = asked_call_at(state, 2, *context.library, "robot:run");
  const SkillInfo& info = *context.library->skill(call.skill);
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    if (!call.arguments[i].empty()) continue;
    if (info.parameters[i].type != "hand") {
      throw Error("robot:run", "'" + call.skill + "' is not told its '" + info.parameters[i].name + "'");
    }
    call.arguments[i] = context.view->hand;
  }
  return ask(state, robot_call::RunSkill{std::move(call)});
}

// robot:fail("no_grasp" [, detail]); a text that is no reason is the detail of failed_by_skill.
int fail(lua_State* state) {
  const std::string_view text = check_text(state, 2);
  robot_call::Fail call;
  const std::optional<Reason> reason = reason_from(text);
  call.reason = reason.value_or(Reason::failed_by_skill);
  call.detail = !lua_isnoneornil(state, 3) ? std::string(check_text(state, 3)) : reason ? "" : std::string(text);
  return ask(state, std::move(call));
}

int tip(lua_State* state) {
  push_pose(state, tip_of(state));
  return 1;
}

int view(lua_State* state) {
  view_of(state);
  lua_getiuservalue(state, 1, 1);
  return 1;
}

// Where the tip must be for the object, held as it is now, to be at a pose.
int tip_for(lua_State* state) {
  const WorldView& world = view_of(state);
  const Transform object_from_tip = world.world_from(check_text(state, 2)).inverse() * tip_of(state);
  push_pose(state, finite_pose(state, 3) * object_from_tip);
  return 1;
}

constexpr luaL_Reg kMethods[] = {
    {"open_hand", lua_function<open_hand>},
    {"close_hand", lua_function<close_hand>},
    {"move_through", lua_function<move_through>},
    {"move_to", lua_function<move_to>},
    {"move_line", lua_function<move_line>},
    {"policy", lua_function<policy>},
    {"lift", lua_function<lift>},
    {"retreat", lua_function<retreat>},
    {"move_home", lua_function<move_home>},
    {"move_joints", lua_function<move_joints>},
    {"move_part", lua_function<move_part>},
    {"reach_of_part", lua_function<reach_of_part>},
    {"find_grasp", lua_function<find_grasp>},
    {"follow", lua_function<follow>},
    {"tilt", lua_function<tilt>},
    {"wait", lua_function<wait>},
    {"run", lua_function<run>},
    {"fail", lua_function<fail>},
    {"tip", lua_function<tip>},
    {"tip_for", lua_function<tip_for>},
    {"view", lua_function<view>},
    {nullptr, nullptr},
};

}  // namespace

void push_robot(lua_State* state, RobotContext& context, int view_index) {
  view_index = lua_absindex(state, view_index);
  auto** stored = static_cast<RobotContext**>(lua_newuserdatauv(state, sizeof(RobotContext*), 1));
  *stored = &context;
  lua_pushvalue(state, view_index);
  lua_setiuservalue(state, -2, 1);
  if (luaL_newmetatable(state, kRobotType) != 0) {
    luaL_newlib(state, kMethods);
    lua_setfield(state, -2, "__index");
    lua_pushboolean(state, 0);
    lua_setfield(state, -2, "__metatable");
  }
  lua_setmetatable(state, -2);
}

}  // namespace stampede
