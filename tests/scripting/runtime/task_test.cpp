#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "scripts_fixture.h"

using namespace stampede;
using test::small_library;

namespace {

const std::string kVariation = "colour=red,height=3";

const Object& object(const Scene& scene, const std::string& name) {
  const Object* found = scene.object(name);
  REQUIRE(found != nullptr);
  return *found;
}

const Body& body(const Scene& scene, const std::string& name) {
  REQUIRE(scene.body_index(name) >= 0);
  return scene.bodies[static_cast<std::size_t>(scene.body_index(name))];
}

std::string canonical_variation() {  // of height 3 and red, in whatever order the library writes axes
  for (const std::string& text : small_library()->task("tower")->variation_texts) {
    if (text.find("height=3") != std::string::npos && text.find("colour=red") != std::string::npos) return text;
  }
  return kVariation;
}

}  // namespace

TEST_CASE("groups follow the variation, and names and colours reach the scene") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Scene scene = scripts.task()(0).scene;
  for (const std::string name : {"block1", "block2", "block3"}) {
    const Object& block = object(scene, name);
    CHECK(block.attributes.at("colour") == "red");
    CHECK(block.attributes.at("material") == "wood");
    CHECK(block.type == "cube");
    CHECK(body(scene, name).free);
    CHECK(body(scene, name).parts[0].shapes[0].colour.red == 1.0);
    CHECK(body(scene, name).parts[0].shapes[0].colour.green == 0.0);
  }
  CHECK(scene.object("block4") == nullptr);  // height is 3
  CHECK(scene.object("none1") == nullptr);   // an empty group
  CHECK(scene.object("none") == nullptr);
  CHECK(object(scene, "pair1").attributes.at("rank") == "low");       // added by the task
  CHECK(object(scene, "pair1").attributes.at("material") == "wood");  // kept from the file
  CHECK(object(scene, "mini.hand").kind == ObjectKind::hand);
  CHECK(std::is_sorted(scene.objects.begin(), scene.objects.end(),
                       [](const Object& a, const Object& b) { return a.name < b.name; }));
}

TEST_CASE("one_of is drawn for each member of a group, sample_of is dealt out") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Scene scene = scripts.task()(0).scene;
  std::set<std::string> others;
  for (int i = 1; i <= 20; ++i) {
    others.insert(object(scene, "other" + std::to_string(i)).attributes.at("colour"));
  }
  // Three colours are left; twenty independent draws of one value each all agree with a chance of 3e-9.
  CHECK(others.size() > 1);
  CHECK(others.count("red") == 0);
  for (int draw = 0; draw < 20; ++draw) {
    const Scene drawn = scripts.task()(draw).scene;
    CHECK(object(drawn, "pair1").attributes.at("colour") != object(drawn, "pair2").attributes.at("colour"));
  }
}

TEST_CASE("draws are a pure function of task, variation, seed and draw number") {
  EpisodeScripts one(small_library(), "tower", canonical_variation(), 1);
  EpisodeScripts again(small_library(), "tower", canonical_variation(), 1);
  EpisodeScripts other(small_library(), "tower", canonical_variation(), 2);
  const std::string third = scene_to_document(one.task()(3).scene);
  CHECK(scene_to_document(one.task()(0).scene) != third);
  CHECK(scene_to_document(again.task()(3).scene) == third);  // without the draws before it
  CHECK(scene_to_document(one.task()(3).scene) == third);
  CHECK(scene_to_document(other.task()(3).scene) != third);
}

TEST_CASE("an articulation gets its joints, parts, regions and names") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Scene scene = scripts.task()(0).scene;
  const Body& chest = body(scene, "chest");
  CHECK_FALSE(chest.free);
  REQUIRE(chest.parts.size() == 3);
  const int drawer = chest.part_index("drawer"), knob = chest.part_index("a_knob");
  REQUIRE(drawer == 1);  // parents first
  CHECK(chest.parts[static_cast<std::size_t>(knob)].parent == drawer);
  const Joint& joint = chest.parts[1].joint;
  CHECK(joint.kind == JointKind::slider);
  CHECK((joint.axis - Vector3(-1, 0, 0)).norm() < 1e-12);  // a unit vector of { -2, 0, 0 }
  CHECK(joint.upper == 0.2);
  CHECK(joint.initial == 0.05);  // the task's joints
  CHECK(joint.damping == 4.0);
  CHECK(object(scene, "chest.drawer").kind == ObjectKind::part);
  CHECK(object(scene, "chest.drawer").grasps.size() == 1);
  CHECK(object(scene, "chest.drawer").numbers.at("open_at") == 0.15);
  CHECK(scene.object("chest.a_knob") == nullptr);  // neither type nor traits: nothing to speak of
  CHECK(object(scene, "chest.drawer.inside").kind == ObjectKind::region);
  const int region = scene.region_index("chest.drawer.inside");
  REQUIRE(region >= 0);
  CHECK(scene.regions[static_cast<std::size_t>(region)].body == "chest");
  CHECK(scene.regions[static_cast<std::size_t>(region)].part == drawer);
  const double x = chest.world_from_body.translation().x();
  CHECK((x >= 0.2 && x < 0.4));
  CHECK(chest.parts[0].shapes[1].colour.red == 1.0);            // the shape's own
  CHECK(chest.parts[1].shapes[0].colour.green == Approx(0.4));  // the object's
}

