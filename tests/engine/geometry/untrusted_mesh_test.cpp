// Mesh files that lie, loop, explode or reach for what is not theirs: an error with the file and the reason, at once.
#include <chrono>

#include "engine/geometry/mesh.h"
#include "mesh_files.h"

using namespace stampede;
using Catch::Contains;

namespace {

const std::string kHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
    "3 0 2 1\n3 0 1 3\n3 1 2 3\n";

std::string refused(const std::filesystem::path& file) {
  const std::string hulls = complaint(file.string(), [&] { (void)load_hulls(file); });
  const std::string drawn = complaint(file.string(), [&] { (void)load_drawn(file); });
  const auto limit = [](const std::string& text) {
    return text.find("reading it takes more than") != std::string::npos;
  };
  CHECK((hulls == drawn || (limit(hulls) && limit(drawn))));  // a busy machine meets the limit of time first
  return hulls;
}

// A glTF whose buffer is a number of zero bytes that its accessors claim.
std::string gltf(const std::string& nodes, const std::string& buffer, int count) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[)" + buffer +
         R"(],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
         std::to_string(count) + R"(,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}]})";
}

const std::string kTriangle =  // 0 0 0, 1 0 0, 0 1 0
    R"({"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"})";

}  // namespace

TEST_CASE("corners that are not there, text for numbers and endless counts in PLY files") {
  const TemporaryFolder folder;
  CHECK_NOTHROW(load_hulls(folder.put("good.ply", kHeader + "3 2 0 3\n")));
  CHECK(refused(folder.put("beyond.ply", kHeader + "3 2 0 999999999\n")) != "accepted");
  CHECK(refused(folder.put("text.ply", kHeader + "\xff\xfev\x80\x80"
                                                 "0 3\n")) != "accepted");
  std::string endless = kHeader;
  endless.replace(endless.find("vertex 4"), 8, "vertex 4000000000");
  CHECK(refused(folder.put("endless.ply", endless)) != "accepted");
  CHECK(refused(folder.put("cut.ply", kHeader.substr(0, kHeader.find("end_header")))) != "accepted");
}

TEST_CASE("what a mesh file counts has to be in it, and its form its ending's, before anybody else reads it") {
  const TemporaryFolder folder;
  const auto refuses = [&](const std::string& name, const std::string& text, const std::string& why) {
    CAPTURE(name, why);
    CHECK_THAT(refused(folder.put(name, text)), Contains(why));
  };
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = kHeader + "3 2 0 3\n";
    return text.replace(text.find(from), from.size(), to);
  };
  refuses("a.ply", changed("3 2 0 3", "3 2 0 4"), "face 3 names a corner that is not there; there are 4");
  refuses("b.ply", changed("3 2 0 3", "3 2 0 -1"), "face 3 names a corner");
  refuses("c.ply", changed("3 2 0 3", "-3 2 0 3"), "face 3 has a list of a length that cannot be");
  refuses("d.ply", changed("3 2 0 3", "900000000 2 0 3"), "face 3 has a list of a length that cannot be");
  refuses("e.ply", changed("3 2 0 3", "3 2 x 3"), "where a number should be");
  refuses("f.ply", changed("3 2 0 3", "3 2 0"), "ends before the last");
  refuses("g.ply", changed("property float x", "e y"), "its header has the line 'e y'");
  refuses("h.ply", changed("element face 4", "element face 2147483648"), "2147483648 of 'face'");
  refuses("i.ply", changed("element vertex 4", "element vertex -4"), "its header has the line");
  refuses("j.ply", changed("format ascii", "format braille"), "its header has the line");
  refuses("k.ply", changed("0 0 1\n", "0 0 nan\n"), "not a finite number");
  refuses("l.ply", changed("0 0 1\n", "0 0 1e30\n"), "1000 km");
  refuses("m.ply", "", "it is empty");
  std::string stl(84 + 50, '\0');
  stl[80] = '\x02';
  refuses("n.stl", stl, "it says that it has 2 triangles, and has bytes for 1");
  refuses("o.stl", "solid", "at least 84 bytes");
  refuses("p.glb", std::string("glTF\2\0\0\0\xff\xff\xff\0\x10\0\0\0JSON{}", 22), "it says that it has 16777215 bytes");
  refuses("q.dae", "<!DOCTYPE a [<!ENTITY b 'c'>]><COLLADA/>", "it declares entities");
  refuses("r.obj", kHeader, "not a readable mesh");  // a PLY by another name
  refuses("s.3mf", "PK", "mesh files that end in '.3mf' are not read; these are: .obj .stl .dae .ply .gltf .glb");
  refuses("t", "v 0 0 0\n", "mesh files that end in ''");
}

