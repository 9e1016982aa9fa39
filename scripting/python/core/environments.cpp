// Environments: actions, resets, steps.
#include "environments.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "interruptible.h"
#include "keywords.h"

namespace stampede::python {
namespace {

using namespace nb::literals;

AgentAction skill_action(const std::string& skill, std::vector<std::string> arguments, const nb::dict& parameters,
                         const std::string& controller, int frames) {
  AgentAction action{.space = "skill", .controller = controller, .frames = frames, .skill = skill};
  action.arguments = std::move(arguments);
  for (const auto& [name, values] : parameters)
    action.parameters.push_back(
        {value_of<std::string>(name, "Action.skill_call(parameters=)"), numbers(values, "a parameter")});
  return action;
}

// `pick(cup, table)`
std::string call_text(const std::string& skill, const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += (text.empty() ? "" : ", ") + argument;
  return skill + "(" + text + ")";
}

nb::dict parameters_of(const AgentAction& action) {
  nb::dict all;
  for (const SkillParameter& one : action.parameters) all[one.name.c_str()] = one.values;
  return all;
}

void bind_spaces(nb::module_& module) {
  nb::class_<ActionComponent>(module, "ActionComponent", "One number of an action.")
      .def_ro("name", &ActionComponent::name, "`panda.joint1`, `x`")
      .def_ro("unit", &ActionComponent::unit)
      .def_ro("lower", &ActionComponent::lower)
      .def_ro("upper", &ActionComponent::upper, "both bounds are allowed");
  nb::class_<ActionSpace>(module, "ActionSpace", "A way to act: joint_position, tool_delta, skill …")
      .def_ro("name", &ActionSpace::name)
      .def_ro("components", &ActionSpace::components)
      .def("__repr__", [](const ActionSpace& space) {
        return "ActionSpace('" + space.name + "', " + std::to_string(space.components.size()) + " components)";
      });
}

void bind_action(nb::module_& module) {
  nb::class_<AgentAction>(module, "Action", R"(What an agent asks of the robot for one step.

space: joint_position (rad), joint_delta (rad), joint_velocity (rad/s), joint_torque (N m), tool_pose (x y z m,
qx qy qz qw), tool_delta (m, rotation vector rad), tool_velocity (m/s, rad/s), tool_impedance (a pose and a stiffness,
N/m), tool_path and tool_path_delta (planned around obstacles), gripper (m), release, hold, go_on, skill (see `skill_call`).
values: one a component of the space.
gripper: opening that the fingers go to beside any space of the arm, m; None: what they were told last.
frame: of tool spaces, `world` or `tool`.
controller: joint_position, joint_impedance or cartesian_impedance; empty: joint_position.
frames: of tool_path, hold and go_on: the step ends after so many; 0: at the end.)")
      .def(
          "__init__",
          [](AgentAction* self, const std::string& space, nb::handle values, std::optional<double> gripper,
             const std::string& frame, const std::string& controller, int frames) {
            new (self) AgentAction{.space = space,
                                   .values = numbers(values, "values"),
                                   .gripper = gripper,
                                   .frame = frame,
                                   .controller = controller,
                                   .frames = frames};
          },
          "space"_a, "values"_a = nb::none(), "gripper"_a = nb::none(), "frame"_a = "world", "controller"_a = "",
          "frames"_a = 0)
      .def_static("skill_call", &skill_action, "skill"_a, "arguments"_a, "parameters"_a = nb::dict(),
                  "controller"_a = "", "frames"_a = 0, R"(A whole skill as one action.

skill: an action of the domain, `pick`. arguments: names of objects, the hand among them, as Environment.skills lists
them. parameters: continuous ones that are not to be drawn, name -> number or list. controller: instead of the skill's
own. frames: the step ends after so many, and `Action("go_on")` goes on; 0: at the skill's end.)")
      .def_ro("space", &AgentAction::space)
      .def_ro("values", &AgentAction::values)
      .def_ro("gripper", &AgentAction::gripper)
      .def_ro("frame", &AgentAction::frame)
      .def_ro("controller", &AgentAction::controller)
      .def_ro("frames", &AgentAction::frames)
      .def_ro("skill", &AgentAction::skill)
      .def_ro("arguments", &AgentAction::arguments)
      .def_prop_ro("parameters", &parameters_of)
      .def("__eq__",
           [](const AgentAction& a, nb::handle b) {
             return nb::isinstance<AgentAction>(b) && a == nb::cast<const AgentAction&>(b);
           })
      .def("__repr__", [](const AgentAction& action) {
        std::string text = "Action('" + action.space + "'";
        if (action.space == "skill") {
          text += ": " + action.skill;
          for (const std::string& argument : action.arguments) text += " " + argument;
        } else if (!action.values.empty()) {
          text += ", " + std::to_string(action.values.size()) + " values";
        }
        return text + ")";
      });
}

void bind_asked(nb::module_& module) {
  nb::class_<AskedAction>(module, "AskedAction", "What an episode keeps of an action that was not refused.")
      .def_ro("asked", &AskedAction::asked)
      .def_ro("first_frame", &AskedAction::first_frame)
      .def_ro("end_frame", &AskedAction::end_frame, "half-open; equal to first_frame where nothing moved")
      .def_ro("segment", &AskedAction::segment, "of the skill whose policy asked; -1: who drives the episode")
      .def_ro("reward", &AskedAction::reward)
      .def_ro("terminated", &AskedAction::terminated)
      .def_ro("truncated", &AskedAction::truncated);
}

void bind_skills(nb::module_& module) {
  nb::class_<SkillChoice>(module, "SkillChoice", "A ground skill, and whether its precondition holds now.")
      .def_ro("skill", &SkillChoice::skill)
      .def_ro("arguments", &SkillChoice::arguments)
      .def_ro("feasible", &SkillChoice::feasible)
      .def("__repr__", [](const SkillChoice& choice) {
        return "SkillChoice(" + call_text(choice.skill, choice.arguments) + (choice.feasible ? ")" : ", not now)");
      });
  nb::class_<SkillParameterInfo>(module, "SkillParameterInfo", R"(A continuous parameter that a skill declares.

initial, lower, upper: one entry a component. Grasps and poses have 7 (x y z m, quaternion x y z w), a grasp an opening
in m as eighth, and no bounds.)")
      .def_ro("name", &SkillParameterInfo::name)
      .def_ro("unit", &SkillParameterInfo::unit)
      .def_ro("frame", &SkillParameterInfo::frame)
      .def_ro("initial", &SkillParameterInfo::initial)
      .def_ro("lower", &SkillParameterInfo::lower)
      .def_ro("upper", &SkillParameterInfo::upper)
      .def_ro("source", &SkillParameterInfo::source, "value, grasps or sample: where it comes from when it is not set");
  nb::class_<SkillDescription>(module, "SkillDescription", "A skill with what it takes.")
      .def_ro("skill", &SkillDescription::skill)
      .def_ro("parameters", &SkillDescription::parameters)
      .def_ro("types", &SkillDescription::types)
      .def_ro("continuous", &SkillDescription::continuous)
      .def_ro("controller", &SkillDescription::controller);
}

void bind_actions(nb::module_& module) {
  bind_spaces(module);
  bind_action(module);
  bind_asked(module);
  bind_skills(module);
}

void bind_changes(nb::module_& module) {
  nb::class_<StateFact>(module, "Fact", "A ground atom: `(on cup shelf)` is Fact.predicate `on`, arguments cup, shelf.")
      .def_ro("predicate", &StateFact::predicate)
      .def_ro("arguments", &StateFact::arguments)
      .def_ro("holds", &StateFact::holds, "in the simulator")
      .def_ro("known", &StateFact::known, "to who has seen what the robot has seen")
      .def("__str__",
           [](const StateFact& fact) {
             std::string text = "(" + fact.predicate;
             for (const std::string& argument : fact.arguments) text += " " + argument;
             return text + ")";
           })
      .def("__repr__", [](nb::handle self) { return nb::str(self); });
  nb::class_<ActionRefusal>(module, "ActionRefusal", "Why an action cannot be done. Nothing has changed then.")
      .def_ro("what", &ActionRefusal::what)
      .def_ro("cure", &ActionRefusal::cure)
      .def("__str__", [](const ActionRefusal& refusal) {
        return refusal.cure.empty() ? refusal.what : refusal.what + "\n    " + refusal.cure;
      });
  nb::class_<SkillEnd>(module, "SkillEnd", "A skill that ended in a step.")
      .def_ro("skill", &SkillEnd::skill)
      .def_ro("arguments", &SkillEnd::arguments)
      .def_ro("success", &SkillEnd::success)
      .def_ro("reason", &SkillEnd::reason, "`none`, or as in the catalogue")
      .def_ro("detail", &SkillEnd::detail)
      .def_ro("precondition_held", &SkillEnd::precondition_held, "None: not reached")
      .def_ro("effect_held", &SkillEnd::effect_held, "None: not reached")
      .def_ro("missing_effects", &SkillEnd::missing_effects)
      .def("__repr__", [](const SkillEnd& end) {
        return "SkillEnd(" + call_text(end.skill, end.arguments) + ": " + (end.success ? "success" : end.reason) + ")";
      });
}

void bind_steps(nb::module_& module) {
  nb::class_<Step>(module, "Step", "What a step led to.")
      .def_prop_ro(
          "observation", [](const Step& s) { return s.observation; }, "channel -> numpy array, or list of str")
      .def_prop_ro("frame", [](const Step& s) { return s.rest.observation.frame; })
      .def_prop_ro(
          "time_s", [](const Step& s) { return s.rest.observation.time_s; }, "simulated, since reset")
      .def_prop_ro("reward", [](const Step& s) { return s.rest.reward; })
      .def_prop_ro(
          "terminated", [](const Step& s) { return s.rest.terminated; }, "success, or the task has failed")
      .def_prop_ro(
          "truncated", [](const Step& s) { return s.rest.truncated; }, "the horizon")
      .def_prop_ro("success", [](const Step& s) { return s.rest.success; })
      .def_prop_ro(
          "refusal", [](const Step& s) { return s.rest.refusal; }, "the action was not done; None: it was")
      .def_prop_ro(
          "reason", [](const Step& s) { return s.rest.reason; }, "why the episode ended, or `none`")
      .def_prop_ro("detail", [](const Step& s) { return s.rest.detail; })
      .def_prop_ro(
          "frames", [](const Step& s) { return s.rest.frames; }, "that went by")
      .def_prop_ro(
          "changes", [](const Step& s) { return s.rest.changes; }, "facts that came (`holds`) and went")
      .def_prop_ro(
          "running", [](const Step& s) { return s.rest.running; }, "what was cut off and can go_on, or empty")
      .def_prop_ro(
          "ended", [](const Step& s) { return s.rest.ended; }, "skills")
      .def_prop_ro(
          "limited", [](const Step& s) { return s.rest.limited; },
          "what kept the arm from going as an action for a frame asks: any of speed, acceleration, jerk, torque,\n"
          "tool_speed, reference (it waits for an arm that does not get on), approach (something is ahead, and is met\n"
          "slowly), contact (the arm presses no harder)")
      .def("__repr__", [](const Step& s) {
        return "Step(frame " + std::to_string(s.rest.observation.frame) + ", reward " + std::to_string(s.rest.reward) +
               (s.rest.refusal ? ", refused" : "") + (s.rest.terminated ? ", terminated" : "") +
               (s.rest.truncated ? ", truncated" : "") + ")";
      });
  nb::class_<SavedState>(module, "SavedState", "A moment to which an environment of the same start can go back.")
      .def("__repr__", [](const SavedState&) { return "SavedState(a moment of an episode)"; });
}

void bind_results(nb::module_& module) {
  bind_changes(module);
  bind_steps(module);
}

class PythonPolicy : public Policy {
 public:
  explicit PythonPolicy(nb::object policy) : policy_(std::move(policy)) {}
  void begin(const PolicyCall& call) override {
    ask_python("begin() gives nothing", [&] {
      if (nb::hasattr(*policy_, "begin")) (*policy_).attr("begin")(nb::cast(call));
    });
  }
  std::optional<AgentAction> act(const EnvironmentObservation& now) override {
    return ask_python("act() gives a stampede.Action, or None when it is done", [&]() -> std::optional<AgentAction> {
      const nb::object asked = (*policy_).attr("act")(to_python(now));
      if (asked.is_none()) return std::nullopt;
      return nb::cast<AgentAction>(asked);
    });
  }

 private:
  Kept policy_;
};

}  // namespace

Step to_step(StepResult result) {
  NamedValues observation = to_python(std::move(result.observation));
  return {std::move(observation), std::move(result)};
}

std::function<std::unique_ptr<Policy>()> policy_maker(std::shared_ptr<Kept> factory) {
  return [factory = std::move(factory)] {
    return ask_python("a policy is made",
                      [&]() -> std::unique_ptr<Policy> { return std::make_unique<PythonPolicy>((**factory)()); });
  };
}

PyEnvironment::PyEnvironment(nb::object session_in, const std::string& task_in, const EnvironmentSettings& settings)
    : Owned("Environment", Turn::Others::fail,
            (*nb::cast<const PySession&>(session_in)).environment(task_in, settings)),
      task(task_in),
      session(std::move(session_in)) {}

void PyEnvironment::check_may_keep() const {
  const auto& made_by = nb::cast<const PySession&>(session);
  if (made_by.turn.was_left_behind())
    throw Error("Environment.episode", "this process was forked from the one that opened the catalogue",
                "make the Environment in this process");
}

namespace {

// For the cycle collector: a policy of the session's may hold the environment.
int traverse_environment(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (nb::inst_ready(self)) Py_VISIT(nb::inst_ptr<PyEnvironment>(self)->session.ptr());
  return 0;
}
int clear_environment(PyObject* self) {
  nb::inst_ptr<PyEnvironment>(self)->session.reset();
  return 0;
}
PyType_Slot kEnvironmentSlots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse_environment)},
                                   {Py_tp_clear, reinterpret_cast<void*>(&clear_environment)},
                                   {0, nullptr}};

