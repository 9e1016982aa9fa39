#include "engine/geometry/mesh.h"

#include <catch2/catch.hpp>

#include "tests/engine/geometry/mesh_files.h"

using namespace stampede;

namespace {

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string refusal(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  const auto file = folder.put(name, text);
  return complaint(file.string(), [&] { (void)load_hulls(file); });
}

}  // namespace

TEST_CASE("a mesh file gives its corners once, scaled, one mesh for each node") {
  const TemporaryFolder folder;
  const auto file =
      folder.put("mesh.obj", "o first\n" + kTetrahedron +
                                 "o second\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n");
  const auto meshes = load_meshes(file, {2, 3, 4});
  REQUIRE(meshes.size() == 2);
  CHECK(meshes[0].node == "first");
  CHECK(meshes[0].vertices.size() == 4);
  CHECK(meshes[0].triangles.size() == 4);
  Vector3 high = meshes[0].vertices[0];
  for (const Vector3& v : meshes[0].vertices) high = high.cwiseMax(v);
  CHECK(high == Vector3(2, 3, 4));
  CHECK(load_hulls(file).size() == 2);
}

TEST_CASE("an STL's repeated corners are joined") {
  std::string text = "solid t\n";
  for (const char* corners : {"0 0 0|0 1 0|1 0 0", "0 0 0|1 0 0|0 0 1", "1 0 0|0 1 0|0 0 1", "0 1 0|0 0 0|0 0 1"}) {
    std::string list(corners);
    for (std::size_t at = list.find('|'); at != std::string::npos; at = list.find('|'))
      list.replace(at, 1, "\nvertex ");
    text += "facet normal 0 0 0\nouter loop\nvertex " + list + "\nendloop\nendfacet\n";
  }
  const TemporaryFolder folder;
  const auto file = folder.put("mesh.stl", text + "endsolid t\n");
  const auto meshes = load_meshes(file);
  REQUIRE(meshes.size() == 1);
  CHECK(meshes[0].vertices.size() == 4);
}

TEST_CASE("bad mesh files are errors with the file and a cure") {
  using Catch::Contains;
  CHECK_THROWS_AS(load_meshes("/nowhere/cup.obj"), Error);
  CHECK_THAT(refusal("mesh.obj", ""), Contains("not a readable mesh") || Contains("no triangles"));
  CHECK_THAT(refusal("mesh.obj", "this is not a mesh\n"), Contains("not a readable mesh") || Contains("no triangles"));
  CHECK_THAT(refusal("mesh.glb", "glTF broken"), Contains("not a readable mesh"));
  CHECK_THAT(refusal("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), Contains("flat"));
  CHECK_THAT(refusal("mesh.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\n"),
             Contains("finite") || Contains("not a readable mesh"));
  const TemporaryFolder folder;
  CHECK_THROWS_AS(load_meshes(folder.put("mesh.obj", kTetrahedron), {1, 0, 1}), Error);
}
