// Every task that ships: made, planned, executed, labelled and replayed, one seed a variation of three.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "engine/episode/runner.h"
#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"
#include "engine/symbolic/pddl.h"
#include "scripting/library/library.h"
#include "scripting/runtime/episode_scripts.h"
#include "tests/support/labels.h"

using namespace stampede;
using namespace stampede::test;

namespace {

std::shared_ptr<const Library> library() {
  static const std::shared_ptr<const Library> shared = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  return shared;
}

// With the tasks of this test's own folder, which use the skills that the six tasks do not need.
std::shared_ptr<const Library> with_own_tasks() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/data"}});
  return shared;
}

EpisodeRecord run(const std::string& task, const std::string& variation, std::int64_t seed,
                  const std::shared_ptr<const Library>& scripts_of = library()) {
  EpisodeScripts scripts(scripts_of, task, variation, seed);
  RunOptions options;
  options.seed = seed;
  return run_episode(scripts.task(), scripts.symbols(), scripts.skills(), options);
}

// The first, the middle and the last variation.
std::vector<std::string> some_variations(const std::string& task) {
  const auto& all = library()->task(task)->variation_texts;
  std::vector<std::string> some = {all.front(), all[all.size() / 2], all.back()};
  some.erase(std::unique(some.begin(), some.end()), some.end());
  return some;
}

void check_effects(const EpisodeRecord& episode) {
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.kind != SegmentKind::skill) continue;
    INFO(segment.label);
    CHECK(segment.precondition_held == true);
    CHECK_FALSE(segment.preconditions.empty());
    for (const PreconditionRecord& literal : segment.preconditions) CHECK((literal.held || literal.choice >= 0));
    CHECK(segment.effect_held == true);
    CHECK_FALSE(segment.declared_effects.empty());
  }
}

}  // namespace

TEST_CASE("each task succeeds, its labels agree with the world, and it replays bit for bit") {
  const auto task = GENERATE(as<std::string>{}, "reach_target", "pick_and_lift", "stack_blocks", "put_item_in_drawer",
                             "push_buttons", "close_drawer");
  std::int64_t seed = 40;
  for (const std::string& variation : some_variations(task)) {
    const EpisodeRecord episode = run(task, variation, ++seed);
    INFO(task << " " << variation << " seed " << seed << ": " << to_string(episode.reason) << " " << episode.detail);
    REQUIRE(episode.outcome == Outcome::success);
    check_tiling(episode);
    check_effects(episode);
    check_plan(episode);
    CHECK(replay_episode(episode) == "");
  }
}

TEST_CASE("a tower is built with no step too many: a pick and a stack for each block but the lowest") {
  for (const std::string& variation : some_variations("stack_blocks")) {
    const EpisodeRecord episode = run("stack_blocks", variation, 3);
    const std::string& plan = *document_of(episode, DocumentKind::plan);
    INFO(variation << "\n" << plan);
    CHECK(std::count(plan.begin(), plan.end(), '\n') == 2 * (std::stoi(episode.axes.at("height")) - 1));
  }
}

TEST_CASE("skills that the six tasks do not need: push and place") {
  const auto [task, skill] =
      GENERATE(table<std::string, std::string>({{"push_block", "push"}, {"move_block", "place"}}));
  for (std::int64_t seed = 1; seed <= 3; ++seed) {
    const EpisodeRecord episode = run(task, "", seed, with_own_tasks());
    INFO(task << " seed " << seed << ": " << to_string(episode.reason) << " " << episode.detail);
    REQUIRE(episode.outcome == Outcome::success);
    check_effects(episode);
    const auto used = [&, name = skill](const SegmentRecord& segment) { return segment.skill == name; };
    CHECK(std::any_of(episode.labels.segments.begin(), episode.labels.segments.end(), used));
  }
}

TEST_CASE("what is held goes to a region that rides on another free body: a lid above its pan") {
  const EpisodeRecord episode = run("take_lid_off_saucepan", "", 1);
  INFO(to_string(episode.reason) << " " << episode.detail);
  REQUIRE(episode.outcome == Outcome::success);
  check_effects(episode);
  CHECK(replay_episode(episode) == "");
}

