// Hidden state: what is true in a closed drawer and what is known of it.
#include <catch2/catch.hpp>
#include <filesystem>

#include "db/catalogue.h"
#include "engine/start/abstract_state.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

EpisodeRecord find_item(const std::string& level, std::int64_t seed,
                        const std::shared_ptr<const Library>& library = all_tasks()) {
  RunOptions options;
  options.seed = seed;
  EpisodeRecord episode = run_task("find_item_in_drawer", "hidden_in=" + level, options, library);
  INFO(level << " seed " << seed << ": " << verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  return episode;
}

const FactRecord* interval(const std::vector<FactRecord>& facts, const Fact& fact) {
  const auto found =
      std::find_if(facts.begin(), facts.end(), [&](const FactRecord& record) { return record.fact == fact; });
  return found == facts.end() ? nullptr : &*found;
}

std::int64_t number(const Catalogue& catalogue, const std::string& sql) {
  const QueryResult result = catalogue.query(sql);
  REQUIRE(result.rows.size() == 1);
  return std::get<std::int64_t>(result.rows[0][0]);
}

}  // namespace

TEST_CASE("an item in a closed drawer is inside and not known to be, until its drawer is open") {
  const auto level = GENERATE(as<std::string>{}, "bottom", "middle", "top");
  const EpisodeRecord episode = find_item(level, 11);
  const std::string drawer = "chest." + level + "_drawer";
  const FactRecord* real = interval(episode.labels.facts, {"inside", {"item", drawer}});
  const FactRecord* known = interval(episode.labels.observed_facts, {"inside", {"item", drawer}});
  const FactRecord* open = interval(episode.labels.facts, {"open", {drawer}});
  REQUIRE((real != nullptr && known != nullptr && open != nullptr));
  CHECK(real->open_start);
  CHECK_FALSE(real->observed);
  CHECK_FALSE(known->open_start);
  // Seen at a frame at which the drawer is far enough open: `open` is dated at the same frame, whatever its settle
  // time.
  CHECK(known->first_frame == open->first_frame);
  CHECK(known->end_step == real->end_step);  // taken out in everybody's sight
  const std::vector<std::string> skills = skills_of(episode);
  REQUIRE(skills.size() >= 3);  // other drawers may have been looked into before
  CHECK(std::vector<std::string>(skills.end() - 3, skills.end()) ==
        std::vector<std::string>{"open " + drawer, "take_out item", "place item"});

  const AbstractState before = abstract_state(episode, 0), after = abstract_state(episode, known->first_frame);
  const Fact fact{"inside", {"item", drawer}};
  CHECK((before.facts.contains(fact) && !before.observed.contains(fact)));
  CHECK((after.facts.contains(fact) && after.observed.contains(fact)));
}

TEST_CASE("what happens in sight is known while it is so, and no frame longer or shorter") {
  for (const char* task : {"pick_and_lift", "put_item_in_drawer", "put_groceries_in_cupboard"}) {
    RunOptions options;
    options.seed = 11;
    const EpisodeRecord episode = run_task(task, first_variation(task), options);
    INFO(task);
    std::size_t count = 0;
    for (const FactRecord& fact : episode.labels.facts) {
      if (fact.fact.predicate != "inside") continue;
      ++count;
      CHECK(fact.observed);
      CHECK(std::ranges::any_of(episode.labels.observed_facts, [&](const FactRecord& known) {
        return known.fact == fact.fact && known.start_step == fact.start_step && known.end_step == fact.end_step &&
               known.first_frame == fact.first_frame && known.end_frame == fact.end_frame;
      }));
    }
    CHECK(count > 0);
  }
}

