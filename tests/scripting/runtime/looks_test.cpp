// What is drawn of objects: meshes and lathes as they are, colours and textures where they were given.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <lua.hpp>
#include <memory>

#include "scripting/runtime/body_builder.h"
#include "scripting/runtime/evaluate.h"

using namespace stampede;

namespace {

const std::filesystem::path kFolder = STAMPEDE_SOURCE_DIR "/tests/scripting/data/runtime/worlds/objects";

BuiltObject built_with(const std::string& table, const std::filesystem::path& folder = kFolder) {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  const std::string words =
      "local function word(tag, key, kind) return function(t) t.tag, t[key] = tag, kind return t end end\n"
      "local box, mesh, lathe = word('shape', 'shape', 'box'), word('shape', 'shape', 'mesh'), word('shape', 'shape', "
      "'lathe')\n"
      "local texture, checker, noise = word('texture', 'texture', 'image'), word('texture', 'texture', 'checker'), "
      "word('texture', 'texture', 'noise')\nreturn ";
  REQUIRE(luaL_loadstring(state.get(), (words + table).c_str()) == LUA_OK);
  lua_call(state.get(), 0, 1);
  const Value fields = read_value(state.get(), 1, {RandomKey("test"), 0, "objects/thing.lua", {}}, "");
  return build_object({"thing", "thing", fields, folder}, {{"red", {1, 0, 0, 1}}, {"blue", {0, 0, 1, 1}}});
}

std::vector<Shape> looks_that(const BuiltObject& object, const std::function<bool(const Shape&)>& test) {
  std::vector<Shape> result;
  for (const Shape& shape : object.body->parts[0].shapes)
    if (test(shape)) result.push_back(shape);
  return result;
}
std::vector<Shape> seen(const BuiltObject& object) {
  return looks_that(object, [](const Shape& shape) { return shape.visible; });
}
std::vector<Shape> felt(const BuiltObject& object) {
  return looks_that(object, [](const Shape& shape) { return shape.collides; });
}

// By the divergence theorem: of a closed surface seen from outside counter-clockwise, it is positive.
double volume(const DrawnMesh& mesh) {
  const auto at = [&](std::uint32_t i) {
    const auto& p = mesh.positions[i];
    return Vector3(p[0], p[1], p[2]);
  };
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += at(a).dot(at(b).cross(at(c))) / 6;
  return sum;
}

}  // namespace

TEST_CASE("a mesh collides as hulls and is drawn as it is, in the file's colour unless the author gives one") {
  const BuiltObject plain = built_with("{ shape = mesh { 'wedge.obj', scale = 2 } }");
  REQUIRE(felt(plain).size() == 1);
  CHECK(felt(plain)[0].kind == ShapeKind::hull);
  REQUIRE(seen(plain).size() == 1);
  const Shape drawn = seen(plain)[0];
  CHECK(drawn.kind == ShapeKind::mesh);
  CHECK_FALSE(drawn.collides);
  CHECK(std::array{drawn.colour.red, drawn.colour.green, drawn.colour.blue} == std::array{0.0, 1.0, 0.0});
  const DrawnMesh& mesh = *plain.drawn.meshes.at(drawn.mesh);
  CHECK(mesh.triangles.size() == 4);
  CHECK(volume(mesh) == Approx(std::pow(0.08, 3) / 6).epsilon(1e-5));  // a corner of a cube of twice 4 cm
  CHECK(plain.objects[0].size.isApprox(Vector3::Constant(0.08), 1e-6));

  const BuiltObject red = built_with("{ colour = 'red', shape = mesh { 'wedge.obj', scale = 2 } }");
  CHECK(seen(red)[0].colour.red == 1.0);
  CHECK(seen(red)[0].mesh == drawn.mesh);  // named by content: stored once
}

TEST_CASE("a lathe collides as its wedges and is drawn as one smooth surface") {
  const BuiltObject solid = built_with("{ shape = lathe { { 0.1, 0 }, { 0.1, 0.2 }, { 0.05, 0.3 } } }");
  CHECK(felt(solid).size() == 2);
  REQUIRE(seen(solid).size() == 1);
  const double frustum = 0.1 * (0.01 + 0.005 + 0.0025) / 3;
  const double pi = 24 * std::sin(2 * 3.14159265358979 / 48);  // a regular 48-gon of radius r has the area pi r^2
  CHECK(volume(*solid.drawn.meshes.at(seen(solid)[0].mesh)) == Approx(pi * (0.002 + frustum)).epsilon(1e-5));

  const BuiltObject tube = built_with("{ shape = lathe { { 0.1, 0 }, { 0.1, 0.2 }, wall = 0.02 } }");
  CHECK(felt(tube).size() == 16);
  REQUIRE(seen(tube).size() == 1);
  CHECK(volume(*tube.drawn.meshes.at(seen(tube)[0].mesh)) == Approx(pi * (0.01 - 0.0064) * 0.2).epsilon(1e-5));
  CHECK(seen(built_with("{ shape = lathe { { 0.1, 0 }, { 0.1, 0.2 }, visible = false } }")).empty());
}

