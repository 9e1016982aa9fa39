// Options of a run as text: what keys and catalogues hold.
#include "engine/start/options.h"

#include <array>
#include <charconv>
#include <sstream>

#include "engine/base/enum_names.h"
#include "engine/base/hash.h"
#include "engine/base/text.h"
#include "engine/model/operation.h"
#include "engine/motion/planner.h"
#include "engine/record/observation.h"
#include "engine/start/call_settings.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 3> kOnFailure{"undo", "stop", "recover"};
constexpr std::array<std::string_view, 3> kBehaviours{"plan", "random_skills", "random_applicable"};

// All but what it reads.
std::string text_of(const SensorEntry& entry) {
  std::string text = entry.version + "; " + std::to_string(entry.rate_hz) + " Hz; " + entry.unit;
  for (const std::string& component : entry.components) text += "; " + component;
  return text;
}

std::string text_of(const Randomisation& ranges) {
  std::ostringstream text;
  text.precision(17);
  const auto list = [&](const char* name, const std::vector<std::string>& words) {
    text << name << '=';
    for (const std::string& word : words) text << word << ',';
    text << ' ';
  };
  const auto range = [&](const char* name, const Range& value) {
    text << name << '=' << value[0] << ".." << value[1] << ' ';
  };
  list("looks", ranges.looks);
  text << "colours=";
  for (const Colour& c : ranges.colours) text << c.red << '/' << c.green << '/' << c.blue << '/' << c.alpha << ',';
  text << ' ';
  list("textures", ranges.textures);
  range("ambient", ranges.ambient);
  range("diffuse", ranges.diffuse);
  text << "light_direction=" << ranges.light_direction_rad << " camera_position=" << ranges.camera_position_m
       << " camera_rotation=" << ranges.camera_rotation_rad << ' ';
  list("dynamics", ranges.dynamics);
  range("mass", ranges.mass);
  range("friction", ranges.friction);
  range("damping", ranges.damping);
  return text.str();
}

}  // namespace

std::string_view to_string(OnFailure value) { return enum_name(kOnFailure, value); }
std::optional<OnFailure> on_failure_from(std::string_view text) { return enum_from<OnFailure>(kOnFailure, text); }

std::string_view to_string(Behaviour value) { return enum_name(kBehaviours, value); }
std::optional<Behaviour> behaviour_from(std::string_view text) { return enum_from<Behaviour>(kBehaviours, text); }

std::map<std::string, std::string> RunOptions::as_text() const {
  std::map<std::string, std::string> text = {{"on_failure", std::string(to_string(on_failure))},
                                             {"tries_per_skill", std::to_string(tries_per_skill)},
                                             {"tries_per_episode", std::to_string(tries_per_episode)},
                                             {"plans", std::to_string(plans)},
                                             {"draws", std::to_string(draws)}};
  if (!controller.empty()) text["controller"] = controller;
  if (!motion_planner.empty()) text["motion_planner"] = motion_planner;
  if (!set.empty()) text["set"] = to_text(set);
  if (where) text["where"] = to_pddl(*where);
  if (goal) text["goal"] = to_pddl(*goal);
  if (behaviour != Behaviour::plan) {
    text["behaviour"] = to_string(behaviour);
    text["skills"] = std::to_string(skills);
  }
  if (physics_hz > 0) text["physics_hz"] = std::to_string(physics_hz);
  if (frame_hz > 0) text["frame_hz"] = std::to_string(frame_hz);
  if (horizon_s > 0) text["horizon_s"] = std::to_string(horizon_s);
  if (policies)
    for (const auto& [name, entry] : *policies) text["policy_" + name] = entry.version;
  if (sensors)
    for (const auto& [name, entry] : *sensors) text["sensor_" + name] = text_of(entry);
  if (planner) text["planner"] = planner.name;
  text.merge(observation.as_text());
  if (randomise) text["randomise"] = text_of(*randomise);
  if (!perturb.empty()) text["perturb"] = to_text(perturb);
  if (sentences && !sentences->empty()) {
    Hasher hasher;
    for (const MadeSentence& one : *sentences)
      hasher.text(to_string(one.level)).text(one.of).text(one.text).text(to_string(one.grain)).text(one.model);
    text["sentences"] = hasher.digest();
  }
  if (!cameras.empty()) {  // as their scene's document tells them apart, to the last bit
    Scene scene;
    scene.cameras = cameras;
    text["cameras"] = content_hash(scene_to_document(scene));
  }
  return text;
}

RunOptions options_from(const std::map<std::string, std::string>& text) {
  RunOptions options;
  const auto with = [&](const char* name, const auto& take) {
    if (const auto found = text.find(name); found != text.end()) take(found->second);
  };
  const auto number = [&](const char* name, auto& value) {
    with(name, [&](const std::string& told) { std::from_chars(told.data(), told.data() + told.size(), value); });
  };
  with("on_failure", [&](const auto& told) { options.on_failure = on_failure_from(told).value_or(OnFailure::undo); });
  number("tries_per_skill", options.tries_per_skill);
  number("tries_per_episode", options.tries_per_episode);
  number("plans", options.plans);
  number("draws", options.draws);
  with("controller", [&](const auto& told) { check_controller(options.controller = told, "controller"); });
  with("motion_planner",
       [&](const auto& told) { check_motion_planner(options.motion_planner = told, "motion_planner"); });
  with("set", [&](const auto& told) {
    for (const std::string& one : split(told, ' ')) add_skill_setting(one, options.set, "set");
  });
  with("where", [&](const auto& told) { options.where = formula_from_pddl(told, "where"); });
  with("goal", [&](const auto& told) { options.goal = formula_from_pddl(told, "goal"); });
  with("behaviour", [&](const auto& told) { options.behaviour = behaviour_from(told).value_or(Behaviour::plan); });
  number("skills", options.skills);
  number("physics_hz", options.physics_hz);
  number("frame_hz", options.frame_hz);
  number("horizon_s", options.horizon_s);
  options.observation = observation_from(text);
  with("randomise", [&](const auto&) { options.randomise = default_randomisation(); });
  with("perturb", [&](const auto& told) { options.perturb = perturbation_from(told, "perturb"); });
  const std::map<std::string, std::string> again = options.as_text();
  for (const auto& [name, told] : text) {
    const auto found = again.find(name);
    if (found == again.end() || found->second != told)
      throw Error("", "of the option '" + name + "' the catalogue keeps too little to use it again");
  }
  return options;
}

}  // namespace stampede
