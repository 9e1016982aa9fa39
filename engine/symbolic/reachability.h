// Which atoms and which instances of schemas can come about when nothing is ever removed.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "engine/symbolic/lifted.h"

namespace stampede::symbolic {

struct Instance {
  int schema = 0;
  std::vector<int> binding;
};

// Semi-naive evaluation with joins over an index on (predicate, position, object); each instance is found once, when
// the last atom of its body becomes known. Negated fluents count as true.
class Reachability {
 public:
  explicit Reachability(const LiftedTask& task);
  // False: given up, because what is reachable needs more memory than this.
  bool run(std::int64_t memory_bytes);

  int find(int predicate, const std::vector<int>& arguments) const;  // number of the atom, or -1
  int find(const LiftedAtom& atom, const std::vector<int>& binding) const;
  const std::vector<Instance>& instances() const { return instances_; }
  std::int64_t instances_of(int schema) const { return instances_of_[schema]; }
  std::size_t atoms() const { return predicate_.size(); }
  int predicate(int atom) const { return predicate_[atom]; }
  const std::vector<int>& arguments(int atom) const { return arguments_[atom]; }
  bool initially(int atom) const { return atom < initial_; }
  // Calls visit(binding) for all bindings of `variables` whose static literals in `when` hold.
  template <typename Visit>
  void for_each(const Schema& schema, const LiftedEffect& effect, std::vector<int>& binding, Visit&& visit,
                std::size_t from = 0) const {
    if (from == effect.forall.size()) {
      if (statics_hold(effect.when, binding)) visit();
      return;
    }
    for (const int value : schema.domains[effect.forall[from]]) {
      binding[effect.forall[from]] = value;
      for_each(schema, effect, binding, visit, from + 1);
    }
    binding[effect.forall[from]] = -1;
  }

 private:
  std::uint64_t key(const std::vector<int>& arguments) const;
  void add(int predicate, const std::vector<int>& arguments);
  void trigger(int atom);
  void join(int schema, const std::vector<int>& remaining, int trigger_position, int atom);
  bool is_full() const { return bytes_ > most_bytes_; }
  void fill(int schema, std::size_t variable);
  void found(int schema);
  static std::int64_t bytes_of_effects(const Schema& schema);
  bool unify(const LiftedAtom& pattern, int atom, int schema, std::vector<int>& bound);
  const std::vector<int>* candidates(const LiftedAtom& pattern, bool& complete, int& exact) const;
  bool statics_hold(const Conjunct& conjunct, const std::vector<int>& binding) const;

  const LiftedTask& task_;
  std::size_t objects_;
  int initial_ = 0;
  std::vector<int> predicate_;
  std::vector<std::vector<int>> arguments_;
  std::vector<std::unordered_map<std::uint64_t, int>> numbers_;  // looked up, never walked
  std::vector<std::vector<int>> of_predicate_;
  std::vector<std::vector<std::vector<std::vector<int>>>> index_;  // [predicate][position][object]
  std::vector<std::vector<std::pair<int, int>>> uses_;             // [predicate]: schema, position in its body
  std::vector<std::vector<std::vector<char>>> allowed_;            // [schema][variable][object]
  std::vector<Instance> instances_;
  std::vector<std::int64_t> instances_of_;  // by schema
  std::vector<int> binding_;
  std::int64_t bytes_ = 0, most_bytes_ = 0;  // about; instances and atoms
};

}  // namespace stampede::symbolic
