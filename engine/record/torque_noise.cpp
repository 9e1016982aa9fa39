#include "engine/record/torque_noise.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace stampede {
namespace {

constexpr std::size_t kNumbers = 6;  // of a joint

double number_from(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    throw Error("episode options", "'" + text + "' is no number of a torque noise", "generate the catalogue again");
  return value;
}

}  // namespace

std::string to_text(const TorqueNoise& noise) {
  if (noise.empty()) return "";
  std::string text = number_text(noise.drift_time_s) + " " + number_text(noise.recorded_s);
  for (const JointTorqueNoise& one : noise.joints) {
    text += "," + one.joint;
    for (const double value : {one.coulomb, one.smooth, one.viscous, one.offset, one.drift, one.white})
      text += " " + number_text(value);
  }
  return text;
}

TorqueNoise torque_noise_from(std::string_view text) {
  TorqueNoise noise;
  if (text.empty()) return noise;
  const std::vector<std::string> parts = split(text, ',');
  const auto words_of = [](const std::string& part, std::size_t count) {
    std::vector<std::string> words = split(part, ' ');
    if (words.size() != count)
      throw Error("episode options", "'" + part + "' is no part of a torque noise", "generate the catalogue again");
    return words;
  };
  const std::vector<std::string> whole = words_of(parts.front(), 2);
  noise.drift_time_s = number_from(whole[0]);
  noise.recorded_s = number_from(whole[1]);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const std::vector<std::string> words = words_of(parts[i], 1 + kNumbers);
    std::array<double, kNumbers> values{};
    for (std::size_t k = 0; k < kNumbers; ++k) values.at(k) = number_from(words[1 + k]);
    const auto& [coulomb, smooth, viscous, offset, drift, white] = values;
    noise.joints.push_back({words[0], coulomb, smooth, viscous, offset, drift, white});
  }
  return noise;
}

TorqueNoise of_arm(const TorqueNoise& noise, const std::vector<std::string>& joints) {
  TorqueNoise ordered = noise;
  ordered.joints.clear();
  for (const std::string& joint : joints) {
    const auto found = std::find_if(noise.joints.begin(), noise.joints.end(),
                                    [&](const JointTorqueNoise& one) { return one.joint == joint; });
    if (found == noise.joints.end())
      throw Error("torque noise", "it says nothing of " + joint + ", a joint of the world's arm",
                  "fit it to a recording of this robot: its joints are " + joined(joints));
    ordered.joints.push_back(*found);
  }
  for (const JointTorqueNoise& one : noise.joints)
    if (std::find(joints.begin(), joints.end(), one.joint) == joints.end())
      throw Error("torque noise", "the world's arm has no joint '" + one.joint + "'",
                  "fit it to a recording of this robot: its joints are " + joined(joints));
  return ordered;
}

double warm_up_s(const TorqueNoise& noise, RandomKey key) {
  return Random(key.with("warm up")).uniform() * noise.recorded_s;
}

double torque_error(const TorqueNoise& noise, std::size_t index, double velocity, double since_on_s, Random& random) {
  const JointTorqueNoise& one = noise.joints[index];
  const double friction = one.coulomb * std::tanh(velocity / one.smooth) + one.viscous * velocity;
  const double drift = one.drift * (1 - std::exp(-since_on_s / noise.drift_time_s));
  return friction + one.offset + drift + one.white * random.normal();
}

}  // namespace stampede
