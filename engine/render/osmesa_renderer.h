// The renderer on top of OSMesa. See renderer.h; README.md says how a picture comes about.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/gl_context.h"
#include "engine/render/gl_target.h"
#include "engine/render/lens.h"
#include "engine/render/renderer.h"
#include "engine/render/scene_drawing.h"
#include "engine/render/shaders.h"
#include "engine/render/shadow_map.h"

namespace stampede {

class OsmesaRenderer : public Renderer {
 public:
  OsmesaRenderer();
  void load(std::shared_ptr<const Scene> scene) override;
  void draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
            std::vector<Picture>& pictures) override;

 private:
  struct Pass {  // what one drawing of a picture makes
    bool colours = false, ids = false, depth = false, shadows = false;
  };
  void set_state();
  void load_textures();
  void draw_shadows();
  void draw_view(const View& view, const DrawOptions& options, Picture& picture);
  void draw_pinhole(const View& view, const DrawOptions& options, Picture& picture);
  void draw_pass(const View& view, const Eye& eye, const Pass& pass);
  void draw_batches(const Selection& selection, const Eye& eye, const Vector3& place, const Pass& pass);
  void use(const Program& program, const Eye& eye, const Vector3& place) const;
  void read_colours(Picture& picture);
  void add_colours(const Camera& camera);
  void read_ids(const PictureKinds& kinds, Picture& picture);
  void read_depth(const Camera& camera, Picture& picture);
  const Lens& lens_of(const Camera& camera);

  GlContext context_;
  const GlFunctions& gl_;
  Programs programs_;
  Targets targets_;
  std::optional<ShadowMap> shadow_map_;
  GLuint still_buffer_ = 0, moved_buffer_ = 0, index_buffer_ = 0, corners_ = 0;
  std::size_t index_capacity_ = 0;

  std::shared_ptr<const Scene> scene_;
  TessellationCache tessellations_;
  std::optional<SceneDrawing> drawing_;
  std::map<std::string, GLuint> pictures_by_content_, textures_;  // the latter by the scene's names
  ShadowView shadow_view_;

  std::vector<Lens> lenses_;
  Selection selection_;
  Picture wide_;
  std::vector<std::uint32_t> words_;  // what was read, before it is sorted into a picture
  std::vector<std::uint16_t> sums_;   // of colours, over samples
};

}  // namespace stampede
