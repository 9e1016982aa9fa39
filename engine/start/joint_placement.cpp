#include "engine/start/joint_placement.h"

#include <algorithm>

#include "engine/sim/collision_state.h"

namespace stampede {
namespace {

constexpr int kMore = 60;         // ways asked of a literal where the first do not do
constexpr double kGap_m = 0.001;  // above what it is put down on

class JointSearch {
 public:
  JointSearch(const PlacementAsked& asked, Symbols& symbols) : asked_(asked), symbols_(symbols) {
    for (const Literal& literal : asked.literals) {
      const bool about = !literal.fact.arguments.empty() && literal.fact.arguments.front() == asked.object;
      const bool within = about && symbols.traits(literal.fact.predicate).requires_pairs == Pairs::near;
      const bool related = !symbols.traits(literal.fact.predicate).made_by.empty();
      if (within || related || asked.conditions.contains(literal.fact.predicate)) tests_.push_back(literal);
      if (literal.negated || !about) continue;
      proposing_.push_back(literal);
      if (within) within_.push_back(literal);
      const bool touches = symbols.traits(literal.fact.predicate).requires_pairs == Pairs::touching;
      if (touches && literal.fact.arguments.size() == 2) resting_.push_back(literal);
    }
  }

  bool anything_to_test() const { return !tests_.empty(); }

  std::optional<Placement> first_of(const std::vector<Placement>& ways) const {
    for (const Placement& way : ways)
      if (way.object == asked_.object && std::holds_alternative<Transform>(way.value) && meets_at(way)) return way;
    return std::nullopt;
  }

  std::optional<Placement> propose(RandomKey key) const {
    for (const Literal& literal : proposing_)
      if (const auto found = first_of(symbols_.sample(literal.fact, asked_.view(), *asked_.state, key, kMore)))
        return found;
    for (const Literal& on : resting_)
      for (const Literal& in : within_)
        if (const auto found = inside_and_on(in.fact, on.fact.arguments[1], key)) return found;
    return std::nullopt;
  }

 private:
  bool meets_at(const Placement& way) const {
    asked_.put(way);
    const WorldView& view = asked_.view();
    return std::ranges::all_of(
        tests_, [&](const Literal& literal) { return symbols_.value(literal.fact, view).holds != literal.negated; });
  }

  // Places inside, as if the support were not there, put down on it.
  std::optional<Placement> inside_and_on(const Fact& in, const std::string& support, RandomKey key) const {
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
  std::vector<Literal> tests_, proposing_, within_, resting_;
};

}  // namespace

std::optional<Placement> joint_placement(const PlacementAsked& asked, const std::vector<Placement>& ways,
                                         Symbols& symbols, RandomKey key) {
  const JointSearch joint(asked, symbols);
  if (!joint.anything_to_test()) return std::nullopt;
  if (auto found = joint.first_of(ways)) return found;
  return joint.propose(key.with("joint"));
}

}  // namespace stampede
