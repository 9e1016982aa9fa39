#include "engine/start/call_settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/start/declared.h"

namespace stampede {
namespace {

constexpr const char* kStopAtVias = "stop_at_vias";

template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string full_name(const SkillInfo& skill, const std::string& parameter) { return skill.name + "." + parameter; }

// How many values the parameter may be given.
std::vector<std::size_t> counts(const ContinuousInfo& info) {
  switch (info.source) {
    case ContinuousInfo::Source::value:
      return {info.initial.size()};
    case ContinuousInfo::Source::sample:
      return {7};
    case ContinuousInfo::Source::grasps:
      return {7, 8};
  }
  return {};
}

void check_bounds(const std::string& name, const ContinuousInfo& info, std::size_t component, double value,
                  const std::string& place) {
  const auto refuse = [&](const char* word, double bound) {
    throw Error(place, name + " is " + word + " " + number_text(bound) + info.unit + ", not " + number_text(value));
  };
  if (info.source != ContinuousInfo::Source::value) return;
  if (value < info.lower[component]) refuse("at least", info.lower[component]);
  if (value > info.upper[component]) refuse("at most", info.upper[component]);
}

void check_value(const SkillInfo& skill, const ContinuousInfo& info, const CallSettings::Value& value,
                 const std::string& place) {
  const std::string name = full_name(skill, info.name);
  for (const double one : value.values)
    if (!std::isfinite(one)) throw Error(place, name + " must be finite");
  if (value.component > 0) {
    if (info.source != ContinuousInfo::Source::value)
      throw Error(place, name + " is set as a whole, not by component", "give all its 7 values");
    const auto count = info.initial.size();
    if (static_cast<std::size_t>(value.component) > count || value.values.size() != 1)
      throw Error(place, name + " has the components 1 to " + std::to_string(count));
    return check_bounds(name, info, static_cast<std::size_t>(value.component) - 1, value.values[0], place);
  }
  const std::vector<std::size_t> allowed = counts(info);
  if (std::find(allowed.begin(), allowed.end(), value.values.size()) == allowed.end())
    throw Error(place, name + " has " + std::to_string(allowed.front()) + " values, not " +
                           std::to_string(value.values.size()));
  for (std::size_t i = 0; i < value.values.size(); ++i) check_bounds(name, info, i, value.values[i], place);
  if (info.source == ContinuousInfo::Source::value) return;
  const auto q = [&](std::size_t i) { return value.values[3 + i]; };
  if (q(0) * q(0) + q(1) * q(1) + q(2) * q(2) + q(3) * q(3) < 1e-6)
    throw Error(place, name + ": its quaternion has no length", "x y z, then the quaternion x y z w: 0 0 0 1");
}

}  // namespace

void check_settings(const SkillInfo& skill, const CallSettings& set, const std::string& place) {
  for (const CallSettings::Value& value : set.values) {
    const auto found = std::find_if(skill.continuous.begin(), skill.continuous.end(),
                                    [&](const ContinuousInfo& info) { return info.name == value.parameter; });
    if (found != skill.continuous.end()) {
      check_value(skill, *found, value, place);
      continue;
    }
    std::vector<std::string> names = {"controller"};
    for (const ContinuousInfo& info : skill.continuous) names.push_back(info.name);
    throw Error(place, "skill '" + skill.name + "' has no continuous parameter '" + value.parameter + "'",
                did_you_mean(value.parameter, names));
  }
}

void add_setting(std::string_view name, std::string_view value, CallSettings& set, const std::string& place) {
  if (name == "controller") {
    check_controller(value, place);
    set.controller = controller_from(value);
    return;
  }
  CallSettings::Value one;
  const std::size_t dot = name.find('.');
  one.parameter = name.substr(0, dot);
  if (dot != std::string_view::npos) {
    one.component = whole_number<int>(name.substr(dot + 1)).value_or(0);
    if (one.component < 1)
      throw Error(place, "'" + std::string(name.substr(dot + 1)) + "' is no component", "components count from 1");
  }
  for (const std::string& text : split(value, ',')) {
    const std::optional<double> number = whole_number<double>(text);
    if (!number) throw Error(place, std::string(name) + ": '" + text + "' is no number");
    one.values.push_back(*number);
  }
  set.values.push_back(std::move(one));
}

void add_skill_setting(std::string_view text, std::map<std::string, CallSettings>& set, const std::string& place) {
  const std::size_t equals = text.find('='), dot = text.substr(0, equals).find('.');
  if (equals == std::string_view::npos || dot == std::string_view::npos || dot == 0 || dot + 1 == equals)
    throw Error(place, "'" + std::string(text) + "' sets nothing",
                "write SKILL.PARAMETER=VALUE, such as pick.height=0.2 or pick.controller=joint_impedance");
  add_setting(text.substr(dot + 1, equals - dot - 1), text.substr(equals + 1), set[std::string(text.substr(0, dot))],
              place);
}

void check_motion_settings(const CallSettings& set, const std::string& place) {
  if (set.controller)
    throw Error(place, "motions have no controller of their own", "set it of a skill: pick.controller=…");
  for (const CallSettings::Value& value : set.values) {
    if (value.parameter != kStopAtVias)
      throw Error(place, "motions have no parameter '" + value.parameter + "'",
                  did_you_mean(value.parameter, {kStopAtVias}));
    if (value.component > 0 || value.values.size() != 1 || (value.values[0] != 0 && value.values[0] != 1))
      throw Error(place, std::string(kOfMotions) + "." + kStopAtVias + " is 0 or 1");
  }
}

bool stops_at_vias(const std::map<std::string, CallSettings>& all) {
  const auto found = all.find(kOfMotions);
  return found != all.end() && !found->second.values.empty() && found->second.values.back().values[0] == 1;
}

std::string to_text(const std::map<std::string, CallSettings>& set) {
  std::string text;
  const auto add = [&](const std::string& name, const std::string& value) {
    text += (text.empty() ? "" : " ") + name + "=" + value;
  };
  for (const auto& [skill, one] : set) {
    for (const CallSettings::Value& value : one.values) {
      std::string values;
      for (const double number : value.values) values += (values.empty() ? "" : ",") + number_text(number);
      add(skill + "." + value.parameter + (value.component > 0 ? "." + std::to_string(value.component) : ""), values);
    }
    if (one.controller) add(skill + ".controller", std::string(to_string(*one.controller)));
  }
  return text;
}

}  // namespace stampede