TEST_CASE("a visual is drawn instead of shapes, and changes nothing that is felt") {
  const std::string box = "shape = box { 0.1, 0.2, 0.3 }, mass = 1, traits = { 'movable' }";
  const BuiltObject plain = built_with("{ " + box + " }"),
                    dressed = built_with("{ " + box + ", visual = mesh { 'wedge.obj' } }");
  REQUIRE(felt(dressed).size() == 1);
  CHECK_FALSE(felt(dressed)[0].visible);
  REQUIRE(seen(dressed).size() == 1);
  CHECK(seen(dressed)[0].kind == ShapeKind::mesh);
  CHECK(dressed.objects[0].size == plain.objects[0].size);
  CHECK(dressed.body->parts[0].inertia == plain.body->parts[0].inertia);
  const BuiltObject two =
      built_with("{ " + box + ", visual = { box { 1, 1, 1, colour = 'red' }, mesh { 'wedge.obj' } } }");
  REQUIRE(seen(two).size() == 2);
  CHECK(seen(two)[0].colour.red == 1.0);
  CHECK(felt(two).size() == 1);
}

TEST_CASE("the innermost word about looks wins: texture and colour of the shape, the part, the object") {
  const BuiltObject object = built_with(
      "{ texture = checker { 'red', 'blue', size = 0.02 }, shapes = { box { 1, 1, 1 }, "
      "box { 1, 1, 1, colour = 'blue' }, box { 1, 1, 1, texture = noise { seed = 3 }, colour = { 0.5, 0.5, 0.5 } }, "
      "box { 1, 1, 1, texture = texture { 'tiles.png' } } } }");
  const std::vector<Shape> shapes = seen(object);
  REQUIRE(shapes.size() == 4);
  const Texture& checker = object.drawn.textures.at(shapes[0].texture);
  CHECK(checker.kind == TextureKind::checker);
  CHECK(checker.size_m == 0.02);
  CHECK(checker.first.red == 1.0);
  CHECK(checker.second.blue == 1.0);
  CHECK(shapes[0].colour.green == 1.0);  // white: the texture as it is
  CHECK(shapes[1].texture.empty());      // plain blue
  const Texture& noise = object.drawn.textures.at(shapes[2].texture);
  CHECK(noise.kind == TextureKind::noise);
  CHECK(noise.seed == 3);
  CHECK(shapes[2].colour.red == 0.5);  // tinted
  const Texture& tiles = object.drawn.textures.at(shapes[3].texture);
  REQUIRE(tiles.image);
  CHECK(tiles.image->width == 2);
  CHECK(tiles.image->rgba == std::vector<std::uint8_t>{255, 0, 0, 255, 0, 0, 255, 255});
  CHECK(object.drawn.textures.size() == 3);
}

TEST_CASE("missing and broken files name place, file and cure") {
  using Catch::Contains;
  char folder[] = "/tmp/stampede_looks_XXXXXX";
  REQUIRE(mkdtemp(folder) != nullptr);
  std::ofstream(std::string(folder) + "/broken.png") << "no picture";
  std::ofstream(std::string(folder) + "/broken.obj") << "no mesh";
  const auto said = [&](const std::string& table) {
    try {
      built_with(table, folder);
    } catch (const Error& error) {
      CHECK_FALSE(error.hint().empty());
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(said("{ shape = mesh { 'gone.obj' } }"), Contains("objects/thing.lua: shape") && Contains("gone.obj"));
  CHECK_THAT(said("{ shape = mesh { 'broken.obj' } }"), Contains("objects/thing.lua: shape") && Contains("broken.obj"));
  CHECK_THAT(said("{ shape = box { 1, 1, 1 }, texture = texture { 'gone.png' } }"),
             Contains("objects/thing.lua: texture") && Contains("gone.png"));
  CHECK_THAT(said("{ shape = box { 1, 1, 1 }, texture = texture { 'broken.png' } }"),
             Contains("objects/thing.lua: texture") && Contains("broken.png"));
  std::filesystem::remove_all(folder);
  CHECK_THROWS_WITH(built_with("{ shape = box { 1, 1, 1 }, texture = checker { 'red', 'blu' } }"),
                    Contains("no colour 'blu'"));
  CHECK_THROWS_WITH(built_with("{ shape = box { 1, 1, 1 }, texture = checker { size = 0 } }"),
                    Contains("size above 0"));
  CHECK_THROWS_WITH(built_with("{ shape = box { 1, 1, 1 }, texture = 'wood' }"),
                    Contains("expected a texture such as"));
}
