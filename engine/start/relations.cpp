#include "engine/start/relations.h"

#include <algorithm>
#include <cmath>

#include "engine/model/operation.h"
#include "engine/sim/collision_state.h"
#include "engine/sim/world.h"
#include "engine/start/constraints.h"
#include "engine/start/joint_placement.h"
#include "engine/start/world_view.h"

namespace stampede {
namespace {

void name_all(const Formula& formula, std::set<std::string>& names) { names.merge(predicates_of(formula)); }

// The world as it is, but for one thing that is put elsewhere.
class Imagined {
 public:
  explicit Imagined(const WorldView& view)
      : world_(std::make_shared<const Scene>(scene_as_it_is(view))), view_(world_) {}
  const WorldView& view() const { return view_; }
  CollisionState space() const { return world_.collision_state(); }

  bool put(const Placement& way) {
    const auto* pose = std::get_if<Transform>(&way.value);
    const int body = view_.scene().body_index(view_.object(way.object).body);
    if (pose == nullptr || body < 0 || !view_.scene().bodies[static_cast<std::size_t>(body)].free) return false;
    world_.apply(operation::Place{body, *pose});
    return true;
  }

 private:
  World world_;
  WorldView view_;
};

// Clearly so: a thing that is let go of comes to rest a little beside its place.
bool clearly(const Literal& literal, Symbols& symbols, const WorldView& view) {
  constexpr double kSpare = 0.004;  // m or rad
  const Symbols::Value value = symbols.value(literal.fact, view);
  if (value.holds == literal.negated) return false;
  return !value.margin || std::abs(*value.margin) >= kSpare;
}

// Places for a thing that is put down, told apart by what is asked of it.
class RelatedSearch {
 public:
  RelatedSearch(const std::vector<Literal>& asked, const Fact& on, const WorldView& view, Symbols& symbols)
      : asked_(asked), on_(on), thing_(on.arguments.front()), symbols_(symbols), imagined_(view) {}

  void sort_in(const std::vector<Placement>& ways, bool sampled_there) {
    for (const Placement& way : ways) {
      if (way.object != thing_ || !imagined_.put(way)) continue;
      if (!sampled_there && !comes_to_rest_on(imagined_.view(), thing_, on_.arguments.at(1))) continue;
      if (!meets_own(thing_)) continue;
      (later_than(thing_).empty() ? whole_ : own_).push_back(way);
    }
  }

  // All that is asked holds at the first; at the next, things that come after it have places; then the others.
  std::vector<Placement> take(RandomKey key) {
    constexpr std::size_t kLookedAt = 24;
    std::vector<Placement> others;
    for (std::size_t i = 0; i < own_.size(); ++i) {
      const bool room = i < kLookedAt && imagined_.put(own_[i]) && leaves_room(key.with(static_cast<std::int64_t>(i)));
      (room ? whole_ : others).push_back(own_[i]);
    }
    whole_.insert(whole_.end(), others.begin(), others.end());
    return std::move(whole_);
  }

 private:
  bool meets_own(const std::string& thing) {
    return std::ranges::all_of(asked_, [&](const Literal& literal) {
      return literal.fact.arguments.front() != thing || clearly(literal, symbols_, imagined_.view());
    });
  }

  // First arguments of what does not hold of the thing as a further argument.
  std::set<std::string> later_than(const std::string& thing) {
    std::set<std::string> later;
    for (const Literal& literal : asked_) {
      const auto& names = literal.fact.arguments;
      if (std::find(names.begin() + 1, names.end(), thing) == names.end()) continue;
      if (!clearly(literal, symbols_, imagined_.view())) later.insert(names.front());
    }
    return later;
  }

  bool leaves_room(RandomKey key) {
    constexpr int kTried = 24;
    const CollisionState space = imagined_.space();
    return std::ranges::all_of(later_than(thing_), [&](const std::string& later) {
      return std::ranges::any_of(asked_, [&](const Literal& literal) {
        if (literal.negated || literal.fact.arguments.front() != later) return false;
        Imagined next(imagined_.view());
        const auto ways = symbols_.sample(literal.fact, imagined_.view(), space, key, kTried);
        return std::ranges::any_of(ways, [&](const Placement& way) {
          return way.object == later && next.put(way) && std::ranges::all_of(asked_, [&](const Literal& one) {
                   return one.fact.arguments.front() != later || clearly(one, symbols_, next.view());
                 });
        });
      });
    });
  }

