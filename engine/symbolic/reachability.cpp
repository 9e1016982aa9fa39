#include "engine/symbolic/reachability.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/stopping.h"

namespace stampede::symbolic {

Reachability::Reachability(const LiftedTask& task)
    : task_(task),
      objects_(task.objects.size() + 1),
      numbers_(task.predicates.size()),
      of_predicate_(task.predicates.size()),
      index_(task.predicates.size()),
      uses_(task.predicates.size()),
      instances_of_(task.schemas.size(), 0) {
  for (std::size_t i = 0; i < task.schemas.size(); ++i) {
    const Schema& schema = task.schemas[i];
    for (std::size_t j = 0; j < schema.body.positive.size(); ++j) {
      uses_[schema.body.positive[j].predicate].emplace_back(static_cast<int>(i), static_cast<int>(j));
    }
    auto& allowed = allowed_.emplace_back();
    for (const std::vector<int>& domain : schema.domains) {
      allowed.emplace_back(objects_, 0);
      for (const int value : domain) allowed.back()[value] = 1;
    }
  }
}

std::uint64_t Reachability::key(const std::vector<int>& arguments) const {
  std::uint64_t value = 0;
  for (const int argument : arguments) {
    if (value > UINT64_MAX / objects_ - 1) throw Error(task_.domain->name, "too many objects for so many arguments");
    value = value * objects_ + static_cast<std::uint64_t>(argument);
  }
  return value;
}

int Reachability::find(int predicate, const std::vector<int>& arguments) const {
  const auto found = numbers_[predicate].find(key(arguments));
  return found == numbers_[predicate].end() ? -1 : found->second;
}

int Reachability::find(const LiftedAtom& atom, const std::vector<int>& binding) const {
  thread_local std::vector<int> arguments;
  arguments.clear();
  for (const LiftedTerm& term : atom.terms) arguments.push_back(term.variable ? binding[term.id] : term.id);
  return find(atom.predicate, arguments);
}

void Reachability::add(int predicate, const std::vector<int>& arguments) {
  const int number = static_cast<int>(predicate_.size());
  if (!numbers_[predicate].try_emplace(key(arguments), number).second) return;
  bytes_ += 120 + 20 * static_cast<std::int64_t>(arguments.size());  // its place in four tables, as allocated
  predicate_.push_back(predicate);
  arguments_.push_back(arguments);
  of_predicate_[predicate].push_back(number);
  auto& positions = index_[predicate];
  if (positions.empty()) {
    positions.assign(arguments.size(), std::vector<std::vector<int>>(objects_));
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) positions[i][arguments[i]].push_back(number);
}

bool Reachability::run(std::int64_t memory_bytes) {
  most_bytes_ = memory_bytes;
  std::vector<int> arguments;
  for (const bool fluent : {false, true}) {  // static atoms first: most joins then fail at once
    for (const LiftedAtom& atom : task_.init) {
      if ((task_.fluent[atom.predicate] != 0) != fluent) continue;
      arguments.clear();
      for (const LiftedTerm& term : atom.terms) arguments.push_back(term.id);
      add(atom.predicate, arguments);
    }
  }
  initial_ = static_cast<int>(predicate_.size());
  for (std::size_t i = 0; i < task_.schemas.size(); ++i) {
    if (!task_.schemas[i].body.positive.empty()) continue;
    binding_.assign(task_.schemas[i].domains.size(), -1);
    fill(static_cast<int>(i), 0);
  }
  for (std::size_t next = 0; next < predicate_.size() && !is_full(); ++next) trigger(static_cast<int>(next));
  return !is_full();
}

void Reachability::trigger(int atom) {
  for (const auto& [schema, position] : uses_[predicate_[atom]]) {
    const Conjunct& body = task_.schemas[schema].body;
    binding_.assign(task_.schemas[schema].domains.size(), -1);
    std::vector<int> bound;
    if (!unify(body.positive[position], atom, schema, bound)) continue;
    std::vector<int> others;
    for (int i = 0; i < static_cast<int>(body.positive.size()); ++i) {
      if (i != position) others.push_back(i);
    }
    join(schema, others, position, atom);
  }
}

bool Reachability::unify(const LiftedAtom& pattern, int atom, int schema, std::vector<int>& bound) {
  for (std::size_t i = 0; i < pattern.terms.size(); ++i) {
    const LiftedTerm& term = pattern.terms[i];
    const int value = arguments_[atom][i];
    if (!term.variable) {
      if (term.id != value) return false;
    } else if (binding_[term.id] < 0) {
      if (!allowed_[schema][term.id][value]) return false;
      binding_[term.id] = value;
      bound.push_back(term.id);
    } else if (binding_[term.id] != value) {
      return false;
    }
  }
  return true;
}

// The shortest list of atoms that can match; `complete`: all terms are bound and `exact` is the atom or -1.
const std::vector<int>* Reachability::candidates(const LiftedAtom& pattern, bool& complete, int& exact) const {
  const std::vector<int>* best = &of_predicate_[pattern.predicate];
  complete = true;
  for (std::size_t i = 0; i < pattern.terms.size(); ++i) {
    const LiftedTerm& term = pattern.terms[i];
    const int value = term.variable ? binding_[term.id] : term.id;
    if (value < 0) {
      complete = false;
    } else if (!index_[pattern.predicate].empty()) {
      const std::vector<int>& list = index_[pattern.predicate][i][value];
      if (list.size() < best->size()) best = &list;
    }
  }
  if (complete) exact = find(pattern, binding_);
  return best;
}

// `remaining`: positions of the body that are not yet matched, ascending.
void Reachability::join(int schema, const std::vector<int>& remaining, int trigger_position, int atom) {
  heed_stop();
  const std::vector<LiftedAtom>& body = task_.schemas[schema].body.positive;
  const auto limit_at = [&](int position) { return position < trigger_position ? atom : atom + 1; };  // each once
  std::vector<int> open;
  int best_position = -1;
  const std::vector<int>* best = nullptr;
  for (const int position : remaining) {
    bool complete = false;
    int exact = -1;
    const std::vector<int>* list = candidates(body[position], complete, exact);
    if (complete) {
      if (exact < 0 || exact >= limit_at(position)) return;
      continue;
    }
    open.push_back(position);
    if (best == nullptr || list->size() < best->size()) best = list, best_position = position;
  }
  if (open.empty()) {
    fill(schema, 0);
    return;
  }
  std::erase(open, best_position);
  std::vector<int> bound;
  for (std::size_t i = 0; i < best->size(); ++i) {  // by index: the list may grow while we are inside
    const int candidate = (*best)[i];
    if (candidate >= limit_at(best_position) || is_full()) break;
    bound.clear();
    if (unify(body[best_position], candidate, schema, bound)) join(schema, open, trigger_position, atom);
    for (const int variable : bound) binding_[variable] = -1;
  }
}

void Reachability::fill(int schema, std::size_t variable) {
  heed_stop();
  const Schema& from = task_.schemas[schema];
  std::size_t next = variable;
  const auto is_wanted = [&](std::size_t v) {
    if (static_cast<int>(v) < from.parameters || from.action < 0) return true;
    return std::find(from.body.extra.begin(), from.body.extra.end(), static_cast<int>(v)) != from.body.extra.end();
  };
  while (next < binding_.size() && (binding_[next] >= 0 || !is_wanted(next))) ++next;
  if (next == binding_.size()) {
    if (statics_hold(from.body, binding_)) found(schema);
    return;
  }
  for (const int value : from.domains[next]) {
    if (is_full()) break;
    binding_[next] = value;
    fill(schema, next + 1);
  }
  binding_[next] = -1;
}

bool Reachability::statics_hold(const Conjunct& conjunct, const std::vector<int>& binding) const {
  const auto value = [&](const LiftedTerm& term) { return term.variable ? binding[term.id] : term.id; };
  for (const Equality& one : conjunct.equalities) {
    if ((value(one.left) == value(one.right)) != one.equal) return false;
  }
  for (const LiftedAtom& one : conjunct.positive) {
    if (!task_.fluent[one.predicate] && find(one, binding) < 0) return false;
  }
  for (const LiftedAtom& one : conjunct.negative) {
    if (!task_.fluent[one.predicate] && find(one, binding) >= 0) return false;
  }
  return true;
}

// What quantified effects take that are written out for an instance.
std::int64_t Reachability::bytes_of_effects(const Schema& schema) {
  std::int64_t bytes = 0;
  for (const LiftedEffect& effect : schema.effects) {
    if (effect.forall.empty()) continue;
    std::int64_t count = 1;
    for (const int id : effect.forall) count *= static_cast<std::int64_t>(schema.domains[id].size());
    bytes += (effect.conditional ? 40 : 8) * count;
  }
  return bytes;
}

void Reachability::found(int schema) {
  const Schema& from = task_.schemas[schema];
  if (is_full()) return;
  // With the operator or axiom that will be made of it, and what heuristics keep of that.
  bytes_ += 250 + 60 * static_cast<std::int64_t>(binding_.size()) + bytes_of_effects(from);
  ++instances_of_[schema];
  instances_.push_back({schema, binding_});
  std::vector<int> binding = binding_, arguments;
  const auto add_atom = [&](const LiftedAtom& atom) {
    arguments.clear();
    for (const LiftedTerm& term : atom.terms) arguments.push_back(term.variable ? binding[term.id] : term.id);
    add(atom.predicate, arguments);
  };
  if (from.action < 0) add_atom(from.head);
  for (const LiftedEffect& effect : from.effects) {
    if (effect.negated) continue;
    for_each(from, effect, binding, [&] { add_atom(effect.atom); });
  }
}

}  // namespace stampede::symbolic
