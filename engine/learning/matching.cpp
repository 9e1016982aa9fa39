#include "engine/learning/matching.h"

#include <algorithm>
#include <cctype>
#include <map>

#include "engine/learning/assignment.h"
#include "engine/learning/counts.h"
#include "engine/learning/literals.h"

namespace stampede::learning {
namespace {

constexpr double kAlmost = 0.8;  // an action gives way to another for so much of its best likeness

struct Side {
  const Action* action;
  ActionLiterals literals;
};

// Where arguments stand: two parameters that share no place need not be tried for each other.
using Places = std::set<std::tuple<bool, std::string, bool, std::size_t>>;

Places places(const ActionLiterals& literals, int slot) {
  Places found;
  for (const bool effect : {false, true})
    for (const LiftedLiteral& one : effect ? literals.effect : literals.precondition)
      for (std::size_t i = 0; i < one.atom.slots.size(); ++i)
        if (one.atom.slots[i] == slot) found.insert({effect, one.atom.predicate, one.negated, i});
  return found;
}

double f1(const Literals& truth, const Literals& learned, const std::vector<int>& slot_of) {
  Counts counts;
  for (LiftedLiteral one : truth) {
    if (replaced(one, slot_of) && learned.contains(one)) {
      ++counts.right;
    } else {
      ++counts.missed;
    }
  }
  counts.wrong = static_cast<std::int64_t>(learned.size()) - counts.right;
  return counts.f1();
}

// Tries all parameters of the learned action for each of the true one, where they share a place or stand at the same
// place of the list, and keeps the best.
class ParameterSearch {
 public:
  ParameterSearch(const Side& learned, const Side& truth, const Domain& domain, bool by_name)
      : learned_(learned), truth_(truth), slot_of_(truth.action->parameters.size(), -1) {
    const std::vector<Parameter>& mine = learned.action->parameters;
    for (std::size_t i = 0; i < slot_of_.size(); ++i) {
      const Places here = places(truth.literals, static_cast<int>(i));
      std::vector<int> options;
      for (std::size_t j = 0; j < mine.size(); ++j) {
        const std::string &a = mine[j].type, &b = truth.action->parameters[i].type;
        if (domain.types.contains(a) && !domain.is_a(a, b) && !domain.is_a(b, a)) continue;
        const Places there = places(learned.literals, static_cast<int>(j));
        const bool share = std::any_of(here.begin(), here.end(), [&](const auto& one) { return there.contains(one); });
        if (share || (by_name && i == j)) options.push_back(static_cast<int>(j));
      }
      std::stable_partition(options.begin(), options.end(), [&](int one) { return one == static_cast<int>(i); });
      options_.push_back(std::move(options));
    }
    extend(0);
  }
  double likeness = -1;
  std::vector<int> best;

 private:
  void extend(std::size_t parameter) {
    if (tried_ > kMost) return;
    if (parameter == slot_of_.size()) return judge();
    for (const int option : options_[parameter]) {
      if (std::find(slot_of_.begin(), slot_of_.end(), option) != slot_of_.end()) continue;
      slot_of_[parameter] = option;
      extend(parameter + 1);
      slot_of_[parameter] = -1;
    }
    extend(parameter + 1);
  }

  void judge() {
    ++tried_;
    const double now = (f1(truth_.literals.effect, learned_.literals.effect, slot_of_) +
                        f1(truth_.literals.precondition, learned_.literals.precondition, slot_of_)) /
                       2;
    if (now <= likeness + 1e-12) return;
    likeness = now;
    best = slot_of_;
  }

  static constexpr int kMost = 20'000;
  const Side &learned_, &truth_;
  std::vector<std::vector<int>> options_;
  std::vector<int> slot_of_;
  int tried_ = 0;
};

std::vector<Side> sides(const Domain& domain, const Domain& truth, const std::set<std::string>* among) {
  std::vector<Side> found;
  for (const Action& action : domain.actions) {
    if (among != nullptr && !among->contains(action.name)) continue;
    found.push_back({&action, literals_of(action)});
    std::erase_if(found.back().literals.effect, [&](const LiftedLiteral& one) {
      const Predicate* predicate = truth.predicate(one.atom.predicate);
      return predicate != nullptr && predicate->kind == PredicateKind::derived;
    });
  }
  return found;
}

// The place of the true action that the name says, -1: it says none.
int named(const Action& action, const std::vector<Side>& truths) {
  int best = -1;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    const std::string& name = truths[i].action->name;
    if (action.name == name || action.skill == name) return static_cast<int>(i);
    if (!action.name.starts_with(name + "_")) continue;
    if (best < 0 || truths[static_cast<std::size_t>(best)].action->name.size() < name.size())
      best = static_cast<int>(i);
  }
  return best;
}

ActionMatch made(const Side& learned, const Side& truth, const ParameterSearch& search, bool by_name) {
  return {learned.action->name, truth.action->name, search.best, search.likeness, by_name};
}

}  // namespace

std::vector<ActionMatch> match_actions(const Domain& learned, const Domain& truth, const std::set<std::string>& among) {
  const std::vector<Side> mine = sides(learned, truth, nullptr), theirs = sides(truth, truth, &among);
  const std::vector<Side> any = sides(truth, truth, nullptr);
  std::vector<ActionMatch> matches(mine.size());
  std::vector<std::size_t> open;
  std::vector<std::vector<ParameterSearch>> searches;
  std::vector<std::vector<double>> gains;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    matches[i].learned = mine[i].action->name;
    const int at = named(*mine[i].action, theirs);
    if (at >= 0) {
      const Side& it = theirs[static_cast<std::size_t>(at)];
      matches[i] = made(mine[i], it, ParameterSearch(mine[i], it, truth, true), true);
      continue;
    }
    if (named(*mine[i].action, any) >= 0) continue;  // that of a true action which is not in question
    open.push_back(i);
    searches.emplace_back();
    gains.emplace_back();
    for (const Side& it : theirs) {
      searches.back().emplace_back(mine[i], it, truth, false);
      const double likeness = searches.back().back().likeness;
      gains.back().push_back(likeness >= kLeastLike ? likeness : 0);
    }
  }
  const std::vector<int> assigned = best_assignment(gains);
  for (std::size_t k = 0; k < open.size(); ++k) {
    const auto most = std::max_element(gains[k].begin(), gains[k].end());
    int at = assigned[k];
    if (most == gains[k].end() || *most <= 0) continue;
    if (at < 0 || gains[k][static_cast<std::size_t>(at)] < kAlmost * *most)
      at = static_cast<int>(most - gains[k].begin());
    const auto place = static_cast<std::size_t>(at);
    matches[open[k]] = made(mine[open[k]], theirs[place], searches[k][place], false);
  }
  return matches;
}

const ActionMatch* match_of(const std::vector<ActionMatch>& matches, const std::string& learned) {
  const auto at = std::find_if(matches.begin(), matches.end(),
                               [&](const ActionMatch& one) { return one.learned == learned && !one.truth.empty(); });
  return at == matches.end() ? nullptr : &*at;
}

}  // namespace stampede::learning
