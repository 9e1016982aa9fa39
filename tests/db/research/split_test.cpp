// Which episodes test: shares, held-out values, pairs never seen together.
#include "db/research/split.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

namespace stampede::research {
namespace {

std::vector<SplitEpisode> made_up(std::int64_t count) {
  std::vector<SplitEpisode> episodes;
  const std::vector<std::string> colours = {"blue", "green", "red"}, heights = {"2", "3"};
  for (std::int64_t i = 0; i < count; ++i) {
    SplitEpisode& one = episodes.emplace_back();
    one.id = i + 1, one.key = "key" + std::to_string(i), one.task = i % 2 ? "stack" : "tidy",
    one.catalogue_split = "train";
    one.axes = {{"colour", colours[static_cast<std::size_t>(i) % 3]},
                {"height", heights[static_cast<std::size_t>(i / 3) % 2]}};
    one.classes = {"table", i % 5 == 0 ? "mug" : "cube"};
    one.skills =
        i % 4 == 0 ? std::vector<std::string>{"open", "pick", "put"} : std::vector<std::string>{"pick", "put", "open"};
  }
  return episodes;
}

std::int64_t how_many(const Split& split, const std::string& name) {
  return std::count_if(split.of.begin(), split.of.end(), [&](const auto& one) { return one.second == name; });
}

Split split_by(const std::vector<SplitEpisode>& episodes, const std::string& rule) {
  return split_episodes(episodes, split_rule(rule));
}

}  // namespace

TEST_CASE("seeds: 70, 15 and 15 of a hundred of each task, the same for the same keys") {
  const auto episodes = made_up(200);
  const Split split = split_by(episodes, "seeds");
  CHECK(how_many(split, "train") == 140);
  CHECK(how_many(split, "validation") == 30);
  CHECK(how_many(split, "test") == 30);
  auto others = episodes;
  std::reverse(others.begin(), others.end());
  CHECK(split_by(others, "seeds").of == split.of);
}

TEST_CASE("the catalogue's own test seeds are the ones that test") {
  auto episodes = made_up(40);
  for (std::size_t i = 0; i < 6; ++i) episodes[i].catalogue_split = "test";
  const Split split = split_by(episodes, "seeds");
  CHECK(how_many(split, "test") == 6);
  for (const SplitEpisode& one : episodes) CHECK((one.catalogue_split == "test") == (split.of.at(one.id) == "test"));
}

TEST_CASE("what holds a held-out value tests, and nothing else does") {
  const auto episodes = made_up(60);
  const Split colour = split_by(episodes, "colour=red"), object = split_by(episodes, "object=mug"),
              task = split_by(episodes, "task=tidy");
  for (const SplitEpisode& one : episodes) {
    CHECK((colour.of.at(one.id) == "test") == (one.axes.at("colour") == "red"));
    CHECK((object.of.at(one.id) == "test") == one.classes.contains("mug"));
    CHECK((task.of.at(one.id) == "test") == (one.task == "tidy"));
  }
  CHECK(colour.held_out.at(0).second.empty());
  CHECK(colour.held_out.at(0).first == "red");
}

TEST_CASE("composition: held-out pairs are never seen in training, and each of their parts is") {
  const auto episodes = made_up(80);
  for (const std::string rule : {"composition", "composition=colour+height"}) {
    const Split split = split_by(episodes, rule);
    INFO(rule);
    REQUIRE_FALSE(split.held_out.empty());
    CHECK(how_many(split, "test") >= 16);
    std::set<std::pair<std::string, std::string>> trained;
    std::set<std::string> parts;
    for (const SplitEpisode& one : episodes) {
      if (split.of.at(one.id) == "test") continue;
      for (const std::string& skill : one.skills) parts.insert(skill);
      for (const auto& [axis, value] : one.axes) parts.insert(value);
      for (std::size_t i = 1; i < one.skills.size(); ++i) trained.emplace(one.skills[i - 1], one.skills[i]);
      trained.emplace(one.axes.at("colour"), one.axes.at("height"));
    }
    for (const HeldOut& held : split.held_out) {
      CHECK_FALSE(trained.contains({held.first, held.second}));
      CHECK((parts.contains(held.first) && parts.contains(held.second)));
    }
  }
}

TEST_CASE("splits that make no sense say what would") {
  const auto episodes = made_up(30);
  for (const std::string rule :
       {"", "colour", "colour=", "=red", "composition=colour", "composition=colour+colour", "task=,stack"})
    CHECK_THROWS_WITH(split_rule(rule), Catch::Contains("--split"));
  CHECK_THROWS_WITH(split_by(episodes, "shape=round"),
                    Catch::Contains("axis 'shape'") && Catch::Contains("colour, height"));
  CHECK_THROWS_WITH(split_by(episodes, "colour=rad"), Catch::Contains("did you mean 'red'"));
  CHECK_THROWS_WITH(split_by(episodes, "task=stock"), Catch::Contains("did you mean 'stack'"));
  CHECK_THROWS_WITH(split_by(episodes, "colour=blue,green,red"),
                    Catch::Contains("colour=blue,green,red holds out all 30 episodes"));
  CHECK_THROWS_WITH(split_by(episodes, "colour=blue,colour=cyan"),
                    Catch::Contains("'colour=cyan' is no value of colour") && Catch::Contains("composition=AXIS+AXIS"));
  auto apart = episodes;
  for (SplitEpisode& one : apart) one.axes.erase(one.task == "stack" ? "colour" : "height");
  CHECK_THROWS_WITH(split_by(apart, "composition=colour+height"),
                    Catch::Contains("no task of this catalogue has both axes 'colour' and 'height'") &&
                        Catch::Contains("stack has height; tidy has colour"));
  auto alike = episodes;
  for (SplitEpisode& one : alike) one.skills = {"pick", "put"};
  CHECK_THROWS_WITH(split_by(alike, "composition"),
                    Catch::Contains("each of its parts is still trained") && Catch::Contains("more tasks"));
  CHECK_THROWS_WITH(split_by(made_up(2), "seeds"), Catch::Contains("nothing is left to test on"));
}

}  // namespace stampede::research
