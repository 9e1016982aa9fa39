// Colours: light, shadows, textures, translucent things, samples; and that depth and ids know nothing of them.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/engine/render/all_shapes.h"

using namespace stampede;

namespace {

void demand_same_geometry(const Picture& a, const Picture& b) {
  CHECK(a.depth == b.depth);
  CHECK(a.instance == b.instance);
  CHECK(a.semantic == b.semantic);
}

std::array<int, 3> pixel(const Picture& picture, const View& view, const Vector3& world_point) {
  const auto [u, v] = project(view.camera, view.world_from_camera.inverse() * world_point);
  const auto i = static_cast<std::size_t>(static_cast<int>(v) * picture.width + static_cast<int>(u));
  return {picture.rgb.at(3 * i), picture.rgb.at(3 * i + 1), picture.rgb.at(3 * i + 2)};
}

bool like(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]) < 20;
}

int brightness(const std::array<int, 3>& rgb) { return rgb[0] + rgb[1] + rgb[2]; }

// A flat floor at z = 0, seen from above with 1 cm a pixel, and what is put over it.
Studio floor_with(const std::function<void(Scene&)>& change) {
  Scene scene;
  scene.bodies.push_back(free_body("floor", box_of({1.5, 1.5, 0.1}, {0.6, 0.6, 0.6, 1}), translation(0, 0, -0.05)));
  scene.light.direction = {0, 0, -1};
  scene.light.specular = 0;
  change(scene);
  number_masks(scene, RandomKey("floor"));
  return Studio(std::move(scene));
}

View from_above() {
  View view = view_from({0, 0, 1}, {0, 0, 0}, 60, 128, 128);
  view.camera.focal_x = view.camera.focal_y = 100;
  return view;
}

Studio floor_wearing(const Texture& texture) {
  return floor_with([&](Scene& scene) {
    scene.textures["pattern"] = texture;
    scene.bodies[0].parts[0].shapes[0].texture = "pattern";
    scene.bodies[0].parts[0].shapes[0].colour = {1, 1, 1, 1};
  });
}

Texture pattern(TextureKind kind, double size_m, int seed = 0) {
  Texture texture;
  texture.kind = kind;
  texture.size_m = size_m;
  texture.seed = seed;
  return texture;
}

}  // namespace

TEST_CASE("Lambert: a surface that faces the light is ambient plus diffuse, and tilts by the cosine") {
  const auto shade = [](const Vector3& direction, double ambient, double diffuse) {
    Studio studio = floor_with([&](Scene& scene) { scene.light = {direction, {1, 1, 1, 1}, ambient, diffuse, 0}; });
    return pixel(studio.draw(from_above()), from_above(), Vector3::Zero())[0];
  };
  CHECK(shade({0, 0, -1}, 0, 1) == Approx(0.6 * 255).margin(1));
  CHECK(shade({0, 0, -3}, 0.5, 0.4) == Approx(0.6 * 0.9 * 255).margin(1));
  CHECK(shade({std::sqrt(3.0), 0, -1}, 0, 1) == Approx(0.5 * 0.6 * 255).margin(1));
  CHECK(shade({0, 0, 1}, 0, 1) == 0);
}

TEST_CASE("Shadows fall where the light says, and on colours only") {
  Studio studio = floor_with([](Scene& scene) {
    scene.bodies.push_back(free_body("plate", box_of({0.2, 0.2, 0.02}), translation(-0.2, 0, 0.2)));
    scene.light.direction = {1, 0, -1};
  });
  const Picture plain = studio.draw(from_above()), shaded = studio.draw(from_above(), {.kinds = {}, .shadows = true});
  demand_same_geometry(plain, shaded);
  const auto darker = [&](const Vector3& point) {
    return brightness(pixel(plain, from_above(), point)) - brightness(pixel(shaded, from_above(), point));
  };
  CHECK(darker({0, 0, 0}) > 100);  // 0.2 m further along x: the middle of the shadow
  CHECK(darker({0.07, 0.07, 0}) > 100);
  CHECK(darker({0.2, 0, 0}) == 0);
  CHECK(darker({0, 0.2, 0}) == 0);
  CHECK(darker({-0.2, 0, 0.21}) == 0);  // the plate itself
}

TEST_CASE("Nothing shadows itself: lit sides of every shape stay as bright") {
  Scene scene = all_shapes();
  std::erase_if(scene.bodies, [](const Body& body) { return body.name == "floor"; });
  Studio studio(std::move(scene));
  const Picture plain = studio.draw(view_of_shapes()),
                shaded = studio.draw(view_of_shapes(), {.kinds = {}, .shadows = true});
  int darker = 0, shown = 0;
  for (std::size_t i = 0; i < plain.instance.size(); ++i) {
    shown += plain.instance[i] != 0;
    darker += plain.rgb[3 * i] > shaded.rgb[3 * i] + 12;
  }
  CHECK(shown > 3000);
  CHECK(darker < shown / 50);
}

TEST_CASE("A checker alternates every half size, along the shape's own axes") {
  Studio studio = floor_wearing(pattern(TextureKind::checker, 0.4));
  const Picture picture = studio.draw(from_above());
  for (int i = -2; i < 2; ++i)
    for (int j = -2; j < 2; ++j) {
      const int value = pixel(picture, from_above(), {0.1 + 0.2 * i, 0.1 + 0.2 * j, 0})[0];
      CHECK(value == ((i + j) % 2 == 0 ? 255 : 0));
    }
  demand_same_geometry(picture, floor_with([](Scene&) {}).draw(from_above()));
}

