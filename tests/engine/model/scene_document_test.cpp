#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/model/scene.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

DrawnMesh triangle() {
  return {{{0, 0, 0}, {1, 0, 0.1F}, {0, 1, -0.0F}},
          {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
          {{0, 0}, {1, 0}, {0, 1}},
          {{0, 1, 2}}};
}

// What is drawn, with every field other than its default.
void add_looks(Scene& scene) {
  scene.meshes["m1"] = std::make_shared<const DrawnMesh>(triangle());
  scene.textures["picture"].image = std::make_shared<const Image>(Image{2, 1, {1, 2, 3, 4, 250, 251, 252, 255}});
  scene.textures["tiles"] = {TextureKind::checker, nullptr, {0.1, 0.2, 0.3, 0.4}, {0.5, 0.6, 0.7, 0.8}, 0.05, 77};
  scene.light = {{1, 2, -3}, {0.9, 0.8, 0.7, 0.6}, 0.1, 0.2, 0.3};
  scene.classes = {"cube", "table"};
  Shape drawn;
  drawn.kind = ShapeKind::mesh, drawn.mesh = "m1", drawn.texture = "picture", drawn.collides = false;
  scene.bodies[0].parts[0].shapes.push_back(drawn);
  scene.bodies[0].parts[0].shapes[0].texture = "tiles";
  scene.bodies[0].fixture = true;
  scene.bodies[0].parts[0].instance = 65535;
}

// A scene in which every field differs from its default.
Scene rich_scene() {
  Scene scene = table_scene(2);
  scene.bodies[1].world_from_body = make_transform({0.1, 1.0 / 3.0, -0.0}, Quaternion(0.1, 0.2, 0.3, 0.4));
  Part drawer;
  drawer.name = "drawer";
  drawer.parent = 0;
  drawer.joint = {"slide",
                  JointKind::slider,
                  Vector3::UnitY(),
                  translation(1, 2, 3),
                  0.004,
                  -0.1,
                  0.3,
                  0.05,
                  1,
                  2,
                  3,
                  4,
                  5,
                  0.01,
                  7,
                  6,
                  "key",
                  0.2,
                  0.1,
                  "lid",
                  120,
                  0.5,
                  0.25};
  Shape hull;
  hull.kind = ShapeKind::hull;
  hull.points = {{0, 0, 0}, {1e-300, 0, 0}, {0, 0.1, 0}, {0, 0, 5e-324}};
  hull.visible = false;
  drawer.shapes.push_back(hull);
  drawer.surface = {0.1, 0.2, 0.3, 0.4, true};
  scene.bodies[0].parts.push_back(drawer);
  scene.bodies[1].joined_to = "table", scene.bodies[1].joined_part = 1;
  scene.regions.push_back({"inside", "table", 1, translation(0, 0, 0.1), {1, 2, 3}, true, {0.1, 0.2, 0.3, 0.4}});
  scene.cameras.push_back(
      {"front", "table", 1, translation(1, 0, 1), 64, 48, 70, 71, 31.5, 24.5, {0.1, 0.2, 0.3, 0.4, 0.5}, 0.02, 3.2});
  scene.objects[0].attributes = {{"colour", "röd"}, {"size", "small"}};
  scene.objects[0].numbers = {{"open_at", 0.1}};
  scene.objects[0].grasps.push_back({translation(0, 0, 0.1), 0.03, 0.07, 15});
  scene.sensors.push_back({"wrench", "force_torque", 9, 60});
  add_looks(scene);
  scene.gravity = {0.1, 0, -1.62};
  scene.physics_hz = 480;
  scene.frame_hz = 10;
  return scene;
}

}  // namespace

TEST_CASE("documents of earlier releases have no couplings, no screws and nothing that lets go") {
  Scene scene = rich_scene();
  scene.bodies[1].joined_to.clear(), scene.bodies[1].joined_part = 0;
  Joint& joint = scene.bodies[0].parts[1].joint;
  joint.follows.clear();
  joint.follow_ratio = 1;
  joint.follow_offset = joint.stiffness = joint.pitch = 0;
  joint.lets_go = std::numeric_limits<double>::infinity();
  const std::string document = scene_to_document(scene);
  CHECK(document.find("follow") == std::string::npos);
  for (const char* field : {"stiffness", "pitch", "lets_go", "joined"})
    CHECK(document.find(field) == std::string::npos);
  CHECK(scene_from_document(document).bodies[0].parts[1].joint.follow_ratio == 1);
}

