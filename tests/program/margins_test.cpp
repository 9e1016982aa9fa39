// The channel of signed margins, from the command line to SQL, arrays and environments.
#include <catch2/catch.hpp>
#include <cmath>

#include "db/catalogue.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

Said run_measured(const std::string& task, const std::string& out, std::vector<std::string> more) {
  std::vector<std::string> words = {"run", task, "--root", kRoot, "--out", out};
  words.insert(words.end(), more.begin(), more.end());
  return say(words);
}

std::string answer(const std::string& catalogue, const std::string& sql) {
  return say({"query", catalogue, sql, "--format", "csv"}).out;
}

}  // namespace

TEST_CASE("a run that asks for margins has them of every atom at every frame, whatever the number of workers") {
  const Folder folder;
  const std::string one = folder / "one.db", two = folder / "two.db";
  REQUIRE(run_measured("open_drawer", one, {"--episodes", "2", "--channels", "margins", "--workers", "1"}).code ==
          kDone);
  REQUIRE(run_measured("open_drawer", two, {"--episodes", "2", "--channels", "margins", "--workers", "2"}).code ==
          kDone);
  CHECK(Catalogue::open(one).content_hash() == Catalogue::open(two).content_hash());
  CHECK(answer(one, "SELECT DISTINCT sensor FROM sensors") == "sensor\nmargins\n");

  // A value for each frame and atom, those of facts that never held too.
  CHECK(answer(one,
               "SELECT count(*) = e.frames * count(DISTINCT s.name) AS whole, count(s.value) = count(*) AS known, "
               "min(s.frame) AS first, min(s.sample = s.frame) AS numbered FROM sensors s JOIN episodes e ON e.episode "
               "= s.episode GROUP BY s.episode") == "whole,known,first,numbered\n1,1,0,1\n1,1,0,1\n");
  CHECK(answer(one,
               "SELECT count(*) > 0 AS never FROM sensors s WHERE NOT EXISTS (SELECT 1 FROM facts f WHERE f.episode = "
               "s.episode AND f.fact = s.name)") == "never\n1\n");
  // Two frames from any change its sign says whether the fact holds.
  CHECK(
      answer(one,
             "WITH told AS (SELECT s.*, EXISTS (SELECT 1 FROM facts f WHERE f.episode = s.episode AND f.fact = s.name "
             "AND s.frame >= f.first_frame AND s.frame < f.end_frame) AS holds FROM sensors s) SELECT count(*) AS n "
             "FROM told t WHERE (CASE WHEN holds THEN value < 0 ELSE value > 0 END) AND NOT EXISTS (SELECT 1 FROM "
             "facts f WHERE f.episode = t.episode AND f.fact = t.name AND (abs(t.frame - f.first_frame) < 3 OR "
             "abs(t.frame - f.end_frame) < 3))") == "n\n0\n");
  // The margin of a fact is the greatest of its frames.
  CHECK(answer(
            one,
            "SELECT count(*) > 3 AS some, max(abs(margin - most)) < 1e-9 AS same FROM (SELECT f.margin, (SELECT "
            "max(s.value) FROM sensors s WHERE s.episode = f.episode AND s.name = f.fact AND s.frame >= "
            "f.first_frame AND s.frame < f.end_frame) AS most FROM facts f WHERE f.predicate IN ('open', 'closed'))") ==
        "some,same\n1,1\n");
  CHECK(answer(one, "SELECT DISTINCT unit FROM sensors WHERE name LIKE '(open %'") == "unit\nm\n");

  const Said replayed = say({"replay", one});
  CHECK(replayed.code == kDone);
  CHECK(says(replayed.out, "same, "));
  CHECK(says(replayed.out, "margins left out: scripts measure them"));
}

