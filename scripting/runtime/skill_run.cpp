#include "scripting/runtime/skill_run.h"

#include <lua.hpp>
#include <optional>

#include "scripting/runtime/pose_binding.h"

namespace stampede {
namespace {

void set_number(lua_State* state, const char* field, double value) {
  lua_pushnumber(state, value);
  lua_setfield(state, -2, field);
}

void set_pose(lua_State* state, const char* field, const Transform& pose) {
  push_pose(state, pose);
  lua_setfield(state, -2, field);
}

void push_grasp(lua_State* state, const GraspCandidate& grasp) {
  lua_createtable(state, 0, 7);
  set_pose(state, "pose", grasp.world_from_tip);
  set_pose(state, "approach", grasp.world_from_approach);
  set_pose(state, "on_object", grasp.object_from_tip);
  set_number(state, "width", grasp.width);
  set_number(state, "opening", grasp.opening);
  set_number(state, "force", grasp.force);
  if (grasp.reach) set_number(state, "reach", *grasp.reach);
}

void push_answer(lua_State* state, const RobotAnswer& answer) {
  if (answer.grasp) return push_grasp(state, *answer.grasp);
  answer.reach ? lua_pushnumber(state, *answer.reach) : lua_pushnil(state);
}

void push_continuous(lua_State* state, const ContinuousValue& value) {
  if (value.grasp) return push_grasp(state, *value.grasp);
  if (value.pose) return push_pose(state, *value.pose);
  const std::vector<double>& values = value.record.values;
  if (values.empty()) {
    lua_pushlstring(state, value.record.text.data(), value.record.text.size());
  } else if (values.size() == 1) {
    lua_pushnumber(state, values[0]);
  } else {
    lua_createtable(state, static_cast<int>(values.size()), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
      lua_pushnumber(state, values[i]);
      lua_rawseti(state, -2, static_cast<lua_Integer>(i) + 1);
    }
  }
}

void push_parameters(lua_State* state, const SkillInfo& info, const SkillCall& call) {
  lua_createtable(state, 0, static_cast<int>(info.parameters.size()));
  for (std::size_t i = 0; i < info.parameters.size(); ++i) {
    lua_pushstring(state, info.parameters[i].name.c_str());
    lua_pushstring(state, call.arguments[i].c_str());
    lua_rawset(state, -3);
  }
}

void push_choices(lua_State* state, const SkillCall& call) {
  lua_newtable(state);
  for (const ContinuousValue& value : call.continuous) {
    lua_pushstring(state, value.record.name.c_str());
    push_continuous(state, value);
    lua_rawset(state, -3);
  }
  lua_pushstring(state, std::string(to_string(call.controller)).c_str());
  lua_setfield(state, -2, "controller");
  set_number(state, "stiffness", call.stiffness);
  if (!call.case_name.empty()) {
    lua_pushstring(state, call.case_name.c_str());
    lua_setfield(state, -2, "case");
  }
}

constexpr int kDeepestSkill = 16;  // skills that run within each other

// Counts who is alive: a skill lives as long as those that it runs.
class Nesting {
 public:
  explicit Nesting(std::shared_ptr<int> depth) : depth_(std::move(depth)) { ++*depth_; }
  ~Nesting() { --*depth_; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;

 private:
  std::shared_ptr<int> depth_;
};

class TooDeep : public SkillRun {
 public:
  explicit TooDeep(std::string skill) : skill_(std::move(skill)) {}
  RobotCall next(const WorldView&) override {
    return robot_call::Fail{Reason::script_error, "skill '" + skill_ + "' is run inside " +
                                                      std::to_string(kDeepestSkill) + " others: does it run itself?"};
  }

 private:
  std::string skill_;
};

class LuaRun : public SkillRun {
 public:
  LuaRun(TestState& tests, const SkillInfo& info, const SkillCall& call, std::shared_ptr<int> depth)
      : nesting_(std::move(depth)), tests_(tests), scripts_(tests.library(), tests.hand()) {
    tests_.drop();
    const int run = scripts_.function_of(DefinitionKind::skill, call.skill, "run");
    if (run == 0) throw Error(call.skill, "has no function 'run'");
    scripts_.protect([&](lua_State* state) {
      coroutine_ = lua_newthread(state);
      luaL_ref(state, LUA_REGISTRYINDEX);
      lua_rawgeti(state, LUA_REGISTRYINDEX, run);
      lua_rawgeti(state, LUA_REGISTRYINDEX, scripts_.robot_reference());
      push_parameters(state, info, call);
      push_choices(state, call);
      lua_xmove(state, coroutine_, 4);
    });
  }
  ~LuaRun() override { tests_.drop(); }

  RobotCall next(const WorldView& view) override {
    if (finished_) return robot_call::Done{};
    const ViewScope scope(scripts_.view, view, ViewScope::Facts::readable);
    scripts_.robot.running = coroutine_;
    scripts_.robot.call.reset();
    return resume();
  }

  void answer(const RobotAnswer& answer) override { answer_ = answer; }

 private:
  RobotCall resume() {
    try {
      int results = 0;
      int arguments = started_ ? 0 : 3;
      if (answer_) {
        scripts_.protect([&](lua_State* state) {
          push_answer(state, *answer_);
          lua_xmove(state, coroutine_, 1);
        });
        answer_.reset();
        arguments = 1;
      }
      const bool yielded = scripts_.sandbox().resume(coroutine_, arguments, results);
      started_ = true;
      lua_pop(coroutine_, results);
      if (yielded && scripts_.robot.call) return std::move(*scripts_.robot.call);
      finished_ = true;
      return robot_call::Done{};
    } catch (const Error& error) {
      finished_ = true;
      return robot_call::Fail{Reason::script_error, error.what()};
    }
  }

  Nesting nesting_;
  TestState& tests_;
  ScriptState scripts_;
  lua_State* coroutine_ = nullptr;
  std::optional<RobotAnswer> answer_;  // to what it asked last
  bool started_ = false, finished_ = false;
};

}  // namespace

const SkillInfo* LuaSkills::skill(const std::string& name) const { return tests_.library()->skill(name); }

std::unique_ptr<SkillRun> LuaSkills::start(const SkillCall& call, const WorldView&) {
  const SkillInfo* info = skill(call.skill);
  if (info == nullptr) throw Error(call.skill, "there is no skill of this name");
  if (call.arguments.size() != info->parameters.size()) {
    throw Error(call.skill, "takes " + std::to_string(info->parameters.size()) + " arguments, was given " +
                                std::to_string(call.arguments.size()));
  }
  if (*depth_ >= kDeepestSkill) return std::make_unique<TooDeep>(call.skill);
  return std::make_unique<LuaRun>(tests_, *info, call, depth_);
}

}  // namespace stampede
