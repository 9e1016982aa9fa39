// Starts differ so much that nobody can learn them by heart: where arms start, where things stand, how they are taken.
#include <catch2/catch.hpp>
#include <set>

#include "tests/support/make_start.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

constexpr int kStarts = 5;  // seeds of one variation

std::vector<std::shared_ptr<const Scene>> starts(const std::string& task) {
  std::vector<std::shared_ptr<const Scene>> scenes;
  for (int seed = 300; seed < 300 + kStarts; ++seed) {
    EpisodeScripts scripts(all_tasks(), task, first_variation(task), seed);
    RunOptions options;
    options.seed = seed;
    const Start start = make_start(scripts.task(), scripts.symbols(), options);
    INFO(task << " seed " << seed << ": " << start.detail);
    REQUIRE(start.scene);
    scenes.push_back(start.scene);
  }
  return scenes;
}

// Of what `value` gives of each scene: the greatest difference of two, and the least.
template <typename Value>
std::pair<double, double> spread(const std::vector<std::shared_ptr<const Scene>>& scenes, const Value& value) {
  double greatest = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < scenes.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const double apart = (value(*scenes[a]) - value(*scenes[b])).norm();
      greatest = std::max(greatest, apart), least = std::min(least, apart);
    }
  return {greatest, least};
}

JointVector arm_of(const Scene& scene) {
  JointVector q(static_cast<Eigen::Index>(scene.robot.arm.size()));
  for (std::size_t i = 0; i < scene.robot.arm.size(); ++i)
    q[static_cast<Eigen::Index>(i)] =
        scene.robot.body.parts[static_cast<std::size_t>(scene.robot.arm[i])].joint.initial;
  return q;
}

std::string taken(const Scene& scene, const std::string& name) {
  std::string text;
  for (const Grasp& grasp : scene.object(name)->grasps)
    for (const double value : {grasp.object_from_tip.translation().x(), grasp.object_from_tip.linear()(0, 2)})
      text += std::to_string(value) + " ";
  return text;
}

}  // namespace

TEST_CASE("each start of a task has another arm, and every thing another place, in every task that ships") {
  for (const std::string& task : shipped_tasks()) {
    const auto scenes = starts(task);
    INFO(task);
    const auto [arms_most, arms_least] = spread(scenes, arm_of);
    CHECK(arms_least > 0.1);  // rad, of all joints together
    CHECK(arms_most > 0.3);
    for (const Body& body : scenes.front()->bodies) {
      if (body.fixture || body.name.ends_with("_tray")) continue;  // trays: the task says where
      const auto place = [&](const Scene& scene) -> Vector3 {
        return scene.bodies[static_cast<std::size_t>(scene.body_index(body.name))].world_from_body.translation();
      };
      INFO(body.name);
      CHECK(spread(scenes, place).first > 0.06);  // m
    }
  }
}

TEST_CASE("furniture with an open side stands behind the table and on either side of it, at many angles") {
  for (const char* task : {"put_item_in_drawer", "put_money_in_safe", "put_groceries_in_cupboard"}) {
    std::set<int> sides;
    double least = 10, most = -10;
    for (int seed = 0; seed < 24; ++seed) {
      EpisodeScripts scripts(all_tasks(), task, first_variation(task), seed);
      const Scene scene = scripts.task()(0).scene;
      for (const Body& body : scene.bodies) {
        const Object* thing = scene.object(body.name);
        if (body.fixture || thing == nullptr || thing->type != "furniture") continue;
        const double yaw = std::atan2(body.world_from_body.linear()(1, 0), body.world_from_body.linear()(0, 0));
        sides.insert(static_cast<int>(std::lround(yaw / 1.5707963)));
        least = std::min(least, yaw - 1.5707963 * std::round(yaw / 1.5707963));
        most = std::max(most, yaw - 1.5707963 * std::round(yaw / 1.5707963));
      }
    }
    INFO(task);
    CHECK(sides.size() >= 2);
    CHECK(most - least > 0.25);  // rad, beside the side
  }
}

TEST_CASE("things that are taken in few ways are taken a little differently each time") {
  for (const auto& [task, name] :
       std::vector<std::pair<std::string, std::string>>{{"unplug_charger", "charger"},
                                                        {"take_usb_out_of_computer", "stick"},
                                                        {"phone_on_base", "phone"},
                                                        {"put_knife_on_chopping_board", "knife"}}) {
    std::set<std::string> ways;
    for (int seed = 0; seed < 6; ++seed) {
      EpisodeScripts scripts(all_tasks(), task, first_variation(task), seed);
      ways.insert(taken(scripts.task()(0).scene, name));
    }
    INFO(task);
    CHECK(ways.size() == 6);
  }
}

TEST_CASE("a tower of equal blocks is built of any of them, in any order") {
  std::set<std::string> towers;
  for (int seed = 0; seed < 4; ++seed) {
    RunOptions options;
    options.seed = seed;
    const std::string variation = first_variation("stack_blocks");
    const EpisodeRecord episode = run_task("stack_blocks", variation, options);
    INFO(seed << ": " << verdict(episode));
    REQUIRE(episode.outcome == Outcome::success);
    std::string tower;
    for (const FactRecord& fact : episode.labels.facts)
      if (fact.fact.predicate == "on" && fact.open_end && fact.fact.arguments[1].starts_with("block"))
        tower += to_text(fact.fact);
    towers.insert(tower);
  }
  CHECK(towers.size() > 2);
}
