// Sensors of a program's own.
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

#include "engine/episode/runner.h"
#include "engine/record/record.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

std::shared_ptr<SessionCore> sensing(const std::string& catalogue = {}) {
  return std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, catalogue);
}

SensorEntry tip_height(const std::string& version = {}) {
  return {.unit = "m, s",
          .components = {"height", "time"},
          .rate_hz = 40,
          .version = version,
          .read = [](const SimulatorView& now) {
            return std::vector<double>{now.pose("panda.hand").position[2], now.time_s()};
          }};
}

}  // namespace

TEST_CASE("a sensor of one's own is recorded at its rate, in arrays and catalogue, and replay leaves it out") {
  const Folder folder;
  const auto memory = sensing(), stored = sensing(folder / "d.db");
  for (const auto& session : {memory, stored}) session->add_sensor("tip", tip_height("1"));
  const Episode here = memory->run("pick_and_lift", {.seed = 7}), there = stored->run("pick_and_lift", {.seed = 7});
  CHECK(here.key == there.key);
  for (const EpisodeArrays& arrays : {memory->arrays(here, {}), stored->arrays(there, {})}) {
    const ArrayColumn &tip = arrays.column("sensor/tip"), &time = arrays.column("sensor_time/tip");
    CHECK(tip.rate_hz == 40);
    CHECK(tip.unit == "m, s");
    CHECK(tip.labels == std::vector<std::string>{"height", "time"});
    REQUIRE(tip.shape == std::vector<std::int64_t>{2 * (here.frames - 1), 2});
    const auto poses = arrays.column("gripper_pose").reals();
    for (std::size_t i = 0; i < time.reals().size(); ++i) {
      CHECK(time.reals()[i] == Approx(0.025 * static_cast<double>(i + 1)));
      CHECK(tip.reals()[2 * i + 1] == Approx(time.reals()[i]));
      if (i % 2 == 1) CHECK(tip.reals()[2 * i] == poses[7 * ((i + 1) / 2) + 2]);  // at frames, what frames say
    }
  }
  const Rows rows = stored->query(
      "SELECT name, unit, rate_hz, count(*) AS n FROM sensors WHERE sensor = 'tip' GROUP BY component ORDER BY 1");
  REQUIRE(rows.size() == 2);
  CHECK(rows.text(0, "name") == "height");
  CHECK(rows.text(0, "unit") == "m");  // of each component its own
  CHECK(rows.text(1, "unit") == "s");
  CHECK(rows.real(0, "rate_hz") == 40);
  CHECK(rows.integer(0, "n") == 2 * (here.frames - 1));

  CHECK(replay_episode(*here.record).empty());
  CHECK(not_replayed(*here.record) == std::vector<std::string>{"tip"});
  const Said replayed = say({"replay", folder / "d.db"});
  CHECK(replayed.code == kDone);
  CHECK(says(replayed.out, "same, "));
  CHECK(says(replayed.out, "sensor tip left out: only the program that recorded it can read it"));

  // All but itself is as without it.
  const auto plain = sensing();
  const Episode without = plain->run("pick_and_lift", {.seed = 7});
  CHECK(without.key != here.key);
  CHECK(without.record->state_hash == here.record->state_hash);
  CHECK_FALSE(says(say({"replay", folder / "d.db", "--json"}).out, "DIFFERENT"));
}

TEST_CASE("name, version, rate and components of a sensor are part of the key") {
  const auto key_with = [](const std::string& name, const SensorEntry& entry) {
    const auto session = sensing();
    session->add_sensor(name, entry);
    return session->run("reach_target", {.seed = 7}).key;
  };
  SensorEntry slow = tip_height("1"), other = tip_height("1");
  slow.rate_hz = 20;
  other.components = {"z", "t"};
  const std::set<std::string> different = {key_with("tip", tip_height("1")), key_with("tip", tip_height("2")),
                                           key_with("top", tip_height("1")), key_with("tip", slow),
                                           key_with("tip", other)};
  CHECK(different.size() == 5);
  CHECK(key_with("tip", tip_height("1")) == key_with("tip", tip_height("1")));
}

TEST_CASE("an agent observes a sensor of the program's, it is not known before the first reading") {
  const auto session = sensing();
  session->add_sensor("tip", tip_height());
  Environment world = session->environment(
      "reach_target", {.channels = {"gripper_pose", "sensor/tip", "sensor_time/tip"}, .record = true});
  const EnvironmentObservation first = world.reset({.seed = 7});
  CHECK(first["sensor/tip"].shape == std::vector<std::int64_t>{2});
  CHECK(std::isnan(first["sensor/tip"].reals().at(1)));
  CHECK(std::isnan(first["sensor_time/tip"].reals().at(0)));
  const SavedState state = world.save();
  for (int again = 0; again < 2; ++again) {
    for (int i = 0; i < 3; ++i) {
      const StepResult now = world.step({.space = "joint_velocity", .values = {0, 0.2, 0, 0, 0, 0, 0}});
      CHECK(now.observation["sensor/tip"].reals().at(0) == now.observation["gripper_pose"].reals().at(2));
      CHECK(now.observation["sensor/tip"].reals().at(1) == Approx(now.observation.time_s));
    }
    if (again == 0) world.restore(state);
  }
  const Episode episode = world.episode();
  CHECK(session->arrays(episode, {{"sensor/tip"}}).column("sensor/tip").shape[0] == 6);
}