TEST_CASE("nodes within nodes, and the same ones many times over") {
  const TemporaryFolder folder;
  CHECK(load_drawn(folder.put("one.gltf", gltf(R"({"mesh":0})", kTriangle, 3))).size() == 1);
  std::string chain, doubled;
  for (int i = 0; i < 100'000; ++i)
    chain += (i == 0 ? "" : ",") + std::string("{\"children\":[") + std::to_string(i + 1) + "]}";
  CHECK(refused(folder.put("deep.gltf", gltf(chain + R"(,{"mesh":0})", kTriangle, 3))) != "accepted");
  for (int i = 0; i < 40; ++i)
    doubled += (i == 0 ? "" : ",") + std::string("{\"children\":[") + std::to_string(i + 1) + "," +
               std::to_string(i + 1) + "]}";
  CHECK(refused(folder.put("laughs.gltf", gltf(doubled + R"(,{"mesh":0})", kTriangle, 3))) != "accepted");
  CHECK(refused(folder.put("claims.gltf", gltf(R"({"mesh":0})", kTriangle, 2'000'000'000))) != "accepted");
  std::string dae = "<COLLADA version='1.4.1'><library_visual_scenes><visual_scene id='s'>";
  for (int i = 0; i < 100'000; ++i) dae += "<node id='n'>";
  CHECK(refused(folder.put("deep.dae", dae)) != "accepted");
}

TEST_CASE("files that a mesh file names lie in its folder, or in the scope") {
  const TemporaryFolder folder;
  const std::string board = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl m\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  folder.put("other.mtl", "newmtl m\nKd 1 0 0\n");
  const auto file = folder.put("mine/up.obj", "mtllib ../other.mtl\n" + board);
  CHECK_THAT(complaint("other.mtl", [&] { (void)load_drawn(file); }), Contains("outside the roots"));
  CHECK(load_drawn(file, Vector3::Ones(), FileScope({folder / ""})).at(0).colour->at(0) == 1);
  const auto buffer = folder.put(
      "mine/buffer.gltf", gltf(R"({"mesh":0})", R"({"byteLength":36,"uri":"../../../../../../../../etc/passwd"})", 3));
  CHECK_THAT(complaint("passwd", [&] { (void)load_drawn(buffer); }), Contains("outside the roots"));
  CHECK_THAT(complaint(file.string(), [&] { (void)load_hulls(file, Vector3::Ones(), 64, FileScope({})); }),
             Contains("outside the roots"));
}

TEST_CASE("a mesh file is read once, and again when it or a companion has changed") {
  const TemporaryFolder folder;
  std::string board = "mtllib m.mtl\nusemtl m\n";
  for (int i = 0; i < 20'000; ++i) {
    const std::string x = std::to_string(i);
    board += "v " + x + " 0 0\nv " + x + " 1 0\nv " + x + " 0 1\nf -1 -2 -3\n";
  }
  folder.put("m.mtl", "newmtl m\nKd 1 0 0\n");
  const auto file = folder.put("big.obj", board);
  const auto time_of = [&] {
    const auto start = std::chrono::steady_clock::now();
    CHECK(load_drawn(file).at(0).mesh.triangles.size() == 20'000);
    return std::chrono::steady_clock::now() - start;
  };
  const auto first = time_of();
  CHECK(time_of() < first / 2);
  folder.put("m.mtl", "newmtl m\nKd 0 1 0\n");
  CHECK(load_drawn(file).at(0).colour->at(1) == 1);
  folder.put("big.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK(load_drawn(file).at(0).mesh.triangles.size() == 1);
}