TEST_CASE("margins are recorded beside sensors, by name alone, and change nothing but the channel") {
  const Folder folder;
  const std::string plain = folder / "plain.db", all = folder / "all.db";
  REQUIRE(run_measured("reach_target", plain, {"--channels", "all"}).code == kDone);
  REQUIRE(run_measured("reach_target", all, {"--channels", "all,margins"}).code == kDone);
  CHECK(answer(plain, "SELECT DISTINCT sensor FROM sensors ORDER BY 1") == "sensor\njoint_torque\nwrench\n");
  CHECK(answer(all, "SELECT DISTINCT sensor FROM sensors ORDER BY 1") == "sensor\njoint_torque\nmargins\nwrench\n");
  const std::string same = "SELECT fact, first_frame, end_frame, margin FROM facts ORDER BY 1, 2";
  CHECK(answer(plain, same) == answer(all, same));
  // The target is a box of 5 cm: what is missing is the way from the tip to it, what there is the depth in it.
  CHECK(
      answer(all,
             "WITH tip AS (SELECT s.value, abs(h.x - p.x) - 0.025 AS x, abs(h.y - p.y) - 0.025 AS y, abs(h.z - p.z) - "
             "0.025 AS z FROM sensors s JOIN hands h ON h.episode = s.episode AND h.frame = s.frame JOIN poses p ON "
             "p.episode = s.episode AND p.frame = s.frame AND p.object = 'target' WHERE s.name = '(at panda.hand "
             "target)') SELECT count(*) > 10 AS frames, max(value) > 0.02 AS reached, min(value) < -0.3 AS away, "
             "max(abs(value + CASE WHEN value < 0 THEN sqrt(max(0, x) * max(0, x) + max(0, y) * max(0, y) + max(0, z) "
             "* max(0, z)) ELSE max(x, y, z) END)) < 1e-6 AS same FROM tip") == "frames,reached,away,same\n1,1,1,1\n");
  const Said unknown = run_measured("reach_target", folder / "no.db", {"--channels", "wrench,margin"});
  CHECK(unknown.code == kUsage);
  CHECK(says(unknown.err, "no sensor 'margin'"));
  CHECK(says(unknown.err, "did you mean 'margins'?"));
}

TEST_CASE("the margin of a hinge is in rad, beside others in m") {
  const Folder folder;
  const std::string file = folder / "d.db";
  REQUIRE(run_measured("put_tray_in_oven", file, {"--channels", "margins"}).code == kDone);
  CHECK(answer(file, "SELECT DISTINCT unit FROM sensors WHERE name LIKE '(closed %'") == "unit\nrad\n");
  CHECK(answer(file, "SELECT DISTINCT unit FROM sensors WHERE name LIKE '(holding %' OR name LIKE '(on %'") ==
        "unit\nm\n");
}

TEST_CASE("an agent observes margins from the start on, but those of what nobody can see") {
  const auto session = std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, "");
  for (const bool hidden : {false, true}) {
    Environment world =
        session->environment("find_item_in_drawer", {.channels = {"sensor/margins"}, .hidden = hidden, .record = true});
    const EnvironmentObservation seen = world.reset({.seed = 7});
    const ChannelValue& margins = seen["sensor/margins"];
    REQUIRE(margins.labels.size() == margins.reals().size());
    std::size_t of_item = 0, unknown = 0;
    for (std::size_t i = 0; i < margins.labels.size(); ++i) {
      of_item += says(margins.labels[i], " item") ? 1U : 0U;
      unknown += std::isnan(margins.reals()[i]) ? 1U : 0U;
    }
    CHECK(of_item > 0);
    CHECK(unknown == (hidden ? 0 : of_item));
  }

  Environment world = session->environment("reach_target", {.channels = {"sensor/margins"}, .record = true});
  world.reset({.seed = 7});
  const SavedState state = world.save();
  for (int again = 0; again < 2; ++again) {
    for (int i = 0; i < 3; ++i) world.step({.space = "joint_velocity", .values = {0, 0.2, 0, 0, 0, 0, 0}});
    if (again == 0) world.restore(state);
  }
  const Episode episode = world.episode();
  CHECK(session->arrays(episode, {{"sensor/margins"}}).column("sensor/margins").shape[0] == 4);  // a row a frame
  world.reset({.seed = 7, .channels = std::vector<std::string>{"gripper_pose"}});
  CHECK_THROWS_WITH(world.restore(state), Catch::Contains("only one of both reads margins"));
}

}  // namespace stampede::program
