// Pictures against the physics: what a camera sees is what a ray through the simulated world meets.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/model/scene_poses.h"
#include "engine/render/renderer.h"
#include "tests/support/make_start.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

// The robot's parts are drawn finer than they collide: rays and pictures are compared where neither meets them.
struct Agreement {
  int pixels = 0, near = 0, same = 0, compared_ids = 0;
};

int instance_of(const Scene& scene, const std::optional<RayHit>& hit) {
  if (!hit) return 0;
  const Body& body = hit->part.body < 0 ? scene.robot.body : scene.bodies[static_cast<std::size_t>(hit->part.body)];
  return body.parts[static_cast<std::size_t>(hit->part.part)].instance;
}

bool inside_one_thing(const Picture& picture, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int u = x + dx, v = y + dy;
      if (u < 0 || v < 0 || u >= picture.width || v >= picture.height) return false;
      if (picture.instance[static_cast<std::size_t>(v * picture.width + u)] !=
          picture.instance[static_cast<std::size_t>(y * picture.width + x)])
        return false;
    }
  return true;
}

Agreement compare(const World& world, const Picture& picture, const View& view) {
  Agreement agreement;
  const Scene& scene = world.scene();
  const int robot_parts = static_cast<int>(scene.robot.body.parts.size());
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto direction = direction_of(view.camera, {x + 0.5, y + 0.5});
      const Vector3 ray((*direction)[0], (*direction)[1], 1);
      const Vector3 from = view.world_from_camera * Vector3(ray * view.camera.near_m);
      const auto hit = world.ray(from, view.world_from_camera * Vector3(ray * view.camera.far_m));
      const std::size_t i = static_cast<std::size_t>(y * picture.width + x);
      const int drawn = picture.instance[i], met = instance_of(scene, hit);
      if ((drawn > 0 && drawn <= robot_parts) || (met > 0 && met <= robot_parts)) continue;
      ++agreement.compared_ids;
      agreement.same += drawn == met;
      if (drawn != met || drawn == 0 || !inside_one_thing(picture, x, y)) continue;
      const double depth = view.camera.near_m + hit->distance / ray.norm();
      ++agreement.pixels;
      agreement.near += std::abs(depth - static_cast<double>(picture.depth[i])) < 1e-3;
    }
  return agreement;
}

}  // namespace

TEST_CASE("depth and masks agree with rays through the physics") {
  const TaskDraw task = plain::stack_draw(8);
  plain::PlainSymbols symbols;
  const Start start = make_start(task, symbols, {});
  REQUIRE(start.scene);
  const World world(start.scene);
  const auto renderer = make_renderer();
  renderer->load(start.scene);
  const ScenePoses poses = scene_poses(*start.scene, initial_state(*start.scene));
  Agreement sum;
  for (const Vector3& from : {Vector3(1.3, 0, 0.8), Vector3(0.4, 0.9, 0.7), Vector3(0.5, -0.1, 1.2)}) {
    View view;
    set_field_of_view(view.camera, 0.7, 160, 120);
    view.world_from_camera = looking_at(from, {0.5, 0, 0});
    std::vector<Picture> pictures;
    renderer->draw(poses, {&view, 1}, {}, pictures);
    const Agreement one = compare(world, pictures[0], view);
    sum.pixels += one.pixels, sum.near += one.near, sum.same += one.same, sum.compared_ids += one.compared_ids;
  }
  INFO(sum.near << " of " << sum.pixels << " depths, " << sum.same << " of " << sum.compared_ids << " ids");
  CHECK(sum.pixels > 8'000);
  CHECK(sum.near >= 0.999 * sum.pixels);
  CHECK(sum.same >= 0.995 * sum.compared_ids);
}
