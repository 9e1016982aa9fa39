#include "engine/render/software_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/stopping.h"
#include "engine/render/baked_texture.h"
#include "engine/render/check_views.h"

namespace stampede {
namespace {

constexpr std::size_t kKeptTextures = 128;  // between scenes
constexpr std::size_t kKeptLenses = 16;
constexpr std::uint32_t kBackground = 204 | 214 << 8 | 224U << 16;  // sRGB: a bright, plain wall
constexpr int kBorderedSide = kShadowSide + 2 * kShadowBorder;
constexpr double kRounding = 1e-5;  // of places, in m and in shares: more than all that floats lose before pixels

Rows rows_of(const Eigen::Matrix<double, 3, 4>& matrix) {
  Rows rows{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) rows[static_cast<std::size_t>(4 * i + j)] = static_cast<float>(matrix(i, j));
  return rows;
}

std::array<float, 3> floats(const Vector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
std::array<double, 3> doubles(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

// Column and row in the shadow map, and how near the lamp is: 0 … 1. As it is drawn, or as it is asked.
enum class ShadowUse { draw, ask };
Eigen::Matrix<double, 3, 4> texels_from_world(const ShadowView& view, ShadowUse use) {
  Eigen::Matrix<double, 3, 4> texels = view.shadow_from_world.topRows<3>();
  texels.topRows<2>() *= kShadowSide;
  texels(0, 3) += kShadowBorder;
  texels(1, 3) += kShadowBorder;
  if (use == ShadowUse::draw) texels.row(2) = view.eye.clip_from_world.row(2);
  return texels;
}

// Of things wider than the fit, only what lies inside throws shadows.
void clear_border(std::vector<float>& shadow_map) {
  for (int row = 0; row < kBorderedSide; ++row) {
    float* at = &shadow_map[static_cast<std::size_t>(row) * kBorderedSide];
    const bool inside = row >= kShadowBorder && row < kBorderedSide - kShadowBorder;
    std::fill_n(at, inside ? kShadowBorder : kBorderedSide, 0.0F);
    std::fill_n(at + kBorderedSide - kShadowBorder, kShadowBorder, 0.0F);
  }
}

void add_colours(const PixelSurface& surface, std::vector<std::uint16_t>& sums) {
  for (std::size_t i = 0; i < surface.pixels(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      sums[3 * i + k] = static_cast<std::uint16_t>(sums[3 * i + k] + (surface.colours[i] >> (8 * k) & 255));
}

}  // namespace

void SoftwareRenderer::load(std::shared_ptr<const Scene> scene) {
  if (scene == nullptr) throw Error("renderer", "there is no scene to load");
  if (scene == scene_) return;
  if (!(scene->light.direction.norm() > 0)) throw Error("scene", "its light shines nowhere", "give it a direction");
  SceneDrawing drawing(*scene, tessellations_);  // may throw: then the last scene stays
  if (textures_by_content_.size() > kKeptTextures) textures_by_content_.clear();
  std::map<std::string, std::shared_ptr<const TexturePyramid>> textures;
  for (const auto& [name, texture] : scene->textures) {
    const Image image = baked(texture, name);
    Hasher hasher;
    hasher.number(image.width).number(image.height).bytes(image.rgba.data(), image.rgba.size());
    std::shared_ptr<const TexturePyramid>& pyramid = textures_by_content_[hasher.digest()];
    if (!pyramid) pyramid = std::make_shared<TexturePyramid>(image);
    textures[name] = pyramid;
  }
  scene_ = std::move(scene);
  textures_ = std::move(textures);
  drawing_.emplace(std::move(drawing));
  kept_.forget();
  const auto& things = drawing_->things();
  placed_.assign(things.size(), {});
  thing_of_triangle_.clear();
  ids_of_triangle_.clear();
  std::size_t most_corners = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    thing_of_triangle_.resize((things[i].first_index + things[i].index_count) / 3, static_cast<std::int32_t>(i));
    if (!thing_of_triangle_.empty() && things[i].index_count > 0)
      ids_of_triangle_.resize(thing_of_triangle_.size(), drawing_->still()[things[i].first_corner].ids);
    most_corners = std::max(most_corners, things[i].entry->places[0].size());
  }
  corners_.resize(most_corners);
  normals_.assign(thing_of_triangle_.size(), {});
  stamp_ = 0;
  paints_.resize(things.size());
}

void SoftwareRenderer::draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
                            std::vector<Picture>& pictures) {
  if (!drawing_) throw Error("renderer", "there is no scene to draw", "load one first");
  check(options);
  for (const View& view : views) check(view.camera);
  place_things(poses);
  if (options.shadows && options.kinds.rgb && !views.empty()) draw_shadows();
  pictures.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    heed_stop();
    draw_view(views[i], options, pictures[i]);
  }
}

void SoftwareRenderer::place_things(const ScenePoses& poses) {
  ++draws_;
  const auto& things = drawing_->things();
  for (std::size_t i = 0; i < things.size(); ++i) {
    const Transform now = drawing_->world_from_shape(things[i], poses);
    const bool shown = SceneDrawing::shows(things[i], poses);
    Placed& last = placed_[i];
    if (last.pose_number != 0 && shown == last.shown && now.matrix() == last.world_from_shape.matrix()) continue;
    last = {now, draws_, shown};
  }
}

void SoftwareRenderer::draw_shadows() {
  const auto& things = drawing_->things();
  std::vector<SceneDrawing::Ball> balls;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (!things[i].translucent && placed_[i].shown)
      balls.push_back({placed_[i].world_from_shape * things[i].entry->centre, things[i].entry->radius});
  shadows_.view = shadow_view(scene_->light, balls);
  shadows_.nearness.assign(std::size_t{kBorderedSide} * kBorderedSide + kLanes, 0.0F);
  const SurfaceView map{kBorderedSide, kBorderedSide, shadows_.nearness.data(), nullptr, nullptr};
  const Eigen::Matrix<double, 3, 4> texels = texels_from_world(shadows_.view, ShadowUse::draw);
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].translucent || !placed_[i].shown) continue;
    const ThingInEye thing{things[i].entry.get(), rows_of(texels * placed_[i].world_from_shape.matrix()), 0,
                           things[i].two_sided};
    kernels_.fill_shadow(map, thing, corners_.view());
  }
  clear_border(shadows_.nearness);
}

