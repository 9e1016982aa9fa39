// Pictures drawn by one camera, compared with what another would see.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "db/catalogue.h"
#include "db/recording/overlay.h"
#include "engine/base/random.h"
#include "engine/model/camera.h"
#include "engine/model/scene_poses.h"
#include "engine/record/observation.h"
#include "engine/render/edge_alignment.h"
#include "engine/render/png.h"
#include "engine/render/renderer.h"
#include "tests/support/lab.h"

using namespace stampede;
using namespace stampede::test;

namespace {

struct Measured {
  Alignment alignment;
  double true_px = 0;                     // median way of the outline's points along their normals
  std::array<double, 2> true_shift_px{};  // their mean way
};

struct Bench {
  Lab lab;
  StoredEpisode stored = stored_of(lab.import());
  std::unique_ptr<Renderer> renderer = make_renderer();

  Bench() {
    Scene scene = *stored.scene;
    Camera& camera = scene.cameras.at(0);
    camera = with_size(camera);
    camera.distortion = {0.08, -0.12, 0.0006, -0.0009, 0.01};
    stored.scene = std::make_shared<const Scene>(scene);
  }
  static Camera with_size(const Camera& camera) { return resized(camera, 640, 480); }

  Picture draw(const std::shared_ptr<const Scene>& scene, const ScenePoses& poses, const View& view, bool rgb) {
    renderer->load(scene);
    DrawOptions options;
    options.kinds = PictureKinds::none();
    for (const PictureKind kind : kPictureKinds)
      if (rgb ? kind == PictureKind::rgb : (kind == PictureKind::instance || kind == PictureKind::depth))
        options.kinds.add(kind);
    options.samples = rgb ? 3 : 1;
    std::vector<Picture> pictures;
    renderer->draw(poses, {&view, 1}, options, pictures);
    return pictures[0];
  }

  Measured measure(const Transform& camera_from_moved) {
    Scene other_light = *stored.scene;
    other_light.light.direction = {0.4, -0.6, -1};
    other_light.light.ambient = 0.4;
    const auto real_scene = std::make_shared<const Scene>(other_light);
    Measured result;
    std::vector<OutlinePoint> all;
    Random random(RandomKey("noise"));
    std::vector<double> ways;
    for (const std::int64_t frame : {0, 20, 40}) {
      const ScenePoses poses = scene_poses(*stored.scene, state_at(*stored.scene, stored.episode, frame));
      const Camera& camera = stored.scene->cameras[0];
      const View truth{camera, world_from_camera(*stored.scene, poses, camera)};
      const View moved{camera, truth.world_from_camera * camera_from_moved};
      Picture real = draw(real_scene, poses, truth, true);
      for (std::uint8_t& value : real.rgb)
        value = static_cast<std::uint8_t>(std::clamp(value + 3 * random.normal(), 0.0, 255.0));
      const Picture ours = draw(stored.scene, poses, moved, false);
      std::vector<std::uint8_t> mask(ours.instance.size());
      for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = ours.instance[i] != 0 ? 1 : 0;
      const auto points = outline_offsets(mask, real.rgb, real.width, real.height);
      for (const OutlinePoint& point : points) {
        const double x = point.at[0] - 1.5 * point.normal[0], y = point.at[1] - 1.5 * point.normal[1];
        const float depth = ours.depth[static_cast<std::size_t>(y) * 640 + static_cast<std::size_t>(x)];
        const auto direction = direction_of(camera, point.at);
        if (depth <= 0 || !direction) continue;
        const Vector3 seen(depth * (*direction)[0], depth * (*direction)[1], depth);
        const auto there = project(camera, camera_from_moved * seen);
        const double right = there[0] - point.at[0], down = there[1] - point.at[1];
        ways.push_back(std::abs(right * point.normal[0] + down * point.normal[1]));
        result.true_shift_px[0] += right, result.true_shift_px[1] += down;
      }
      all.insert(all.end(), points.begin(), points.end());
    }
    result.alignment = alignment_of(all);
    std::nth_element(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2), ways.end());
    result.true_px = ways[ways.size() / 2];
    for (double& way : result.true_shift_px) way /= static_cast<double>(ways.size());
    return result;
  }
};

}  // namespace

