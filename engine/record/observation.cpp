#include "engine/record/observation.h"

#include <algorithm>
#include <charconv>

#include "engine/base/enum_names.h"
#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/text.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 3> kWhichNames{"none", "keyframes", "all"};
constexpr const char* kPrefix = "observe_";

// The inverse of `joined`.
std::vector<std::string> words_of(std::string_view text) {
  return text.empty() ? std::vector<std::string>{} : split(text, ',');
}

std::string kinds_text(const PictureKinds& kinds) {
  std::vector<std::string> names;
  for (const PictureKind kind : kPictureKinds)
    if (kinds.has(kind)) names.emplace_back(to_string(kind));
  return joined(names, ",");
}

PictureKinds kinds_from(std::string_view text) {
  PictureKinds kinds = PictureKinds::none();
  for (const std::string& name : words_of(text))
    if (const auto kind = picture_kind_from(name)) kinds.add(*kind);
  return kinds;
}

template <typename Number>
Number number_from(std::string_view text) {
  Number value{};
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc())
    throw Error("episode options", "'" + std::string(text) + "' is no number", "generate the catalogue again");
  return value;
}

std::string text_of(const TorqueNoise& value) { return to_text(value); }
std::string text_of(bool value) { return value ? "1" : "0"; }
std::string text_of(double value) { return number_text(value); }
std::string text_of(WhichFrames value) { return std::string(to_string(value)); }
std::string text_of(DrawnBy value) { return std::string(to_string(value)); }
std::string text_of(const std::vector<std::string>& value) { return joined(value, ","); }
std::string text_of(const PictureKinds& value) { return kinds_text(value); }
std::string text_of(const std::array<int, 2>& value) {
  return std::to_string(value[0]) + "x" + std::to_string(value[1]);
}

void read(const std::string& text, std::optional<bool>& value) { value = text == "1"; }
void read(const std::string& text, std::optional<double>& value) { value = number_from<double>(text); }
void read(const std::string& text, std::optional<TorqueNoise>& value) { value = torque_noise_from(text); }
void read(const std::string& text, std::optional<WhichFrames>& value) { value = which_frames_from(text); }
void read(const std::string& text, std::optional<DrawnBy>& value) { value = drawn_by_from(text); }
void read(const std::string& text, std::optional<std::vector<std::string>>& value) { value = words_of(text); }
void read(const std::string& text, std::optional<PictureKinds>& value) { value = kinds_from(text); }
void read(const std::string& text, std::optional<std::array<int, 2>>& value) {
  const std::vector<std::string> numbers = split(text, 'x');
  if (numbers.size() == 2) value = {number_from<int>(numbers[0]), number_from<int>(numbers[1])};
}

// The one list of what can be asked for: its name in options, where the choice has it, and what it does to what is
// observed.
template <typename Visit>
void each_option(Visit&& visit) {
  using C = ObservationChoice;
  using O = Observation;
  visit("images", &C::images, [](O& o, WhichFrames value) { o.images = value; });
  visit("cameras", &C::cameras, [](O& o, const std::vector<std::string>& value) { o.cameras = value; });
  visit("size", &C::size, [](O& o, const std::array<int, 2>& value) { o.width = value[0], o.height = value[1]; });
  visit("kinds", &C::kinds, [](O& o, const PictureKinds& value) { o.kinds = value; });
  visit("points", &C::points, [](O& o, bool value) { o.points = value; });
  visit("shadows", &C::shadows, [](O& o, bool value) { o.shadows = value; });
  visit("renderer", &C::renderer, [](O& o, DrawnBy value) { o.renderer = value; });
  visit("rgb_noise", &C::rgb_noise, [](O& o, double value) { o.noise.rgb = value; });
  visit("depth_noise", &C::depth_noise, [](O& o, double value) { o.noise.depth = value; });
  visit("torque_noise", &C::torque_noise, [](O& o, double value) { o.torque_noise = value; });
  visit("torque_model", &C::torque_model, [](O& o, const TorqueNoise& value) { o.torque_model = value; });
  visit("channels", &C::channels, [](O& o, const std::vector<std::string>& value) { o.channels = value; });
}

}  // namespace

std::string_view to_string(WhichFrames value) { return enum_name(kWhichNames, value); }
std::optional<WhichFrames> which_frames_from(std::string_view text) {
  return enum_from<WhichFrames>(kWhichNames, text);
}

std::map<std::string, std::string> ObservationChoice::as_text() const {
  std::map<std::string, std::string> text;
  each_option([&](const char* name, auto field, const auto&) {
    if (const auto& value = this->*field) text[std::string(kPrefix) + name] = text_of(*value);
  });
  return text;
}

ObservationChoice before(const ObservationChoice& first, const ObservationChoice& otherwise) {
  ObservationChoice choice = first;
  each_option([&](const char*, auto field, const auto&) {
    if (!(choice.*field)) choice.*field = otherwise.*field;
  });
  return choice;
}

bool asks_for_channel(const Observation& observation, std::string_view name) {
  return std::find(observation.channels.begin(), observation.channels.end(), name) != observation.channels.end();
}

std::vector<std::string> channel_names(const Scene& scene) {
  std::vector<std::string> names = names_of(scene.sensors);
  names.emplace_back(kMargins);
  return names;
}

Observation chosen(const ObservationChoice& choice) {
  Observation observation;
  each_option([&](const char*, auto field, const auto& apply) {
    if (const auto& value = choice.*field) apply(observation, *value);
  });
  return observation;
}

ObservationChoice observation_from(const std::map<std::string, std::string>& options) {
  ObservationChoice choice;
  each_option([&](const char* name, auto field, const auto&) {
    const auto found = options.find(std::string(kPrefix) + name);
    if (found != options.end()) read(found->second, choice.*field);
  });
  return choice;
}

ObservationChoice observation_of(const EpisodeRecord& episode) { return observation_from(episode.made.options); }

}  // namespace stampede
