#include "engine/start/perturbation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "engine/base/enum_names.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/model/randomise.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 7> kAxisNames{"layout", "camera",  "start", "sentence",
                                                     "light",  "texture", "noise"};
constexpr double kStrongest = 10;

// Of strength 1.
constexpr int kThings = 3;
constexpr double kCamera_m = 0.05, kCamera_rad = 5 * std::numbers::pi / 180;
constexpr double kStart_rad = 0.2;
constexpr double kShare = 0.3, kDarkest = 0.05, kLight_rad = 40 * std::numbers::pi / 180;
constexpr SensorNoise kNoise{0.05, 3 * 0.00145, 0.5};

constexpr std::array kFrames{"please {}",
                             "{}, please",
                             "robot, this is your job: {}",
                             "here is what I would like: {}",
                             "{}; take the time that you need",
                             "now then: {}",
                             "one more thing to do: {}",
                             "when you are ready: {}"};
constexpr std::array kAsides{"the coffee is cold already, but never mind. {}",
                             "somebody will come by later to look at the cables. {}",
                             "yesterday's tray went to the kitchen, which is settled. {}",
                             "{}. I shall be in the next room until lunch",
                             "it has rained since the morning. {}",
                             "{}. The floor was cleaned an hour ago"};
// Whole words that another says as well in every sentence.
constexpr std::array<std::array<const char*, 2>, 16> kWords{{{"put", "set"},
                                                             {"raise", "lift"},
                                                             {"lift", "raise"},
                                                             {"bring", "carry"},
                                                             {"carry", "bring"},
                                                             {"pull", "tug"},
                                                             {"push", "shove"},
                                                             {"shove", "push"},
                                                             {"store", "stow"},
                                                             {"cube", "block"},
                                                             {"cubes", "blocks"},
                                                             {"cash", "money"},
                                                             {"table", "worktop"},
                                                             {"grasp", "grip"},
                                                             {"saucepan", "pan"},
                                                             {"rubbish", "litter"}}};

double strength_of(const Perturbation& perturbation, PerturbationAxis axis) {
  const auto found = perturbation.find(axis);
  return found == perturbation.end() ? 0 : found->second;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Calls change(word) for each word and puts its answer in the word's place.
template <typename Change>
std::string with_words(const std::string& sentence, Change&& change) {
  std::string result;
  for (std::size_t i = 0; i < sentence.size();) {
    std::size_t end = i;
    while (end < sentence.size() && is_letter(sentence[end])) ++end;
    if (end == i)
      result += sentence[i++];
    else
      result += change(sentence.substr(i, end - i));
    i = std::max(i, end);
  }
  return result;
}

std::string other_word(const std::string& word) {
  for (const auto& [from, to] : kWords)
    if (word == from) return to;
  return word;
}

// Two neighbouring letters inside a long word change places.
std::string mistyped(std::string word, Random& random) {
  constexpr std::int64_t kShortest = 5;
  const auto length = static_cast<std::int64_t>(word.size());
  if (length < kShortest || random.uniform() < 0.5) return word;
  const auto at = static_cast<std::size_t>(1 + random.below(length - 3));
  std::swap(word[at], word[at + 1]);
  return word;
}

template <std::size_t N>
std::string framed(const std::array<const char*, N>& frames, const std::string& sentence, Random& random) {
  std::string frame = frames.at(static_cast<std::size_t>(random.below(N)));
  return frame.replace(frame.find("{}"), 2, sentence);
}

void move_joints(Robot& robot, double reach_rad, RandomKey key) {
  Random random(key);
  for (const int part : robot.arm) {
    Joint& joint = robot.body.parts[static_cast<std::size_t>(part)].joint;
    const double margin = 0.02 * (joint.upper - joint.lower);
    joint.initial =
        std::clamp(joint.initial + random.between(-reach_rad, reach_rad), joint.lower + margin, joint.upper - margin);
  }
}

// Which things look otherwise, where not all do.
std::vector<std::string> some_things(const Scene& scene, double share, RandomKey key) {
  if (share >= 1) return {"*"};
  std::vector<std::string> names;
  for (const Body& body : scene.bodies)
    if (Random(key.with(body.name)).uniform() < share) names.push_back(body.name);
  if (Random(key.with("robot")).uniform() < share) names.emplace_back("robot");
  return names;
}

}  // namespace

