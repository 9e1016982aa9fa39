// What the software renderer keeps between frames, and the processor it runs on, show in no pixel.
#include <catch2/catch.hpp>

#include "engine/render/kept_views.h"
#include "engine/render/software_renderer.h"
#include "tests/engine/render/all_shapes.h"

using namespace stampede;

namespace {

bool same(const Picture& a, const Picture& b) {
  return a.rgb == b.rgb && a.depth == b.depth && a.instance == b.instance && a.semantic == b.semantic;
}

// Table, arm and cubes; a textured cube, a translucent zone, and a camera with a lens beside the five.
std::shared_ptr<const Scene> busy_scene(int cubes) {
  Scene scene = scene_with_five_cameras(cubes, 64);
  Texture noise;
  noise.kind = TextureKind::noise;
  noise.size_m = 0.05;
  scene.textures["noise"] = noise;
  scene.bodies[1].parts[0].shapes[0].texture = "noise";
  scene.bodies[0].parts[0].shapes[0].texture = "noise";
  Region zone;
  zone.name = "zone";
  zone.visible = true;
  zone.size = {0.3, 0.3, 0.2};
  zone.part_from_region = translation(0.5, 0, 0.2);
  zone.colour = {0, 1, 0, 0.3};
  scene.regions.push_back(zone);
  Camera bent = scene.cameras[0];
  bent.name = "bent";
  bent.distortion = {-0.2, 0.05, 0.001, 0.001, 0};
  scene.cameras.push_back(bent);
  scene.classes.clear();
  number_masks(scene, RandomKey("busy scene"));
  return std::make_shared<const Scene>(std::move(scene));
}

// The arm moves from frame 2 to 11 but for 5; the second cube from 7 to 9, and a cube is put down where it was.
SceneState moment_of(const Scene& scene, int frame) {
  SceneState moment = initial_state(scene);
  const int moves = std::min(frame, 11) - (frame >= 5 ? 1 : 0);
  moment.robot_position[1] += 0.04 * std::max(0, moves - 1);
  if (frame >= 7)
    moment.world_from_body[2] = translation(0.01 * (std::min(frame, 9) - 6), 0, 0.02) * moment.world_from_body[2];
  return moment;
}

}  // namespace

TEST_CASE("What stands still is drawn once, and every picture is the one that is drawn as a whole") {
  const DrawOptions options{.kinds = {}, .shadows = GENERATE(false, true), .samples = GENERATE(1, 2)};
  SoftwareRenderer keeping(pixel_kernels(), true), whole(pixel_kernels(), false);
  int compared = 0;
  for (const int cubes : {6, 3}) {  // two scenes, one after the other
    const std::shared_ptr<const Scene> scene = busy_scene(cubes);
    keeping.load(scene);
    whole.load(scene);
    for (const int frame : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 4, 5}) {  // and back
      const ScenePoses poses = scene_poses(*scene, moment_of(*scene, frame));
      const std::vector<View> views = views_of(*scene, poses);
      std::vector<Picture> kept, drawn;
      keeping.draw(poses, views, options, kept);
      whole.draw(poses, views, options, drawn);
      REQUIRE(kept.size() == 6);
      for (std::size_t i = 0; i < kept.size(); ++i) {
        INFO("frame " << frame << ", camera " << views[i].camera.name);
        CHECK(same(kept[i], drawn[i]));
        ++compared;
      }
    }
  }
  CHECK(compared == 2 * 16 * 6);
}

