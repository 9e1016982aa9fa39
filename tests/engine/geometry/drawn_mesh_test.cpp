#include "engine/geometry/drawn_mesh.h"

#include <cmath>
#include <numbers>

#include "tests/engine/geometry/mesh_files.h"

using namespace stampede;
using Catch::Contains;

namespace {

const std::string kCube =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

Vector3 vector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

Vector3 face_normal(const DrawnMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vector3 at = vector(mesh.positions[a]);
  return (vector(mesh.positions[b]) - at).cross(vector(mesh.positions[c]) - at).normalized();
}

void check_flat_shading(const DrawnMesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t corner : mesh.triangles[i])
      CHECK((vector(mesh.normals[corner]) - face_normal(mesh, i)).norm() < 1e-5);
}

// A tube of `sides` plates without ends, of radius 1 and height 1, as STL: facets only.
std::string tube_stl(int sides) {
  std::string text = "solid tube\n";
  const auto vertex = [&](int i, int z) {
    const double angle = 2 * std::numbers::pi * (i % sides) / sides;
    text += "vertex " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " " +
            std::to_string(z) + "\n";
  };
  for (int i = 0; i < sides; ++i)
    for (const bool upper : {false, true}) {
      text += "facet normal 1 0 0\nouter loop\n";
      vertex(i + upper, 0), vertex(i + 1, upper), vertex(i, 1);
      text += "endloop\nendfacet\n";
    }
  return text + "endsolid tube\n";
}

std::string number32(std::size_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

std::string padded(std::string bytes, char with) {
  while (bytes.size() % 4 != 0) bytes += with;
  return bytes;
}

template <typename Item>
std::string raw(const std::vector<Item>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item)};
}

// One triangle in the plane z = 0 with a picture inside the file; its node turns by 90 degrees about z and moves by 5.
std::string glb(const std::string& picture) {
  const std::string positions = raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), coordinates = raw<float>({0, 0, 1, 0, 0, 1});
  const std::string indices = padded(raw<std::uint16_t>({0, 1, 2}), '\0');
  const std::string binary = padded(positions + coordinates + indices + picture, '\0');
  const std::string json = padded(
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
      R"("nodes":[{"name":"turned","mesh":0,"rotation":[0,0,0.70710678,0.70710678],"translation":[5,0,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],)"
      R"("materials":[{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.214041,1,0,1],"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0}],"images":[{"bufferView":3,"mimeType":"image/png"}],)"
      R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
      R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},{"bufferView":2,"componentType":5123,"count":3,"type":"SCALAR"}],)"
      R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},)"
      R"({"buffer":0,"byteOffset":60,"byteLength":6},{"buffer":0,"byteOffset":68,"byteLength":)" +
          std::to_string(picture.size()) + R"(}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) + "}]}",
      ' ');
  return "glTF" + number32(2) + number32(28 + json.size() + binary.size()) + number32(json.size()) + "JSON" + json +
         number32(binary.size()) + std::string("BIN\0", 4) + binary;
}

std::string complaint_of(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const auto file = folder.put(name, text);
  return complaint(file.string(), [&] { (void)load_drawn(file); });
}

}  // namespace

TEST_CASE("a cube without normals gets flat faces, corners shared within a face only") {
  const TemporaryFolder folder;
  const auto drawn = load_drawn(folder.put("cube.obj", kCube), {2, 3, 4});
  REQUIRE(drawn.size() == 1);
  const DrawnMesh& mesh = drawn[0].mesh;
  CHECK(mesh.triangles.size() == 12);
  CHECK(mesh.positions.size() == 24);
  CHECK(mesh.coordinates.empty());
  CHECK_FALSE(drawn[0].colour);
  CHECK(volume(mesh) == Approx(24));
  check_flat_shading(mesh);
}

TEST_CASE("a mirroring scale keeps faces and normals outwards") {
  const TemporaryFolder folder;
  const auto drawn = load_drawn(folder.put("cube.obj", kCube), {-1, 1, 1});
  CHECK(volume(drawn.at(0).mesh) == Approx(1));
  check_flat_shading(drawn[0].mesh);
}

TEST_CASE("normals of the file are kept, and turned as surfaces are under an uneven scale") {
  const TemporaryFolder folder;
  const std::string slope = "v 0 0 0\nv 1 0 -1\nv 0 1 0\nvn 0.70710678 0 0.70710678\nvn 0 0 1\nf 1//1 2//2 3//1\n";
  const auto drawn = load_drawn(folder.put("slope.obj", slope), {3, 1, 1});
  REQUIRE(drawn.at(0).mesh.normals.size() == 3);
  const Vector3 expected = Vector3(1, 0, 3).normalized();  // of the plane x + 3 z = 0
  CHECK((vector(drawn[0].mesh.normals[0]) - expected).norm() < 1e-5);
  CHECK((vector(drawn[0].mesh.normals[1]) - Vector3::UnitZ()).norm() < 1e-5);
}

TEST_CASE("facets that bend by less than 40 degrees look round, others do not") {
  const TemporaryFolder folder;
  const auto round = load_drawn(folder.put("round.stl", tube_stl(16)));  // 22.5 degrees
  REQUIRE(round.size() == 1);
  CHECK(round[0].mesh.positions.size() == 32);
  for (std::size_t i = 0; i < 32; ++i) {
    const Vector3 p = vector(round[0].mesh.positions[i]);
    CHECK((vector(round[0].mesh.normals[i]) - Vector3(p.x(), p.y(), 0)).norm() < 1e-4);
  }
  const auto edged = load_drawn(folder.put("edged.stl", tube_stl(8)));  // 45 degrees
  CHECK(edged.at(0).mesh.positions.size() == 32);
  check_flat_shading(edged[0].mesh);
}