TEST_CASE("a box of uniform density has the inertia of the textbook") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Scene scene = scripts.task()(0).scene;
  const Part& cube = body(scene, "block1").parts[0];
  const double expected = 0.1 / 6 * 0.04 * 0.04;  // m a^2 / 6
  CHECK(cube.mass == 0.1);
  CHECK((cube.inertia - expected * Matrix3::Identity()).norm() < 1e-9 * expected + 1e-15);
}

TEST_CASE("the robot takes limits from its URDF and from its Lua file") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Robot& robot = scripts.task()(0).scene.robot;
  REQUIRE(robot.limits.size() == 3);
  CHECK(robot.limits[1].upper == 2.0);
  CHECK(robot.limits[1].velocity == 2.0);
  CHECK(robot.limits[2].acceleration == 5.0);
  CHECK(robot.limits[2].jerk == 300.0);
  CHECK(robot.fingers.size() == 2);
  CHECK(robot.grip_force == 15.0);
  CHECK((robot.tip_part_from_tip.translation() - Vector3(0, 0, 0.1)).norm() == 0.0);
  CHECK(robot.body.world_from_body.translation().x() == -0.4);
}

TEST_CASE("a camera above the bench looks straight down") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Scene scene = scripts.task()(0).scene;
  REQUIRE(scene.cameras.size() == 2);
  const Camera& above = scene.cameras[0];
  CHECK((above.mount_from_camera.linear().col(2) - Vector3(0, 0, -1)).norm() < 1e-12);
  CHECK(above.mount_from_camera.linear().determinant() == Approx(1.0));
  CHECK(above.width == 64);
  CHECK(scene.cameras[1].mount_body == "mini");
}

TEST_CASE("init speaks of every member of a group and of the hand") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const std::vector<Literal> init = scripts.task()(0).init;
  // 3 blocks, 20 others, 2 of a pair on the bench; the spot; the empty hand; neither of the pair held
  REQUIRE(init.size() == 3 + 20 + 2 + 1 + 1 + 2);
  CHECK(init[0].fact == Fact{"on", {"block1", "bench"}});
  CHECK(init[26].fact == Fact{"hand_empty", {"mini.hand"}});
  CHECK(init[27].fact == Fact{"holding", {"mini.hand", "pair1"}});
  CHECK(init[27].negated);
  std::vector<std::string> unplaced = scripts.task()(0).unplaced;
  CHECK(unplaced.size() == 3 + 20 + 2 + 1);
  CHECK(std::count(unplaced.begin(), unplaced.end(), "spot") == 1);
  CHECK(std::count(unplaced.begin(), unplaced.end(), "chest") == 0);
}

TEST_CASE("goal: any two of three blocks, whichever, none while they lie side by side") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Domain& domain = scripts.symbols().domain();
  std::vector<TypedObject> objects;
  for (const Object& thing : scripts.task()(0).scene.objects) objects.push_back({thing.name, thing.type});
  Facts facts{{"hand_empty", {"mini.hand"}}, {"movable", {"block1"}}};
  for (const std::string block : {"block1", "block2", "block3"}) {
    for (const std::string trait : {"movable", "graspable", "surface"}) facts.insert({trait, {block}});
  }
  CHECK_FALSE(holds(scripts.task()(0).goal, facts, domain, objects));
  facts.insert({"on", {"block3", "block1"}});
  CHECK_FALSE(holds(scripts.task()(0).goal, facts, domain, objects));  // height is 3
  facts.insert({"on", {"block2", "block3"}});
  CHECK(holds(scripts.task()(0).goal, facts, domain, objects));
  facts.erase({"hand_empty", {"mini.hand"}});
  CHECK_FALSE(holds(scripts.task()(0).goal, facts, domain, objects));
}

