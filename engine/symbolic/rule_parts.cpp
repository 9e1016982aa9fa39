#include "engine/symbolic/rule_parts.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace stampede::symbolic {

std::set<int> variables_of(const Conjunct& one) {
  std::set<int> found(one.extra.begin(), one.extra.end());
  const auto note = [&](const LiftedTerm& term) {
    if (term.variable) found.insert(term.id);
  };
  for (const LiftedAtom& at : one.positive) std::for_each(at.terms.begin(), at.terms.end(), note);
  for (const LiftedAtom& at : one.negative) std::for_each(at.terms.begin(), at.terms.end(), note);
  for (const Equality& at : one.equalities) note(at.left), note(at.right);
  return found;
}

void take_apart(Conjunct& mine, Conjunct& rest, int variable) {
  const auto is_it = [&](const LiftedTerm& term) { return term.variable && term.id == variable; };
  const auto speaks = [&](const LiftedAtom& one) { return std::any_of(one.terms.begin(), one.terms.end(), is_it); };
  const auto move = [](auto& from, auto& to, const auto& stays) {
    std::copy_if(from.begin(), from.end(), std::back_inserter(to), [&](const auto& one) { return !stays(one); });
    std::erase_if(from, [&](const auto& one) { return !stays(one); });
  };
  move(mine.positive, rest.positive, speaks);
  move(mine.negative, rest.negative, speaks);
  move(mine.equalities, rest.equalities, [&](const Equality& one) { return is_it(one.left) || is_it(one.right); });
  move(mine.extra, rest.extra, [&](int one) { return one == variable; });
}

int least_bound(const Conjunct& body, const std::set<int>& kept, std::set<int>& beside) {
  int best = -1;
  for (const int id : variables_of(body)) {
    if (kept.contains(id)) continue;
    Conjunct mine = body, rest;
    take_apart(mine, rest, id);
    std::set<int> others = variables_of(mine);
    others.erase(id);
    if (best >= 0 && others.size() >= beside.size()) continue;
    best = id;
    beside = std::move(others);
  }
  return best;
}

}  // namespace stampede::symbolic