std::string_view to_string(PerturbationAxis axis) { return enum_name(kAxisNames, axis); }

Perturbation perturbation_from(const std::string& text, const std::string& where) {
  Perturbation perturbation;
  for (const std::string& part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    const std::string name = part.substr(0, equals);
    const auto found = enum_from<PerturbationAxis>(kAxisNames, name);
    if (!found)
      throw Error(where, "there is no axis '" + name + "'", did_you_mean(name, {kAxisNames.begin(), kAxisNames.end()}));
    double strength = 1;
    if (equals != std::string::npos) {
      const char *begin = part.data() + equals + 1, *end = part.data() + part.size();
      const auto [last, fault] = std::from_chars(begin, end, strength);
      if (fault != std::errc() || last != end || begin == end || !(strength > 0) || strength > kStrongest)
        throw Error(where, "'" + part.substr(equals + 1) + "' is no strength of " + name,
                    "a number above 0, at most " + number_text(kStrongest) + ": " + name + "=2");
    }
    if (!perturbation.emplace(*found, strength).second)
      throw Error(where, "'" + name + "' is named twice", "leave one out");
  }
  return perturbation;
}

std::string to_text(const Perturbation& perturbation) {
  std::string text;
  for (const auto& [axis, strength] : perturbation)
    text += (text.empty() ? "" : ",") + std::string(to_string(axis)) + "=" + number_text(strength);
  return text;
}

void perturb(Scene& scene, const Perturbation& perturbation, RandomKey key, const std::vector<std::string>& said) {
  const auto strength = [&](PerturbationAxis axis) { return strength_of(perturbation, axis); };
  const auto draw = [&](PerturbationAxis axis, const Randomisation& ranges) {
    if (strength(axis) > 0) randomise(scene, ranges, key.with(to_string(axis)), said);
  };
  Randomisation camera;
  camera.camera_position_m = kCamera_m * strength(PerturbationAxis::camera);
  camera.camera_rotation_rad = kCamera_rad * strength(PerturbationAxis::camera);
  draw(PerturbationAxis::camera, camera);

  Randomisation light;
  const double share = kShare * strength(PerturbationAxis::light);
  for (const auto& [range, now] :
       {std::pair{&light.ambient, scene.light.ambient}, std::pair{&light.diffuse, scene.light.diffuse}})
    *range = {std::max(kDarkest, now - share), now + share};
  light.light_direction_rad = kLight_rad * strength(PerturbationAxis::light);
  draw(PerturbationAxis::light, light);

  Randomisation texture;
  texture.looks = some_things(scene, strength(PerturbationAxis::texture), key.with("looks"));
  texture.textures = {"plain", "checker", "stripes", "noise"};
  draw(PerturbationAxis::texture, texture);

  if (const double of = strength(PerturbationAxis::start); of > 0)
    move_joints(scene.robot, kStart_rad * of, key.with("start"));
}

std::string perturbed(const std::string& sentence, const Perturbation& perturbation, RandomKey key) {
  const double strength = strength_of(perturbation, PerturbationAxis::sentence);
  if (!(strength > 0)) return sentence;
  Random random(key.with("sentence").with(sentence));
  std::string text = with_words(sentence, other_word);
  text = framed(kFrames, text, random);
  if (strength >= 2) text = framed(kAsides, text, random);
  if (strength >= 3) text = with_words(text, [&](const std::string& word) { return mistyped(word, random); });
  return text;
}

int further_things(const Perturbation& perturbation) {
  const double strength = strength_of(perturbation, PerturbationAxis::layout);
  return strength > 0 ? std::max(1, static_cast<int>(std::lround(kThings * strength))) : 0;
}

SensorNoise further_noise(const Perturbation& perturbation) {
  const double strength = strength_of(perturbation, PerturbationAxis::noise);
  return {kNoise.rgb * strength, kNoise.depth * strength, kNoise.torque * strength};
}

}  // namespace stampede
