#include "scripting/session/policy_json.h"

#include <algorithm>
#include <map>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/read_json.h"
#include "engine/symbolic/symbols.h"
#include "scripting/session/policy_program.h"

namespace stampede {
namespace {

using Ordered = nlohmann::ordered_json;
using Parsed = nlohmann::json;

constexpr const char* kPictureEndings[] = {"_rgb", "_depth", "_mask", "_semantic_mask", "_point_cloud"};
constexpr const char* kTypes[] = {"float64", "uint8", "float32", "uint16", "int64", "text"};  // as in ChannelValue

std::string one_line(const Ordered& message) { return message.dump(-1, ' ', false, Ordered::error_handler_t::replace); }

std::string fact_text(const std::string& name, const std::vector<std::string>& arguments) {
  return to_text(Fact{name, arguments});
}

Ordered optional_truth(const std::optional<bool>& value) { return value ? Ordered(*value) : Ordered(nullptr); }

Ordered spaces_json(const std::vector<ActionSpace>& spaces) {
  Ordered list = Ordered::array();
  for (const ActionSpace& space : spaces) {
    Ordered components = Ordered::array();
    for (const ActionComponent& one : space.components)
      components.push_back({{"name", one.name}, {"unit", one.unit}, {"lower", one.lower}, {"upper", one.upper}});
    list.push_back({{"name", space.name}, {"components", std::move(components)}});
  }
  return list;
}

Ordered skills_json(const std::vector<SkillDescription>& skills) {
  Ordered list = Ordered::array();
  for (const SkillDescription& skill : skills) {
    Ordered continuous = Ordered::array();
    for (const SkillParameterInfo& one : skill.continuous)
      continuous.push_back({{"name", one.name},
                            {"unit", one.unit},
                            {"frame", one.frame},
                            {"initial", one.initial},
                            {"lower", one.lower},
                            {"upper", one.upper},
                            {"source", one.source}});
    list.push_back({{"skill", skill.skill},
                    {"parameters", skill.parameters},
                    {"types", skill.types},
                    {"continuous", std::move(continuous)},
                    {"controller", skill.controller}});
  }
  return list;
}

Ordered channels_json(const EnvironmentObservation& seen) {
  Ordered list = Ordered::array();
  for (const ChannelValue& one : seen.channels)
    list.push_back({{"name", one.name},
                    {"shape", one.shape},
                    {"unit", one.unit},
                    {"frame", one.frame},
                    {"type", kTypes[one.data.index()]}});
  return list;
}

Ordered observation_json(const EnvironmentObservation& seen, const PictureStore& pictures) {
  Ordered values = Ordered::object();
  for (const ChannelValue& one : seen.channels) {
    if (is_picture(one))
      values[one.name] = pictures(one);
    else
      std::visit([&](const auto& data) { values[one.name] = data; }, one.data);
  }
  return values;
}

bool observes(const EnvironmentObservation& seen, std::initializer_list<const char*> names) {
  return std::any_of(seen.channels.begin(), seen.channels.end(), [&](const ChannelValue& one) {
    return std::find(names.begin(), names.end(), one.name) != names.end();
  });
}

// What the places of channels `facts`, `known` and `applicable` stand for.
void put_names(const Environment& world, const EnvironmentObservation& seen, Ordered& message) {
  if (observes(seen, {"facts", "known"})) {
    Ordered& atoms = message["atoms"] = Ordered::array();
    for (const StateFact& one : world.atoms()) atoms.push_back(fact_text(one.predicate, one.arguments));
  }
  if (observes(seen, {"applicable"})) {
    Ordered& ground = message["ground_skills"] = Ordered::array();
    for (const SkillChoice& one : world.skills()) ground.push_back(fact_text(one.skill, one.arguments));
  }
}

// A value of the program's line, which knows its key.
class Answer {
 public:
  Answer(const Parsed& json, std::string key) : json_(json), key_(std::move(key)) {}

  [[noreturn]] void fail(const std::string& expected) const {
    throw Error("", "key '" + key_ + "' is " + shown() + ", not " + expected, "");
  }
  std::string text() const {
    if (!json_.is_string()) fail("a text");
    return json_.get<std::string>();
  }
  double number() const {
    if (!json_.is_number()) fail("a number");
    return json_.get<double>();
  }
  int count() const {
    constexpr std::int64_t kMost = 1'000'000'000;
    if (!json_.is_number_integer() || json_.get<std::int64_t>() < -kMost || json_.get<std::int64_t>() > kMost)
      fail("a whole number of frames");
    return static_cast<int>(json_.get<std::int64_t>());
  }
  std::vector<Answer> list(const char* expected) const {
    if (!json_.is_array()) fail(expected);
    std::vector<Answer> items;
    for (std::size_t i = 0; i < json_.size(); ++i) items.emplace_back(json_[i], key_ + "[" + std::to_string(i) + "]");
    return items;
  }
  std::vector<double> numbers() const {
    std::vector<double> values;
    for (const Answer& one : list("a list of numbers")) values.push_back(one.number());
    return values;
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> values;
    for (const Answer& one : list("a list of texts")) values.push_back(one.text());
    return values;
  }
  std::vector<SkillParameter> parameters() const {
    if (!json_.is_object()) fail("an object such as {\"height\": [0.2]}");
    std::vector<SkillParameter> values;
    for (const auto& [name, value] : json_.items())
      values.push_back({name, Answer(value, key_ + "." + name).numbers()});
    return values;
  }
  bool truth() const {
    if (!json_.is_boolean()) fail("true or false");
    return json_.get<bool>();
  }

