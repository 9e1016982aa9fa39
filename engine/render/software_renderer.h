// The renderer that draws where nobody asks for another: triangles into pixels by our own loops. See renderer.h;
// README.md says how a picture comes about.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/kept_views.h"
#include "engine/render/lens.h"
#include "engine/render/pixel_kernels.h"
#include "engine/render/pixel_surface.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_drawing.h"
#include "engine/render/shadow_map.h"
#include "engine/render/texture_pyramid.h"

namespace stampede {

class SoftwareRenderer : public Renderer {
 public:
  // `keep`: whether what stands still is drawn once. It changes no pixel.
  explicit SoftwareRenderer(const PixelKernels& kernels, bool keep) : kernels_(kernels), keep_(keep) {}
  void load(std::shared_ptr<const Scene> scene) override;
  void draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
            std::vector<Picture>& pictures) override;

 private:
  struct Eye {
    Transform camera_from_world = Transform::Identity();
    PinholeOfEye pinhole;
    EyeKey key;
  };
  struct Placed {
    Transform world_from_shape = Transform::Identity();
    std::uint64_t pose_number = 0;  // that of the draw that met its pose first
    bool shown = true;
  };
  struct Shadows {  // of the last draw that had any
    ShadowView view;
    std::vector<float> nearness;  // the map, with its border
  };
  using Flags = std::vector<std::uint8_t>;  // one a thing

  static Eye eye_of(const View& view, bool coloured, double right, double down);
  void place_things(const ScenePoses& poses);
  void draw_shadows();
  void draw_view(const View& view, const DrawOptions& options, Picture& picture);
  void draw_pinhole(const View& view, const DrawOptions& options, Picture& picture);
  void draw_surface(const Eye& eye, bool shadows);  // into surface_
  void keep_still_things(const Eye& eye, KeptView& kept);
  void see_things(const Eye& eye);
  void fill(const Eye& eye, const Flags& wanted, PixelSurface& surface);
  void shade(const Eye& eye, const Flags& wanted, bool shadows, PixelSurface& surface);
  void tint(const Eye& eye, bool shadows, PixelSurface& surface);
  ThingInEye in_eye(const Eye& eye, std::size_t thing) const;
  ThingPaint paint_of(const Eye& eye, std::size_t thing, bool shadows) const;
  LampPaint lamp(bool shadows) const;
  void write_kinds(const PictureKinds& kinds, bool coloured, Picture& picture);
  const Lens& lens_of(const Camera& camera);

  const PixelKernels& kernels_;
  const bool keep_;
  std::shared_ptr<const Scene> scene_;
  TessellationCache tessellations_;
  std::optional<SceneDrawing> drawing_;
  std::map<std::string, std::shared_ptr<const TexturePyramid>> textures_by_content_, textures_;  // the latter by name
  std::vector<std::int32_t> thing_of_triangle_;
  std::vector<std::uint32_t> ids_of_triangle_;  // instance + 65536 * semantic

  std::vector<Placed> placed_;  // things, in their order
  std::uint64_t draws_ = 0;
  KeptViews kept_;

  // Scratch.
  CornerRoom corners_;
  Flags seen_, wanted_, repainted_;
  std::vector<ThingPaint> paints_;
  std::vector<NormalPlane> normals_;
  std::uint32_t stamp_ = 0;
  PixelSurface surface_;
  Shadows shadows_;
  std::vector<Lens> lenses_;
  Picture wide_;
  std::vector<std::uint16_t> sums_;  // of colours, over samples
};

}  // namespace stampede
