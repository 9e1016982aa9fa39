// What is drawn, against exact rays through the same scene.
#include <catch2/catch.hpp>

#include "tests/engine/render/agreement.h"
#include "tests/engine/render/all_shapes.h"
#include "tests/engine/render/ray_caster.h"

using namespace stampede;

namespace {

void demand_agreement(Studio& studio, const View& view, int least_surface) {
  const Picture drawn = studio.draw(view);
  const Agreement found = agreement(drawn, RayCaster(*studio.scene, studio.poses).draw(view));
  INFO(view.camera.name << ": depth " << found.depth << " (worst " << found.worst_mm << " mm), ids " << found.ids);
  CHECK(found.surfaces >= least_surface);
  CHECK(found.depth >= 0.999);
  CHECK(found.ids >= 0.995);
}

// Mean place of the pixels with an id, in pixels.
std::array<double, 2> middle_of(const Picture& picture, int instance) {
  double u = 0, v = 0, count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (picture.instance[static_cast<std::size_t>(y * picture.width + x)] == instance)
        u += x + 0.5, v += y + 0.5, ++count;
  return {u / count, v / count};
}

}  // namespace

TEST_CASE("The Panda scene agrees with exact rays in all five cameras") {
  Studio studio(scene_with_five_cameras(10));
  for (const View& view : views_of(*studio.scene, studio.poses)) demand_agreement(studio, view, 1000);
}

TEST_CASE("Every kind of shape agrees with exact rays, at odd sizes too") {
  Studio studio(all_shapes());
  demand_agreement(studio, view_of_shapes(), 10000);
  demand_agreement(studio, view_of_shapes(333, 257), 30000);
  demand_agreement(studio, view_from({-0.9, 0.5, 0.3}, {0, 0, 0.2}, 50, 121, 199), 3000);
}

TEST_CASE("Depth is in metres along z, and 0 where nothing lies between near and far") {
  Scene scene;
  scene.bodies.push_back(free_body("wall", box_of({20, 20, 0.1}), translation(0, 0, 2.05)));
  number_masks(scene, RandomKey("wall"));
  Studio studio(std::move(scene));
  View view = view_from({0, 0, 0}, {0, 0, 1}, 90, 64, 64);
  view.camera.near_m = 0.01;
  view.camera.far_m = 4.5;
  for (const float depth : studio.draw(view).depth)
    REQUIRE(depth == Approx(2.0).margin(1e-5));  // corners too: not range
  view.camera.far_m = 1.9;
  const Picture short_sighted = studio.draw(view);
  for (const float depth : short_sighted.depth) REQUIRE(depth == 0);
  for (const std::uint16_t instance : short_sighted.instance) REQUIRE(instance == 0);
}

TEST_CASE("Points land where general intrinsics put them") {
  Scene scene;
  const std::vector<Vector3> places{{0, 0, 1}, {0.3, 0.1, 1.2}, {-0.25, 0.15, 0.9}, {0.1, -0.3, 1.5}};
  for (std::size_t i = 0; i < places.size(); ++i)
    scene.bodies.push_back(
        free_body("ball" + std::to_string(i), shape_of(ShapeKind::sphere, 0.03, 0), translation(places[i])));
  number_masks(scene, RandomKey("balls"));
  Studio studio(std::move(scene));
  View view;  // stands at the origin, looking along z
  view.camera.width = 320;
  view.camera.height = 200;
  view.camera.focal_x = 210;
  view.camera.focal_y = 170;
  view.camera.centre_x = 131.3;
  view.camera.centre_y = 117.8;
  const auto check_places = [&] {
    const Picture picture = studio.draw(view);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto [u, v] = middle_of(picture, studio.scene->bodies[i].parts[0].instance);
      const auto [right_u, right_v] = project(view.camera, places[i]);
      CHECK(u == Approx(right_u).margin(0.35));
      CHECK(v == Approx(right_v).margin(0.35));
    }
  };
  SECTION("without distortion") { check_places(); }
  SECTION("through a lens") {
    view.camera.distortion = {-0.25, 0.08, 0.004, -0.006, 0.01};
    const auto [u, v] = project(view.camera, places[1]);
    View plain = view;
    plain.camera.distortion = {};
    REQUIRE(std::hypot(project(plain.camera, places[1])[0] - u, project(plain.camera, places[1])[1] - v) > 1);
    check_places();
  }
}

TEST_CASE("Through a lens, depth and ids still agree with exact rays") {
  Studio studio(all_shapes());
  View view = view_of_shapes(160, 120);
  SECTION("barrel") { view.camera.distortion = {-0.3, 0.1, 0.003, -0.002, 0}; }
  SECTION("cushion") { view.camera.distortion = {0.2, 0.05, -0.003, 0.002, 0.01}; }
  const Agreement found = agreement(studio.draw(view), RayCaster(*studio.scene, studio.poses).draw(view));
  INFO("depth " << found.depth << " (worst " << found.worst_mm << " mm), ids " << found.ids);
  CHECK(found.depth >= 0.999);
  CHECK(found.ids >= 0.995);
}

TEST_CASE("A ball of a hundred thousand triangles, most of them smaller than a pixel, has no holes") {
  constexpr double kRadius = 0.3;
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= 224; ++i) {
    const double angle = std::numbers::pi * (i / 224.0 - 0.5);
    profile.push_back({i % 224 == 0 ? 0 : kRadius * std::cos(angle), kRadius * std::sin(angle)});
  }
  Scene exact, drawn;
  exact.bodies.push_back(free_body("ball", shape_of(ShapeKind::sphere, kRadius, 0), translation(0, 0, 0.3)));
  number_masks(exact, RandomKey("ball"));
  drawn = exact;
  const auto mesh = std::make_shared<const DrawnMesh>(lathe_mesh(profile, 224));
  REQUIRE(mesh->triangles.size() > 99'000);
  drawn.meshes["ball"] = mesh;
  drawn.bodies[0].parts[0].shapes[0].kind = ShapeKind::mesh;
  drawn.bodies[0].parts[0].shapes[0].mesh = "ball";
  Studio studio(drawn);
  const RayCaster rays(exact, studio.poses);
  for (const int size : {31, 128, 400}) {
    const View view = view_from({0.7, -1.0, 0.8}, {0, 0, 0.3}, 40, size, size + 7);
    const Agreement found = agreement(studio.draw(view), rays.draw(view));
    CHECK(found.surfaces > size * size / 10);
    CHECK(found.depth >= 0.999);
    CHECK(found.ids >= 0.999);
  }
}
