#include "engine/render/scene_drawing.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/model/masks.h"
#include "engine/render/tessellate.h"

namespace stampede {
namespace {

constexpr int kRobot = -1, kRegion = -2;
constexpr std::size_t kCachedCorners = 4'000'000;  // 150 MB
constexpr float kPixelMargin = 1.0F / 32;          // more than all rounding between here and the rasteriser

std::uint8_t to_byte(double share) { return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.0, 1.0) * 255)); }
std::int8_t to_signed(float share) {
  return static_cast<std::int8_t>(std::lround(std::clamp(share, -1.0F, 1.0F) * 127));
}

Shape shape_of(const Region& region) {
  Shape shape;
  shape.size = region.size;
  shape.colour = region.colour;
  return shape;
}

StillCorner still_corner(const DrawnMesh& mesh, std::size_t i, const Shape& shape, double size_m, std::uint32_t ids) {
  StillCorner corner{};
  const bool own = !mesh.coordinates.empty();
  const auto& at = mesh.positions[i];
  const auto scale = static_cast<float>(1 / size_m);
  corner.coordinate = own ? std::array<float, 3>{mesh.coordinates[i][0], mesh.coordinates[i][1], 0}
                          : std::array<float, 3>{at[0] * scale, at[1] * scale, at[2] * scale};
  for (std::size_t k = 0; k < 3; ++k) corner.side[k] = to_signed(mesh.normals[i][k]);
  corner.side[3] = own ? 127 : 0;
  corner.colour = {to_byte(shape.colour.red), to_byte(shape.colour.green), to_byte(shape.colour.blue),
                   to_byte(shape.colour.alpha)};
  corner.ids = ids;
  return corner;
}

}  // namespace

std::shared_ptr<const TessellationCache::Entry> TessellationCache::get(const Shape& shape, const Scene& scene) {
  const std::string key = tessellation_key(shape, scene);
  const auto found = entries_.find(key);
  if (found != entries_.end()) return found->second;
  if (corners_ > kCachedCorners) {
    entries_.clear();
    corners_ = 0;
  }
  auto entry = std::make_shared<Entry>();
  entry->mesh = tessellate(shape, scene);
  entry->closed = shape.kind != ShapeKind::mesh || is_closed(entry->mesh);
  Eigen::AlignedBox3d bounds;
  const auto corner = [](const std::array<float, 3>& p) { return Vector3(p[0], p[1], p[2]); };
  for (const auto& position : entry->mesh.positions) bounds.extend(corner(position));
  if (!bounds.isEmpty()) entry->centre = bounds.center();
  for (const auto& position : entry->mesh.positions)
    entry->radius = std::max(entry->radius, (corner(position) - entry->centre).norm());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<float>& places = entry->places.at(axis);
    places.reserve(entry->mesh.positions.size() + kLanes);
    for (const auto& position : entry->mesh.positions) places.push_back(position[axis]);
    while (places.size() % kLanes != 0) places.push_back(0);
  }
  corners_ += entry->mesh.positions.size();
  entries_.emplace(key, entry);
  return entry;
}

SceneDrawing::SceneDrawing(const Scene& scene, TessellationCache& cache) {
  std::vector<std::uint32_t> ids(65536, 0);
  for (const MaskEntry& entry : mask_key(scene))
    ids.at(static_cast<std::size_t>(entry.instance)) =
        static_cast<std::uint32_t>(entry.instance) + 65536U * static_cast<std::uint32_t>(entry.semantic);
  const auto thing_of = [](int body, std::size_t part) {
    Thing thing;
    thing.body = body;
    thing.part = static_cast<int>(part);
    return thing;
  };
  const auto add_parts = [&](const Body& body, int index) {
    for (std::size_t part = 0; part < body.parts.size(); ++part)
      for (const Shape& shape : body.parts[part].shapes)
        if (shape.visible)
          add(thing_of(index, part), shape, ids[static_cast<std::size_t>(body.parts[part].instance)], scene, cache);
  };
  add_parts(scene.robot.body, kRobot);
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) add_parts(scene.bodies[body], static_cast<int>(body));
  for (std::size_t i = 0; i < scene.regions.size(); ++i) {
    const Region& region = scene.regions[i];
    if (region.visible)
      add(thing_of(kRegion, i), shape_of(region), ids[static_cast<std::size_t>(region.instance)], scene, cache);
  }
  moved_.resize(still_.size());
  projected_.resize(still_.size());
}

