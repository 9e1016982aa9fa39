#include "engine/render/sensor_noise.h"

#include <catch2/catch.hpp>

#include "tests/engine/render/traced.h"

using namespace stampede;

namespace {

constexpr int kSide = 200;
const RandomKey kKey = RandomKey("noise test").with("front").with(3);

Picture flat(std::uint8_t colour, float depth) {
  Picture picture;
  picture.width = picture.height = kSide;
  picture.rgb.assign(3 * kSide * kSide, colour);
  picture.depth.assign(kSide * kSide, depth);
  picture.instance.assign(kSide * kSide, 7);
  return picture;
}

struct Moments {
  double mean = 0, deviation = 0;
};

template <typename Item>
Moments moments(const std::vector<Item>& list) {
  double sum = 0, squares = 0;
  for (const Item& item : list) sum += item;
  const double mean = sum / static_cast<double>(list.size());
  for (const Item& item : list) squares += (item - mean) * (item - mean);
  return {mean, std::sqrt(squares / static_cast<double>(list.size()))};
}

Picture noised(Picture picture, const CameraNoise& noise, RandomKey key = kKey) {
  add_noise(picture, Camera(), noise, key);
  return picture;
}

}  // namespace

TEST_CASE("no noise changes nothing, and ids never change") {
  const Picture picture = flat(100, 1);
  const Picture same = noised(picture, {});
  CHECK(same.rgb == picture.rgb);
  CHECK(same.depth == picture.depth);
  CHECK(noised(picture, {0.1, 0.01}).instance == picture.instance);
}

TEST_CASE("a picture without a kind gets no noise of it") {
  Picture picture = flat(100, 1);
  picture.depth.clear();
  CHECK(noised(picture, {0.05, 0.0015}).depth.empty());
  picture = flat(100, 1);
  picture.rgb.clear();
  CHECK(noised(picture, {0.05, 0.0015}).rgb.empty());
}

TEST_CASE("colour noise has the deviation asked for, no bias, and tails") {
  const auto [mean, deviation] = moments(noised(flat(128, 1), {0.05, 0}).rgb);
  // 120,000 draws: a mean is good to 0.04 and a deviation to 0.03; rounding adds 1/12 to the variance.
  CHECK(mean == Approx(128).margin(0.15));
  CHECK(deviation == Approx(std::sqrt(std::pow(0.05 * 255, 2) + 1.0 / 12)).margin(0.12));
  int beyond = 0;
  for (const std::uint8_t channel : noised(flat(128, 1), {0.05, 0}).rgb) beyond += std::abs(channel - 128) > 2 * 12.75;
  CHECK(beyond / 120000.0 == Approx(0.0455).margin(0.005));  // of a normal distribution beyond 2 deviations
}

TEST_CASE("bright and dark are clipped") {
  const Picture bright = noised(flat(255, 1), {0.1, 0}), dark = noised(flat(0, 1), {0.1, 0});
  int untouched = 0;
  for (std::size_t i = 0; i < bright.rgb.size(); ++i) untouched += (bright.rgb[i] == 255) + (dark.rgb[i] == 0);
  CHECK(untouched / 240000.0 == Approx(0.5).margin(0.02));
}

TEST_CASE("depth noise grows with the square of the distance") {
  for (const float z : {0.5F, 1.0F, 2.0F, 4.0F}) {
    const auto [mean, deviation] = moments(noised(flat(0, z), {0, 0.00145}).depth);
    const double step = 2 * 0.00145 * z * z;
    // The noise and the rounding to its steps: 1/12 of the step's square.
    const double expected = std::sqrt(step * step / 4 + step * step / 12);
    CHECK(deviation == Approx(expected).epsilon(0.06));
    CHECK(mean == Approx(z).margin(0.1 * expected));
  }
}

TEST_CASE("measured depths are whole steps of disparity") {
  for (const float depth : noised(flat(0, 1.3F), {0, 0.00145}).depth) {
    const double steps = 1 / (2 * 0.00145 * double{depth});
    if (std::abs(steps - std::round(steps)) > 1e-4) FAIL(depth << " lies between two steps");
  }
}

TEST_CASE("there is no reading at silhouettes, nor where there was none") {
  Picture picture = flat(0, 2);
  for (int v = 50; v < 150; ++v)
    for (int u = 50; u < 150; ++u) picture.depth[static_cast<std::size_t>(v * kSide + u)] = 1;
  for (int u = 0; u < kSide; ++u) picture.depth[static_cast<std::size_t>(u)] = 0;
  const Picture seen = noised(picture, {0, 0.001});
  const auto at = [&](int u, int v) { return seen.depth[static_cast<std::size_t>(v * kSide + u)]; };
  for (const int u : {49, 50, 149, 150}) CHECK(at(u, 100) == 0);
  for (const int u : {48, 51, 148, 151}) CHECK(at(u, 100) > 0);
  CHECK(at(100, 0) == 0);
  CHECK(at(100, 1) == 0);
  CHECK(at(100, 2) > 0);
}

TEST_CASE("there is no reading from surfaces seen at a grazing angle") {
  for (const double degrees : {75.0, 78.0, 82.0, 85.0}) {
    const double slope = std::tan(degrees / 180 * std::numbers::pi);
    Picture picture;
    picture.width = 3, picture.height = 1;
    for (const double x_over_z : {-0.001, 0.0, 0.001})  // the plane z = 1 + slope x
      picture.depth.push_back(static_cast<float>(1 / (1 - slope * x_over_z)));
    Camera camera;
    camera.focal_x = 1000;
    add_noise(picture, camera, {0, 1e-5}, kKey);
    CHECK((picture.depth[1] > 0) == (degrees < 80));
  }
}

TEST_CASE("noise is a function of key and pixel: one kind does not move the other") {
  const Picture picture = TracedScene().draw(TracedScene::view(0));
  const Picture both = noised(picture, {0.02, 0.00145});
  CHECK(noised(picture, {0.02, 0.00145}).rgb == both.rgb);
  CHECK(noised(picture, {0.02, 0}).rgb == both.rgb);
  CHECK(noised(picture, {0, 0.00145}).depth == both.depth);
  CHECK(noised(picture, {0.02, 0}, kKey.with(1)).rgb != both.rgb);
  Picture brighter = picture;  // another pixel's value moves nothing here
  brighter.depth[0] = 3;
  const Picture other = noised(brighter, {0, 0.00145});
  for (std::size_t i = 300; i < other.depth.size(); ++i)
    if (other.depth[i] != both.depth[i]) FAIL("pixel " << i << " moved");
}