TEST_CASE("materials give one mesh each, with colour and picture") {
  const TemporaryFolder folder;
  folder.put("looks.mtl", "newmtl red\nKd 0.8 0.1 0.2\nd 0.5\nnewmtl wood\nKd 1 1 1\nmap_Kd pictures\\four.png\n");
  folder.put("pictures/four.png", png_bytes(2, 2, kFourColours));
  const auto drawn = load_drawn(folder.put(
      "board.obj", "mtllib looks.mtl\n" + kSquare + "usemtl red\nf 1/1 2/2 3/3\nusemtl wood\nf 1/1 3/3 4/4\n"));
  REQUIRE(drawn.size() == 2);
  REQUIRE(drawn[0].colour);
  CHECK((*drawn[0].colour)[0] == Approx(0.8));
  CHECK((*drawn[0].colour)[3] == Approx(0.5));
  CHECK_FALSE(drawn[0].image);
  REQUIRE(drawn[1].image);
  CHECK(drawn[1].image->rgba == kFourColours);
  const DrawnMesh& wood = drawn[1].mesh;
  REQUIRE(wood.coordinates.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {  // here u is x, and v, counted from the top, 1 - y
    CHECK(wood.coordinates[i][0] == Approx(wood.positions[i][0]));
    CHECK(wood.coordinates[i][1] == Approx(1 - wood.positions[i][1]));
  }
}

TEST_CASE("a GLB file's picture comes from inside it, its nodes move its corners") {
  const TemporaryFolder folder;
  const auto drawn = load_drawn(folder.put("turned.glb", glb(png_bytes(2, 2, kFourColours))), {1, 2, 1});
  REQUIRE(drawn.size() == 1);
  const DrawnMesh& mesh = drawn[0].mesh;
  REQUIRE(mesh.positions.size() == 3);
  CHECK((vector(mesh.positions[0]) - Vector3(5, 0, 0)).norm() < 1e-6);
  CHECK((vector(mesh.positions[1]) - Vector3(5, 2, 0)).norm() < 1e-6);  // x became y, then the scale
  CHECK((vector(mesh.positions[2]) - Vector3(4, 0, 0)).norm() < 1e-6);
  CHECK((vector(mesh.normals[0]) - Vector3::UnitZ()).norm() < 1e-6);
  CHECK(mesh.coordinates[1] == std::array{1.0F, 0.0F});  // glTF counts v from the top as we do
  REQUIRE(drawn[0].image);
  CHECK(drawn[0].image->rgba == kFourColours);
  REQUIRE(drawn[0].colour);
  CHECK((*drawn[0].colour)[0] == Approx(0.5).margin(1e-4));  // linear 0.214 is sRGB 0.5
}

TEST_CASE("broken meshes and pictures are errors with the file and a cure") {
  const TemporaryFolder folder;
  CHECK_THAT(complaint("none.obj", [&] { (void)load_drawn(folder / "none.obj"); }), Contains("no such mesh"));
  CHECK_THAT(complaint_of(folder, "a.glb", "glTF broken"), Contains("not a readable mesh"));
  CHECK_THAT(complaint_of(folder, "b.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), Contains("no triangles"));
  CHECK_THAT(complaint_of(folder, "c.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
             Contains("finite") || Contains("not a readable mesh"));
  const std::string board = kSquare + "usemtl wood\nf 1/1 2/2 3/3\n";
  folder.put("lost.mtl", "newmtl wood\nmap_Kd lost.png\n");
  CHECK_THAT(complaint_of(folder, "d.obj", "mtllib lost.mtl\n" + board), Contains("'lost.png' is missing"));
  folder.put("bad.mtl", "newmtl wood\nmap_Kd bad.png\n");
  folder.put("bad.png", "no picture");
  CHECK_THAT(complaint("bad.png", [&] { (void)load_drawn(folder.put("e.obj", "mtllib bad.mtl\n" + board)); }),
             Contains("neither PNG nor JPEG"));
  CHECK_THAT(complaint_of(folder, "f.glb", glb("no picture")), Contains("neither PNG nor JPEG"));
  CHECK_THROWS_AS(load_drawn(folder.put("g.obj", kCube), {1, 0, 1}), Error);
}

TEST_CASE("a drawn mesh survives its bytes, damaged bytes are errors") {
  const TemporaryFolder folder;
  const DrawnMesh mesh = load_drawn(folder.put("s.obj", kSquare + "f 1/1 2/2 3/3 4/4\n")).at(0).mesh;
  CHECK_FALSE(mesh.coordinates.empty());
  const std::string bytes = to_bytes(mesh);
  CHECK(mesh_from_bytes(bytes) == mesh);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    CHECK_THROWS_AS(mesh_from_bytes(bytes.substr(0, size)), Error);
  CHECK_THROWS_AS(mesh_from_bytes(bytes + "x"), Error);
  std::string wild = bytes;
  wild[wild.size() - 1] = 0x7f;  // a corner that is not there
  CHECK_THROWS_AS(mesh_from_bytes(wild), Error);
}
