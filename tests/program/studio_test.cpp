// Pictures for programs: those of the catalogue, as arrays.
#include "scripting/session/studio.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <thread>

#include "db/catalogue.h"
#include "engine/render/png.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

struct Stored {
  Folder folder;
  Catalogue catalogue;
  std::shared_ptr<const EpisodeRecord> episode;
  Stored() : catalogue(make(folder)), episode(std::make_shared<const EpisodeRecord>(catalogue.read_episode(1))) {}
  static Catalogue make(const Folder& folder) {
    REQUIRE(say({"run", "reach_target", "--root", STAMPEDE_SOURCE_DIR, "--out", folder / "d.db", "--images",
                 "keyframes", "--size", "64x48"})
                .code == kDone);
    return Catalogue::open(folder / "d.db");
  }
  Picture picture(std::int64_t frame, const std::string& camera) const {
    Picture picture;
    for (const PictureKind kind : kPictureKinds)
      from_png(catalogue.read_image(1, frame, camera, to_string(kind)), kind, picture);
    return picture;
  }
};

PictureRequest all_kinds(const std::string& camera) {
  return {.camera = camera, .width = 64, .height = 48, .rgb = true, .depth = true, .instance = true, .semantic = true};
}

}  // namespace

TEST_CASE("pictures for programs are those of the catalogue, depth is exact there and rounded here") {
  const Stored stored;
  Studio studio;
  const std::vector<ImageEntry> images = stored.catalogue.images(1);
  std::set<std::pair<std::int64_t, std::string>> moments;
  for (const ImageEntry& image : images) moments.emplace(image.frame, image.camera);
  REQUIRE(moments.size() > 2);
  for (const auto& [frame, camera] : moments) {
    const Picture wanted = stored.picture(frame, camera);
    const CameraPicture drawn = studio.picture(stored.episode, frame, all_kinds(camera));
    CHECK(drawn.rgb == wanted.rgb);
    CHECK(drawn.instance == wanted.instance);
    CHECK(drawn.semantic == wanted.semantic);
    REQUIRE(drawn.depth.size() == wanted.depth.size());
    double worst = 0;
    for (std::size_t i = 0; i < drawn.depth.size(); ++i)
      worst = std::max(worst, static_cast<double>(std::abs(drawn.depth[i] - wanted.depth[i])));
    CHECK(worst <= kDepthUnit / 2 + 1e-6);
  }
}

TEST_CASE("what was not asked for is empty, and points carry what was") {
  const Stored stored;
  Studio studio;
  const CameraPicture picture = studio.picture(stored.episode, 0, {.camera = "front", .width = 32, .height = 32});
  CHECK(picture.rgb.size() == 32 * 32 * 3);
  CHECK((picture.depth.empty() && picture.instance.empty() && picture.semantic.empty()));
  const CameraPoints points =
      studio.points(stored.episode, 0, {.camera = "front", .width = 32, .height = 32, .rgb = false, .instance = true});
  CHECK(points.colours.empty());
  CHECK(points.instance.size() == points.positions.size());
  CHECK_FALSE(points.positions.empty());
}

TEST_CASE("another thread gets the same pixels") {
  const Stored stored;
  Studio studio;
  const CameraPicture here = studio.picture(stored.episode, 0, all_kinds("front"));
  CameraPicture there;
  std::thread([&] { there = studio.picture(stored.episode, 0, all_kinds("front")); }).join();
  CHECK(here.rgb == there.rgb);
  CHECK(here.depth == there.depth);
}

TEST_CASE("unknown frames, cameras and sizes are errors that say so") {
  const Stored stored;
  Studio studio;
  const auto complaint = [&](std::int64_t frame, const PictureRequest& request) {
    try {
      studio.picture(stored.episode, frame, request);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(complaint(100000, {}).find("it has no frame 100000") != std::string::npos);
  CHECK(complaint(-1, {}).find("it has no frame -1") != std::string::npos);
  CHECK(complaint(0, {.camera = "frnt"}).find("did you mean 'front'?") != std::string::npos);
  CHECK_FALSE(complaint(0, {.width = 5000, .height = 10}).empty());
  CHECK_FALSE(complaint(0, {.width = 0, .height = 10}).empty());
  CHECK(complaint(0, {}).empty());  // and it still works
}

}  // namespace stampede::program
