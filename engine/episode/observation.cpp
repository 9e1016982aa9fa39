#include "engine/episode/observation.h"

#include <charconv>

#include "engine/base/error.h"
#include "engine/base/text.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 3> kWhichNames{"none", "keyframes", "all"};
constexpr const char* kPrefix = "observe_";

std::string number(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};  // shortest exact
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

// The inverse of `joined`.
std::vector<std::string> words_of(std::string_view text) {
  return text.empty() ? std::vector<std::string>{} : split(text, ',');
}

std::string kinds_text(const PictureKinds& kinds) {
  std::vector<std::string> names;
  for (const PictureKind kind : kPictureKinds)
    if (kinds.has(kind)) names.emplace_back(to_string(kind));
  return joined(names);
}

PictureKinds kinds_from(std::string_view text) {
  PictureKinds kinds{false, false, false, false};
  for (const std::string& name : words_of(text)) {
    const auto kind = picture_kind_from(name);
    kinds.rgb |= kind == PictureKind::rgb;
    kinds.depth |= kind == PictureKind::depth;
    kinds.instance |= kind == PictureKind::instance;
    kinds.semantic |= kind == PictureKind::semantic;
  }
  return kinds;
}

template <typename Number>
Number number_from(std::string_view text) {
  Number value{};
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc())
    throw Error("episode options", "'" + std::string(text) + "' is no number", "generate the catalogue again");
  return value;
}

template <typename Value>
void fill(std::optional<Value>& value, const std::optional<Value>& otherwise) {
  if (!value) value = otherwise;
}

}  // namespace

std::string_view to_string(WhichFrames value) { return kWhichNames.at(static_cast<std::size_t>(value)); }

std::optional<WhichFrames> which_frames_from(std::string_view text) {
  for (std::size_t i = 0; i < kWhichNames.size(); ++i)
    if (kWhichNames[i] == text) return static_cast<WhichFrames>(i);
  return std::nullopt;
}

std::map<std::string, std::string> ObservationChoice::as_text() const {
  std::map<std::string, std::string> text;
  const auto put = [&](const char* name, std::string value) { text[std::string(kPrefix) + name] = std::move(value); };
  if (images) put("images", std::string(to_string(*images)));
  if (cameras) put("cameras", joined(*cameras));
  if (size) put("size", std::to_string((*size)[0]) + "x" + std::to_string((*size)[1]));
  if (kinds) put("kinds", kinds_text(*kinds));
  if (points) put("points", *points ? "1" : "0");
  if (shadows) put("shadows", *shadows ? "1" : "0");
  if (rgb_noise) put("rgb_noise", number(*rgb_noise));
  if (depth_noise) put("depth_noise", number(*depth_noise));
  if (torque_noise) put("torque_noise", number(*torque_noise));
  if (channels) put("channels", joined(*channels));
  return text;
}

ObservationChoice before(const ObservationChoice& first, const ObservationChoice& otherwise) {
  ObservationChoice choice = first;
  fill(choice.images, otherwise.images);
  fill(choice.cameras, otherwise.cameras);
  fill(choice.size, otherwise.size);
  fill(choice.kinds, otherwise.kinds);
  fill(choice.points, otherwise.points);
  fill(choice.shadows, otherwise.shadows);
  fill(choice.rgb_noise, otherwise.rgb_noise);
  fill(choice.depth_noise, otherwise.depth_noise);
  fill(choice.torque_noise, otherwise.torque_noise);
  fill(choice.channels, otherwise.channels);
  return choice;
}

Observation chosen(const ObservationChoice& choice) {
  Observation observation;
  observation.images = choice.images.value_or(observation.images);
  observation.cameras = choice.cameras.value_or(observation.cameras);
  if (choice.size) observation.width = (*choice.size)[0], observation.height = (*choice.size)[1];
  observation.kinds = choice.kinds.value_or(observation.kinds);
  observation.points = choice.points.value_or(observation.points);
  observation.shadows = choice.shadows.value_or(observation.shadows);
  observation.noise.rgb = choice.rgb_noise.value_or(0);
  observation.noise.depth = choice.depth_noise.value_or(0);
  observation.torque_noise = choice.torque_noise.value_or(0);
  observation.channels = choice.channels.value_or(observation.channels);
  return observation;
}

ObservationChoice observation_of(const EpisodeRecord& episode) {
  ObservationChoice choice;
  const auto get = [&](const char* name) -> std::optional<std::string> {
    const auto found = episode.options.find(std::string(kPrefix) + name);
    return found == episode.options.end() ? std::nullopt : std::optional(found->second);
  };
  if (const auto text = get("images")) choice.images = which_frames_from(*text);
  if (const auto text = get("cameras")) choice.cameras = words_of(*text);
  if (const auto text = get("size")) {
    const std::vector<std::string> numbers = split(*text, 'x');
    if (numbers.size() == 2) choice.size = {number_from<int>(numbers[0]), number_from<int>(numbers[1])};
  }
  if (const auto text = get("kinds")) choice.kinds = kinds_from(*text);
  if (const auto text = get("points")) choice.points = *text == "1";
  if (const auto text = get("shadows")) choice.shadows = *text == "1";
  if (const auto text = get("rgb_noise")) choice.rgb_noise = number_from<double>(*text);
  if (const auto text = get("depth_noise")) choice.depth_noise = number_from<double>(*text);
  if (const auto text = get("torque_noise")) choice.torque_noise = number_from<double>(*text);
  if (const auto text = get("channels")) choice.channels = words_of(*text);
  return choice;
}

}  // namespace stampede
