#include "scripting/runtime/world_reader.h"

#include <algorithm>
#include <cmath>
#include <lua.hpp>

#include "engine/base/nearest.h"
#include "scripting/runtime/evaluate.h"

namespace stampede {
namespace {

constexpr int kMostPixels = 4096;

double share_of(const Value& fields, std::string_view name, double otherwise) {
  const double share = fields.number_or(name, otherwise);
  if (share < 0) fields[name].expected("a number that is not negative");
  return share;
}

Range range_of(const Value& fields, std::string_view name, const Range& otherwise, bool positive) {
  const Value& value = fields[name];
  if (!value.present()) return otherwise;
  const std::vector<double> ends = value.as_numbers();
  if (ends.size() != 2 || ends[0] > ends[1] || ends[0] < 0 || (positive && ends[0] == 0))
    value.expected(positive ? "{ lower, upper } above 0" : "{ lower, upper } that are not negative");
  return {ends[0], ends[1]};
}

std::vector<std::string> texts_of(const Value& fields, std::string_view name) {
  return fields[name].present() ? fields[name].as_texts() : std::vector<std::string>{};
}

PictureKinds kinds_from(const Value& value) {
  PictureKinds kinds = PictureKinds::none();
  for (const std::string& name : value.as_texts()) {
    const std::optional<PictureKind> kind = picture_kind_from(name);
    if (!kind)
      throw Error(value.place, "there is no kind of picture '" + name + "'",
                  did_you_mean(name, {"rgb", "depth", "instance", "semantic"}));
    kinds.add(*kind);
  }
  return kinds;
}

}  // namespace

std::array<int, 2> picture_size_from(const Value& value) {
  const std::vector<double> size = value.as_numbers();
  const auto fits = [](double side) { return side >= 1 && side <= kMostPixels && side == std::floor(side); };
  if (size.size() != 2 || !fits(size[0]) || !fits(size[1]))
    throw Error(value.place, "a picture has 1 to 4096 whole pixels a side", "size = { 128, 128 }");
  return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

Light light_from(const Value& fields, const Colours& colours) {
  Light light;
  light.direction = fields.vector_or("direction", light.direction);
  if (!(light.direction.norm() > 0)) throw Error(fields["direction"].place, "has no length", "{ 0, 0, -1 } is down");
  if (fields["colour"].present()) light.colour = colour_from(fields["colour"], colours);
  light.ambient = share_of(fields, "ambient", light.ambient);
  light.diffuse = share_of(fields, "diffuse", light.diffuse);
  light.specular = share_of(fields, "specular", light.specular);
  return light;
}

Randomisation randomisation_from(const Value& fields, const ShapeContext& context) {
  Randomisation ranges;
  ranges.looks = texts_of(fields, "looks");
  for (const Value& colour : fields["colours"].items) ranges.colours.push_back(colour_from(colour, context.colours));
  for (const Value& texture : fields["textures"].items)
    ranges.textures.push_back(texture.kind == Value::Kind::text ? texture.text : texture_from(texture, context));
  ranges.ambient = range_of(fields, "ambient", ranges.ambient, false);
  ranges.diffuse = range_of(fields, "diffuse", ranges.diffuse, false);
  ranges.light_direction_rad = share_of(fields, "light_direction", 0);
  ranges.camera_position_m = share_of(fields, "camera_position", 0);
  ranges.camera_rotation_rad = share_of(fields, "camera_rotation", 0);
  ranges.dynamics = texts_of(fields, "dynamics");
  ranges.mass = range_of(fields, "mass", ranges.mass, true);
  ranges.friction = range_of(fields, "friction", ranges.friction, false);
  ranges.damping = range_of(fields, "damping", ranges.damping, false);
  return ranges;
}

ObservationChoice observation_from(const Value& fields) {
  ObservationChoice choice;
  if (const Value& images = fields["images"]; images.present()) {
    choice.images = which_frames_from(images.as_text());
    if (!choice.images) images.expected("none, keyframes or all");
  }
  if (fields["cameras"].present()) choice.cameras = fields["cameras"].as_texts();
  if (fields["size"].present()) choice.size = picture_size_from(fields["size"]);
  if (fields["kinds"].present()) choice.kinds = kinds_from(fields["kinds"]);
  if (fields["points"].present()) choice.points = fields["points"].as_boolean();
  if (fields["shadows"].present()) choice.shadows = fields["shadows"].as_boolean();
  const Value& noise = fields["noise"];
  if (noise["rgb"].present()) choice.rgb_noise = share_of(noise, "rgb", 0);
  if (noise["depth"].present()) choice.depth_noise = share_of(noise, "depth", 0);
  if (noise["torque"].present()) choice.torque_noise = share_of(noise, "torque", 0);
  if (fields["channels"].present()) choice.channels = fields["channels"].as_texts();
  return choice;
}

Colours read_colours(lua_State* state, RandomKey key) {
  Colours colours;
  lua_getglobal(state, "colours");
  lua_getfield(state, -1, "names");
  const int names = lua_gettop(state);
  const auto count = static_cast<lua_Integer>(lua_rawlen(state, names));
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_getfield(state, names - 1, "rgb");
    lua_rawgeti(state, names, i);
    const std::string name = luaL_checkstring(state, -1);
    lua_call(state, 1, 1);
    colours[name] = colour_from(read_value(state, -1, {key, 0, "colours", {}}, name), {});
    lua_pop(state, 1);
  }
  lua_pop(state, 2);
  return colours;
}

}  // namespace stampede
