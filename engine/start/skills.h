// What an episode asks of skills. Implemented by scripting for Lua, by tests in C++.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "engine/start/declared.h"
#include "engine/start/robot_call.h"

namespace stampede {

class WorldView;

struct ContinuousValue {
  ParameterRecord record;
  std::optional<GraspCandidate> grasp;  // source grasps
  std::optional<Transform> pose;        // source sample: world_from_object
};

struct SkillCall {
  std::string skill, case_name;
  std::vector<std::string> arguments;       // names of objects, one per parameter
  std::vector<ContinuousValue> continuous;  // one per declared parameter, in order
  ControllerKind controller = ControllerKind::joint_position;
  double stiffness = 0;
};

// One run of a skill. next() is called with the view as it is when the previous call has ended well; a call that
// failed ends the run. Never copied: undo starts a new one.
class SkillRun {
 public:
  virtual ~SkillRun() = default;
  virtual RobotCall next(const WorldView& view) = 0;
  virtual void answer(const RobotAnswer&) {}  // to the question that the last call was
};

class SkillLibrary {
 public:
  virtual ~SkillLibrary() = default;
  virtual const SkillInfo* skill(const std::string& name) const = 0;
  virtual std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) = 0;
};

}  // namespace stampede