TEST_CASE("fields that are functions of the variation, sentences, and subgoals in the order written") {
  EpisodeScripts scripts(small_library(), "tower", canonical_variation(), 1);
  const Task task = scripts.task()(0);
  CHECK(task.hold_s == 1.5);
  CHECK(task.horizon_s == 33.0);
  CHECK(task.axes == std::map<std::string, std::string>{{"colour", "red"}, {"height", "3"}});
  CHECK(task.instructions == std::vector<std::string>{"stack 3 red blocks", "a tower of 3"});
  REQUIRE(task.subgoals.size() == 2);
  CHECK(task.subgoals[0].name == "zebra");
  CHECK(task.subgoals[0].formula == atom("holding", {{false, "mini.hand"}, {false, "block1"}}));
  CHECK_FALSE(task.steps.has_value());
  CHECK(task.stages.empty());
}

TEST_CASE("subgoals of a list keep their order, and their sentences are filled in") {
  EpisodeScripts scripts(small_library(), "parts", "colour=blue,where=on_it", 1);
  const std::vector<Subgoal> parts = scripts.task()(0).subgoals;
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "zebra");
  CHECK(parts[0].sentence == "leave the blue cube on it");
  CHECK(parts[1].name == "ape");
  CHECK(parts[1].sentence.empty());
}

TEST_CASE("steps leave open what they do not name, an ordered goal has stages") {
  EpisodeScripts scripts(small_library(), "steps", "", 1);
  REQUIRE(scripts.task()(0).steps.has_value());
  const std::vector<TaskStep> steps = *scripts.task()(0).steps;
  REQUIRE(steps.size() == 2);
  CHECK(steps[0].step == PlanStep{"everything", {"cube", "", ""}});
  CHECK(steps[1].step == PlanStep{"counting", {"", "bench", ""}});
  REQUIRE(steps[0].set.values.size() == 3);  // in alphabetical order
  CHECK(steps[0].set.values[0] == CallSettings::Value{"grasp", 0, {0, 0, 0.1, 0, 0, 0, 1}});
  CHECK(steps[0].set.values[1] == CallSettings::Value{"height", 0, {0.2}});
  CHECK(steps[0].set.values[2] == CallSettings::Value{"push", 0, {3, 2, 1}});
  CHECK(steps[0].set.controller == ControllerKind::joint_position);
  CHECK(steps[1].set == CallSettings{{}, ControllerKind::cartesian_impedance});
  CHECK(scripts.task()(0).stages.size() == 2);
  CHECK(scripts.task()(0).goal.parts.size() == 2);
}

TEST_CASE("tests beside the goal see the world and the variation") {
  EpisodeScripts tower(small_library(), "tower", canonical_variation(), 1);
  test::SmallWorld small;
  CHECK(tower.task()(0).reward(small.view) == 0.75);
  CHECK_FALSE(tower.task()(0).fails(small.view));
  CHECK_FALSE(small.scripts.task()(0).also(small.view));  // the cube is white
  CHECK_FALSE(small.scripts.task()(0).reward);            // it says nothing of one
}

TEST_CASE("unknown tasks and variations are told with a cure") {
  CHECK_THROWS_AS(EpisodeScripts(small_library(), "towel", "", 1), Error);
  CHECK_THROWS_WITH(EpisodeScripts(small_library(), "tower", "height=9", 1), Catch::Contains("has no variation"));
}

TEST_CASE("all files that took part are named once") {
  EpisodeScripts scripts(small_library(), "steps", "", 1);
  std::set<std::pair<std::string, std::string>> names;
  for (const DefinitionRecord& record : scripts.definitions()) {
    CHECK(names.emplace(record.kind, record.name).second);
    CHECK_FALSE(record.source.empty());
  }
  CHECK(names.count({"task", "steps"}) == 1);
  CHECK(names.count({"task", "tower"}) == 0);
  CHECK(names.count({"object", "chest"}) == 1);
  CHECK(names.count({"object", "spot"}) == 0);
  CHECK(names.count({"robot", "mini"}) == 1);
  CHECK(names.count({"world", "bench"}) == 1);
  CHECK(names.count({"predicate", "broken"}) == 1);
}
