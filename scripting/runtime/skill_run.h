// Skills as the runner sees them: a coroutine for each run.
#pragma once

#include <memory>
#include <string>

#include "engine/start/skills.h"
#include "scripting/runtime/script_state.h"

namespace stampede {

class LuaSkills : public SkillLibrary {
 public:
  explicit LuaSkills(TestState& tests) : tests_(tests) {}
  const SkillInfo* skill(const std::string& name) const override;
  // Throws Error for an unknown skill or a wrong number of arguments; what its run raises later is Fail.
  // So is a skill inside of too many others.
  std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) override;

 private:
  TestState& tests_;
  std::shared_ptr<int> depth_ = std::make_shared<int>(0);  // skills that run now, each inside of the one before
};

}  // namespace stampede
