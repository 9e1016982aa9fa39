#include "engine/render/point_cloud.h"

#include <catch2/catch.hpp>
#include <cstring>

#include "engine/base/error.h"
#include "tests/engine/render/traced.h"

using namespace stampede;

namespace {

template <typename Number>
Number take(const std::string& bytes, std::size_t& at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  at += sizeof number;
  return number;
}

}  // namespace

TEST_CASE("points lie on the surfaces that were seen, from every camera") {
  PointCloud all;
  for (int camera = 0; camera < 4; ++camera) {
    const View view = TracedScene::view(camera);
    append(all, point_cloud(TracedScene().draw(view), view));
  }
  REQUIRE(all.instance.size() == all.positions.size());
  REQUIRE(all.colours.size() == all.positions.size());
  int on_floor = 0, on_table = 0;
  for (std::size_t i = 0; i < all.positions.size(); ++i) {
    const auto [x, y, z] = all.positions[i];
    if (all.instance[i] == 11) {
      ++on_floor;
      CHECK(z == Approx(0).margin(1e-5));
    }
    if (all.instance[i] != 12) continue;  // the table: 0.8 x 1.2 x 0.1 around (0.35, 0, 0.7)
    ++on_table;
    const double reach = std::max({std::abs(x - 0.35) / 0.4, std::abs(y) / 0.6, std::abs(z - 0.7) / 0.05});
    CHECK(reach == Approx(1).margin(1e-4));
  }
  CHECK(on_floor > 1000);
  CHECK(on_table > 1000);
}

TEST_CASE("a point's pixel is where the lens puts it, whatever its distortion") {
  View view = TracedScene::view(2, 61, 47);
  view.camera.focal_y *= 1.1;
  view.camera.centre_x -= 3;
  view.camera.distortion = {-0.2, 0.05, 0.003, -0.002, 0.01};
  Picture picture;
  picture.width = 61;
  picture.height = 47;
  for (int i = 0; i < 61 * 47; ++i) picture.depth.push_back(0.5F + 0.001F * static_cast<float>(i));
  const PointCloud cloud = point_cloud(picture, view);
  REQUIRE(cloud.positions.size() == picture.depth.size());
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const auto& p = cloud.positions[i];
    const Vector3 seen = view.world_from_camera.inverse() * Vector3(p[0], p[1], p[2]);
    const auto [u, v] = project(view.camera, seen);
    CHECK(seen.z() == Approx(picture.depth[i]).epsilon(1e-5));
    CHECK(u == Approx(static_cast<double>(i % 61) + 0.5).margin(1e-3));
    CHECK(v == Approx(static_cast<double>(i / 61) + 0.5).margin(1e-3));
  }
}

TEST_CASE("pixels without depth give no points, kinds that were not drawn stay empty") {
  Picture picture;
  picture.width = picture.height = 2;
  picture.depth = {0, 1, 0, 2};
  picture.semantic = {5, 6, 7, 8};
  const PointCloud cloud = point_cloud(picture, TracedScene::view(0, 2, 2));
  CHECK(cloud.positions.size() == 2);
  CHECK(cloud.semantic == std::vector<std::uint16_t>{6, 8});
  CHECK(cloud.colours.empty());
  CHECK(cloud.instance.empty());
  picture.depth.clear();
  CHECK_THROWS_AS(point_cloud(picture, View()), Error);
}

TEST_CASE("clouds with and without colours do not mix") {
  PointCloud plain{{{1, 2, 3}}, {}, {}, {}}, coloured{{{1, 2, 3}}, {{1, 2, 3}}, {}, {}}, none;
  CHECK_THROWS_AS(append(plain, coloured), Error);
  CHECK(plain.positions.size() == 1);
  append(plain, none);
  append(none, coloured);
  CHECK(none.colours.size() == 1);
}

TEST_CASE("a PLY file says what its bytes are") {
  const PointCloud cloud{{{1.5F, -2, 3}, {4, 5, 6}}, {{10, 20, 255}, {1, 2, 3}}, {7, 65535}, {3, 300}};
  const std::string ply = to_ply(cloud);
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment world frame, metres\nelement vertex 2\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property ushort instance\nproperty ushort semantic\nend_header\n";
  REQUIRE(ply.substr(0, header.size()) == header);
  REQUIRE(ply.size() == header.size() + 2 * 19);
  std::size_t at = header.size();
  for (std::size_t i = 0; i < 2; ++i) {
    for (const float coordinate : cloud.positions[i]) CHECK(take<float>(ply, at) == coordinate);
    for (const std::uint8_t channel : cloud.colours[i]) CHECK(take<std::uint8_t>(ply, at) == channel);
    CHECK(take<std::uint16_t>(ply, at) == cloud.instance[i]);
    CHECK(take<std::uint16_t>(ply, at) == cloud.semantic[i]);
  }
  CHECK(to_ply(PointCloud{{{1, 2, 3}}, {}, {}, {}}).find("uchar") == std::string::npos);
}
