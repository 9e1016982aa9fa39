#include "engine/record/observation.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/model/camera.h"
#include "engine/render/png.h"
#include "tests/support/make_start.h"
#include "tests/support/plain_task.h"

using namespace stampede;
using namespace stampede::plain;

namespace {

// Two cameras: one that stands, one in the hand.
Task seen_task(int) {
  Task task = stack_task(2);
  Scene& scene = task.scene;
  Camera front;
  front.name = "front";
  front.mount_from_camera = looking_at({1.2, 0, 0.6}, {0.35, 0, 0});
  set_field_of_view(front, 0.8, 48, 32);
  Camera wrist = front;
  wrist.name = "wrist";
  wrist.mount_body = scene.robot.name;
  wrist.mount_part = scene.robot.tip_part;
  wrist.mount_from_camera = translation(0.06, 0, 0.02);
  scene.cameras = {front, wrist};
  task.observation.kinds = PictureKinds{true, true, true, false};
  return task;
}

EpisodeRecord run_seen(WhichFrames images, const ObservationChoice& more = {}) {
  PlainSymbols symbols;
  PlainSkills skills;
  RunOptions options;
  options.seed = 3;
  options.observation = more;
  options.observation.images = images;
  return run_episode(seen_task, symbols, skills, options);
}

const EpisodeRecord& seen() {
  static const EpisodeRecord episode = run_seen(WhichFrames::all);
  return episode;
}

std::vector<std::uint8_t> bytes_of(const EpisodeRecord& episode, std::int64_t frame, const std::string& camera,
                                   const std::string& kind) {
  for (std::size_t i = 0; i < episode.images->count(); ++i) {
    const ImageRecord& image = episode.images->record(i);
    if (image.frame == frame && image.kind == kind &&
        episode.scene.cameras[static_cast<std::size_t>(image.camera)].name == camera)
      return episode.images->read(i);
  }
  return {};
}

}  // namespace

TEST_CASE("what was chosen survives as text, and the first choice goes before the other") {
  ObservationChoice first, other;
  first.size = {64, 48};
  first.rgb_noise = 0.1;
  first.cameras = {"front", "wrist"};
  other.size = {10, 10};
  other.images = WhichFrames::keyframes;
  other.kinds = PictureKinds{false, true, false, true};
  other.points = true;
  EpisodeRecord episode;
  episode.made.options = before(first, other).as_text();
  const Observation observation = chosen(observation_of(episode));
  CHECK(observation.width == 64);
  CHECK(observation.height == 48);
  CHECK(observation.noise.rgb == 0.1);
  CHECK(observation.cameras == std::vector<std::string>{"front", "wrist"});
  CHECK(observation.images == WhichFrames::keyframes);
  CHECK((!observation.kinds.rgb && observation.kinds.depth && !observation.kinds.instance));
  CHECK(observation.kinds.semantic);
  CHECK(observation.points);
  CHECK_FALSE(observation.shadows);
  CHECK(ObservationChoice{}.as_text().empty());
}