// What is seen where an episode begins, or goes on from elsewhere.
template <typename Begin>
auto begun(PyEnvironment& self, const char* name, const Begin& begin) {
  const Using use(self.turn, name);
  return to_python(interruptible(begin));
}

// Longer than the frame that a set-point lasts.
bool may_last(const AgentAction& action) {
  return action.space == "skill" || action.space == "hold" || action.space == "go_on" ||
         action.space.starts_with("tool_path");
}

// What an environment says of itself.
template <typename Answer>
Answer asked(const PyEnvironment& self, const char* question, Answer (Environment::*answer)() const) {
  const Using use(self.turn, ("Environment." + std::string(question)).c_str());
  const Released free;
  return ((*self).*answer)();
}

void set_reward(EnvironmentSettings& settings, nb::handle value, const char* where) {
  const auto name = nb::cast<std::string>(value);
  const auto reward = value_named<RewardKind>(
      name, {{"sparse", RewardKind::sparse}, {"dense", RewardKind::dense}, {"task", RewardKind::task}});
  if (!reward)
    throw Error(std::string(where) + "(reward=)", "there is no reward '" + name + "'", "one of sparse, dense, task");
  settings.reward = *reward;
}

void set_renderer(EnvironmentSettings& settings, nb::handle value, const char* where) {
  const auto name = nb::cast<std::string>(value);
  const auto renderer = value_named<DrawnBy>(name, {{"own", DrawnBy::own}, {"osmesa", DrawnBy::osmesa}});
  if (!renderer)
    throw Error(std::string(where) + "(renderer=)", "there is no renderer '" + name + "'", "own or osmesa");
  settings.renderer = *renderer;
}

