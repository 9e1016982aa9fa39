// Pictures on their way into a store: the same bytes in the same order for any number of encoders.
#include "engine/record/encode_queue.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"

using namespace stampede;

namespace {

constexpr int kWidth = 40, kHeight = 30;

// Those of every third frame are those of the frame before.
Picture picture_of(std::int64_t frame, int camera) {
  Random random(RandomKey("encode queue").with(frame - (frame % 3 == 2 ? 1 : 0)).with(std::int64_t{camera}));
  Picture picture;
  picture.width = kWidth;
  picture.height = kHeight;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    for (int k = 0; k < 3; ++k) picture.rgb.push_back(static_cast<std::uint8_t>(random.below(8)));
    picture.depth.push_back(static_cast<float>(random.between(0, 2)));
    picture.instance.push_back(static_cast<std::uint16_t>(random.below(5)));
    picture.semantic.push_back(static_cast<std::uint16_t>(random.below(3)));
  }
  return picture;
}

void fill_store(ImageStore& store, int encoders, int frames) {
  Observation observation;
  observation.points = true;
  const std::vector<int> cameras{0, 3};
  View view;
  view.camera.width = kWidth;
  view.camera.height = kHeight;
  EncodeQueue queue(observation, cameras, store, encoders);
  std::vector<Picture> pictures;
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    pictures.resize(2);
    for (int camera = 0; camera < 2; ++camera) pictures[static_cast<std::size_t>(camera)] = picture_of(frame, camera);
    queue.add(frame, pictures, {view, view});
  }
  queue.finish();
}

}  // namespace

TEST_CASE("the same bytes in the same order for any number of encoders, and for pictures that do not change") {
  constexpr int kFrames = 25;
  ImageStore alone;
  fill_store(alone, 0, kFrames);
  REQUIRE(alone.count() == kFrames * 2 * 5);
  std::size_t place = 0;
  for (std::int64_t frame = 0; frame < kFrames; ++frame)
    for (const int camera : {0, 1}) {
      const Picture picture = picture_of(frame, camera);
      for (const PictureKind kind : kPictureKinds) {
        const ImageRecord& record = alone.record(place);
        CHECK(record.frame == frame);
        CHECK(record.camera == 3 * camera);
        CHECK(record.kind == to_string(kind));
        CHECK(record.visible == (kind == PictureKind::instance ? visible_pixels(picture) : decltype(record.visible){}));
        CHECK(alone.read(place++) == to_png(picture, kind));
      }
      CHECK(alone.record(place++).kind == "points");
    }
  for (const int encoders : {1, 2, 5}) {
    ImageStore store;
    fill_store(store, encoders, kFrames);
    REQUIRE(store.count() == alone.count());
    for (std::size_t i = 0; i < store.count(); ++i) {
      CHECK(store.record(i).kind == alone.record(i).kind);
      CHECK(store.read(i) == alone.read(i));
    }
  }
}

TEST_CASE("what an encoder refuses reaches whoever added it, with what came before in the store") {
  for (const int encoders : {0, 1, 2}) {
    const Observation observation;
    const std::vector<int> cameras{0};
    ImageStore store;
    EncodeQueue queue(observation, cameras, store, encoders);
    std::vector<Picture> pictures{picture_of(0, 0)};
    queue.add(0, pictures, {});
    pictures.assign(1, picture_of(1, 0));
    pictures[0].depth.clear();
    const auto add_and_finish = [&] {
      queue.add(1, pictures, {});
      queue.finish();
    };
    CHECK_THROWS_AS(add_and_finish(), Error);
    CHECK(store.count() == 4);
  }
}