TEST_CASE("the outline's offset grows with the camera's error, and agrees with the way that it moved") {
  Bench bench;
  const Measured none = bench.measure(Transform::Identity());
  CHECK(none.alignment.points > 1000);
  CHECK(none.alignment.found > none.alignment.points * 3 / 4);
  CHECK(none.alignment.median_px < 0.35);
  CHECK(std::hypot(none.alignment.shift_px[0], none.alignment.shift_px[1]) < 0.25);
  const auto agrees = [&](const Transform& camera_from_moved, const std::string& by, double& last) {
    const Measured m = bench.measure(camera_from_moved);
    const Alignment& a = m.alignment;
    INFO(by << ": median " << a.median_px << ", true " << m.true_px << "; 95 % " << a.p95_px << "; shift "
            << a.shift_px[0] << " " << a.shift_px[1] << ", true " << m.true_shift_px[0] << " " << m.true_shift_px[1]);
    CHECK(a.median_px > last);
    CHECK(a.median_px == Approx(m.true_px).epsilon(0.1).margin(0.4));
    CHECK(a.shift_px[0] == Approx(m.true_shift_px[0]).epsilon(0.1).margin(0.2));
    CHECK(a.shift_px[1] == Approx(m.true_shift_px[1]).margin(0.6));
    last = a.median_px;
  };
  double last = none.alignment.median_px;
  for (const double millimetres : {5.0, 10.0, 20.0})
    agrees(translation(millimetres / 1000, 0, 0), std::to_string(millimetres) + " mm", last);
  last = none.alignment.median_px;
  for (const double degrees : {0.2, 0.5, 1.0})
    agrees(rotation_rpy(0, degrees * std::numbers::pi / 180, 0), std::to_string(degrees) + " deg", last);
}

TEST_CASE("an error of a millimetre shows in the shift, and beyond the search most edges are missing") {
  Bench bench;
  const Measured none = bench.measure(Transform::Identity());
  const auto told = [](const Measured& m) {
    const Alignment& a = m.alignment;
    return "found " + std::to_string(a.found) + " of " + std::to_string(a.points) + ", median " +
           std::to_string(a.median_px) + ", true " + std::to_string(m.true_px) + "; shift " +
           std::to_string(a.shift_px[0]) + " " + std::to_string(a.shift_px[1]) + ", true " +
           std::to_string(m.true_shift_px[0]) + " " + std::to_string(m.true_shift_px[1]);
  };
  double last = none.alignment.shift_px[0];
  for (const double millimetres : {1.0, 2.0}) {
    const Measured m = bench.measure(translation(millimetres / 1000, 0, 0));
    INFO(told(m));
    CHECK(m.alignment.shift_px[0] == Approx(m.true_shift_px[0]).margin(0.2));
    CHECK(m.alignment.shift_px[0] > last + 0.15);
    last = m.alignment.shift_px[0];
  }
  const Measured far = bench.measure(rotation_rpy(0, 2 * std::numbers::pi / 180, 0));
  INFO(told(far));
  CHECK(far.true_px > 15);
  CHECK(far.alignment.median_px > 2);
  CHECK(far.alignment.median_px < 12);
  CHECK(far.alignment.found < far.alignment.points / 2);  // what is told then is of other edges
}

TEST_CASE("an outline without edges has no offset") {
  const std::vector<std::uint8_t> grey(3 * 100 * 100, 128);
  std::vector<std::uint8_t> mask(100 * 100, 0);
  for (std::size_t y = 40; y < 60; ++y)
    for (std::size_t x = 40; x < 60; ++x) mask[y * 100 + x] = 1;
  const Alignment alignment = alignment_of(outline_offsets(mask, grey, 100, 100));
  CHECK(alignment.points > 20);
  CHECK(alignment.found == 0);
}

TEST_CASE("a rim within the thing that is steeper than its outline is not taken for it") {
  std::vector<std::uint8_t> rgb(3 * 100 * 100, 90), mask(100 * 100, 0);
  for (std::size_t y = 30; y < 70; ++y)
    for (std::size_t x = 30; x < 70; ++x) {
      mask[y * 100 + x] = 1;
      const bool inner = x >= 35 && x < 65 && y >= 35 && y < 65;
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * (y * 100 + x) + c] = inner ? 170 : 120;
    }
  const Alignment alignment = alignment_of(outline_offsets(mask, rgb, 100, 100));
  CHECK(alignment.found == alignment.points);
  CHECK(alignment.median_px < 0.1);
}

TEST_CASE("an edge that was moved by two pixels is found there, to a tenth") {
  std::vector<std::uint8_t> rgb(3 * 100 * 100, 40), mask(100 * 100, 0);
  for (std::size_t y = 30; y < 70; ++y)
    for (std::size_t x = 30; x < 70; ++x) {
      mask[y * 100 + x] = 1;
      for (std::size_t c = 0; c < 3; ++c) rgb[3 * ((y + 1) * 100 + x + 2) + c] = 200;
    }
  const Alignment alignment = alignment_of(outline_offsets(mask, rgb, 100, 100));
  CHECK(alignment.found == alignment.points);
  CHECK(alignment.shift_px[0] == Approx(2).margin(0.1));
  CHECK(alignment.shift_px[1] == Approx(1).margin(0.1));
}