const Lens& SoftwareRenderer::lens_of(const Camera& camera) {
  for (const Lens& lens : lenses_)
    if (lens.fits(camera)) return lens;
  if (lenses_.size() >= kKeptLenses) lenses_.clear();
  return lenses_.emplace_back(camera);
}

void SoftwareRenderer::draw_view(const View& view, const DrawOptions& options, Picture& picture) {
  if (!distorts(view.camera)) return draw_pinhole(view, options, picture);
  const Lens& lens = lens_of(view.camera);
  View wide = view;
  wide.camera = lens.wide();
  wide.camera.near_m = view.camera.near_m;
  wide.camera.far_m = view.camera.far_m;
  draw_pinhole(wide, options, wide_);
  lens.apply(wide_, picture);
}

SoftwareRenderer::Eye SoftwareRenderer::eye_of(const View& view, bool coloured, double right, double down) {
  const Camera& camera = view.camera;
  Eye eye;
  eye.camera_from_world = view.world_from_camera.inverse();
  eye.key = {
      {},
      {camera.focal_x, camera.focal_y, camera.centre_x - right, camera.centre_y - down, camera.near_m, camera.far_m},
      camera.width,
      camera.height,
      coloured};
  const auto matrix = eye.camera_from_world.matrix().topRows<3>();
  std::copy_n(matrix.reshaped().begin(), 12, eye.key.camera_from_world.begin());
  eye.pinhole = {static_cast<float>(eye.key.lens[0]), static_cast<float>(eye.key.lens[1]),
                 static_cast<float>(eye.key.lens[2]), static_cast<float>(eye.key.lens[3]),
                 static_cast<float>(eye.key.lens[4])};
  return eye;
}

void SoftwareRenderer::draw_pinhole(const View& view, const DrawOptions& options, Picture& picture) {
  picture.width = view.camera.width;
  picture.height = view.camera.height;
  picture.rgb.clear();
  picture.depth.clear();
  picture.instance.clear();
  picture.semantic.clear();
  const PictureKinds& kinds = options.kinds;
  const bool apart = kinds.rgb && options.samples > 1;  // then colours are drawn by themselves
  const bool coloured = kinds.rgb && !apart;
  if (coloured || kinds.depth || kinds.instance || kinds.semantic) {
    draw_surface(eye_of(view, coloured, 0, 0), options.shadows);
    write_kinds(kinds, coloured, picture);
  }
  if (!apart) return;
  const int n = options.samples;
  sums_.assign(3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 0);
  for (int i = 0; i < n * n; ++i) {
    draw_surface(eye_of(view, true, (i % n + 0.5) / n - 0.5, (i / n + 0.5) / n - 0.5), options.shadows);
    add_colours(surface_, sums_);
  }
  picture.rgb.resize(sums_.size());
  for (std::size_t i = 0; i < sums_.size(); ++i)
    picture.rgb[i] = static_cast<std::uint8_t>((sums_[i] + n * n / 2) / (n * n));
}

