// Which camera shows what, and when: a drawer between two cameras, one of which sees the chest's back.
#include <catch2/catch.hpp>

#include "engine/model/camera.h"
#include "scripting/commands/render_shots.h"

namespace stampede::program {
namespace {

constexpr int kFrames = 30, kOpens = 10, kOpen = 15;  // frames of the drawer's way

Shape box_at(const Vector3& size, const Vector3& at) {
  Shape shape;
  shape.size = size;
  shape.part_from_shape = translation(at.x(), at.y(), at.z());
  return shape;
}

// Its drawer comes out towards -x; the rest is closed.
Body chest() {
  Body body;
  body.name = "chest";
  body.parts.resize(2);
  body.parts[0].name = "chest";
  body.parts[0].shapes = {box_at({0.22, 0.26, 0.01}, {0, 0, 0}), box_at({0.22, 0.26, 0.01}, {0, 0, 0.1}),
                          box_at({0.22, 0.01, 0.1}, {0, 0.13, 0.05}), box_at({0.22, 0.01, 0.1}, {0, -0.13, 0.05}),
                          box_at({0.01, 0.26, 0.1}, {0.11, 0, 0.05})};
  Part& drawer = body.parts[1];
  drawer.name = "drawer";
  drawer.parent = 0;
  drawer.joint.kind = JointKind::slider;
  drawer.joint.axis = {-1, 0, 0};
  drawer.joint.upper = 0.2;
  drawer.shapes = {box_at({0.01, 0.24, 0.08}, {-0.11, 0, 0.05})};
  return body;
}

Camera camera(const std::string& name, double x) {
  Camera result;
  result.name = name;
  result.mount_from_camera = looking_at({x, 0, 0.4}, {0, 0, 0});
  set_field_of_view(result, 0.7, 64, 64);
  return result;
}

std::shared_ptr<const Scene> scene() {
  Scene scene;
  scene.bodies = {chest()};
  Body cube;
  cube.name = "cube";
  cube.free = true;
  cube.parts.resize(1);
  cube.parts[0].shapes = {box_at({0.04, 0.04, 0.04}, {0, 0, 0})};
  cube.world_from_body = translation(0.25, 0, 0.02);  // behind the chest
  scene.bodies.push_back(cube);
  scene.cameras = {camera("behind", 1.2), camera("before", -1.2)};
  scene.robot.body.parts.resize(1);
  const auto add = [&](const char* name, ObjectKind kind, const char* body, int part) {
    Object& object = scene.objects.emplace_back();
    object.name = name;
    object.kind = kind;
    object.class_name = object.type = body;
    object.body = body;
    object.part = part;
  };
  add("chest", ObjectKind::body, "chest", 0);
  add("chest.drawer", ObjectKind::part, "chest", 1);
  add("cube", ObjectKind::body, "cube", 0);
  number_masks(scene, RandomKey("shots"));
  return std::make_shared<const Scene>(std::move(scene));
}

// The drawer is shut until frame kOpens and open from kOpen on; then nothing moves.
EpisodeRecord episode() {
  EpisodeRecord record;
  record.scene.joints = {{"chest.drawer", {0, 1}, "slider", "m", 0, 0.2, false}};
  record.scene.posed = {"cube"};
  for (int i = 0; i < kFrames; ++i) {
    FrameRecord& frame = record.frames.emplace_back();
    frame.joint_position = {0.2 * std::clamp(double(i - kOpens) / (kOpen - kOpens), 0.0, 1.0)};
    frame.object_pose = {to_pose(translation(0.25, 0, 0.02))};
  }
  return record;
}

void add_skill(EpisodeRecord& record, std::int64_t first, std::int64_t end, const char* thing, int parent = -1) {
  SegmentRecord& segment = record.labels.segments.emplace_back();
  segment.kind = SegmentKind::skill;
  segment.ordinal = static_cast<int>(record.labels.segments.size()) - 1;
  segment.parent = parent;
  segment.arguments = {thing};
  segment.span.first_frame = first;
  segment.span.end_frame = end;
}

std::vector<std::string> cameras_of(const std::vector<Shot>& shots, const Scene& in) {
  std::vector<std::string> names;
  for (const Shot& shot : shots) names.push_back(in.cameras[shot.camera].name);
  return names;
}

}  // namespace

TEST_CASE("a drawer whose front faces away from the usual camera is shown by the other one") {
  const auto here = scene();
  EpisodeRecord record = episode();
  add_skill(record, 2, 20, "chest.drawer");
  add_skill(record, 20, 28, "cube");
  std::vector<Shot> shots = shots_of(record, *here);
  const auto renderer = make_renderer();
  for (const std::size_t usual : {0u, 1u}) {
    choose_cameras(*renderer, {0, record, here, {}}, {"behind", "before"}, usual, shots);
    CHECK(cameras_of(shots, *here) == std::vector<std::string>{"before", "behind"});
  }
}

TEST_CASE("a camera that sees about as much as the best one stays") {
  Scene changed = *scene();
  changed.cameras = {camera("one", 1.2), camera("two", 1.1)};  // two is a little nearer
  const auto here = std::make_shared<const Scene>(changed);
  EpisodeRecord record = episode();
  add_skill(record, 0, 30, "cube");
  std::vector<Shot> shots = shots_of(record, *here);
  const auto renderer = make_renderer();
  for (const std::size_t usual : {0u, 1u}) {
    choose_cameras(*renderer, {0, record, here, {}}, {"one", "two"}, usual, shots);
    CHECK(shots.front().camera == usual);
  }
}

TEST_CASE("shots follow each other without gaps, inner skills among them, and tell when their things move") {
  const auto here = scene();
  EpisodeRecord record = episode();
  add_skill(record, 2, 20, "chest.drawer");
  add_skill(record, 4, 8, "cube", 0);
  add_skill(record, 22, 28, "cube");
  const std::vector<Shot> shots = shots_of(record, *here);
  REQUIRE(shots.size() == 2);
  CHECK(shots[0].first_frame == 0);
  CHECK(shots[0].end_frame == shots[1].first_frame);
  CHECK(shots[1].first_frame == 22);
  CHECK(shots[1].end_frame == kFrames);
  CHECK(shots[0].telling_frame == (kOpens + kOpen + 1) / 2);  // half open
  CHECK(shots[1].telling_frame == 25);                        // nothing moves: the middle of the skill
}

TEST_CASE("the frame that tells of a skill is the one in which its effect comes true") {
  EpisodeRecord record = episode();
  add_skill(record, 2, 20, "chest.drawer");
  const Fact open{"open", {"chest.drawer"}}, closed{"closed", {"chest.drawer"}};
  record.labels.segments.front().declared_effects = {{open, false}, {closed, true}};
  FactRecord before, after;
  before.fact = open, before.first_frame = 0, before.end_frame = 1;  // not this one
  after.fact = open, after.first_frame = kOpen - 1, after.end_frame = kFrames;
  record.labels.facts = {before, after};
  CHECK(shots_of(record, *scene()).front().telling_frame == kOpen - 1);
}

TEST_CASE("what turns in its place moves") {
  Scene turning = *scene();
  turning.bodies[0].parts[1].joint.kind = JointKind::hinge;
  turning.bodies[0].parts[1].joint.axis = {0, 0, 1};
  turning.bodies[0].parts[1].shapes = {box_at({0.04, 0.04, 0.08}, {0, 0, 0.05})};  // about its own middle
  EpisodeRecord record = episode();
  record.scene.joints = {{"chest.drawer", {0, 1}, "hinge", "rad", 0, 2, false}};
  for (FrameRecord& frame : record.frames) frame.joint_position = {10 * frame.joint_position[0]};
  add_skill(record, 0, kFrames, "chest.drawer");
  CHECK(shots_of(record, turning).front().telling_frame == (kOpens + kOpen + 1) / 2);
}

TEST_CASE("an episode without skills is one shot of all that can move") {
  const std::vector<Shot> shots = shots_of(episode(), *scene());
  REQUIRE(shots.size() == 1);
  CHECK(shots[0].skill == nullptr);
  CHECK(shots[0].things == std::vector<std::string>{"cube"});
  CHECK(shots[0].end_frame == kFrames);
}

}  // namespace stampede::program