void SceneDrawing::add(Thing thing, const Shape& shape, std::uint32_t ids, const Scene& scene,
                       TessellationCache& cache) {
  double size_m = 1;
  if (!shape.texture.empty()) {
    const auto found = scene.textures.find(shape.texture);
    if (found == scene.textures.end())
      throw Error("scene", "the texture '" + shape.texture + "' is missing", "put it into Scene::textures");
    size_m = found->second.size_m;
    if (!(size_m > 0))
      throw Error("scene", "the texture '" + shape.texture + "' has no size", "give it a size_m above 0");
  }
  if (shape.colour.alpha <= 0) return;  // nobody sees it
  thing.part_from_shape = shape.part_from_shape;
  thing.entry = cache.get(shape, scene);
  thing.two_sided = !thing.entry->closed;
  thing.translucent = shape.colour.alpha < kOpaque;
  thing.texture = shape.texture;
  thing.shown_by = shape.shown_by;
  thing.shown_without = shape.shown_without;
  thing.first_corner = static_cast<std::uint32_t>(still_.size());
  thing.first_index = static_cast<std::uint32_t>(corners_of_triangles_.size());
  const DrawnMesh& mesh = thing.entry->mesh;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) still_.push_back(still_corner(mesh, i, shape, size_m, ids));
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) corners_of_triangles_.push_back(thing.first_corner + corner);
  thing.index_count = static_cast<std::uint32_t>(corners_of_triangles_.size()) - thing.first_index;
  things_.push_back(std::move(thing));
}

const Transform& SceneDrawing::pose_of(const Thing& thing, const ScenePoses& poses) const {
  const auto part = static_cast<std::size_t>(thing.part);
  const std::vector<Transform>* of = &poses.world_from_robot_part;
  if (thing.body == kRegion) of = &poses.world_from_region;
  if (thing.body >= 0) {
    const auto body = static_cast<std::size_t>(thing.body);
    if (body >= poses.world_from_part.size()) throw Error("renderer", "the poses are of another scene");
    of = &poses.world_from_part[body];
  }
  if (part >= of->size()) throw Error("renderer", "the poses are of another scene", "load the scene that they are of");
  return (*of)[part];
}

Transform SceneDrawing::world_from_shape(const Thing& thing, const ScenePoses& poses) const {
  return pose_of(thing, poses) * thing.part_from_shape;
}

bool SceneDrawing::shows(const Thing& thing, const ScenePoses& poses) {
  return thing.shown_by.empty() || poses.facts.contains(thing.shown_by) != thing.shown_without;
}

void SceneDrawing::move(const ScenePoses& poses) {
  for (Thing& thing : things_) {
    const Transform world_from_this = world_from_shape(thing, poses);
    thing.shown = shows(thing, poses);
    thing.world_centre = world_from_this * thing.entry->centre;
    const Eigen::Matrix3f turn = world_from_this.linear().cast<float>();
    const Eigen::Vector3f shift = world_from_this.translation().cast<float>();
    const DrawnMesh& mesh = thing.entry->mesh;
    MovedCorner* moved = &moved_[thing.first_corner];
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      Eigen::Map<Eigen::Vector3f>(moved[i].position.data()) =
          turn * Eigen::Map<const Eigen::Vector3f>(mesh.positions[i].data()) + shift;
      Eigen::Map<Eigen::Vector3f>(moved[i].normal.data()) =
          turn * Eigen::Map<const Eigen::Vector3f>(mesh.normals[i].data());
    }
  }
}

