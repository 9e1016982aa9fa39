// What authors asked for: skills that know of their predicates, parts of variables, looks that follow facts.
#include <catch2/catch.hpp>

#include "engine/record/observation.h"
#include "engine/render/renderer.h"
#include "engine/start/effects.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

EpisodeRecord run_authors(const std::string& task, std::int64_t seed = 3) {
  RunOptions options;
  options.seed = seed;
  return run_task(task, "", options, authors());
}

bool has_action(const Domain& domain, const std::string& name) { return domain.action(name) != nullptr; }

}  // namespace

TEST_CASE("a skill that extends another is in the domains of those tasks alone that name it") {
  const Domain& own = authors()->domain_of("take_the_guarded");
  CHECK(has_action(own, "wary_pick"));
  CHECK_FALSE(has_action(own, "pick"));
  CHECK(has_action(own, "place"));
  for (const char* other : {"open_each", "pick_and_lift"}) {
    CHECK(has_action(authors()->domain_of(other), "pick"));
    CHECK_FALSE(has_action(authors()->domain_of(other), "wary_pick"));
  }
}

TEST_CASE("a fact that ends when a thing is moved is deleted by skills that know nothing of it") {
  const EpisodeRecord episode = run_authors("take_the_guarded");
  INFO(episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  const std::vector<std::string> skills = skills_of(episode);
  REQUIRE(skills.size() == 4);
  CHECK(skills[0] == "wary_pick guard");
  CHECK(skills[2] == "wary_pick rear");
  const SegmentRecord* first = nullptr;
  for (const SegmentRecord& segment : episode.labels.segments)
    if (first == nullptr && segment.kind == SegmentKind::skill) first = &segment;
  CHECK(first->arguments[0] == "guard");
  const EffectRecord ends{{"guards", {"guard", "rear"}}, true};
  CHECK(std::count(first->declared_effects.begin(), first->declared_effects.end(), ends) == 1);
  CHECK(first->effect_held == true);
}

TEST_CASE("a fact that ends when a thing is moved goes on between the thing and its own load") {
  const Action* pick = authors()->domain_of("take_the_guarded").action("wary_pick");
  REQUIRE(pick != nullptr);
  const std::vector<TypedObject> objects = {{"tray", "thing"},  {"tin", "thing"},     {"bean", "thing"},
                                            {"hold", "region"}, {"table", "fixture"}, {"panda.hand", "hand"}};
  const auto ends = [&](Facts before) {
    before.insert({"guards", {"bean", "tray"}});
    for (const char* thing : {"tray", "tin", "bean"}) before.insert({"movable", {thing}});
    const std::vector<Literal> effects = ground_effects(*pick, {"tray", "table", "panda.hand"}, before,
                                                        authors()->domain_of("take_the_guarded"), objects);
    return std::ranges::any_of(effects, [](const Literal& one) {
      return one.negated && one.fact == Fact{"guards", {"bean", "tray"}};
    });
  };
  CHECK(ends({}));
  CHECK(ends({{"on", {"bean", "table"}}}));
  CHECK_FALSE(ends({{"on", {"bean", "tray"}}}));
  CHECK_FALSE(ends({{"part_of", {"hold", "tray"}}, {"inside", {"bean", "hold"}}}));
  CHECK_FALSE(ends({{"on", {"tin", "tray"}}, {"on", {"bean", "tin"}}}));  // on what is on it
  CHECK(ends({{"part_of", {"hold", "tin"}}, {"inside", {"bean", "hold"}}}));
}

TEST_CASE("formulas name parts of variables, and part_of relates them") {
  const EpisodeRecord episode = run_authors("open_each");
  INFO(episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(skills_of(episode) == std::vector<std::string>{"open chest.top_drawer"});
  const auto holds = [&](const Fact& fact) {
    return std::any_of(episode.labels.facts.begin(), episode.labels.facts.end(),
                       [&](const FactRecord& one) { return one.fact == fact && one.open_end; });
  };
  CHECK(holds({"part_of", {"chest.top_drawer", "chest"}}));
  CHECK(holds({"part_name", {"chest.top_drawer", "top_drawer"}}));
}

TEST_CASE("an effect that counts holds when so many do, and the plan is made again from what did") {
  const EpisodeRecord episode = run_authors("fill_the_dish");
  INFO(episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  std::vector<std::set<std::string>> filled;  // by call: the beans that it says it has put inside
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.skill != "fill_some") continue;
    CHECK(segment.effect_held == true);
    CHECK(segment.missing_effects.empty());
    std::set<std::string>& beans = filled.emplace_back();
    for (const EffectRecord& effect : segment.declared_effects)
      if (effect.fact.predicate == "inside" && !effect.negated) beans.insert(effect.fact.arguments[0]);
    CHECK(beans.contains(segment.arguments[0]));
  }
  REQUIRE(filled.size() == 2);  // a plan counts on all after the first
  CHECK(filled[0].size() == 1);
  CHECK(filled[1].size() == 2);  // what is inside already is among them
  CHECK(replay_episode(episode) == "");
}

TEST_CASE("an effect that counts does not hold while too few do") {
  const Domain& domain = authors()->domain_of("fill_the_dish");
  Action fill = *domain.action("fill_some");
  const std::vector<TypedObject> objects = {
      {"bean1", "food"}, {"bean2", "food"}, {"dish", "dish"}, {"panda.hand", "hand"}};
  const std::vector<std::string> arguments = {"bean1", "dish", "panda.hand"};
  const auto counted = counted_effects(fill, arguments, {}, domain, objects);
  REQUIRE(counted.size() == 1);
  CHECK(counted[0].enough == 1);
  CHECK(counted[0].literals.size() == 2);
  for (Effect& effect : fill.effects)
    if (effect.at_least > 0) effect.at_least = 5;
  CHECK(counted_effects(fill, arguments, {}, domain, objects)[0].enough == 2);  // no more than there are
}

TEST_CASE("a lid on a thread is a thing of its own: it is unscrewed, let go of, and put down like any other") {
  RunOptions options;
  options.seed = 3;
  const EpisodeRecord episode = run_task("open_jar", first_variation("open_jar"), options);
  INFO(episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(skills_of(episode) == std::vector<std::string>{"unscrew jar.lid", "place jar.lid"});
  const auto joined = std::find_if(episode.labels.facts.begin(), episode.labels.facts.end(),
                                   [](const FactRecord& one) { return one.fact.predicate == "joined"; });
  REQUIRE(joined != episode.labels.facts.end());
  CHECK((joined->open_start && !joined->open_end));
  const auto screw = std::find_if(episode.scene.joints.begin(), episode.scene.joints.end(),
                                  [](const JointName& one) { return one.name == "jar.lid"; });
  REQUIRE(screw != episode.scene.joints.end());
  CHECK((screw->kind == "screw" && screw->unit == "rad"));
  const auto place = static_cast<std::size_t>(screw - episode.scene.joints.begin());
  const auto at = [&](std::int64_t frame) {
    return episode.frames[static_cast<std::size_t>(frame)].joint_position[place];
  };
  CHECK(std::abs(at(0)) < 0.01);
  CHECK(at(joined->end_frame) > 1.39);  // 80 degrees: there the thread lets go
  double fastest = 0;
  for (const FrameRecord& frame : episode.frames) fastest = std::max(fastest, frame.joint_velocity[place]);
  CHECK(fastest > 0.2);
  CHECK(episode.frames.back().joint_velocity[place] == 0);
  CHECK(replay_episode(episode) == "");
}

TEST_CASE("values that formulas of the library name are constants of every domain") {
  const Domain& domain = authors()->domain_of("open_jar");  // where nothing has a power button
  CHECK(std::find(domain.constants.begin(), domain.constants.end(), TypedObject{"power_button", "value"}) !=
        domain.constants.end());
}

TEST_CASE("what eight tries of authors look like now: each is done, with one seed") {
  const std::vector<std::pair<std::string, std::string>> tasks = {
      {"peg_in_bore", "insert peg"},       {"beans_into_dish", "drop bean"},     {"shut_every_lid", "close crate.lid"},
      {"wipe_stain", "wipe sponge"},       {"light_beacon", "press beacon.cap"}, {"put_away", "close crate.lid"},
      {"empty_the_pot", "pick_empty pot"}, {"tin_beside_cube", "put_beside tin"}};
  for (const auto& [task, skill] : tasks) {
    const EpisodeRecord episode = run_authors(task, 4);
    INFO(task + ": " + verdict(episode));
    CHECK(episode.outcome == Outcome::success);
    const std::vector<std::string> skills = skills_of(episode);
    CHECK(std::any_of(skills.begin(), skills.end(), [&](const std::string& one) { return one.starts_with(skill); }));
  }
}

TEST_CASE("contents are load: a full beaker is lifted, a drawer is shut with what lies in it") {
  const EpisodeRecord beaker = run_task("lift_the_full_beaker", "", {});
  INFO(verdict(beaker));
  CHECK(beaker.outcome == Outcome::success);
  CHECK(beaker.labels.attempts.empty());  // nothing undone
  for (const char* level : {"level=bottom", "level=middle", "level=top"}) {
    const EpisodeRecord drawer = run_task("store_and_shut", level, {}, authors());
    INFO(std::string(level) + ": " + verdict(drawer));
    CHECK(drawer.outcome == Outcome::success);
    CHECK(drawer.labels.attempts.empty());
  }
}

TEST_CASE("a third step that can never be grasped is not tried for ever") {
  const auto failed = [](const EpisodeRecord& episode) {
    int count = 0;
    const auto is_it = [](const SegmentRecord& segment) {
      return segment.kind == SegmentKind::skill && segment.skill == "pick" && segment.arguments[0] == "far" &&
             segment.reason == Reason::no_grasp;
    };
    for (const AttemptRecord& attempt : episode.labels.attempts) count += is_it(attempt.segment);
    for (const SegmentRecord& segment : episode.labels.segments) count += is_it(segment);
    return count;
  };
  int most = 0;
  for (const std::int64_t seed : {1, 2, 3, 4}) {  // which of both is tried first is drawn
    const EpisodeRecord episode = run_authors("take_either", seed);
    INFO(verdict(episode));
    CHECK(episode.outcome == Outcome::success);  // another way is taken
    most = std::max(most, failed(episode));
  }
  CHECK(most == 6);
  const EpisodeRecord never = run_authors("take_the_far");  // there is none: the plan is given up
  INFO(verdict(never));
  CHECK(never.reason == Reason::no_grasp);
  CHECK((failed(never) >= 2 && failed(never) <= 13));
}

TEST_CASE(
    "a tool acts with its tip: that goes where a skill sends it, and a stain that it wipes is gone from then on") {
  const EpisodeRecord episode = run_authors("wipe_stain");
  INFO(verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  const Scene scene = scene_from_document(episode.scene.document);
  const Object* tip = scene.object("sponge.tip");
  REQUIRE(tip != nullptr);
  CHECK(tip->kind == ObjectKind::region);
  const auto wiped = std::find_if(episode.labels.facts.begin(), episode.labels.facts.end(),
                                  [](const FactRecord& one) { return one.fact.predicate == "wiped"; });
  REQUIRE(wiped != episode.labels.facts.end());
  const ShownFacts gone{{"wiped", "stain"}};
  CHECK(state_at(scene, episode, wiped->first_frame - 1).facts.empty());
  CHECK(state_at(scene, episode, wiped->first_frame).facts == gone);
  // At that frame the tip is over the stain, as near to the table as the skill asked for; the hand is far above.
  const ScenePoses poses = scene_poses(scene, state_at(scene, episode, wiped->first_frame));
  const Vector3 at = poses.world_from_region[static_cast<std::size_t>(scene.region_index("sponge.tip"))].translation();
  const Vector3 stain = poses.world_from_part[static_cast<std::size_t>(scene.body_index("stain"))][0].translation();
  CHECK((at - stain).head<2>().norm() < 0.015);
  CHECK(std::abs(at.z() - stain.z() - 0.002) < 0.003);
}

TEST_CASE("a lamp shines from the frame on at which its button has been pressed") {
  RunOptions options;
  options.seed = 3;
  const EpisodeRecord episode = run_task("lamp_on", first_variation("lamp_on"), options);
  REQUIRE(episode.outcome == Outcome::success);
  const auto scene = std::make_shared<const Scene>(scene_from_document(episode.scene.document));
  const auto pressed = std::find_if(episode.labels.facts.begin(), episode.labels.facts.end(),
                                    [](const FactRecord& one) { return one.fact.predicate == "pressed"; });
  REQUIRE(pressed != episode.labels.facts.end());
  REQUIRE(pressed->first_frame > 0);
  const ShownFacts lit{{"pressed", "lamp.button"}};
  CHECK(facts_that_show(*scene) == lit);
  CHECK(state_at(*scene, episode, pressed->first_frame - 1).facts.empty());
  CHECK(state_at(*scene, episode, pressed->first_frame).facts == lit);
  CHECK(state_at(*scene, episode, static_cast<std::int64_t>(episode.frames.size()) - 1).facts == lit);

  // The same moment in both looks, drawn in turns: what is kept of one must not show in the other.
  ScenePoses poses = scene_poses(*scene, state_at(*scene, episode, 0));
  const Camera& camera = scene->cameras[static_cast<std::size_t>(1)];
  const std::vector<View> views{{camera, world_from_camera(*scene, poses, camera)}};
  std::vector<std::vector<Picture>> drawn;
  for (const DrawnBy by : {DrawnBy::own, DrawnBy::osmesa}) {
    const auto renderer = make_renderer();
    renderer->load(scene);
    for (int i = 0; i < 6; ++i) {
      poses.facts = i % 4 < 2 ? ShownFacts{} : lit;
      DrawOptions draw;
      draw.shadows = i == 5;
      draw.by = by;
      renderer->draw(poses, views, draw, drawn.emplace_back());
    }
    const std::size_t first = drawn.size() - 6;
    CHECK(drawn[first][0].rgb == drawn[first + 1][0].rgb);
    CHECK(drawn[first][0].rgb == drawn[first + 4][0].rgb);
    CHECK(drawn[first + 2][0].rgb == drawn[first + 3][0].rgb);
    CHECK(drawn[first][0].rgb != drawn[first + 2][0].rgb);
    CHECK(drawn[first][0].depth == drawn[first + 2][0].depth);
  }
}