// Into surface_. Which things come from what is kept shows in no pixel: a surface does not tell in what order it was
// filled, and a colour depends on its own triangle and pixel alone. Shadows move with others, so then only colours are
// made anew.
void SoftwareRenderer::draw_surface(const Eye& eye, bool shadows) {
  const bool coloured = eye.key.coloured, keep_colours = coloured && !shadows;
  const auto& things = drawing_->things();
  see_things(eye);
  Eye kept_eye = eye;
  kept_eye.key.coloured = keep_colours;
  KeptView* kept = keep_ ? kept_.find(kept_eye.key) : nullptr;
  wanted_ = seen_;
  if (kept != nullptr) {
    keep_still_things(kept_eye, *kept);
    surface_ = kept->surface;
    if (coloured && !keep_colours) surface_.colours.assign(surface_.pixels() + kLanes, kBackground);
    for (std::size_t i = 0; i < things.size(); ++i)
      if (kept->contained[i] != 0) wanted_[i] = 0;
  } else {
    surface_.clear(eye.key.width, eye.key.height, eye.key.lens[5], coloured, kBackground);
  }
  fill(eye, wanted_, surface_);
  if (!coloured) return;
  shade(eye, keep_colours ? wanted_ : seen_, shadows, surface_);
  tint(eye, shadows, surface_);
}

// Things that stand where they stood in the draw before join what is kept; when one of these moves, it begins anew.
void SoftwareRenderer::keep_still_things(const Eye& eye, KeptView& kept) {
  const auto& things = drawing_->things();
  bool valid = !kept.surface.nearness.empty();
  for (std::size_t i = 0; valid && i < things.size(); ++i)
    valid = kept.contained[i] == 0 || kept.contained[i] == placed_[i].pose_number;
  if (!valid) {
    kept.surface.clear(eye.key.width, eye.key.height, eye.key.lens[5], eye.key.coloured, kBackground);
    kept.contained.assign(things.size(), 0);
  }
  repainted_.assign(things.size(), 0);
  bool more = false;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].translucent || kept.contained[i] != 0 || placed_[i].pose_number == draws_) continue;
    kept.contained[i] = placed_[i].pose_number;
    if (seen_[i] == 0) continue;
    repainted_[i] = 1;
    more = true;
  }
  if (!more) return;
  fill(eye, repainted_, kept.surface);
  if (eye.key.coloured) shade(eye, repainted_, false, kept.surface);
}

// Which things may touch a pixel: a ball around each, against the sides of the picture and near and far.
void SoftwareRenderer::see_things(const Eye& eye) {
  const auto& things = drawing_->things();
  const auto [focal_x, focal_y, centre_x, centre_y, near, far] = eye.key.lens;
  const double right = centre_x - eye.key.width, below = centre_y - eye.key.height;
  seen_.assign(things.size(), 0);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const Vector3 at = eye.camera_from_world * (placed_[i].world_from_shape * things[i].entry->centre);
    const double reach = things[i].entry->radius * (1 + kRounding) + kRounding;
    const auto outside = [&](double focal, double along, double centre) {  // of a plane through the eye
      return (focal * along + centre * at.z()) / std::hypot(focal, centre);
    };
    seen_[i] = placed_[i].shown && things[i].index_count > 0 && at.z() + reach > near && at.z() - reach < far &&
                       outside(focal_x, at.x(), centre_x) > -reach && outside(focal_x, at.x(), right) < reach &&
                       outside(focal_y, at.y(), centre_y) > -reach && outside(focal_y, at.y(), below) < reach
                   ? 1
                   : 0;
  }
}

ThingInEye SoftwareRenderer::in_eye(const Eye& eye, std::size_t thing) const {
  const SceneDrawing::Thing& drawn = drawing_->things()[thing];
  return {drawn.entry.get(), rows_of((eye.camera_from_world * placed_[thing].world_from_shape).matrix().topRows<3>()),
          static_cast<std::int32_t>(drawn.first_index / 3), drawn.two_sided};
}

void SoftwareRenderer::fill(const Eye& eye, const Flags& wanted, PixelSurface& surface) {
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i] != 0 && !drawing_->things()[i].translucent)
      kernels_.fill(surface.view(), eye.pinhole, in_eye(eye, i), corners_.view());
}

