// Draws a scene. The interface is small, so that other back ends can join.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/model/scene.h"
#include "engine/model/scene_poses.h"
#include "engine/render/picture.h"
#include "stampede/picture.h"

namespace stampede {

std::string_view to_string(DrawnBy value);
std::optional<DrawnBy> drawn_by_from(std::string_view name);

struct DrawOptions {
  PictureKinds kinds;
  bool shadows = false;  // of the scene's light
  int samples = 1;       // rgb only: samples x samples a pixel, averaged; 1 … 4
  DrawnBy by = DrawnBy::own;
};

// Lifetime: used and destroyed by the thread that made it. Repeatable: pixels depend on the arguments alone, not on
// what was drawn before, nor on which views are drawn together. Colours: sRGB; the light is Scene::light. Throws Error
// for more than 4096 pixels a side, scenes that were not numbered (masks.h), meshes or textures that are missing, and
// where no context can be had.
class Renderer {
 public:
  virtual ~Renderer() = default;
  virtual void load(std::shared_ptr<const Scene> scene) = 0;  // what the following draws show
  // One picture a view. Distorted cameras are drawn through their lens.
  virtual void draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
                    std::vector<Picture>& pictures) = 0;
};

// Draws as DrawOptions::by says, in the calling thread; each is made when it is first asked for (the first of OSMesa's
// sets LP_NUM_THREADS=0).
std::unique_ptr<Renderer> make_renderer();

}  // namespace stampede
