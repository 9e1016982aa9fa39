// Pictures stored with their episode or after it.
#include <catch2/catch.hpp>

#include "engine/model/camera.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

EpisodeRecord episode() { return sample_episode("lift", "colour=red", 7); }

std::vector<CameraTrack> tracks(const EpisodeRecord& e) {
  std::vector<CameraTrack> list;
  for (const Camera& camera : e.scene.cameras) list.push_back({camera, {}});
  return list;
}

const std::vector<std::int64_t> kFrames{0, 6, 11};

QueryResult image_rows(const Catalogue& catalogue) {
  return catalogue.query("SELECT episode, frame, camera, kind, width, height, data FROM image ORDER BY 1, 2, 3, 4");
}

}  // namespace

TEST_CASE("pictures stored with an episode come back byte by byte") {
  const Folder folder;
  EpisodeRecord e = episode();
  const auto images = sample_images(e, kFrames);
  e.images = images;
  Catalogue writer = Catalogue::write(folder / "a.db");
  REQUIRE(writer.add(e, kEngine) == 1);
  writer.close();
  const Catalogue catalogue = Catalogue::open(folder / "a.db");
  const auto list = catalogue.images(1);
  REQUIRE(list.size() == 3 * 2 * 3);
  REQUIRE(images->count() == list.size());
  for (std::size_t i = 0; i < images->count(); ++i) {
    const ImageRecord& image = images->record(i);
    const std::string name = e.scene.cameras[static_cast<std::size_t>(image.camera)].name;
    CHECK(catalogue.read_image(1, image.frame, name, image.kind) == images->read(i));
    const ImageEntry entry{image.frame, name, image.kind, image.width, image.height, 600};
    CHECK(std::count(list.begin(), list.end(), entry) == 1);
  }
  CHECK(list.front() == ImageEntry{0, "front", "depth", 128, 128, 600});
  CHECK(catalogue.read_episode(1).images == nullptr);
  CHECK_THROWS_WITH(catalogue.read_image(1, 1, "front", "rgb"),
                    Contains("no picture of frame 1") && Contains("render"));
  CHECK_THROWS_WITH(catalogue.images(2), Contains("no episode 2"));
}

TEST_CASE("rendered later equals rendered at once, row by row, and a second time changes nothing") {
  const Folder folder;
  EpisodeRecord e = episode();
  Catalogue later = Catalogue::write(folder / "later.db"), at_once = Catalogue::write(folder / "at_once.db");
  later.add(e, kEngine);
  const auto images = sample_images(e, kFrames);
  CHECK(later.content_hash() != "");
  const AddedImages first = later.add_images(1, *images, tracks(e));
  CHECK(first.added == static_cast<std::int64_t>(images->count()));
  CHECK(first.skipped == 0);
  e.images = images;
  at_once.add(e, kEngine);
  CHECK(image_rows(later).rows == image_rows(at_once).rows);
  CHECK(later.content_hash() == at_once.content_hash());  // the options were the same here
  const AddedImages again = later.add_images(1, *images, tracks(e));
  CHECK(again.added == 0);
  CHECK(again.skipped == first.added);
  CHECK(later.content_hash() == at_once.content_hash());
  const auto more = sample_images(e, {0, 3}, {"rgb", "semantic"});
  const AddedImages third = later.add_images(1, *more, tracks(e));
  CHECK(third.skipped == 2);        // frame 0, rgb, two cameras
  CHECK(third.added == 2 * 4 - 2);  // the rest of them
}

TEST_CASE("the content hash sees every byte of a picture and every mask") {
  const Folder folder;
  const auto hash_of = [&](const std::string& name, auto change) {
    EpisodeRecord e = episode();
    e.images = sample_images(e, kFrames);
    change(e);
    Catalogue catalogue = Catalogue::write(folder / name);
    catalogue.add(e, kEngine);
    return catalogue.content_hash();
  };
  const std::string plain = hash_of("a.db", [](EpisodeRecord&) {});
  CHECK(plain == hash_of("b.db", [](EpisodeRecord&) {}));
  CHECK(plain != hash_of("c.db", [](EpisodeRecord& e) { e.scene.masks[3].semantic = 2; }));
  CHECK(plain != hash_of("d.db", [](EpisodeRecord& e) { e.images = nullptr; }));
  CHECK(plain != hash_of("e.db", [](EpisodeRecord& e) {
          auto other = std::make_shared<ImageStore>();
          for (std::size_t i = 0; i < e.images->count(); ++i) {
            auto bytes = e.images->read(i);
            if (i == 4) bytes.back() ^= 1;
            other->append(e.images->record(i), bytes);
          }
          e.images = other;
        }));
}

TEST_CASE("other bytes where a picture is stored are refused, and the rest of them too") {
  const Folder folder;
  const EpisodeRecord e = episode();
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(e, kEngine);
  catalogue.add_images(1, *sample_images(e, {6}), tracks(e));
  const std::string before = catalogue.content_hash();
  const auto other = sample_images(e, {0, 6}, {"rgb"}, 601);  // frame 0 is new, frame 6 differs
  CHECK_THROWS_WITH(catalogue.add_images(1, *other, tracks(e)),
                    Contains("episode 1, frame 6, camera front, kind rgb") && Contains("into a folder"));
  CHECK(catalogue.content_hash() == before);
  CHECK_NOTHROW(catalogue.add_images(1, *sample_images(e, {0, 6}), tracks(e)));  // the statements are usable again
}