TEST_CASE("a scene survives its document, and the document its scene") {
  const std::string document = scene_to_document(rich_scene());
  const Scene back = scene_from_document(document);
  CHECK(scene_to_document(back) == document);
  const Scene scene = rich_scene();
  CHECK(back.bodies[1].world_from_body.matrix() == scene.bodies[1].world_from_body.matrix());
  CHECK(std::signbit(back.bodies[1].world_from_body.translation().z()));
  CHECK(back.bodies[0].parts[1].shapes[0].points == scene.bodies[0].parts[1].shapes[0].points);
  CHECK(back.bodies[0].parts[1].joint.latch_key == "key");
  CHECK(back.bodies[0].parts[1].joint.follow_ratio == 120);
  CHECK(back.bodies[0].parts[1].joint.pitch == 0.004);
  CHECK(back.bodies[0].parts[1].joint.lets_go == 0.25);
  CHECK(back.bodies[1].joined_to == "table");
  CHECK(back.robot.checked_pairs == scene.robot.checked_pairs);
  CHECK(back.robot.body.parts[3].inertia == scene.robot.body.parts[3].inertia);
  CHECK(back.objects[0].attributes == scene.objects[0].attributes);
  CHECK(back.regions[0].size == scene.regions[0].size);
  CHECK(back.cameras[0].far_m == 3.2);
}

TEST_CASE("every difference shows in the document") {
  const std::string document = scene_to_document(table_scene(1));
  Scene scene = table_scene(1);
  CHECK(scene_to_document(scene) == document);
  scene.bodies[1].parts[0].mass = std::nextafter(0.1, 1.0);
  CHECK(scene_to_document(scene) != document);
}

TEST_CASE("a number that is not finite cannot be stored, and the error says where") {
  Scene scene = table_scene(1);
  scene.bodies[1].parts[0].mass = std::nan("");
  try {
    (void)scene_to_document(scene);
    FAIL("no error");
  } catch (const Error& error) {
    CHECK(error.where() == "scene.bodies[1].parts[0].mass");
  }
}

TEST_CASE("what is drawn survives the document") {
  const Scene scene = rich_scene(), back = scene_from_document(scene_to_document(scene));
  CHECK(*back.meshes.at("m1") == triangle());
  CHECK(*back.textures.at("picture").image == *scene.textures.at("picture").image);
  const Texture& tiles = back.textures.at("tiles");
  CHECK(tiles.kind == TextureKind::checker);
  CHECK_FALSE(tiles.image);
  CHECK(tiles.second.blue == 0.7);
  CHECK(tiles.size_m == 0.05);
  CHECK(tiles.seed == 77);
  CHECK(back.light.direction == Vector3(1, 2, -3));
  CHECK(back.light.colour.alpha == 0.6);
  CHECK(back.light.specular == 0.3);
  CHECK(back.classes == scene.classes);
  CHECK(back.sensors.at(0).rate_hz == 60);
  CHECK(back.bodies[0].fixture);
  CHECK(back.bodies[0].parts[0].instance == 65535);
  CHECK(back.bodies[0].parts[0].shapes[1].mesh == "m1");
  CHECK(back.cameras[0].focal_y == 71);
  CHECK(back.cameras[0].distortion == scene.cameras[0].distortion);
}

