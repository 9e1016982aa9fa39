#include "engine/learning/lifting.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace stampede::learning {
namespace {

Facts without(const Facts& from, const Facts& taken) {
  Facts rest;
  std::set_difference(from.begin(), from.end(), taken.begin(), taken.end(), std::inserter(rest, rest.end()));
  return rest;
}

// Where an object stands in the changes; objects that differ in it never trade places.
using Signature = std::multiset<std::tuple<bool, std::string, std::size_t>>;

std::map<std::string, Signature> signatures(const Facts& added, const Facts& removed,
                                            const std::vector<std::string>& fixed) {
  std::map<std::string, Signature> found;
  for (const bool gone : {false, true})
    for (const Fact& fact : gone ? removed : added)
      for (std::size_t i = 0; i < fact.arguments.size(); ++i) {
        if (std::find(fixed.begin(), fixed.end(), fact.arguments[i]) != fixed.end()) continue;
        found[fact.arguments[i]].insert({gone, fact.predicate, i});
      }
  return found;
}

// All orders of objects sorted by signature, those with equal signatures in every order.
class Orders {
 public:
  explicit Orders(const std::map<std::string, Signature>& signatures) {
    std::map<Signature, std::vector<std::string>> by_signature;
    for (const auto& [object, signature] : signatures) by_signature[signature].push_back(object);
    for (auto& [signature, objects] : by_signature) groups_.push_back(std::move(objects));
  }
  template <typename Visit>
  void each(Visit&& visit, std::vector<std::string> begun = {}, std::size_t group = 0) {
    if (group == groups_.size()) return visit(begun);
    std::vector<std::string> order = groups_[group];  // sorted
    do {
      std::vector<std::string> longer = begun;
      longer.insert(longer.end(), order.begin(), order.end());
      each(visit, std::move(longer), group + 1);
    } while (std::next_permutation(order.begin(), order.end()));
  }

 private:
  std::vector<std::vector<std::string>> groups_;
};

}  // namespace

LiftedAtoms lifted(const Facts& facts, const std::vector<std::string>& objects) {
  std::map<std::string_view, int> place;
  for (std::size_t i = 0; i < objects.size(); ++i) place[objects[i]] = static_cast<int>(i);
  LiftedAtoms atoms;
  for (const Fact& fact : facts) {
    LiftedAtom atom{fact.predicate, {}};
    for (const std::string& argument : fact.arguments) {
      const auto found = place.find(argument);
      if (found == place.end()) break;
      atom.slots.push_back(found->second);
    }
    if (atom.slots.size() == fact.arguments.size()) atoms.insert(std::move(atom));
  }
  return atoms;
}

Fact ground(const LiftedAtom& atom, const std::vector<std::string>& objects) {
  Fact fact{atom.predicate, {}};
  for (const int slot : atom.slots) fact.arguments.push_back(objects[static_cast<std::size_t>(slot)]);
  return fact;
}

LiftedChange lifted_change(const Facts& before, const Facts& after, const std::vector<std::string>& fixed,
                           std::size_t most) {
  const Facts added = without(after, before), removed = without(before, after);
  const std::map<std::string, Signature> further = signatures(added, removed, fixed);
  LiftedChange best;
  if (further.size() > most) return best;
  Orders(further).each([&](const std::vector<std::string>& order) {
    std::vector<std::string> objects = fixed;
    objects.insert(objects.end(), order.begin(), order.end());
    LiftedAtoms plus = lifted(added, objects), minus = lifted(removed, objects);
    const auto now = std::tie(plus, minus), least = std::tie(best.added, best.removed);
    if (!best.orders.empty() && least < now) return;
    if (best.orders.empty() || now < least) {
      best.orders.clear();
      best.added = std::move(plus);
      best.removed = std::move(minus);
    }
    best.orders.push_back(std::move(objects));
  });
  return best;
}

}  // namespace stampede::learning
