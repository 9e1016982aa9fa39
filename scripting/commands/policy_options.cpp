#include "scripting/commands/policy_options.h"

#include <algorithm>

#include "engine/base/text.h"
#include "scripting/commands/commands.h"

namespace stampede::program {
namespace {

constexpr std::int64_t kMostPatience_s = 86'400;

std::vector<std::string> observed(const std::string& text) {
  std::vector<std::string> names = split(text, ',');
  if (std::find(names.begin(), names.end(), "") != names.end())
    throw UsageError("--observe: a name is missing in '" + text + "'", "--observe gripper_pose,object_pose,front_rgb");
  return names;
}

RewardKind reward_from(const std::string& name) {
  return name == "dense" ? RewardKind::dense : name == "task" ? RewardKind::task : RewardKind::sparse;
}

}  // namespace

std::vector<OptionRow> policy_options() {
  return {{"--policy",
           "COMMAND",
           "a program that acts instead of the planner: it reads observations and writes actions, a line of JSON each "
           "(scripting/session/POLICIES.md)",
           Takes::text,
           "",
           {},
           false},
          {"--policy-timeout", "S", "seconds that it may take for an action", Takes::integer, "60", {}, false},
          {"--observe",
           "CHANNELS",
           "what it observes: joint_positions,object_pose,front_rgb,fact_names; default: joints, hand and objects",
           Takes::text,
           "",
           {},
           false},
          {"--reward",
           "KIND",
           "what it is told: 1 at success, how far a plan for the goal has come, or the task's own",
           Takes::text,
           "sparse",
           {"sparse", "dense", "task"},
           false}};
}

std::optional<PolicySettings> policy_settings(const Arguments& arguments, const ObservationChoice& pictures) {
  if (!arguments.has("--policy")) {
    for (const char* option : {"--policy-timeout", "--observe", "--reward"})
      if (arguments.has(option)) throw UsageError(std::string(option) + " is of a policy", "add --policy COMMAND");
    return std::nullopt;
  }
  for (const char* option : {"--behaviour", "--skills", "--planner", "--on-failure"})
    if (arguments.has(option))
      throw UsageError(std::string(option) + " is of the planner, which does not act beside --policy",
                       std::string("leave out one of --policy and ") + option);
  if (arguments.integer("--workers").value_or(1) > 1)
    throw UsageError(
        "--policy: one program acts in one episode after the other, with one worker",
        "leave --workers out; several runs at once: --shard 1/2 --out part1.db, --shard 2/2 --out part2.db");
  PolicySettings settings;
  settings.command = arguments.text("--policy");
  if (settings.command.find_first_not_of(" \t\n") == std::string::npos)
    throw UsageError("--policy needs a command", "--policy \"python3 policy.py\"");
  settings.patience = std::chrono::seconds(in_range(arguments, "--policy-timeout", 1, kMostPatience_s));
  EnvironmentSettings& environment = settings.environment;
  if (arguments.has("--observe")) environment.channels = observed(arguments.text("--observe"));
  environment.reward = reward_from(arguments.text("--reward"));
  if (pictures.size) environment.width = pictures.size->at(0), environment.height = pictures.size->at(1);
  environment.shadows = pictures.shadows.value_or(false);
  environment.renderer = pictures.renderer.value_or(DrawnBy::own);
  environment.rgb_noise = pictures.rgb_noise.value_or(0);
  environment.depth_noise = pictures.depth_noise.value_or(0);
  environment.torque_noise = pictures.torque_noise.value_or(0);
  environment.torque_model = to_text(pictures.torque_model.value_or(TorqueNoise{}));
  return settings;
}

}  // namespace stampede::program