void SceneDrawing::select(const Eye& eye, bool colours, Selection& selection) {
  selection.indices.clear();
  selection.batches.clear();
  std::array<Eigen::Vector4d, 6> planes;  // inside is positive
  const Eigen::Matrix4d& clip = eye.clip_from_world;
  for (int i = 0; i < 2; ++i) {
    planes[static_cast<std::size_t>(2 * i)] = clip.row(3) + clip.row(i);
    planes[static_cast<std::size_t>(2 * i + 1)] = clip.row(3) - clip.row(i);
  }
  planes[4] = clip.row(2);
  planes[5] = clip.row(3) - clip.row(2);
  struct Seen {
    std::size_t thing;
    double distance;
  };
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const Thing& thing = things_[i];
    if (!thing.shown || (thing.translucent && !colours)) continue;
    const Eigen::Vector4d centre = thing.world_centre.homogeneous();
    const double radius = thing.entry->radius * (1 + 1e-5) + 1e-5;
    if (std::any_of(planes.begin(), planes.end(),
                    [&](const Eigen::Vector4d& p) { return p.dot(centre) < -radius * p.head<3>().norm(); }))
      continue;
    seen.push_back({i, -planes[4].dot(centre) / planes[4].head<3>().norm() - (thing.translucent ? 0 : radius)});
  }
  std::sort(seen.begin(), seen.end(), [&](const Seen& a, const Seen& b) {
    const Thing &p = things_[a.thing], &q = things_[b.thing];
    if (p.translucent != q.translucent) return q.translucent;
    if (!p.translucent && p.two_sided != q.two_sided) return q.two_sided;
    if (!p.translucent && p.texture != q.texture) return p.texture < q.texture;
    if (a.distance != b.distance) return (a.distance < b.distance) != p.translucent;
    return a.thing < b.thing;
  });
  const Eigen::Matrix4f clip_from_world = clip.cast<float>();
  for (const Seen& one : seen) {
    const Thing& thing = things_[one.thing];
    const auto first = static_cast<std::uint32_t>(selection.indices.size());
    project(thing, clip_from_world, eye);
    take_triangles(thing, eye, selection.indices);
    const auto count = static_cast<std::uint32_t>(selection.indices.size()) - first;
    if (count == 0) continue;
    Batch* last = selection.batches.empty() ? nullptr : &selection.batches.back();
    if (last != nullptr && last->texture == thing.texture && last->two_sided == thing.two_sided &&
        last->translucent == thing.translucent)
      last->count += count;
    else
      selection.batches.push_back({thing.texture, thing.two_sided, thing.translucent, first, count});
  }
}

void SceneDrawing::project(const Thing& thing, const Eigen::Matrix4f& m, const Eye& eye) {
  const float half_width = 0.5F * static_cast<float>(eye.width), half_height = 0.5F * static_cast<float>(eye.height);
  const std::size_t end = thing.first_corner + thing.entry->mesh.positions.size();
  for (std::size_t i = thing.first_corner; i < end; ++i) {
    const auto& [px, py, pz] = moved_[i].position;
    const float x = m(0, 0) * px + m(0, 1) * py + m(0, 2) * pz + m(0, 3);
    const float y = m(1, 0) * px + m(1, 1) * py + m(1, 2) * pz + m(1, 3);
    const float z = m(2, 0) * px + m(2, 1) * py + m(2, 2) * pz + m(2, 3);
    const float w = m(3, 0) * px + m(3, 1) * py + m(3, 2) * pz + m(3, 3);
    const float inverse = 1 / w;
    projected_[i] = {(x * inverse + 1) * half_width, (y * inverse + 1) * half_height,
                     (z > w ? 1 : 0) | (z < 0 ? 2 : 0)};
  }
}

void SceneDrawing::take_triangles(const Thing& thing, const Eye& eye, std::vector<std::uint32_t>& indices) const {
  const auto width = static_cast<float>(eye.width), height = static_cast<float>(eye.height);
  const std::uint32_t* corner = corners_of_triangles_.data() + thing.first_index;
  const std::size_t start = indices.size();
  indices.resize(start + thing.index_count);
  std::uint32_t* out = indices.data() + start;
  const auto misses_centres = [](float low, float high) {
    return std::ceil(low - 0.5F - kPixelMargin) > std::floor(high - 0.5F + kPixelMargin);
  };
  for (std::uint32_t i = 0; i < thing.index_count; i += 3, corner += 3) {
    const Projected &a = projected_[corner[0]], &b = projected_[corner[1]], &c = projected_[corner[2]];
    if ((a.place & b.place & c.place) != 0) continue;
    if (((a.place | b.place | c.place) & 1) == 0) {
      const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);  // rows run down: front is negative
      const float left = std::min({a.x, b.x, c.x}), right = std::max({a.x, b.x, c.x});
      const float top = std::min({a.y, b.y, c.y}), bottom = std::max({a.y, b.y, c.y});
      if (!thing.two_sided && area > kPixelMargin * (1 + right - left + bottom - top)) continue;
      if (right < 0 || bottom < 0 || left > width || top > height) continue;
      if (misses_centres(left, right) || misses_centres(top, bottom)) continue;
    }
    *out++ = corner[0];
    *out++ = corner[1];
    *out++ = corner[2];
  }
  indices.resize(static_cast<std::size_t>(out - indices.data()));
}

std::vector<SceneDrawing::Ball> SceneDrawing::balls() const {
  std::vector<Ball> balls;
  for (const Thing& thing : things_)
    if (thing.shown && !thing.translucent) balls.push_back({thing.world_centre, thing.entry->radius});
  return balls;
}

}  // namespace stampede
