// What programs ask of arrays that are made.
#include <algorithm>
#include <array>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/geometry/transform.h"
#include "engine/record/arrays.h"

namespace stampede {
namespace {

constexpr std::array<const char*, 3> kTypes{"float64", "int64", "bool"};

template <typename Value>
std::span<const Value> values_of(const ArrayColumn& column, const char* wanted) {
  if (const auto* values = std::get_if<std::vector<Value>>(&column.data)) return *values;
  throw Error(column.name, "it is of type " + std::string(column.type()) + ", not " + wanted);
}

Transform pose_at(std::span<const double> rows, std::int64_t row) {
  const double* v = &rows[static_cast<std::size_t>(row) * 7];
  return to_transform({{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}});
}

Transform matrix_at(std::span<const double> rows, std::int64_t row) {
  Transform transform = Transform::Identity();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 4; ++k)
      transform.matrix()(i, k) =
          rows[static_cast<std::size_t>(row) * 16 + static_cast<std::size_t>(4 * i) + static_cast<std::size_t>(k)];
  return transform;
}

}  // namespace

std::string_view ArrayColumn::type() const { return kTypes.at(data.index()); }
std::span<const double> ArrayColumn::reals() const { return values_of<double>(*this, "float64"); }
std::span<const std::int64_t> ArrayColumn::integers() const { return values_of<std::int64_t>(*this, "int64"); }
std::span<const std::uint8_t> ArrayColumn::booleans() const { return values_of<std::uint8_t>(*this, "bool"); }

std::optional<PictureColumn> picture_column(std::string_view name) {
  for (const auto& [ending, kind] : {std::pair{std::string_view("_rgb"), PictureKind::rgb},
                                     {"_depth", PictureKind::depth},
                                     {"_semantic_mask", PictureKind::semantic},
                                     {"_mask", PictureKind::instance}})
    if (name.ends_with(ending)) return PictureColumn{std::string(name.substr(0, name.size() - ending.size())), kind};
  return std::nullopt;
}

PictureRequest ArrayPictures::request() const {
  PictureRequest wanted;
  wanted.camera = camera;
  const std::optional<PictureColumn> column = picture_column(name);
  wanted.rgb = column && column->kind == PictureKind::rgb;
  wanted.depth = column && column->kind == PictureKind::depth;
  wanted.semantic = column && column->kind == PictureKind::semantic;
  wanted.instance = column && column->kind == PictureKind::instance;
  return wanted;
}

const ArrayColumn* EpisodeArrays::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const ArrayColumn& c) { return c.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

const ArrayColumn& EpisodeArrays::column(std::string_view name) const {
  if (const ArrayColumn* found = find(name)) return *found;
  throw Error(std::string(name), "there is no such column here", did_you_mean(name, names_of(columns)));
}

ArrayColumn EpisodeArrays::pose_in(const std::string& object, const std::string& reference) const {
  const std::span<const double> own = column("object_pose/" + object).reals();
  const ArrayColumn* camera = find(reference + "_camera_extrinsics");
  const std::span<const double> other = (camera ? *camera : column("object_pose/" + reference)).reals();
  ArrayColumn result;
  result.name = "object_pose/" + object + "/in/" + reference;
  result.shape = {frames, 7};
  result.unit = "m, 1";
  result.frame = reference;
  result.rate_hz = frame_hz;
  result.labels = column("object_pose/" + object).labels;
  std::vector<double> values;
  for (std::int64_t row = 0; row < frames; ++row) {
    const Transform world_from_reference = camera ? matrix_at(other, row) : pose_at(other, row);
    const Pose pose = to_pose(world_from_reference.inverse() * pose_at(own, row));
    values.insert(values.end(), pose.position.begin(), pose.position.end());
    values.insert(values.end(), pose.quaternion.begin(), pose.quaternion.end());
  }
  result.data = std::move(values);
  return result;
}

}  // namespace stampede