 private:
  std::string shown() const {
    constexpr std::size_t kMost = 60;
    const std::string text = json_.dump();
    return text.size() <= kMost ? text : std::string(json_.type_name());
  }
  const Parsed& json_;
  std::string key_;
};

const std::map<std::string, void (*)(const Answer&, AgentAction&)>& action_keys() {
  static const std::map<std::string, void (*)(const Answer&, AgentAction&)> keys = {
      {"space", [](const Answer& value, AgentAction& action) { action.space = value.text(); }},
      {"values", [](const Answer& value, AgentAction& action) { action.values = value.numbers(); }},
      {"gripper", [](const Answer& value, AgentAction& action) { action.gripper = value.number(); }},
      {"frame", [](const Answer& value, AgentAction& action) { action.frame = value.text(); }},
      {"controller", [](const Answer& value, AgentAction& action) { action.controller = value.text(); }},
      {"frames", [](const Answer& value, AgentAction& action) { action.frames = value.count(); }},
      {"skill", [](const Answer& value, AgentAction& action) { action.skill = value.text(); }},
      {"arguments", [](const Answer& value, AgentAction& action) { action.arguments = value.texts(); }},
      {"parameters", [](const Answer& value, AgentAction& action) { action.parameters = value.parameters(); }}};
  return keys;
}

}  // namespace

bool is_picture(const ChannelValue& channel) {
  return channel.shape.size() > 1 && std::any_of(std::begin(kPictureEndings), std::end(kPictureEndings),
                                                 [&](const char* ending) { return channel.name.ends_with(ending); });
}

std::string reset_line(const PolicyEpisode& episode, const Environment& world, const EnvironmentObservation& seen,
                       const PictureStore& pictures) {
  Ordered message = {{"type", "reset"},
                     {"task", episode.task},
                     {"variation", episode.variation},
                     {"seed", episode.seed},
                     {"instructions", episode.instructions},
                     {"spaces", spaces_json(world.spaces())},
                     {"skills", skills_json(world.skill_descriptions())},
                     {"channels", channels_json(seen)}};
  put_names(world, seen, message);
  message["observation"] = observation_json(seen, pictures);
  return one_line(message);
}

std::string step_line(const StepResult& result, const PictureStore& pictures) {
  Ordered changes = Ordered::array(), ended = Ordered::array();
  for (const StateFact& one : result.changes)
    changes.push_back({{"fact", fact_text(one.predicate, one.arguments)}, {"holds", one.holds}});
  for (const SkillEnd& one : result.ended)
    ended.push_back({{"skill", one.skill},
                     {"arguments", one.arguments},
                     {"success", one.success},
                     {"reason", one.reason},
                     {"detail", one.detail},
                     {"precondition_held", optional_truth(one.precondition_held)},
                     {"effect_held", optional_truth(one.effect_held)},
                     {"missing_effects", one.missing_effects}});
  Ordered refusal = nullptr;
  if (result.refusal) refusal = {{"what", result.refusal->what}, {"cure", result.refusal->cure}};
  return one_line({{"type", "step"},
                   {"observation", observation_json(result.observation, pictures)},
                   {"frame", result.observation.frame},
                   {"time_s", result.observation.time_s},
                   {"reward", result.reward},
                   {"terminated", result.terminated},
                   {"truncated", result.truncated},
                   {"success", result.success},
                   {"reason", result.reason},
                   {"detail", result.detail},
                   {"refusal", std::move(refusal)},
                   {"frames", result.frames},
                   {"changes", std::move(changes)},
                   {"running", result.running},
                   {"ended", std::move(ended)}});
}

std::optional<AgentAction> action_from_line(const std::string& line) {
  JsonLimits limits;
  limits.depth = 8;  // answers need four
  limits.values = kLongestPolicyLine / 2;
  const Parsed answer = json_from_text(line, "", "", limits);
  if (!answer.is_object()) throw Error("", std::string("it is no object but of type ") + answer.type_name(), "");
  if (const auto end = answer.find("end"); end != answer.end()) {
    const Answer value(*end, "end");
    if (!value.truth() || answer.size() > 1) value.fail("true and alone");
    return std::nullopt;
  }
  AgentAction action;
  std::vector<std::string> known = {"end"};
  for (const auto& [key, read] : action_keys()) known.push_back(key);
  for (const auto& [key, value] : answer.items()) {
    const auto read = action_keys().find(key);
    if (read == action_keys().end()) throw Error("", "there is no key '" + key + "'", did_you_mean(key, known));
    if (!value.is_null()) read->second(Answer(value, key), action);
  }
  if (action.space.empty()) throw Error("", "key 'space' is missing", "");
  return action;
}

}  // namespace stampede