namespace {

// The rich scene's document with one text in it replaced.
std::string replaced(const std::string& from, const std::string& to) {
  std::string text = scene_to_document(rich_scene());
  INFO(from);
  REQUIRE(text.find(from) != std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

std::string document_complaint(const std::string& document) {
  try {
    (void)scene_from_document(document);
  } catch (const Error& error) {
    CHECK_FALSE(error.hint().empty());
    return error.where() + ": " + error.message();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("damaged documents are errors, never crashes") {
  using Catch::Contains;
  const std::string document = scene_to_document(rich_scene());
  REQUIRE(document_complaint(document) == "accepted");
  for (const std::string& bad : {std::string(), std::string("[]"), document.substr(0, document.size() / 2)})
    CHECK_THAT(document_complaint(bad), Contains("scene document"));
  CHECK_THAT(document_complaint(replaced("\"physics_hz\":480", "\"physics_hz\":\"fast\"")), Contains("a whole number"));
  CHECK_THAT(document_complaint(replaced("\"physics_hz\":480", "\"physics_herz\":480")),
             Contains("'physics_hz' is missing"));
  CHECK_THAT(document_complaint(replaced("\"physics_hz\":480", "\"physics_hz\":480,\"x\":1")),
             Contains("does not know"));
  CHECK_THAT(document_complaint(replaced("\"format\":", "\"format\":1000")), Contains("is not known to this version"));
  CHECK_THAT(document_complaint(replaced("\"parent\":-1", "\"parent\":7")), Contains("parent must come before"));
  CHECK_THAT(document_complaint(replaced("\"tip_part\":9", "\"tip_part\":900")), Contains("the robot's tip"));
  CHECK_THAT(document_complaint(replaced("\"kind\":\"box\"", "\"kind\":\"torus\"")), Contains("no known kind"));
}

TEST_CASE("damaged looks are errors with their place") {
  using Catch::Contains;
  CHECK_THAT(document_complaint(replaced("\"mesh\":\"m1\"", "\"mesh\":\"m2\"")),
             Contains("body table") && Contains("a mesh"));
  CHECK_THAT(document_complaint(replaced("\"m1\":{\"drawn\":", "\"m1\":{\"drown\":")), Contains("meshes.m1"));
  CHECK_THAT(document_complaint(replaced("\"texture\":\"tiles\"", "\"texture\":\"tile\"")),
             Contains("no texture 'tile'"));
  CHECK_THAT(document_complaint(replaced("\"kind\":\"checker\"", "\"kind\":\"image\"")), Contains("it has no image"));
  CHECK_THAT(document_complaint(replaced("\"width\":2}", "\"width\":3}")), Contains("does not agree with its pixels"));
  CHECK_THAT(document_complaint(replaced("\"width\":2}", "\"width\":-2}")), Contains("does not agree with its pixels"));
  CHECK_THAT(document_complaint(replaced("\"width\":2}", "\"width\":2,\"x\":1}")), Contains("an image is expected"));
  CHECK_THAT(document_complaint(replaced("\"classes\":[\"cube\"", "\"classes\":[7")), Contains("classes[0]: a text"));
  CHECK_THAT(document_complaint(replaced("\"specular\":", "\"spectacular\":")),
             Contains("light: the field 'specular'"));
  CHECK_THAT(document_complaint(replaced("\"instance\":65535", "\"instance\":1.5")), Contains("a whole number"));
  for (const char* number : {"4294967297", "18446744073709551615"})
    CHECK_THAT(document_complaint(replaced("\"instance\":65535", std::string("\"instance\":") + number)),
               Contains("too large"));
  CHECK_THAT(document_complaint(replaced("\"fixture\":true", "\"fixture\":1")), Contains("true or false"));
  CHECK_THAT(document_complaint(replaced("\"focal_y\":71.0", "\"focal_y\":0.0")), Contains("camera front"));
  CHECK_THAT(document_complaint(replaced("\"distortion\":[0.1,", "\"distortion\":[")), Contains("a list of 5"));
}

TEST_CASE("damaged base64 is an error, and so are bytes that are no mesh") {
  using Catch::Contains;
  const std::string document = scene_to_document(rich_scene());
  const std::string start = "\"meshes\":{\"m1\":{\"drawn\":{\"base64\":\"";
  REQUIRE(document.find(start) != std::string::npos);
  for (const std::string bad : {"*", "=", "A", "AAAA"}) {  // ahead of the rest
    INFO(bad);
    CHECK_THAT(document_complaint(replaced(start, start + bad)), Contains("damaged"));
  }
  std::string wild = document;  // the last corner's number: a corner that is not there
  const std::size_t end = wild.find('"', wild.find(start) + start.size());
  wild[end - 6] = '/';
  CHECK_THAT(document_complaint(wild), Contains("damaged"));
}

TEST_CASE("no damage of single bytes crashes the reader") {
  const std::string document = scene_to_document(rich_scene());
  Random random(RandomKey("damage"));
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string bad = document;
    bad[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(bad.size())))] =
        static_cast<char>(random.below(256));
    refused += document_complaint(bad) != "accepted";
  }
  CHECK(refused > 150);  // the others changed digits of numbers and letters of names
}
