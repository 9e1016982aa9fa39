// Frames of five cameras, read back to memory: the figures of tests/bench/README.md. One frame is five pictures.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "engine/geometry/drawn_mesh.h"
#include "engine/render/png.h"
#include "engine/render/renderer.h"
#include "tests/engine/render/five_cameras.h"

namespace {

using namespace stampede;

// A wavy vase of about `triangles`, as a scanned thing has them.
std::shared_ptr<const DrawnMesh> vase(int triangles) {
  const int sides = static_cast<int>(std::sqrt(triangles / 2.0)), steps = sides;
  std::vector<std::array<double, 2>> profile;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    profile.push_back({0.05 + 0.02 * std::sin(9 * t) + 0.0005 * std::sin(200 * t), 0.2 * t});
  }
  return std::make_shared<DrawnMesh>(lathe_mesh(profile, sides));
}

Scene scene_with_vases(int count, int triangles_each) {
  Scene scene = scene_with_five_cameras(10);
  scene.meshes["vase"] = vase(triangles_each);
  for (int i = 0; i < count; ++i) {
    Body body;
    body.name = "vase" + std::to_string(i);
    body.free = true;
    body.parts.resize(1);
    Shape shape;
    shape.kind = ShapeKind::mesh;
    shape.mesh = "vase";
    shape.colour = {0.4, 0.55, 0.7, 1};
    shape.collides = false;
    body.parts[0].name = body.name;
    body.parts[0].shapes.push_back(shape);
    body.world_from_body = translation(0.62 + 0.2 * (i % 2), 0.24 * i - 0.48, 0);
    scene.bodies.push_back(std::move(body));
  }
  scene.classes.clear();
  number_masks(scene, RandomKey("render bench"));
  return scene;
}

void draw_frames(benchmark::State& state, Scene made, const DrawOptions& options) {
  const auto scene = std::make_shared<const Scene>(std::move(made));
  const std::unique_ptr<Renderer> renderer = make_renderer();
  renderer->load(scene);
  SceneState moment = initial_state(*scene);
  std::vector<Picture> pictures;
  double turn = 0;
  const auto frame = [&] {  // the arm moves, as it does in an episode
    moment.robot_position[1] = 0.3 * std::sin(turn += 0.05);
    const ScenePoses poses = scene_poses(*scene, moment);
    renderer->draw(poses, views_of(*scene, poses), options, pictures);
  };
  for (int i = 0; i < 3; ++i) frame();  // shaders are compiled at first use
  for (auto _ : state) frame();
  state.SetItemsProcessed(state.iterations());
  state.counters["views/s"] =
      benchmark::Counter(static_cast<double>(state.iterations() * 5), benchmark::Counter::kIsRate);
  std::size_t bytes = 0;
  for (const Picture& picture : pictures)
    for (const PictureKind kind : kPictureKinds)
      if (options.kinds.has(kind)) bytes += to_png(picture, kind).size();
  state.counters["png_kB/frame"] = static_cast<double>(bytes) / 1000;
}

void all_kinds(benchmark::State& state) { draw_frames(state, scene_with_five_cameras(10), {}); }
void all_kinds_shadows(benchmark::State& state) {
  draw_frames(state, scene_with_five_cameras(10), {.kinds = {}, .shadows = true});
}
void all_kinds_opengl(benchmark::State& state) {
  draw_frames(state, scene_with_five_cameras(10), {.kinds = {}, .by = DrawnBy::osmesa});
}
void all_kinds_shadows_opengl(benchmark::State& state) {
  draw_frames(state, scene_with_five_cameras(10), {.kinds = {}, .shadows = true, .by = DrawnBy::osmesa});
}
void depth_only(benchmark::State& state) {
  draw_frames(state, scene_with_five_cameras(10), {.kinds = {false, true, false, false}});
}
void all_kinds_2x2_samples(benchmark::State& state) {
  draw_frames(state, scene_with_five_cameras(10), {.kinds = {}, .shadows = false, .samples = 2});
}
void all_kinds_256_pixels(benchmark::State& state) { draw_frames(state, scene_with_five_cameras(10, 256), {}); }
void triangles_100k(benchmark::State& state) { draw_frames(state, scene_with_vases(5, 20000), {}); }
void triangles_100k_shadows(benchmark::State& state) {
  draw_frames(state, scene_with_vases(5, 20000), {.kinds = {}, .shadows = true});
}

// A worker's next episode: another scene of the same shapes.
void load_next_scene(benchmark::State& state) {
  const std::array<std::shared_ptr<const Scene>, 2> scenes{std::make_shared<const Scene>(scene_with_five_cameras(10)),
                                                           std::make_shared<const Scene>(scene_with_five_cameras(10))};
  const std::unique_ptr<Renderer> renderer = make_renderer();
  std::size_t next = 0;
  for (auto _ : state) renderer->load(scenes[next++ % 2]);
}

BENCHMARK(all_kinds)->Unit(benchmark::kMillisecond);
BENCHMARK(all_kinds)->Unit(benchmark::kMillisecond)->Threads(2)->UseRealTime();
BENCHMARK(all_kinds_shadows)->Unit(benchmark::kMillisecond);
BENCHMARK(all_kinds_opengl)->Unit(benchmark::kMillisecond);
BENCHMARK(all_kinds_opengl)->Unit(benchmark::kMillisecond)->Threads(2)->UseRealTime();
BENCHMARK(all_kinds_shadows_opengl)->Unit(benchmark::kMillisecond);
BENCHMARK(depth_only)->Unit(benchmark::kMillisecond);
BENCHMARK(all_kinds_2x2_samples)->Unit(benchmark::kMillisecond);
BENCHMARK(all_kinds_256_pixels)->Unit(benchmark::kMillisecond);
BENCHMARK(triangles_100k)->Unit(benchmark::kMillisecond);
BENCHMARK(triangles_100k_shadows)->Unit(benchmark::kMillisecond);
BENCHMARK(load_next_scene)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