TEST_CASE("a camera that the episode does not have comes with its poses") {
  const Folder folder;
  const EpisodeRecord e = episode();
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(e, kEngine);
  Camera side;
  side.name = "side";
  set_field_of_view(side, 1.0, 64, 48);
  std::vector<CameraTrack> list = tracks(e);
  list.push_back({side, {}});
  ImageStore images;
  images.append({5, 2, "rgb", 64, 48}, {1, 2, 3});
  const std::string before = catalogue.content_hash();
  CHECK_THROWS_WITH(catalogue.add_images(1, images, list), Contains("pose at each of the 12 frames"));
  CHECK(catalogue.content_hash() == before);
  list.back().world_from_camera.assign(12, Pose{{1, 2, 3}, {0, 0, 0, 1}});
  list.back().world_from_camera[11].position[0] = 4;
  CHECK(catalogue.add_images(1, images, list).added == 1);
  CHECK(catalogue.read_image(1, 5, "side", "rgb") == std::vector<std::uint8_t>{1, 2, 3});
  const EpisodeRecord b = catalogue.read_episode(1);
  REQUIRE(b.scene.cameras.size() == 3);
  CHECK(b.scene.cameras[2].name == "side");
  CHECK(b.frames[10].camera_pose[2] == list.back().world_from_camera[10]);
  CHECK(b.frames[11].camera_pose[2] == list.back().world_from_camera[11]);
  CHECK(b.frames[4].camera_pose[1] == e.frames[4].camera_pose[1]);
  list.back().world_from_camera.clear();  // now it has it
  ImageStore next;
  next.append({6, 2, "rgb", 64, 48}, {4});
  CHECK(catalogue.add_images(1, next, list).added == 1);
  CHECK(catalogue.query("SELECT * FROM camera_pose WHERE camera = 2").rows.size() == 2);  // written once
}

TEST_CASE("a camera of a known name must be that camera, at any size") {
  const Folder folder;
  const EpisodeRecord e = episode();
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(e, kEngine);
  const auto add = [&](const Camera& camera) {
    ImageStore images;
    images.append({0, 0, "rgb", camera.width, camera.height}, {9});
    return catalogue.add_images(1, images, {{camera, {}}}).added;
  };
  const Camera& wrist = e.scene.cameras[1];
  CHECK(add(resized(wrist, 512, 256)) == 1);
  const auto refused = [&](auto change, const std::string& what) {
    Camera other = wrist;
    change(other);
    CHECK_THROWS_WITH(add(other), Contains("another camera of this name: " + what) && Contains("name of its own"));
  };
  refused([](Camera& c) { c.focal_x *= 1.001; }, "its focal length");
  refused([](Camera& c) { c.centre_y += 0.01; }, "its principal point");
  refused([](Camera& c) { c.distortion[4] = 0; }, "its lens");
  refused([](Camera& c) { c.mount_body.clear(); }, "its mount");
  refused([](Camera& c) { c.mount_from_camera.translation().x() += 1e-4; }, "where it is mounted");
  refused([](Camera& c) { c.far_m = 9; }, "its near or far plane");
  CHECK(catalogue.images(1).size() == 1);
}

TEST_CASE("pictures of what is not there are refused") {
  const Folder folder;
  EpisodeRecord e = episode();
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const auto refused = [&](const ImageRecord& image, const std::string& complaint) {
    const auto store = std::make_shared<ImageStore>();
    store->append(image, {1});
    EpisodeRecord with = e;
    with.images = store;
    CHECK_THROWS_WITH(catalogue.add(with, kEngine), Contains(complaint));
  };
  refused({12, 0, "rgb", 4, 4}, "frame 12");
  refused({-1, 0, "rgb", 4, 4}, "frame -1");
  refused({0, 2, "rgb", 4, 4}, "camera number 2");
  refused({0, 0, "flow", 4, 4}, "unknown kind 'flow'");
  refused({0, 0, "rgb", 0, 4}, "no size");
  const auto twice = std::make_shared<ImageStore>();
  for (int i = 0; i < 2; ++i) twice->append({0, 0, "rgb", 4, 4}, {1});
  EpisodeRecord with = e;
  with.images = twice;
  CHECK_THROWS_AS(catalogue.add(with, kEngine), CatalogueError);
  EpisodeRecord ambiguous = e;
  ambiguous.scene.masks[1].instance = ambiguous.scene.masks[0].instance;
  CHECK_THROWS_WITH(catalogue.add(ambiguous, kEngine), Contains("mask of panda.link1"));
  CHECK(catalogue.episodes().empty());
  catalogue.add(e, kEngine);
  ImageStore late;
  late.append({12, 0, "rgb", 4, 4}, {1});
  CHECK_THROWS_WITH(catalogue.add_images(1, late, tracks(e)), Contains("frame 12"));
  CHECK_THROWS_WITH(catalogue.add_images(3, late, tracks(e)), Contains("no episode 3"));
}
