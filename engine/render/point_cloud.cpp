#include "engine/render/point_cloud.h"

#include <cstring>

#include "engine/base/error.h"
#include "engine/model/camera.h"

namespace stampede {
namespace {

template <typename Item>
void append_list(std::vector<Item>& list, const std::vector<Item>& more) {
  list.insert(list.end(), more.begin(), more.end());
}

template <typename Number>
void put(std::string& bytes, Number number) {  // little-endian, as all processors are that this is built for
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

std::string ply_header(const PointCloud& cloud) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment world frame, metres\nelement vertex " +
                       std::to_string(cloud.positions.size()) + "\n";
  for (const char* name : {"x", "y", "z"}) header += std::string("property float ") + name + "\n";
  if (!cloud.colours.empty())
    for (const char* name : {"red", "green", "blue"}) header += std::string("property uchar ") + name + "\n";
  if (!cloud.instance.empty()) header += "property ushort instance\n";
  if (!cloud.semantic.empty()) header += "property ushort semantic\n";
  return header + "end_header\n";
}

}  // namespace

PointCloud point_cloud(const Picture& picture, const View& view) {
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  if (picture.depth.empty() || picture.depth.size() != width * height)
    throw Error("point cloud", "the picture has no depth", "ask the renderer for depth");
  PointCloud cloud;
  for (std::size_t i = 0; i < picture.depth.size(); ++i) {
    const double z = picture.depth[i];
    if (!(z > 0)) continue;
    const double u = static_cast<double>(i % width) + 0.5, v = static_cast<double>(i / width) + 0.5;
    const auto direction = direction_of(view.camera, {u, v});
    if (!direction) continue;  // no ray of this lens ends there
    const Vector3 point = view.world_from_camera * Vector3((*direction)[0] * z, (*direction)[1] * z, z);
    cloud.positions.push_back(
        {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())});
    if (!picture.rgb.empty())
      cloud.colours.push_back({picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]});
    if (!picture.instance.empty()) cloud.instance.push_back(picture.instance[i]);
    if (!picture.semantic.empty()) cloud.semantic.push_back(picture.semantic[i]);
  }
  return cloud;
}

void append(PointCloud& cloud, const PointCloud& more) {
  const bool alike = cloud.colours.empty() == more.colours.empty() && cloud.instance.empty() == more.instance.empty() &&
                     cloud.semantic.empty() == more.semantic.empty();
  if (!alike && !cloud.positions.empty() && !more.positions.empty())
    throw Error("point cloud", "only one of the clouds has colours, or ids of a kind",
                "make them from pictures of the same kinds");
  append_list(cloud.positions, more.positions);
  append_list(cloud.colours, more.colours);
  append_list(cloud.instance, more.instance);
  append_list(cloud.semantic, more.semantic);
}

std::string to_ply(const PointCloud& cloud) {
  std::string bytes = ply_header(cloud);
  bytes.reserve(bytes.size() + 19 * cloud.positions.size());
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    for (const float coordinate : cloud.positions[i]) put(bytes, coordinate);
    if (!cloud.colours.empty())
      for (const std::uint8_t channel : cloud.colours[i]) put(bytes, channel);
    if (!cloud.instance.empty()) put(bytes, cloud.instance[i]);
    if (!cloud.semantic.empty()) put(bytes, cloud.semantic[i]);
  }
  return bytes;
}

}  // namespace stampede
