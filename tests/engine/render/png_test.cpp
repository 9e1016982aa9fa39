#include "engine/render/png.h"

#include <catch2/catch.hpp>
#include <thread>

#include "engine/base/error.h"
#include "tests/engine/render/traced.h"

using namespace stampede;

namespace {

Picture noisy(int width, int height) {
  Random random(RandomKey("noisy picture").with(width));
  Picture picture{width, height, {}, {}, {}, {}};
  for (int i = 0; i < width * height; ++i) {
    for (int k = 0; k < 3; ++k) picture.rgb.push_back(static_cast<std::uint8_t>(random.below(256)));
    picture.depth.push_back(static_cast<float>(random.between(0.01, 6.55)));
    picture.instance.push_back(static_cast<std::uint16_t>(random.below(65536)));
    picture.semantic.push_back(static_cast<std::uint16_t>(random.below(65536)));
  }
  return picture;
}

std::string complaint(const Bytes& png, PictureKind kind) {
  try {
    Picture picture;
    from_png(png, kind, picture);
  } catch (const Error& error) {
    return error.message();
  }
  return "accepted";
}

Bytes depth_png(std::vector<float> depth) {
  Picture picture;
  picture.width = static_cast<int>(depth.size());
  picture.height = 1;
  picture.depth = std::move(depth);
  return to_png(picture, PictureKind::depth);
}

// As an image editor would write it: with the gamma of sRGB (and its checksum).
Bytes with_gamma(const Bytes& png) {
  const Bytes gamma{0, 0, 0, 4, 'g', 'A', 'M', 'A', 0, 0, 0xb1, 0x8f, 0x0b, 0xfc, 0x61, 0x05};
  Bytes result(png.begin(), png.begin() + 33);
  result.insert(result.end(), gamma.begin(), gamma.end());
  result.insert(result.end(), png.begin() + 33, png.end());
  return result;
}

}  // namespace

TEST_CASE("a reader of PNG files gets back what was written, for sizes of every kind") {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {5, 1}, {3, 2}, {64, 48}, {131, 77}}) {
    const Picture picture = noisy(width, height);
    Picture back;
    for (const PictureKind kind : kPictureKinds) from_png(to_png(picture, kind), kind, back);
    CHECK(back.width == width);
    CHECK(back.height == height);
    CHECK(back.rgb == picture.rgb);
    CHECK(back.instance == picture.instance);
    CHECK(back.semantic == picture.semantic);
    REQUIRE(back.depth.size() == picture.depth.size());
    double worst = 0;
    for (std::size_t i = 0; i < back.depth.size(); ++i)
      worst = std::max(worst, std::abs(double{back.depth[i]} - double{picture.depth[i]}));
    CHECK(worst <= kDepthUnit / 2 + 1e-6);  // half a unit, and a float's own rounding
  }
}

TEST_CASE("depth is rounded to 0.1 mm, and what 16 bits cannot hold is no reading") {
  Picture back;
  from_png(depth_png({1.0F, 1.00004F, 1.00006F, 6.5535F, 6.5537F, 0.0F, -1.0F, NAN, INFINITY}), PictureKind::depth,
           back);
  const std::vector<float> expected{1.0F, 1.0F, 1.0001F, 6.5535F, 0, 0, 0, 0, 0};
  REQUIRE(back.depth.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(back.depth[i] == Approx(expected[i]).epsilon(1e-7));
  const Bytes png = depth_png(back.depth);
  Picture again;
  from_png(png, PictureKind::depth, again);
  CHECK(again.depth == back.depth);  // once rounded, it stays
}

TEST_CASE("the same pixels give the same bytes, in any thread and after any other picture") {
  const Picture picture = TracedScene().draw(TracedScene::view(1));
  for (const PictureKind kind : kPictureKinds) {
    const Bytes png = to_png(picture, kind);
    (void)to_png(noisy(200, 3), kind);
    CHECK(to_png(picture, kind) == png);
    Bytes other;
    std::thread([&] { other = to_png(picture, kind); }).join();
    CHECK(other == png);
  }
}

TEST_CASE("the twenty pictures of a frame take less than 64 kB") {
  std::size_t total = 0;
  for (int camera = 0; camera < 5; ++camera) {
    const Picture picture = TracedScene().draw(TracedScene::view(camera));
    for (const PictureKind kind : kPictureKinds) total += to_png(picture, kind).size();
  }
  CHECK(total < 64000);
  CHECK(total > 10000);  // there was something to see
}

TEST_CASE("the gamma that another program wrote changes neither depths nor ids") {
  const Picture picture = noisy(8, 8);
  for (const PictureKind kind : {PictureKind::depth, PictureKind::instance}) {
    Picture plain, marked;
    from_png(to_png(picture, kind), kind, plain);
    from_png(with_gamma(to_png(picture, kind)), kind, marked);
    CHECK(marked.depth == plain.depth);
    CHECK(marked.instance == plain.instance);
  }
}

TEST_CASE("broken PNG files are errors, and leave the picture as it was") {
  using Catch::Contains;
  const Picture picture = noisy(40, 30);
  const Bytes png = to_png(picture, PictureKind::instance);
  CHECK_THAT(complaint({}, PictureKind::rgb), Contains("no header"));
  CHECK_THAT(complaint(Bytes(100, 'x'), PictureKind::rgb), Contains("no header"));
  for (std::size_t size = 0; size < png.size(); size += 13)
    CHECK(complaint(Bytes(png.begin(), png.begin() + static_cast<std::ptrdiff_t>(size)), PictureKind::instance) !=
          "accepted");
  for (const std::size_t at : {std::size_t{18}, std::size_t{50}, png.size() / 2, png.size() - 14}) {
    Bytes damaged = png;
    damaged[at] ^= 0x15;
    INFO("byte " << at);
    CHECK(complaint(damaged, PictureKind::instance) != "accepted");
  }
  CHECK_THAT(complaint(to_png(picture, PictureKind::rgb), PictureKind::depth), Contains("16 bits"));
  Picture kept = picture;
  CHECK_THROWS_AS(from_png(to_png(picture, PictureKind::rgb), PictureKind::depth, kept), Error);
  CHECK(kept.depth == picture.depth);
}

TEST_CASE("kinds that a picture does not have are errors") {
  Picture picture;
  picture.width = picture.height = 4;
  for (const PictureKind kind : kPictureKinds) CHECK_THROWS_AS(to_png(picture, kind), Error);
  CHECK_THROWS_AS(png_of(0, 0, {}), Error);
  CHECK_THROWS_AS(png_of(2, 2, std::vector<std::uint8_t>(11)), Error);
}