TEST_CASE("what a sensor may read: joints, poses, speeds, forces, distances") {
  const auto session = sensing();
  double touch = 0, fastest = 0;
  session->add_sensor("all", {.unit = "",
                              .components = {"value"},
                              .rate_hz = 60,
                              .read = [&](const SimulatorView& now) -> std::vector<double> {
                                const auto tip = now.pose("panda.hand").position;
                                touch = std::max(touch, now.contact_force("target", "panda.hand"));
                                fastest = std::max(fastest, std::abs(now.joint_velocity("panda.joint2")));
                                const auto down = now.distance({tip[0], tip[1] + 0.3, 2}, {tip[0], tip[1] + 0.3, -1});
                                return {now.joint_position("panda.joint2") + now.joint_effort("panda.joint2") +
                                        now.opening_m() + now.velocity("target")[2] + down.value_or(9)};
                              }});
  const Episode episode = session->run("pick_and_lift", {.seed = 7});
  CAPTURE(episode.reason, episode.detail);
  CHECK(episode.outcome == Outcome::success);
  CHECK(touch > 1);
  CHECK(fastest > 0.1);
}

TEST_CASE("a sensor that fails ends the episode with the reason, one that cannot be is an error") {
  const std::vector<std::pair<std::function<std::vector<double>(const SimulatorView&)>, std::string>> bad = {
      {[](const SimulatorView&) -> std::vector<double> { throw std::runtime_error("no cable"); }, "no cable"},
      {[](const SimulatorView&) -> std::vector<double> { throw 7; }, "no std::exception"},
      {[](const SimulatorView&) {
         return std::vector<double>{1, 2, 3};
       },
       "it gave 3 values for 2 components"},
      {[](const SimulatorView&) {
         return std::vector<double>{1, std::nan("")};
       },
       "time is not a finite number"},
      {[](const SimulatorView& now) {
         return std::vector<double>{now.pose("panda.hnd").position[0], 0};
       },
       "did you mean 'panda.hand'"},
      {[](const SimulatorView& now) {
         return std::vector<double>{now.joint_position("panda.joint0"), 0};
       },
       "did you mean 'panda.joint"},
  };
  for (const auto& [read, what] : bad) {
    CAPTURE(what);
    const auto session = sensing();
    SensorEntry entry = tip_height();
    entry.read = read;
    session->add_sensor("tip", entry);
    const Episode episode = session->run("reach_target", {.seed = 4});
    CHECK(episode.reason == "sensor_error");
    CHECK_THAT(episode.detail, Catch::StartsWith("sensor 'tip' at 0.025"));
    CHECK_THAT(episode.detail, Catch::Contains(what));
    CHECK(episode.undone == 0);
    Environment world = session->environment("reach_target", {});
    world.reset({.seed = 4});
    const StepResult now = world.step({.space = "joint_velocity", .values = {0, 0.2, 0, 0, 0, 0, 0}});
    CHECK(now.terminated);
    CHECK(now.reason == "sensor_error");
    CHECK_THAT(now.detail, Catch::Contains(what));
  }

  const auto session = sensing();
  SensorEntry entry = tip_height();
  CHECK_THROWS_WITH(session->add_sensor("", entry), Catch::Contains("no name for a sensor"));
  CHECK_THROWS_WITH(session->add_sensor("a/b", entry), Catch::Contains("letters, digits and _"));
  entry.components = {};
  CHECK_THROWS_WITH(session->add_sensor("a", entry), Catch::Contains("SensorEntry::components"));
  entry = tip_height();
  entry.read = {};
  CHECK_THROWS_WITH(session->add_sensor("a", entry), Catch::Contains("SensorEntry::read"));
  entry = tip_height();
  entry.rate_hz = 0;
  CHECK_THROWS_WITH(session->add_sensor("a", entry), Catch::Contains("SensorEntry::rate_hz"));
  entry.rate_hz = 37;
  session->add_sensor("a", entry);
  CHECK_THROWS_WITH(session->run("reach_target", {.seed = 7}), Catch::Contains("divides its 240 steps a second"));
  const auto other = sensing();
  other->add_sensor("margins", tip_height());
  CHECK_THROWS_WITH(other->run("reach_target", {.seed = 7}), Catch::Contains("are called so"));
}

}  // namespace stampede::program
