// What a renderer refuses, and what it says then.
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "tests/engine/render/all_shapes.h"

using namespace stampede;
using Catch::Matchers::Contains;

namespace {

std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

Shape mesh_shape() {
  Shape shape;
  shape.kind = ShapeKind::mesh;
  shape.mesh = "thing";
  return shape;
}

std::string refusal_of(
    const Shape& shape, const std::function<void(Scene&)>& change = [](Scene&) {}) {
  Scene scene;
  scene.bodies.push_back(free_body("thing", shape, Transform::Identity()));
  change(scene);
  number_masks(scene, RandomKey("input"));
  return refusal([&] { Studio studio(scene); });
}

}  // namespace

TEST_CASE("Sizes, lenses and options out of range are refused by name") {
  Studio studio(all_shapes());
  const auto of = [&](const std::function<void(View&, DrawOptions&)>& change) {
    View view = view_of_shapes();
    DrawOptions options;
    change(view, options);
    return refusal([&] { studio.draw(view, options); });
  };
  for (const int size : {0, -1, 4097, 1 << 30}) {
    CHECK_THAT(of([&](View& view, DrawOptions&) { view.camera.width = size; }), Contains("eye") && Contains("4096"));
    CHECK_THAT(of([&](View& view, DrawOptions&) { view.camera.height = size; }), Contains("eye") && Contains("4096"));
  }
  CHECK_THAT(of([](View& view, DrawOptions&) { view.camera.focal_x = 0; }), Contains("focal"));
  CHECK_THAT(of([](View& view, DrawOptions&) { view.camera.focal_y = std::nan(""); }), Contains("focal"));
  CHECK_THAT(of([](View& view, DrawOptions&) { view.camera.near_m = 0; }), Contains("near"));
  CHECK_THAT(of([](View& view, DrawOptions&) { view.camera.far_m = 0.001; }), Contains("near"));
  CHECK_THAT(of([](View&, DrawOptions& options) { options.samples = 5; }), Contains("1 to 4"));
  CHECK_THAT(of([](View&, DrawOptions& options) { options.samples = 0; }), Contains("1 to 4"));
  CHECK(of([](View&, DrawOptions&) {}) == "nothing was refused");
}

TEST_CASE("The widest and the smallest picture are drawn") {
  Studio studio(all_shapes());
  const Picture wide = studio.draw(view_from({0, 0, 0.9}, {0, 0, 0}, 90, 4096, 1), {});
  CHECK(wide.rgb.size() == 3 * 4096);
  CHECK(studio.draw(view_from({0, 0, 0.9}, {0, 0, 0}, 90, 1, 1)).depth.at(0) > 0.5F);
}

TEST_CASE("A scene must be numbered, loaded and whole") {
  Scene unnumbered = all_shapes();
  unnumbered.bodies[0].parts[0].instance = 0;
  CHECK_THAT(refusal([&] { Studio studio(unnumbered); }), Contains("number_masks"));
  const std::unique_ptr<Renderer> empty = make_renderer();
  std::vector<Picture> pictures;
  CHECK_THAT(refusal([&] { empty->draw({}, {}, {}, pictures); }), Contains("load"));
  CHECK_THAT(refusal([&] { empty->load(nullptr); }), Contains("no scene"));
  const DrawOptions by_mesa{.kinds = {}, .by = DrawnBy::osmesa};
  CHECK_THAT(refusal([&] { make_renderer()->draw({}, {}, by_mesa, pictures); }), Contains("load"));
  Studio studio(all_shapes());
  const std::vector<View> views{view_of_shapes()};
  CHECK_THAT(refusal([&] { studio.renderer->draw({}, views, {}, pictures); }), Contains("another scene"));
}

TEST_CASE("Missing and broken meshes and textures are refused by name") {
  CHECK_THAT(refusal_of(mesh_shape()), Contains("'thing'") && Contains("missing"));
  const auto broken = [](const DrawnMesh& mesh) {
    return refusal_of(mesh_shape(), [&](Scene& scene) { scene.meshes["thing"] = std::make_shared<DrawnMesh>(mesh); });
  };
  const std::vector<std::array<float, 3>> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, up(3, {0, 0, 1});
  CHECK(broken({corners, up, {}, {{0, 1, 2}}}) == "nothing was refused");
  CHECK_THAT(broken({corners, up, {}, {{0, 1, 3}}}), Contains("corners"));
  CHECK_THAT(broken({corners, {}, {}, {{0, 1, 2}}}), Contains("normals"));
  CHECK_THAT(broken({corners, up, {{0, 0}}, {{0, 1, 2}}}), Contains("coordinates"));
  CHECK_THAT(broken({{{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, up, {}, {{0, 1, 2}}}), Contains("nowhere"));

  Shape worn = box_of({1, 1, 1});
  worn.texture = "cloth";
  CHECK_THAT(refusal_of(worn), Contains("'cloth'") && Contains("missing"));
  const auto wearing = [&](Texture texture) {
    return refusal_of(worn, [&](Scene& scene) { scene.textures["cloth"] = std::move(texture); });
  };
  CHECK_THAT(wearing({}), Contains("'cloth'") && Contains("missing"));
  Texture damaged;
  damaged.image = std::make_shared<Image>(Image{4, 4, {0, 0, 0, 255}});
  CHECK_THAT(wearing(damaged), Contains("number of pixels"));
  Texture flat;
  flat.kind = TextureKind::checker;
  CHECK(wearing(flat) == "nothing was refused");
  flat.size_m = 0;
  CHECK_THAT(wearing(flat), Contains("size"));
}

TEST_CASE("Shapes without volume are refused where they would be seen") {
  CHECK_THAT(refusal_of(box_of({1, 0, 1})), Contains("box"));
  CHECK_THAT(refusal_of(shape_of(ShapeKind::sphere, 0, 0)), Contains("sphere"));
  CHECK_THAT(refusal_of(shape_of(ShapeKind::cylinder, 1, 0)), Contains("cylinder"));
  CHECK_THAT(refusal_of(shape_of(ShapeKind::cone, -1, 1)), Contains("cone"));
  Shape flat;
  flat.kind = ShapeKind::hull;
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  CHECK_THAT(refusal_of(flat), Contains("hull"));
  flat.visible = false;
  CHECK(refusal_of(flat) == "nothing was refused");
}

TEST_CASE("A scene that is refused leaves the last one to draw, or says that there is none") {
  Studio studio(all_shapes());
  const Picture before = studio.draw(view_of_shapes());
  auto bad = std::make_shared<Scene>(all_shapes());
  bad->bodies[0].parts[0].shapes[0].texture = "none";
  CHECK_THROWS_AS(studio.renderer->load(bad), Error);
  CHECK(studio.draw(view_of_shapes()).rgb == before.rgb);
}