void set_picture_sizes(EnvironmentSettings& settings, nb::handle value, const char*) {
  for (const auto& [camera, size] : nb::cast<std::map<std::string, std::pair<int, int>>>(value))
    settings.picture_sizes[camera] = {size.first, size.second};
}

constexpr Keyword<EnvironmentSettings> kSettings[] = {
    {"channels", set_field<&EnvironmentSettings::channels>},
    {"hidden", set_field<&EnvironmentSettings::hidden>},
    {"reward", set_reward},
    {"frame_hz", set_field<&EnvironmentSettings::frame_hz>},
    {"physics_hz", set_field<&EnvironmentSettings::physics_hz>},
    {"horizon_s", set_field<&EnvironmentSettings::horizon_s>},
    {"record", set_field<&EnvironmentSettings::record>},
    {"width", set_field<&EnvironmentSettings::width>},
    {"height", set_field<&EnvironmentSettings::height>},
    {"picture_sizes", set_picture_sizes},
    {"shadows", set_field<&EnvironmentSettings::shadows>},
    {"renderer", set_renderer},
    {"picture_hz", set_field<&EnvironmentSettings::picture_hz>},
    {"rgb_noise", set_field<&EnvironmentSettings::rgb_noise>},
    {"depth_noise", set_field<&EnvironmentSettings::depth_noise>},
    {"torque_noise", set_field<&EnvironmentSettings::torque_noise>},
    {"torque_model", set_field<&EnvironmentSettings::torque_model>},
};

}  // namespace

