// Debouncing: what is too short to be a fact, and when a fact began.
#include "engine/start/fact_tracker.h"

#include <catch2/catch.hpp>

#include "engine/record/observation.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

// hand_empty is true at the listed frames only; nothing else ever holds.
class Scripted : public plain::PlainSymbols {
 public:
  Value value(const Fact& fact, const WorldView& view) override {
    if (fact.predicate != "hand_empty") return {};
    const auto frame = view.world().step_count() / 12;
    return {std::find(frames.begin(), frames.end(), frame) != frames.end(), {}};
  }
  std::vector<std::int64_t> frames;
};

std::vector<FactRecord> track(const std::vector<std::int64_t>& frames, int count) {
  Scripted symbols;
  symbols.frames = frames;
  World world(std::make_shared<const Scene>(table_scene(1)));
  WorldView view(world);
  FactTracker tracker(symbols, view);
  tracker.begin(tracker.read_all(view));
  for (int frame = 1; frame <= count; ++frame) {
    for (int i = 0; i < 12; ++i) world.step();
    world.close_window();
    view.close_frame();
    tracker.frame(view);
  }
  std::vector<FactRecord> records = tracker.intervals(world.step_count(), 12);
  std::erase_if(records, [](const FactRecord& record) { return record.fact.predicate != "hand_empty"; });
  return records;
}

}  // namespace

TEST_CASE("a change shorter than the settle time is no fact") {  // 0.1 s is two frames
  CHECK(track({3}, 8).empty());
  CHECK(track({0, 1, 2, 4, 5, 6, 7, 8}, 8).size() == 1);
}

TEST_CASE("a debounced change is dated at its first moment") {
  const auto records = track({3, 4, 5, 6}, 10);
  REQUIRE(records.size() == 1);
  CHECK(records[0].first_frame == 3);
  CHECK(records[0].end_frame == 7);
  CHECK_FALSE(records[0].open_start);
  CHECK_FALSE(records[0].open_end);
}

TEST_CASE("what holds from the start and to the end is open on both sides") {
  const auto records = track({0, 1, 2, 3, 4}, 4);
  REQUIRE(records.size() == 1);
  CHECK(records[0].open_start);
  CHECK(records[0].open_end);
  CHECK(records[0].end_frame == 5);  // the frame count
}

TEST_CASE("values of attributes that are no names stay out of symbols: PDDL could not say them") {
  class Marked : public plain::PlainSymbols {
   public:
    Marked() {
      domain_.predicates.push_back(
          {"mark", {{"thing", "", {}}, {"value", "object", {}}}, PredicateKind::fixed, {}, ""});
    }
    const Domain& domain() const override { return domain_; }

   private:
    Domain domain_ = plain::domain();
  };
  Scene scene = table_scene(2);
  for (Object& object : scene.objects) {
    if (object.name == "cube1") object.attributes["mark"] = "4";
    if (object.name == "cube2") object.attributes["mark"] = "four";
  }
  Marked symbols;
  World world(std::make_shared<const Scene>(scene));
  const WorldView view(world);
  FactTracker tracker(symbols, view);
  tracker.begin({});
  CHECK(tracker.facts().contains(Fact{"mark", {"cube2", "four"}}));
  CHECK_FALSE(tracker.facts().contains(Fact{"mark", {"cube1", "4"}}));
  for (const TypedObject& object : tracker.objects()) CHECK(object.name != "4");
}

TEST_CASE("nothing is related to its own parts and regions, but by a static predicate") {
  class Related : public plain::PlainSymbols {
   public:
    Related() {
      const std::vector<Parameter> pair{{"a", "", {}}, {"b", "", {}}};
      domain_.predicates.push_back({"near", pair, PredicateKind::basic, {}, ""});
      domain_.predicates.push_back({"owns", pair, PredicateKind::fixed, {}, ""});
      domain_.predicates.push_back({"roomy", pair, PredicateKind::start, {}, ""});
      std::sort(domain_.predicates.begin(), domain_.predicates.end(),
                [](const Predicate& a, const Predicate& b) { return a.name < b.name; });
    }
    const Domain& domain() const override { return domain_; }
    Value value(const Fact&, const WorldView&) override { return {true, {}}; }

   private:
    Domain domain_ = plain::domain();
  };
  Scene scene = table_scene(1);
  Object seat;
  seat.name = "cube1.seat", seat.kind = ObjectKind::region, seat.type = "region", seat.body = "cube1";
  scene.objects.push_back(seat);
  scene.regions.push_back({"cube1.seat", "cube1", 0, Transform::Identity(), {0.01, 0.01, 0.01}, false, {}, 0});
  std::sort(scene.objects.begin(), scene.objects.end(),
            [](const Object& a, const Object& b) { return a.name < b.name; });
  Related symbols;
  World world(std::make_shared<const Scene>(scene));
  const WorldView view(world);
  FactTracker tracker(symbols, view);
  tracker.begin(tracker.read_all(view));
  CHECK(tracker.facts().contains(Fact{"near", {"cube1", "table"}}));
  CHECK(tracker.facts().contains(Fact{"near", {"cube1.seat", "table"}}));
  CHECK_FALSE(tracker.facts().contains(Fact{"near", {"cube1", "cube1.seat"}}));
  CHECK_FALSE(tracker.facts().contains(Fact{"near", {"cube1.seat", "cube1"}}));
  CHECK(tracker.facts().contains(Fact{"owns", {"cube1", "cube1.seat"}}));
  // What is only asked of starts is a fact for those who ask, of a start.
  CHECK_FALSE(tracker.facts().contains(Fact{"roomy", {"cube1", "table"}}));
  FactTracker asked(symbols, view, {"roomy"});
  asked.begin(asked.read_all(view));
  CHECK(asked.facts().contains(Fact{"roomy", {"cube1", "table"}}));
}

TEST_CASE("an interval keeps the greatest margin of its frames") {
  class Measured : public plain::PlainSymbols {
   public:
    Value value(const Fact& fact, const WorldView& view) override {
      if (fact.predicate != "hand_empty") return {};
      constexpr std::array<double, 10> kMargins{-1, 1, 3, 2, -1, -1, -1, 5, 1, 1};
      const double margin = kMargins.at(static_cast<std::size_t>(view.world().step_count() / 12));
      return {margin >= 0, margin};
    }
  } symbols;
  World world(std::make_shared<const Scene>(table_scene(1)));
  WorldView view(world);
  FactTracker tracker(symbols, view);
  tracker.begin(tracker.read_all(view));
  for (int frame = 1; frame <= 9; ++frame) {
    for (int i = 0; i < 12; ++i) world.step();
    world.close_window();
    view.close_frame();
    tracker.frame(view);
  }
  std::vector<double> greatest;
  for (const FactRecord& record : tracker.intervals(world.step_count(), 12))
    if (record.fact.predicate == "hand_empty") greatest.push_back(record.margin.value());
  CHECK(greatest == std::vector<double>{3, 5});
}
