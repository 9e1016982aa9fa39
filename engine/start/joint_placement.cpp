#include "engine/start/joint_placement.h"

#include <algorithm>
#include <cmath>

#include "engine/sim/collision_state.h"

namespace stampede {
namespace {

constexpr int kMore = 60;           // ways asked of a literal where the first do not do
constexpr int kMostAsked = 24;      // places of which the arm is asked in vain
constexpr int kMostInVain = 96;     // the same, of all searches: from then on one each
constexpr double kGap_m = 0.001;    // above what it is put down on
constexpr double kRests_m = 0.005;  // how far above it may be for it to come to rest on it

class JointSearch {
 public:
  JointSearch(const PlacementAsked& asked, Symbols& symbols, ArmQuestions& questions)
      : asked_(asked), symbols_(symbols), questions_(questions) {
    left_ = questions.in_vain < kMostInVain ? kMostAsked : 1;
    for (const Literal& literal : asked.literals) {
      const PredicateTraits traits = symbols.traits(literal.fact.predicate);
      const bool about = !literal.fact.arguments.empty() && literal.fact.arguments.front() == asked.object;
      const bool within = about && traits.requires_pairs == Pairs::near;
      if (within || !traits.made_by.empty() || asked.conditions.contains(literal.fact.predicate))
        tests_.push_back({literal});
      if (literal.negated || !about) continue;
      proposing_.push_back(literal);
      if (within) within_.push_back(literal);
      if (traits.requires_pairs == Pairs::touching && literal.fact.arguments.size() == 2) resting_.push_back(literal);
    }
    put_arm_last();
    std::ranges::stable_partition(proposing_, [&](const Literal& literal) { return !rests(literal); });
  }

  bool anything_to_test() const { return !tests_.empty(); }

  // `by`: whose ways they are; what only rests on something is put where it does so.
  std::optional<Placement> first_of(const std::vector<Placement>& ways, const Literal& by) {
    for (const Placement& way : ways) {
      if (way.object != asked_.object || !std::holds_alternative<Transform>(way.value) || !meets_at(way)) continue;
      if (rests(by) || rests_at_last()) return way;
      if (!hovering_) hovering_ = way;
    }
    return std::nullopt;
  }

  std::optional<Placement> propose(RandomKey key) {
    for (const Literal& literal : proposing_)
      if (const auto found = first_of(symbols_.sample(literal.fact, asked_.view(), *asked_.state, key, kMore), literal))
        return found;
    for (const Literal& on : resting_)
      for (const Literal& in : within_)
        if (const auto found = inside_and_on(in.fact, on.fact.arguments[1], key)) return found;
    return hovering_;
  }

  // Of which most places failed, the first of these.
  JointPlacement failed() const {
    const auto most = std::ranges::max_element(tests_, {}, &Test::failed);
    if (most == tests_.end() || most->failed == 0) return {};
    return {std::nullopt, most->literal, most->at};
  }

 private:
  struct Test {
    Literal literal;
    int failed = 0;
    std::optional<Placement> at = {};
  };

  bool rests(const Literal& literal) const {
    return std::ranges::any_of(resting_, [&](const Literal& on) { return on.fact == literal.fact; });
  }

  bool rests_at_last() const {
    return std::ranges::all_of(resting_, [&](const Literal& on) {
      return comes_to_rest_on(asked_.view(), asked_.object, on.fact.arguments[1]);
    });
  }

  void put_arm_last() {
    std::ranges::stable_partition(
        tests_, [&](const Test& test) { return !questions_.predicates.contains(test.literal.fact.predicate); });
  }

  bool meets_at(const Placement& way) {
    if (left_ <= 0) return false;
    asked_.put(way);
    const std::size_t known = questions_.predicates.size();
    const bool meets = std::ranges::all_of(tests_, [&](Test& test) { return meets_at(way, test); });
    if (questions_.predicates.size() > known) put_arm_last();
    return meets;
  }

  bool meets_at(const Placement& way, Test& test) {
    const Symbols::Value value = symbols_.value(test.literal.fact, asked_.view());
    const bool meets = value.holds != test.literal.negated;
    if (value.asked_arm) {
      questions_.predicates.insert(test.literal.fact.predicate);
      questions_.in_vain = meets ? 0 : questions_.in_vain + 1;
      left_ -= meets ? 0 : 1;
    }
    if (meets) return true;
    ++test.failed;
    test.at = way;
    return false;
  }

  // Places inside, as if the support were not there, put down on it.
  std::optional<Placement> inside_and_on(const Fact& in, const std::string& support, RandomKey key) {
    const int body = asked_.view().scene().body_index(asked_.view().object(asked_.object).body);
    CollisionState without = *asked_.state;
    without.remove(asked_.view().part_of(support));
    for (Placement way : symbols_.sample(in, asked_.view(), without, key, kMore)) {
      auto* pose = std::get_if<Transform>(&way.value);
      if (pose == nullptr || way.object != asked_.object) continue;
      asked_.put(way);
      pose->translation().z() += asked_.view().top(support) + kGap_m - asked_.view().bottom(asked_.object);
      if (asked_.state->body_free(body, *pose, 0) && meets_at(way)) return way;
    }
    return std::nullopt;
  }

  const PlacementAsked& asked_;
  Symbols& symbols_;
  ArmQuestions& questions_;
  std::vector<Test> tests_;
  std::vector<Literal> proposing_, within_, resting_;
  std::optional<Placement> hovering_;  // meets all, but comes to rest somewhere only once it falls
  int left_ = 0;                       // places of which the arm may still be asked in vain
};

}  // namespace

bool comes_to_rest_on(const WorldView& view, const std::string& thing, const std::string& below) {
  const Vector3 at = view.world_from(thing).translation();
  const double top = view.top(below);
  return std::abs(view.bottom(thing) - top) < kRests_m &&
         view.box_distance(below, {at.x(), at.y(), (view.bottom(below) + top) / 2}) <= 0;
}

JointPlacement joint_placement(const PlacementAsked& asked, const Literal& first, const std::vector<Placement>& ways,
                               Symbols& symbols, RandomKey key, ArmQuestions& questions) {
  JointSearch joint(asked, symbols, questions);
  if (!joint.anything_to_test()) return {};
  if (auto found = joint.first_of(ways, first)) return {found, {}, {}};
  if (auto found = joint.propose(key.with("joint"))) return {found, {}, {}};
  return joint.failed();
}

}  // namespace stampede