TEST_CASE("plans know what has been seen, assume the rest and plan again: drawers are opened until the item is seen") {
  int looked_in_vain = 0;
  std::set<std::string> first;
  for (std::int64_t seed = 21; seed < 25; ++seed) {
    const EpisodeRecord episode = find_item("middle", seed);
    const std::vector<std::string> skills = skills_of(episode);
    first.insert(skills.front());
    looked_in_vain += skills.size() > 3 ? 1 : 0;
    const std::string* plan = document_of(episode, DocumentKind::plan);
    REQUIRE(plan != nullptr);
    INFO(*plan);
    CHECK(plan->find("; assumed (inside item chest.middle_drawer) and saw that it holds\n") != std::string::npos);
    const bool wrong = plan->find("and saw that it does not hold") != std::string::npos;
    CHECK(wrong == (skills.size() > 3));
    const auto shows = [](const SegmentRecord& one) { return !one.searched_for.empty(); };
    std::ptrdiff_t assumptions = 0;
    for (std::size_t at = plan->find("; assumed "); at != std::string::npos; at = plan->find("; assumed ", at + 1))
      ++assumptions;
    CHECK(std::count_if(episode.labels.segments.begin(), episode.labels.segments.end(), shows) == assumptions);
    const auto search = std::find_if(episode.labels.segments.begin(), episode.labels.segments.end(), shows);
    CHECK((search->kind == SegmentKind::skill && search->skill == "open"));
    CHECK(search->searched_for.front().starts_with("(inside item chest."));
    CHECK(plan->find("; step 1 searched: (" + skills.front() + " panda.hand)\n") != std::string::npos);
  }
  CHECK(first.size() > 1);
  CHECK(looked_in_vain > 0);
}

TEST_CASE("drawers opened in vain are shut before one below them is opened: plans know that they cover it") {
  for (std::int64_t seed = 500000; seed < 500004; ++seed) {
    const std::vector<std::string> skills = skills_of(find_item("bottom", seed));
    std::set<std::string> open;
    for (const std::string& skill : skills) {
      const std::string drawer = skill.substr(skill.find(' ') + 1);
      if (skill.starts_with("close ")) open.erase(drawer);
      if (!skill.starts_with("open ")) continue;
      if (drawer == "chest.middle_drawer") CHECK_FALSE(open.contains("chest.top_drawer"));
      if (drawer == "chest.bottom_drawer") CHECK(open.empty());
      open.insert(drawer);
    }
  }
}

TEST_CASE("drawers opened in vain are closed where both are in the way of the third, what lies in that is not") {
  const EpisodeRecord episode = find_item("bottom", 500000, unaware());
  const auto together = [](const AttemptRecord& attempt) {
    return attempt.segment.detail.find("in the way: chest.middle_drawer, chest.top_drawer") != std::string::npos;
  };
  CHECK(std::any_of(episode.labels.attempts.begin(), episode.labels.attempts.end(), together));
  const std::vector<std::string> skills = skills_of(episode);
  CHECK(std::any_of(skills.begin(), skills.end(), [](const std::string& one) { return one.starts_with("close"); }));
  CHECK(episode.labels.attempts.size() < 20);
}

TEST_CASE("the catalogue keeps both versions: facts and observed_facts") {
  EpisodeRecord episode = find_item("middle", 12);
  episode.made.key = "hidden";
  const auto path = std::filesystem::temp_directory_path() / "stampede_hidden_test.db";
  std::filesystem::remove(path);
  Catalogue catalogue = Catalogue::write(path);
  catalogue.add(episode, {"test", "probe"});
  const std::string at_start = " WHERE predicate = 'inside' AND arg1 = 'item' AND first_frame = 0";
  CHECK(number(catalogue, "SELECT count(*) FROM facts" + at_start) == 1);
  CHECK(number(catalogue, "SELECT count(*) FROM observed_facts" + at_start) == 0);
  CHECK(number(catalogue, "SELECT count(*) FROM observed_facts WHERE predicate = 'inside' AND arg1 = 'item'") == 1);
  // What does not hide is known as it is.
  const std::string on = " WHERE predicate = 'on' AND arg1 = 'item'";
  CHECK(number(catalogue, "SELECT count(*) FROM observed_facts" + on) ==
        number(catalogue, "SELECT count(*) FROM facts" + on));
  std::filesystem::remove(path);
}