ThingPaint SoftwareRenderer::paint_of(const Eye& eye, std::size_t thing, bool shadows) const {
  const SceneDrawing::Thing& drawn = drawing_->things()[thing];
  const StillCorner& corner = drawing_->still().at(drawn.first_corner);
  const Transform shape_from_camera = (eye.camera_from_world * placed_[thing].world_from_shape).inverse();
  const Matrix3 shape_from_world = placed_[thing].world_from_shape.linear().transpose();
  const auto& [focal_x, focal_y, centre_x, centre_y, near, far] = eye.key.lens;
  const Vector3 first((0.5 - centre_x) / focal_x, (0.5 - centre_y) / focal_y, 1);
  ThingPaint paint;
  paint.entry = drawn.entry.get();
  paint.first_triangle = static_cast<std::int32_t>(drawn.first_index / 3);
  paint.eye = doubles(shape_from_camera.translation());
  paint.ray = {doubles(shape_from_camera.linear() * first),
               doubles(shape_from_camera.linear() * Vector3(1 / focal_x, 0, 0)),
               doubles(shape_from_camera.linear() * Vector3(0, 1 / focal_y, 0))};
  paint.towards_light = floats(shape_from_world * -scene_->light.direction.normalized());
  // From everywhere, but more from above; a little askew, so that the sides of a box differ.
  paint.around = floats(shape_from_world * Vector3(0.06, -0.09, 0.18));
  for (std::size_t k = 0; k < 3; ++k) paint.colour[k] = static_cast<float>(corner.colour[k]) / 255;
  paint.alpha = static_cast<float>(corner.colour[3]) / 255;
  if (!drawn.texture.empty()) {
    paint.texture = textures_.at(drawn.texture)->levels();
    paint.texture_scale = static_cast<float>(1 / scene_->textures.at(drawn.texture).size_m);
  }
  if (shadows)
    paint.shadow_from_shape =
        rows_of(texels_from_world(shadows_.view, ShadowUse::ask) * placed_[thing].world_from_shape.matrix());
  return paint;
}

LampPaint SoftwareRenderer::lamp(bool shadows) const {
  const Light& light = scene_->light;
  LampPaint paint;
  paint.colour = floats(Vector3(light.colour.red, light.colour.green, light.colour.blue));
  paint.ambient = static_cast<float>(light.ambient);
  paint.diffuse = static_cast<float>(light.diffuse);
  paint.specular = static_cast<float>(light.specular);
  if (!shadows) return paint;
  paint.shadow_map = shadows_.nearness.data();
  paint.shadow_side = kBorderedSide;
  // A step along the normal keeps a surface out of its own shadow, whose map knows it by steps of a texel only.
  paint.shadow_offset = static_cast<float>(1.5 * shadows_.view.texel_m);
  return paint;
}

void SoftwareRenderer::shade(const Eye& eye, const Flags& wanted, bool shadows, PixelSurface& surface) {
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (wanted[i] != 0) paints_[i] = paint_of(eye, i, shadows);
  const PaintJob job{thing_of_triangle_.data(), paints_.data(), wanted.data(), lamp(shadows),
                     normals_.data(),           ++stamp_};
  kernels_.shade(surface.view(), job);
}

void SoftwareRenderer::tint(const Eye& eye, bool shadows, PixelSurface& surface) {
  const auto& things = drawing_->things();
  std::vector<std::pair<double, std::size_t>> furthest_first;
  for (std::size_t i = 0; i < things.size(); ++i)
    if (things[i].translucent && seen_[i] != 0)
      furthest_first.emplace_back(
          -(eye.camera_from_world * (placed_[i].world_from_shape * things[i].entry->centre)).norm(), i);
  std::sort(furthest_first.begin(), furthest_first.end());
  for (const auto& [distance, i] : furthest_first)
    kernels_.tint(surface.view(), eye.pinhole, in_eye(eye, i), corners_.view(),
                  {paint_of(eye, i, shadows), lamp(shadows)});
}

void SoftwareRenderer::write_kinds(const PictureKinds& kinds, bool coloured, Picture& picture) {
  const SurfaceView view = surface_.view();
  if (coloured) {
    picture.rgb.resize(3 * surface_.pixels());
    kernels_.write_colours(view, picture.rgb.data());
  }
  if (kinds.depth) {
    picture.depth.resize(surface_.pixels());
    kernels_.write_depth(view, picture.depth.data());
  }
  if (!kinds.instance && !kinds.semantic) return;
  if (kinds.instance) picture.instance.resize(surface_.pixels());
  if (kinds.semantic) picture.semantic.resize(surface_.pixels());
  kernels_.write_ids(view, ids_of_triangle_.data(), kinds.instance ? picture.instance.data() : nullptr,
                     kinds.semantic ? picture.semantic.data() : nullptr);
}

}  // namespace stampede