EnvironmentSettings settings_from(const nb::kwargs& words, const char* where) {
  return from_keywords(kSettings, words, where);
}

namespace {

void bind_requests(nb::module_& module) {
  nb::class_<ResetRequest>(module, "Reset", R"(Which start an environment makes.

variation: canonical text, or axes of it; empty: the first. seed: of all draws; from 1'000'000 up: the test split.
where, goal: PDDL that must hold at the start, and instead of the task's goal. randomise: looks, light, cameras,
dynamics. perturb: what is otherwise than usual, `camera=1,layout=0.5`. episode, frame: instead of all these, that
frame of an episode of this engine. channels: observed from now on; None: as before.)")
      .def(
          "__init__",
          [](ResetRequest* self, const std::string& variation, std::int64_t seed, const std::string& where,
             const std::string& goal, bool randomise, const std::string& perturb, std::optional<Episode> episode,
             std::int64_t frame, std::optional<std::vector<std::string>> channels) {
            new (self) ResetRequest{.variation = variation,
                                    .seed = seed,
                                    .where = where,
                                    .goal = goal,
                                    .randomise = randomise,
                                    .perturb = perturb,
                                    .episode = std::move(episode),
                                    .frame = frame,
                                    .channels = std::move(channels)};
          },
          "variation"_a = "", "seed"_a = 0, "where"_a = "", "goal"_a = "", "randomise"_a = false, "perturb"_a = "",
          "episode"_a = nb::none(), "frame"_a = 0, "channels"_a = nb::none())
      .def_ro("variation", &ResetRequest::variation)
      .def_ro("seed", &ResetRequest::seed)
      .def("__repr__", [](const ResetRequest& request) {
        return "Reset(" + (request.variation.empty() ? "" : "'" + request.variation + "', ") + "seed " +
               std::to_string(request.seed) + ")";
      });
  nb::class_<PolicyCall>(module, "PolicyCall",
                         "What a skill was called with, for the policy that is its body; or the "
                         "task, for one that acts in a whole episode.")
      .def_ro("task", &PolicyCall::task)
      .def_ro("instruction", &PolicyCall::instruction)
      .def_ro("skill", &PolicyCall::skill, "empty: a whole episode")
      .def_ro("arguments", &PolicyCall::arguments, "parameter -> object")
      .def_ro("parameters", &PolicyCall::parameters, "continuous ones");
}

void bind_stepping(nb::class_<PyEnvironment>& environment) {
  environment
      .def(
          "reset",
          [](PyEnvironment& self, const ResetRequest& request) {
            return begun(self, "Environment.reset", [&] { return self->reset(request); });
          },
          "request"_a = ResetRequest{}, "A start. Raises Error for one that cannot be made.")
      .def(
          "reset",
          [](PyEnvironment& self, const SavedState& state) {
            return begun(self, "Environment.reset", [&] { return self->reset(state); });
          },
          "state"_a, "A saved state, whatever start is under way.")
      .def(
          "step",
          [](PyEnvironment& self, const AgentAction& action) {
            const Using use(self.turn, "Environment.step");
            if (may_last(action)) return to_step(interruptible([&] { return self->step(action); }));
            StepResult result;
            {
              const Released free;
              result = self->step(action);
            }
            return to_step(std::move(result));
          },
          "action"_a)
      .def("__repr__", [](const PyEnvironment& self) { return "Environment('" + self.task + "')"; })
      .def("observe",
           [](const PyEnvironment& self) {
             const Using use(self.turn, "Environment.observe");
             return to_python(self->observe());
           })
      .def(
          "picture",
          [](const PyEnvironment& self, const std::string& camera, int width, int height) {
            const Using use(self.turn, "Environment.picture");
            ChannelValue seen;
            {
              const Released free;
              seen = self->picture(camera, {width, height});
            }
            return to_python(std::move(seen));
          },
          "camera"_a, "width"_a = 0, "height"_a = 0,
          "What a camera sees now, without noise: height x width x 3, uint8. 0: the size that its channels have.");
}

void bind_asking(nb::class_<PyEnvironment>& environment) {
  environment
      .def_prop_ro(
          "frame_hz", [](const PyEnvironment& self) { return asked(self, "frame_hz", &Environment::frame_hz); },
          "Steps of set-points a second.")
      .def_prop_ro(
          "horizon_s", [](const PyEnvironment& self) { return asked(self, "horizon_s", &Environment::horizon_s); },
          "Simulated; the episode is truncated then. Before the first reset: of the first variation, as frame_hz, "
          "spaces and skill_descriptions.")
      .def(
          "instructions",
          [](const PyEnvironment& self) { return asked(self, "instructions", &Environment::instructions); },
          "What the task is called in words, for this start.")
      .def(
          "labels",
          [](const PyEnvironment& self) {
            std::map<std::string, std::vector<std::string>> labels;
            for (ChannelValue& channel : asked(self, "labels", &Environment::observe).channels)
              if (!channel.labels.empty()) labels[channel.name] = std::move(channel.labels);
            return labels;
          },
          "What the last axis of each channel counts, where it has names; see also atoms() and skills().")
      .def("spaces", [](const PyEnvironment& self) { return asked(self, "spaces", &Environment::spaces); })
      .def(
          "skills", [](const PyEnvironment& self) { return asked(self, "skills", &Environment::skills); },
          "Every ground skill of the scene, in a fixed order, with what can be done now.")
      .def(
          "skill_descriptions",
          [](const PyEnvironment& self) { return asked(self, "skill_descriptions", &Environment::skill_descriptions); })
      .def(
          "atoms", [](const PyEnvironment& self) { return asked(self, "atoms", &Environment::atoms); },
          "Ground atoms of the channels `facts` and `known`, in their order.");
}

void bind_saving(nb::class_<PyEnvironment>& environment) {
  environment
      .def(
          "save",
          [](PyEnvironment& self) {
            const Using use(self.turn, "Environment.save");
            const Released free;
            return self->save();
          },
          "Between two steps. What follows a save and a restore is equal, bit for bit.")
      .def(
          "restore",
          [](PyEnvironment& self, const SavedState& state) {
            return begun(self, "Environment.restore", [&] { return self->restore(state); });
          },
          "state"_a)
      .def(
          "episode",
          [](PyEnvironment& self) {
            const Using use(self.turn, "Environment.episode");
            self.check_may_keep();
            const Released free;
            return self->episode();
          },
          "The episode so far; it ends here. With `record` it is kept, in the session's catalogue where there is one.");
}

}  // namespace

void bind_environments(nb::module_& module) {
  bind_actions(module);
  bind_results(module);
  bind_requests(module);
  nb::class_<PyEnvironment> environment(module, "Environment", nb::type_slots(kEnvironmentSlots),
                                        R"(A task that the caller steps; made by Session.environment.

One thread at a time: another one, meanwhile, gets an Error. An action that cannot be done gives a Step with a
`refusal`, and nothing changed.)");
  bind_stepping(environment);
  bind_asking(environment);
  bind_saving(environment);
}

}  // namespace stampede::python