TEST_CASE("pictures come back whole when they no longer fit in memory") {
  ImageStore store;
  const auto content = [](int i) { return std::vector<std::uint8_t>(static_cast<std::size_t>(700'000 + i), i & 255); };
  for (int i = 0; i < 30; ++i) store.append({i, i % 3, "rgb", 4, 4}, content(i));  // 21 MB
  REQUIRE(store.count() == 30);
  for (const int i : {0, 29, 7, 11, 12, 28}) {
    CHECK(store.record(static_cast<std::size_t>(i)).frame == i);
    CHECK(store.read(static_cast<std::size_t>(i)) == content(i));
  }
  CHECK(store.bytes() == 30 * 700'000 + 29 * 30 / 2);
}

TEST_CASE("every frame has a picture of each camera and wanted kind") {
  const EpisodeRecord& episode = seen();
  REQUIRE(episode.outcome == Outcome::success);
  REQUIRE(episode.images);
  CHECK(episode.images->count() == episode.frames.size() * 2 * 3);
  Picture picture;
  from_png(bytes_of(episode, 0, "front", "rgb"), PictureKind::rgb, picture);
  CHECK(picture.width == 48);
  CHECK(picture.height == 32);
}

TEST_CASE("the moving block moves in the masks, and in the colours too") {
  const EpisodeRecord& episode = seen();
  int number = 0;
  for (const MaskEntry& entry : episode.scene.masks)
    if (entry.object == "cube1") number = entry.instance;
  REQUIRE(number > 0);
  const auto last = static_cast<std::int64_t>(episode.frames.size()) - 1;
  const auto pixels = [&](std::int64_t frame) {
    Picture picture;
    from_png(bytes_of(episode, frame, "front", "instance"), PictureKind::instance, picture);
    std::vector<std::size_t> list;
    for (std::size_t i = 0; i < picture.instance.size(); ++i)
      if (picture.instance[i] == number) list.push_back(i);
    return list;
  };
  CHECK_FALSE(pixels(0).empty());
  CHECK_FALSE(pixels(last).empty());
  CHECK(pixels(0) != pixels(last));
}

TEST_CASE("pictures made later are the same bytes, one camera alone is the same as among others") {
  const EpisodeRecord& episode = seen();
  const auto renderer = make_renderer();
  ObservationChoice alone = observation_of(episode);
  alone.cameras = {"wrist"};
  const Observation observation = chosen(alone);
  EpisodePainter painter(*renderer, episode, std::make_shared<const Scene>(scene_from_document(episode.scene.document)),
                         observation);
  ImageStore later;
  const auto last = static_cast<std::int64_t>(episode.frames.size()) - 1;
  paint_frames(painter, observation, {last, 0, last / 2}, later);
  REQUIRE(later.count() == 9);
  for (std::size_t i = 0; i < later.count(); ++i)
    CHECK(later.read(i) == bytes_of(episode, later.record(i).frame, "wrist", later.record(i).kind));
}

TEST_CASE("keyframe pictures are some of all pictures, and the first, the last and the starts of skills among them") {
  const EpisodeRecord few = run_seen(WhichFrames::keyframes);
  const EpisodeRecord& all = seen();
  REQUIRE(few.images);
  CHECK(few.images->count() < all.images->count() / 2);
  std::vector<std::int64_t> frames;
  for (std::size_t i = 0; i < few.images->count(); ++i) {
    const ImageRecord& image = few.images->record(i);
    frames.push_back(image.frame);
    CHECK(few.images->read(i) ==
          bytes_of(all, image.frame, few.scene.cameras[static_cast<std::size_t>(image.camera)].name, image.kind));
  }
  const auto has = [&](std::int64_t frame) { return std::find(frames.begin(), frames.end(), frame) != frames.end(); };
  CHECK(has(0));
  CHECK(has(static_cast<std::int64_t>(all.frames.size()) - 1));
  for (const SegmentRecord& segment : all.labels.segments)
    if (segment.kind == SegmentKind::skill) CHECK(has(segment.span.first_frame));
}

TEST_CASE("where things are by kinematics is where physics had them") {
  const EpisodeRecord& episode = seen();
  const Scene scene = scene_from_document(episode.scene.document);
  for (const std::size_t frame : {std::size_t{0}, episode.frames.size() / 2, episode.frames.size() - 1}) {
    const ScenePoses poses = scene_poses(scene, state_at(scene, episode, static_cast<std::int64_t>(frame)));
    const FrameRecord& recorded = episode.frames[frame];
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
      const Transform here = world_from_camera(scene, poses, scene.cameras[i]);
      CHECK((here.matrix() - to_transform(recorded.camera_pose[i]).matrix()).cwiseAbs().maxCoeff() < 1e-9);
    }
    for (std::size_t i = 0; i < episode.scene.posed.size(); ++i) {
      const int body = scene.body_index(episode.scene.posed[i]);
      if (body < 0) continue;
      const Transform here = poses.world_from_part[static_cast<std::size_t>(body)][0];
      CHECK((here.matrix() - to_transform(recorded.object_pose[i]).matrix()).cwiseAbs().maxCoeff() < 1e-9);
    }
  }
}

TEST_CASE("noise is the episode's own and repeats") {
  ObservationChoice noisy;
  noisy.rgb_noise = 0.05;
  noisy.cameras = {"front"};
  const EpisodeRecord a = run_seen(WhichFrames::keyframes, noisy), b = run_seen(WhichFrames::keyframes, noisy);
  REQUIRE(a.images->count() == b.images->count());
  CHECK(a.images->read(0) == b.images->read(0));
  CHECK(a.images->read(0) != bytes_of(seen(), 0, "front", "rgb"));
}

TEST_CASE("an unknown camera is named, with the one that was meant") {
  ObservationChoice wrong;
  wrong.cameras = {"frnt"};
  try {
    run_seen(WhichFrames::keyframes, wrong);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find("frnt") != std::string::npos);
    CHECK(error.hint().find("front") != std::string::npos);
  }
}

TEST_CASE("what is randomised is in the stored scene, and the same seed draws the same") {
  const auto start = [](std::int64_t seed) {
    PlainSymbols symbols;
    RunOptions options;
    options.seed = seed;
    options.randomise.emplace();
    options.randomise->dynamics = {"cube1"};
    options.randomise->mass = {2, 3};
    options.randomise->ambient = {0.2, 0.8};
    return make_start(seen_task, symbols, options).scene;
  };
  const auto a = start(3), b = start(3), c = start(4);
  REQUIRE(a);
  REQUIRE(c);
  CHECK(scene_to_document(*a) == scene_to_document(*b));
  CHECK(a->light.ambient != c->light.ambient);
  const double mass = seen_task(0).scene.bodies[static_cast<std::size_t>(a->body_index("cube1"))].parts[0].mass;
  const double drawn = a->bodies[static_cast<std::size_t>(a->body_index("cube1"))].parts[0].mass;
  CHECK(drawn >= 2 * mass);
  CHECK(drawn < 3 * mass);
}