  const std::vector<Literal>& asked_;
  const Fact& on_;
  const std::string& thing_;
  Symbols& symbols_;
  Imagined imagined_;
  std::vector<Placement> whole_, own_;
};

}  // namespace

std::set<std::string> named_by(const Task& task, const Symbols& symbols) {
  std::set<std::string> names = task.named;
  name_all(task.goal, names);
  if (task.where) name_all(*task.where, names);
  for (const Formula& stage : task.stages) name_all(stage, names);
  for (const Subgoal& subgoal : task.subgoals) name_all(subgoal.formula, names);
  for (const Literal& literal : task.init) names.insert(literal.fact.predicate);
  for (const Fact& fact : task.told) names.insert(fact.predicate);
  for (const Action& action : symbols.domain().actions) {
    name_all(action.precondition, names);
    for (const Effect& effect : action.effects) {
      names.insert(effect.predicate);
      name_all(effect.when, names);
    }
  }
  for (const Predicate& predicate : symbols.domain().predicates)
    if (predicate.kind == PredicateKind::derived) name_all(predicate.derived, names);
  std::erase_if(names, [&](const std::string& name) { return !symbols.traits(name).only_named; });
  return names;
}

std::vector<Literal> relations_asked(const Task& task, const FactTracker& facts) {
  const Symbols& symbols = facts.symbols();
  const auto is_relation = [&](const std::string& name) { return !symbols.traits(name).made_by.empty(); };
  if (std::ranges::none_of(predicates_of(task.goal), is_relation)) return {};
  const RandomKey key = RandomKey("relations").with(task.name).with(task.variation);
  auto drawn = draw_literals(task.goal, symbols, facts.objects(), facts.fixed(), key);
  if (!drawn) return {};
  std::erase_if(*drawn, [&](const Literal& literal) { return !is_relation(literal.fact.predicate); });
  return *drawn;
}

std::vector<Placement> related_placements(const std::vector<Literal>& asked, const Fact& on, const WorldView& view,
                                          const CollisionState& space, Symbols& symbols, RandomKey key, int most) {
  constexpr int kMore = 4;  // times as many, of which some will do
  RelatedSearch search(asked, on, view, symbols);
  search.sort_in(symbols.sample(on, view, space, key, kMore * most), true);
  for (const Literal& literal : asked)
    if (!literal.negated && literal.fact.arguments.front() == on.arguments.front())
      search.sort_in(symbols.sample(literal.fact, view, space, key.with(to_text(literal.fact)), most), false);
  return search.take(key.with("next"));
}

std::optional<Literal> relation_without_room(const std::vector<Literal>& asked, const FactTracker& facts,
                                             const WorldView& view, Symbols& symbols, RandomKey key) {
  constexpr int kTried = 8;
  Imagined imagined(view);
  std::set<std::string> moved;
  for (;;) {
    const auto unmet = [&](const Literal& literal) {
      return symbols.value(literal.fact, imagined.view()).holds == literal.negated;
    };
    std::set<std::string> waiting;
    for (const Literal& literal : asked)
      if (unmet(literal)) waiting.insert(literal.fact.arguments.front());
    const auto next = std::ranges::find_if(waiting, [&](const std::string& thing) {
      return std::ranges::all_of(asked, [&](const Literal& literal) {
        const auto& names = literal.fact.arguments;
        return names.front() != thing || std::none_of(names.begin() + 1, names.end(), [&](const std::string& other) {
                 return waiting.contains(other);
               });
      });
    });
    if (next == waiting.end() || !moved.insert(*next).second) return std::nullopt;
    const auto on = std::ranges::find_if(facts.facts(), [&](const Fact& fact) {
      return fact.arguments.size() == 2 && fact.arguments.front() == *next &&
             symbols.traits(fact.predicate).requires_pairs == Pairs::touching;
    });
    if (on == facts.facts().end()) return std::nullopt;
    const auto ways =
        related_placements(asked, *on, imagined.view(), imagined.space(), symbols, key.with(*next), kTried);
    if (ways.empty() && moved.size() == 1) return std::nullopt;
    if (ways.empty())
      return *std::ranges::find_if(
          asked, [&](const Literal& literal) { return literal.fact.arguments.front() == *next && unmet(literal); });
    imagined.put(ways.front());
  }
}

}  // namespace stampede