TEST_CASE("Kinds that come and go from frame to frame leave no trace in what is kept") {
  const std::shared_ptr<const Scene> scene = busy_scene(4);
  SoftwareRenderer keeping(pixel_kernels(), true), whole(pixel_kernels(), false);
  keeping.load(scene);
  whole.load(scene);
  for (int frame = 0; frame < 24; ++frame) {
    const ScenePoses poses = scene_poses(*scene, moment_of(*scene, frame / 2));
    const DrawOptions options{.kinds = {frame % 3 != 1, frame % 2 == 0, true, frame % 5 != 0},
                              .shadows = frame % 7 > 4,
                              .samples = 1 + (frame % 4) / 3};
    std::vector<Picture> kept, drawn;
    keeping.draw(poses, views_of(*scene, poses), options, kept);
    whole.draw(poses, views_of(*scene, poses), options, drawn);
    for (std::size_t i = 0; i < kept.size(); ++i) CHECK(same(kept[i], drawn[i]));
  }
}

TEST_CASE("Every set of instructions draws the same bytes") {
  if (avx2_pixel_kernels() == nullptr) return;  // nothing to compare with
  SoftwareRenderer plain(plain_pixel_kernels(), true), wide(*avx2_pixel_kernels(), true);
  const std::shared_ptr<const Scene> scene = busy_scene(6);
  plain.load(scene);
  wide.load(scene);
  for (int frame = 0; frame < 6; ++frame) {
    const DrawOptions options{.kinds = {}, .shadows = frame % 2 == 1, .samples = 1 + frame / 4};
    const ScenePoses poses = scene_poses(*scene, moment_of(*scene, frame));
    std::vector<Picture> a, b;
    plain.draw(poses, views_of(*scene, poses), options, a);
    wide.draw(poses, views_of(*scene, poses), options, b);
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(same(a[i], b[i]));
  }
}

TEST_CASE("OpenGL draws nearly the same") {
  const std::shared_ptr<const Scene> scene = busy_scene(6);
  const ScenePoses poses = scene_poses(*scene, initial_state(*scene));
  DrawOptions options{.kinds = {}, .shadows = GENERATE(false, true)};
  std::vector<Picture> own, gl;
  const std::unique_ptr<Renderer> renderer = make_renderer();
  renderer->load(scene);
  renderer->draw(poses, views_of(*scene, poses), options, own);
  options.by = DrawnBy::osmesa;
  renderer->draw(poses, views_of(*scene, poses), options, gl);
  for (std::size_t i = 0; i < own.size(); ++i) {
    int other_ids = 0, other_colours = 0;
    const auto pixels = static_cast<int>(own[i].instance.size());
    for (std::size_t p = 0; p < own[i].instance.size(); ++p) {
      other_ids += own[i].instance[p] != gl[i].instance[p];
      int difference = 0;
      for (std::size_t k = 0; k < 3; ++k)
        difference = std::max(difference, std::abs(own[i].rgb[3 * p + k] - gl[i].rgb[3 * p + k]));
      other_colours += difference > 6;
    }
    INFO("camera " << scene->cameras[i].name << ": " << other_ids << " other ids, " << other_colours
                   << " other colours of " << pixels);
    CHECK(other_ids * 200 < pixels);
    CHECK(other_colours * 100 < pixels);
  }
}

TEST_CASE("An eye is kept from its second picture on, the longest unused goes first, and there is an end to the room") {
  const auto eye = [](int number, int side) {
    EyeKey key;
    key.camera_from_world[3] = number;
    key.width = key.height = side;
    return key;
  };
  KeptViews views;
  CHECK(views.find(eye(0, 8)) == nullptr);
  KeptView* first = views.find(eye(0, 8));
  REQUIRE(first != nullptr);
  first->surface.clear(8, 8, 4.5, true, 0);
  for (int number = 1; number < 500; ++number) {
    CHECK(views.find(eye(number, 8)) == nullptr);
    const KeptView* again = views.find(eye(0, 8));
    REQUIRE(again != nullptr);
    CHECK(again->surface.width == 8);
  }
  CHECK(views.find(eye(1, 8)) == nullptr);  // went long ago
  CHECK(views.find(eye(-1, 4000)) == nullptr);
  CHECK(views.find(eye(-1, 4000)) == nullptr);  // too large
  views.forget();
  CHECK(views.find(eye(0, 8)) == nullptr);
}
