#include "scripting/program/timeline.h"

#include <catch2/catch.hpp>
#include <sstream>

#include "scripting/program/console.h"

namespace stampede::program {
namespace {

Span span(std::int64_t start, std::int64_t end) { return {start, end, start / 12, end / 12}; }

// Ten seconds: a pick of 4 s after one undone try, then a place of 6 s that fails.
EpisodeRecord small_episode() {
  EpisodeRecord e;
  e.task = "stack";
  e.variation = "colour=red";
  e.world = "tabletop";
  e.made.split = Split::train;
  e.seed = 7;
  e.steps = 2400;
  e.reason = Reason::dropped;
  e.labels.language = {{LanguageLevel::task, "stack red blocks", -1}};
  SegmentRecord pick, motion, place, tried;
  pick.kind = place.kind = tried.kind = SegmentKind::skill;
  pick.skill = tried.skill = "pick";
  pick.arguments = tried.arguments = {"block1", "table"};
  pick.span = span(0, 960);
  motion.kind = SegmentKind::motion;
  motion.skill = "move_through";
  motion.ordinal = 1;
  motion.parent = 0;
  motion.span = span(0, 480);
  place.skill = "place";
  place.ordinal = 2;
  place.arguments = {"block1", "block2"};
  place.span = span(960, 2400);
  place.outcome = Outcome::failure;
  place.reason = Reason::dropped;
  place.preconditions = {{{"holding", {"panda.hand", "block1"}}, false, true, -1},
                         {{"clear", {"block2"}}, false, false, -1},
                         {{"wet", {"block2"}}, true, false, -1},
                         {{"flat", {"block1"}}, false, false, 0}};
  tried.span = span(0, 240);
  tried.outcome = Outcome::failure;
  tried.reason = Reason::no_grasp;
  e.labels.segments = {pick, motion, place};
  e.labels.attempts = {{tried, 0, 1}};
  ViaRecord via;
  via.segment = 1;
  via.name = "approach";
  via.step = 240;
  via.speed = 0.42;
  e.labels.vias = {via};
  FactRecord held, still;
  held.fact = {"holding", {"panda.hand", "block1"}};
  held.start_step = 720;
  held.end_step = 1200;
  still.fact = {"on", {"block2", "table"}};
  still.end_step = 2400;
  still.open_start = still.open_end = true;
  e.labels.facts = {held, still};
  return e;
}

}  // namespace

TEST_CASE("a timeline tells what happened, when, why, and what it changed") {
  const std::string text = timeline(small_episode(), {100, false, "episode 1"});
  for (const char* piece :
       {"episode 1\n", "stack (colour=red), seed 7, train, world tabletop", "“stack red blocks”",
        "✗ failure after 10.00 s: dropped, a held object was lost", "✓ pick block1 table", "0.00   4.00",
        "↶ undone after 1.00 s: pick block1 table (no_grasp)", "◆ approach passed at 1.00 s, 0.42 rad/s",
        "+ holding(panda.hand, block1)", "− holding(panda.hand, block1)", "✗ place block1 block2",
        "before it was false: clear(block2), not wet(block2)\n", "and 1 facts that held throughout"}) {
    INFO(piece);
    CHECK(text.find(piece) != std::string::npos);
  }
}

TEST_CASE("bars are as long as what they stand for, and no line is wider than asked") {
  for (const int width : {60, 80, 100, 160}) {
    std::istringstream lines(timeline(small_episode(), {width, false, ""}));
    int pick = 0, place = 0;
    for (std::string line; std::getline(lines, line);) {
      int bar = 0;
      for (std::size_t at = line.find("█"); at != std::string::npos; at = line.find("█", at + 3)) ++bar;
      if (line.find("✓ pick") != std::string::npos) pick = bar;
      if (line.find("✗ place") != std::string::npos) place = bar;
      if (line.find("world tabletop") != std::string::npos || line.find("failure after") != std::string::npos) continue;
      INFO(line);
      CHECK(display_width(line) <= width);
    }
    CHECK(pick > 0);
    CHECK(std::abs(place * 4 - pick * 6) <= 10);  // 6 s against 4 s, a column of rounding each
  }
}

TEST_CASE("facts that held throughout are shown when asked for") {
  CHECK(timeline(small_episode(), {100, true, ""}).find("on(block2, table)") != std::string::npos);
  CHECK(timeline(small_episode(), {100, false, ""}).find("on(block2, table)") == std::string::npos);
}

}  // namespace stampede::program