TEST_CASE("Stripes change along one axis only, noise is a function of its seed") {
  Studio stripes = floor_wearing(pattern(TextureKind::stripes, 0.4));
  const Picture picture = stripes.draw(from_above());
  for (const double y : {-0.3, 0.0, 0.3}) {
    CHECK(pixel(picture, from_above(), {0.1, y, 0})[0] == 255);
    CHECK(pixel(picture, from_above(), {0.3, y, 0})[0] == 0);
  }
  const auto noise = [](int seed) {
    return floor_wearing(pattern(TextureKind::noise, 0.4, seed)).draw(from_above()).rgb;
  };
  CHECK(noise(1) == noise(1));
  CHECK(noise(1) != noise(2));
}

TEST_CASE("A pattern finer than pixels is grey, not moire") {
  Studio studio = floor_wearing(pattern(TextureKind::checker, 0.003));
  const Picture picture = studio.draw(from_above());
  for (int i = 0; i < 20; ++i)
    CHECK(pixel(picture, from_above(), {0.02 * i, 0.013 * i, 0})[0] == Approx(1.1 * 127.5).margin(12));
}

TEST_CASE("A mesh wears a picture by its own coordinates, v down") {
  Image image{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}};  // red green, blue white
  auto sheet = std::make_shared<DrawnMesh>();
  sheet->positions = {{-0.4F, 0.4F, 0}, {0.4F, 0.4F, 0}, {0.4F, -0.4F, 0}, {-0.4F, -0.4F, 0}};
  sheet->normals.assign(4, {0, 0, 1});
  sheet->coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  sheet->triangles = {{0, 2, 1}, {0, 3, 2}};
  Studio studio = floor_with([&](Scene& scene) {
    scene.meshes["sheet"] = sheet;
    scene.textures["picture"].image = std::make_shared<const Image>(image);
    Shape shape;
    shape.kind = ShapeKind::mesh;
    shape.mesh = "sheet";
    shape.texture = "picture";
    shape.colour = {1, 1, 1, 1};
    scene.bodies.push_back(free_body("sheet", shape, translation(0, 0, 0.1)));
  });
  const Picture picture = studio.draw(from_above());
  const auto at = [&](double x, double y) { return pixel(picture, from_above(), {x, y, 0.1}); };
  CHECK(like(at(-0.2, 0.2), {255, 0, 0}));
  CHECK(like(at(0.2, 0.2), {0, 255, 0}));
  CHECK(like(at(-0.2, -0.2), {0, 0, 255}));
  CHECK(like(at(0.2, -0.2), {255, 255, 255}));
  View below = view_from({0, 0, 0.02}, {0, 0, 1}, 60, 32, 32);  // an open sheet has a back
  CHECK(studio.draw(below).instance[16 * 32 + 16] == studio.scene->bodies[1].parts[0].instance);
}

TEST_CASE("What is translucent tints what is behind it, and hides nothing in depth and masks") {
  const auto with_zone = [](double alpha) {
    return floor_with([&](Scene& scene) {
      Region zone;
      zone.name = "zone";
      zone.visible = true;
      zone.size = {0.3, 0.3, 0.1};
      zone.part_from_region = translation(0, 0, 0.05);
      zone.colour = {1, 0, 0, alpha};
      scene.regions.push_back(zone);
    });
  };
  const Picture bare = floor_with([](Scene&) {}).draw(from_above());
  Studio air = with_zone(0.3), solid = with_zone(1);
  const Picture seen_through = air.draw(from_above()), blocked = solid.draw(from_above());
  CHECK(seen_through.depth == bare.depth);
  const auto zone_number = static_cast<std::uint16_t>(air.scene->regions[0].instance);
  CHECK(std::count(seen_through.instance.begin(), seen_through.instance.end(), zone_number) == 0);
  const std::array<int, 3> plain = pixel(bare, from_above(), Vector3::Zero());
  const std::array<int, 3> tinted = pixel(seen_through, from_above(), Vector3::Zero());
  CHECK(tinted[0] > plain[0] + 20);
  CHECK(tinted[1] == Approx(0.7 * plain[1]).margin(2));
  const std::size_t middle = 64 * 128 + 64;
  CHECK(blocked.depth[middle] == Approx(0.9).margin(1e-4));
  CHECK(blocked.instance[middle] == solid.scene->regions[0].instance);
  CHECK(pixel(blocked, from_above(), Vector3::Zero())[1] == 0);
}

TEST_CASE("Samples smooth colours only, and tell an edge's share") {
  Studio studio(all_shapes());
  const Picture one = studio.draw(view_of_shapes());
  for (const int samples : {2, 3, 4}) {
    const Picture many = studio.draw(view_of_shapes(), {.kinds = {}, .shadows = false, .samples = samples});
    demand_same_geometry(one, many);
    CHECK(one.rgb != many.rgb);
  }
  Scene scene;                                       // a white wall whose edge runs through the middle of a column
  scene.light = {{0, 0, 1}, {0, 0, 0, 1}, 0, 0, 0};  // black
  scene.bodies.push_back(free_body("wall", box_of({4, 8, 0.1}), translation(-2 + 0.005, 0, 1.05)));
  number_masks(scene, RandomKey("edge"));
  Studio edge(std::move(scene));
  View view;
  view.camera.width = view.camera.height = 64;
  view.camera.focal_x = view.camera.focal_y = 100;
  view.camera.centre_x = view.camera.centre_y = 32;
  const Picture half = edge.draw(view, {.kinds = {}, .shadows = false, .samples = 4});
  const auto red = [&](int column) {
    return static_cast<int>(half.rgb[static_cast<std::size_t>(3 * (32 * 64 + column))]);
  };
  CHECK(red(31) == 0);
  CHECK(red(32) == Approx(red(33) / 2.0).margin(1));
  CHECK(red(33) > 180);
}
