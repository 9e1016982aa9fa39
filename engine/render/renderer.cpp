#include "engine/render/renderer.h"

#include <array>

#include "engine/base/enum_names.h"
#include "engine/render/osmesa_renderer.h"
#include "engine/render/software_renderer.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 2> kDrawnBy{"own", "osmesa"};

std::unique_ptr<Renderer> made_for(DrawnBy by) {
  if (by == DrawnBy::osmesa) return std::make_unique<OsmesaRenderer>();
  return std::make_unique<SoftwareRenderer>(pixel_kernels(), true);
}

class ChosenRenderer : public Renderer {
 public:
  void load(std::shared_ptr<const Scene> scene) override {
    of(DrawnBy::own).renderer->load(scene);  // throws for a scene that is wrong: the last one stays
    scene_ = std::move(scene);
    for (BackEnd& one : back_ends_) one.loaded = false;
    of(DrawnBy::own).loaded = true;
  }

  void draw(const ScenePoses& poses, std::span<const View> views, const DrawOptions& options,
            std::vector<Picture>& pictures) override {
    BackEnd& one = of(options.by);
    if (!one.loaded && scene_) one.renderer->load(scene_);
    one.loaded = scene_ != nullptr;
    one.renderer->draw(poses, views, options, pictures);
  }

 private:
  struct BackEnd {
    std::unique_ptr<Renderer> renderer;
    bool loaded = false;
  };

  BackEnd& of(DrawnBy by) {
    BackEnd& one = back_ends_.at(static_cast<std::size_t>(by));
    if (!one.renderer) one.renderer = made_for(by);
    return one;
  }

  std::shared_ptr<const Scene> scene_;
  std::array<BackEnd, kDrawnBy.size()> back_ends_;
};

}  // namespace

std::string_view to_string(DrawnBy value) { return enum_name(kDrawnBy, value); }
std::optional<DrawnBy> drawn_by_from(std::string_view name) { return enum_from<DrawnBy>(kDrawnBy, name); }

std::unique_ptr<Renderer> make_renderer() { return std::make_unique<ChosenRenderer>(); }

}  // namespace stampede