TEST_CASE("reading only the pairs that can hold gives the same facts as reading all, at every frame") {
  const std::string task = GENERATE(as<std::string>{}, "stack_blocks", "put_item_in_drawer");
  const std::string variation = library()->task(task)->variation_texts.front();
  const EpisodeRecord episode = run(task, variation, 5);
  REQUIRE(episode.outcome == Outcome::success);
  EpisodeScripts scripts(library(), task, variation, 5);
  World world(std::make_shared<const Scene>(scene_from_document(episode.scene.document)));
  WorldView view(world);
  const FactTracker tracker(scripts.symbols(), view);
  std::size_t next = 0, different = 0;
  while (world.step_count() < episode.steps) {
    while (next < episode.commands.size() && episode.commands[next].step == world.step_count())
      world.apply(episode.commands[next++].operation);
    world.step();
    if (world.step_count() % 12 != 0) continue;
    world.close_window();
    view.close_frame();
    const auto some = tracker.read_all(view), all = tracker.read_all(view, false);
    for (const auto& [fact, value] : all) different += value.holds != some.at(fact).holds;
  }
  CHECK(different == 0);
}

TEST_CASE("every task has its variations and at least four instructions, all filled in and none twice") {
  // What RLBench varies, and two tasks of checkers and chess in which six layouts of each count are told apart.
  const std::map<std::string, std::size_t> counts = {{"block_pyramid", 20},
                                                     {"change_channel", 2},
                                                     {"close_drawer", 3},
                                                     {"find_item_in_drawer", 3},
                                                     {"insert_onto_square_peg", 20},
                                                     {"lift_numbered_block", 3},
                                                     {"meat_off_grill", 2},
                                                     {"meat_on_grill", 2},
                                                     {"open_drawer", 3},
                                                     {"open_jar", 20},
                                                     {"pick_and_lift", 20},
                                                     {"pick_and_lift_small", 5},
                                                     {"pick_up_cup", 20},
                                                     {"place_cups", 3},
                                                     {"place_shape_in_shape_sorter", 5},
                                                     {"push_button", 18},
                                                     {"push_buttons", 50},
                                                     {"put_books_on_bookshelf", 3},
                                                     {"put_groceries_in_cupboard", 9},
                                                     {"put_item_in_drawer", 3},
                                                     {"put_money_in_safe", 3},
                                                     {"put_plate_in_colored_dish_rack", 20},
                                                     {"reach_and_drag", 20},
                                                     {"reach_target", 20},
                                                     {"remove_cups", 2},
                                                     {"setup_checkers", 18},
                                                     {"setup_chess", 18},
                                                     {"slide_cabinet_open", 2},
                                                     {"slide_cabinet_open_and_place_cups", 2},
                                                     {"sort_blocks", 20},
                                                     {"stack_blocks", 60},
                                                     {"stack_cups", 20},
                                                     {"take_cup_out_from_cabinet", 2},
                                                     {"take_item_out_of_drawer", 3},
                                                     {"take_money_out_safe", 3},
                                                     {"take_off_weighing_scales", 3},
                                                     {"take_plate_off_colored_dish_rack", 3},
                                                     {"turn_tap", 2},
                                                     {"weighing_scales", 3}};
  std::size_t known = 0;
  for (const ScriptFile* file : library()->files(DefinitionKind::task)) {
    const Library::TaskInfo* info = library()->task(file->name);
    REQUIRE(info != nullptr);
    const auto found = counts.find(file->name);
    known += found != counts.end() ? 1 : 0;
    INFO(file->name);
    CHECK(info->variation_texts.size() == (found == counts.end() ? 1 : found->second));
    for (const std::string& variation : {info->variation_texts.front(), info->variation_texts.back()}) {
      INFO(variation);
      EpisodeScripts scripts(library(), file->name, variation, 1);
      const std::vector<std::string> instructions = scripts.task()(0).instructions;
      CHECK(instructions.size() >= 4);
      CHECK(std::set<std::string>(instructions.begin(), instructions.end()).size() == instructions.size());
      for (const std::string& sentence : instructions) CHECK(sentence.find_first_of("{}") == std::string::npos);
    }
  }
  CHECK(known == counts.size());
}

TEST_CASE("pressing a later button first fails the episode as out of order") {
  const auto& variations = library()->task("push_buttons")->variation_texts;
  const auto two = std::find_if(variations.begin(), variations.end(),
                                [](const std::string& text) { return text.find("count=2") != std::string::npos; });
  REQUIRE(two != variations.end());
  EpisodeScripts scripts(library(), "push_buttons", *two, 7);
  const TaskDraw reversed = [&scripts](int draw) {  // the same task, demonstrated the wrong way round
    Task task = scripts.task()(draw);
    task.steps = {{{"press", {"button2.cap", "panda.hand"}}, {}}, {{"press", {"button1.cap", "panda.hand"}}, {}}};
    return task;
  };
  RunOptions options;
  options.seed = 7;
  options.on_failure = OnFailure::stop;
  const EpisodeRecord episode = run_episode(reversed, scripts.symbols(), scripts.skills(), options);
  CHECK(episode.outcome == Outcome::failure);
  CHECK(episode.reason == Reason::out_of_order);
}
