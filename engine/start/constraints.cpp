#include "engine/start/constraints.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/stopping.h"
#include "engine/start/fact_tracker.h"
#include "engine/symbolic/instances.h"
#include "engine/symbolic/pddl.h"

namespace stampede {

std::string atom_fault(const Fact& fact, const Domain& domain, const std::vector<TypedObject>& objects,
                       const Facts& known) {
  const symbolic::View view{known, domain, objects};
  const Predicate* predicate = domain.predicate(fact.predicate);
  if (predicate == nullptr || predicate->kind == PredicateKind::fixed) return {};
  for (std::size_t i = 0; i < fact.arguments.size(); ++i) {
    std::string fault = symbolic::argument_fault(predicate->parameters.at(i), fact.arguments[i], view);
    if (!fault.empty()) return fault;
  }
  return {};
}

namespace {

constexpr int kMostSteps = 100'000;  // of the search; a formula that needs more counts as contradictory

std::vector<std::size_t> shuffled(std::size_t count, RandomKey key) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random(key).shuffle(order);
  return order;
}

// Depth first over alternatives. What is still to be made true is a list on the heap, and so are the choices to come
// back to: a formula over many objects takes no more of the stack than one over few.
class Drawing {
 public:
  Drawing(const Symbols& symbols, const std::vector<TypedObject>& objects, const Facts& known, RandomKey key)
      : symbols_(symbols), view_{known, symbols.domain(), objects}, key_(key) {
    const Domain& domain = symbols.domain();
    for (const Fact& fact : known) decided_.insert(fact.predicate);
    decided_.insert(domain.traits.begin(), domain.traits.end());
  }

  bool make(const Formula& formula) {
    open_ = nullptr;
    ask(formula, std::make_shared<const Binding>());
    while (open_ != nullptr) {
      heed_stop();
      const Asked& next = *std::exchange(open_, open_->then);
      if (!take_up(next) && !go_back()) return false;
    }
    return true;
  }

  std::vector<Literal> take() { return std::move(literals_); }

 private:
  static bool same(const Formula& formula, const Binding& binding) {
    return symbolic::value_of(formula.terms[0], binding) == symbolic::value_of(formula.terms[1], binding);
  }

  using Bound = std::shared_ptr<const Binding>;
  struct Asked {
    const Formula* formula = nullptr;
    Bound binding;
    const Asked* then = nullptr;  // what is asked for behind it
  };
  // One of several, of which those up to `next` were tried.
  struct Choice {
    std::vector<Asked> ways;  // in the order drawn
    std::size_t next = 0, literals = 0, asked = 0;
  };

  void ask(const Formula& formula, Bound binding) {
    open_ = &asked_.emplace_back(Asked{&formula, std::move(binding), open_});
  }

  // False: it cannot be.
  bool take_up(const Asked& asked) {
    if (++steps_ > kMostSteps) return false;
    const Formula& formula = *asked.formula;
    switch (formula.kind) {
      case Formula::Kind::always:
        return true;
      case Formula::Kind::never:
        return false;
      case Formula::Kind::atom:
        return literal(formula, *asked.binding, false);
      case Formula::Kind::equal:
        return same(formula, *asked.binding);
      case Formula::Kind::negation:
        if (formula.parts[0].kind == Formula::Kind::equal) return !same(formula.parts[0], *asked.binding);
        return literal(formula.parts[0], *asked.binding, true);
      case Formula::Kind::conjunction:
        for (std::size_t i = formula.parts.size(); i-- > 0;) ask(formula.parts[i], asked.binding);
        return true;
      case Formula::Kind::forall: {
        const std::vector<Bound> list = bindings(formula, *asked.binding);
        for (std::size_t i = list.size(); i-- > 0;) ask(formula.parts[0], list[i]);
        return true;
      }
      case Formula::Kind::disjunction:
      case Formula::Kind::exists:
        return choose(formula, asked.binding);
    }
    return false;
  }

  bool choose(const Formula& formula, const Bound& binding) {
    std::vector<Asked> ways;
    if (formula.kind == Formula::Kind::disjunction)
      for (const Formula& part : formula.parts) ways.push_back({&part, binding, open_});
    else
      for (Bound& one : bindings(formula, *binding)) ways.push_back({&formula.parts[0], std::move(one), open_});
    Choice choice;
    for (const std::size_t i : shuffled(ways.size(), key_.with(steps_))) choice.ways.push_back(ways[i]);
    choice.literals = literals_.size();
    choice.asked = asked_.size();
    choices_.push_back(std::move(choice));
    return go_back();
  }

  // To the last choice that has another way left. False: there is none, or no more steps.
  bool go_back() {
    while (!choices_.empty() && steps_ <= kMostSteps) {
      Choice& last = choices_.back();
      if (last.next == last.ways.size()) {
        choices_.pop_back();
        continue;
      }
      literals_.resize(last.literals);
      asked_.resize(last.asked);
      open_ = &asked_.emplace_back(last.ways[last.next++]);
      return true;
    }
    return false;
  }

  bool literal(const Formula& formula, const Binding& binding, bool negated) {
    const Fact fact = symbolic::ground_atom(formula.predicate, formula.terms, binding);
    if (decided_.contains(fact.predicate)) return view_.facts.contains(fact) != negated;
    if (!atom_fault(fact, view_.domain, view_.objects, view_.facts).empty()) return negated;  // no fact of it can be
    for (const Literal& known : literals_) {
      if (known.fact == fact) return known.negated == negated;
      if (!negated && !known.negated && (excludes(fact, known.fact) || excludes(known.fact, fact))) return false;
    }
    literals_.push_back({fact, negated});
    return true;
  }

  // What `one` says of itself rules the other out.
  bool excludes(const Fact& one, const Fact& other) const {
    const PredicateTraits traits = symbols_.traits(one.predicate);
    const bool same_first =
        !one.arguments.empty() && !other.arguments.empty() && one.arguments[0] == other.arguments[0];
    if (same_first && std::find(traits.mutex.begin(), traits.mutex.end(), other.predicate) != traits.mutex.end())
      return true;
    if (traits.functional < 0 || one.predicate != other.predicate) return false;
    for (std::size_t i = 0; i < one.arguments.size(); ++i)
      if (static_cast<int>(i) != traits.functional && one.arguments[i] != other.arguments[i]) return false;
    return true;
  }

  std::vector<Bound> bindings(const Formula& formula, const Binding& binding) const {
    std::vector<Bound> list;
    Binding own = binding;
    symbolic::for_each_binding(formula.variables, view_, own, [&] {
      list.push_back(std::make_shared<const Binding>(own));
      return true;
    });
    return list;
  }

  const Symbols& symbols_;
  symbolic::View view_;
  RandomKey key_;
  std::set<std::string> decided_;
  std::vector<Literal> literals_;
  std::deque<Asked> asked_;      // what was asked for on this way: what is open leads through them
  const Asked* open_ = nullptr;  // the first of what is still to be made true
  std::vector<Choice> choices_;
  int steps_ = 0;
};

class Checker {
 public:
  Checker(const Domain& domain, const std::vector<TypedObject>& objects, std::string place)
      : domain_(domain), place_(std::move(place)) {
    for (const TypedObject& object : objects) {
      objects_.push_back(object.name);
      if (domain.is_a(object.type, "hand")) hands_.push_back(object.name);
    }
    for (const Predicate& predicate : domain.predicates) predicates_.push_back(predicate.name);
    predicates_.insert(predicates_.end(), domain.traits.begin(), domain.traits.end());
  }

  Formula check(Formula formula, std::set<std::string> bound) const {
    for (const Parameter& variable : formula.variables) {
      bound.insert(variable.name);
      if (!variable.type.empty() && variable.type != "object" && !domain_.types.contains(variable.type))
        unknown("type", variable.type, types());
    }
    if (formula.kind == Formula::Kind::atom) check_atom(formula);
    for (std::size_t i = 0; i < formula.terms.size(); ++i) {
      const Term& term = formula.terms[i];
      if (is_value(formula, i)) continue;
      if (term.variable && !bound.contains(term.name))
        throw Error(place_, "nothing binds the variable ?" + term.name, "write (exists (?" + term.name + " - …) …)");
      if (!term.variable && std::find(objects_.begin(), objects_.end(), term.name) == objects_.end())
        unknown("object", term.name, objects_);
    }
    for (Formula& part : formula.parts) part = check(std::move(part), bound);
    return formula;
  }

 private:
  [[noreturn]] void unknown(const std::string& kind, const std::string& name,
                            const std::vector<std::string>& known) const {
    throw Error(place_, "there is no " + kind + " '" + name + "'", did_you_mean(name, known));
  }
  std::vector<std::string> types() const {
    std::vector<std::string> names;
    for (const auto& [name, parent] : domain_.types) names.push_back(name);
    return names;
  }
  // Values of attributes are in a problem when something of this draw has them; another draw may have others.
  bool is_value(const Formula& formula, std::size_t index) const {
    const Predicate* predicate = formula.kind == Formula::Kind::atom ? domain_.predicate(formula.predicate) : nullptr;
    return predicate != nullptr && predicate->kind == PredicateKind::fixed &&
           predicate->parameters.at(index).type == "value" && !formula.terms[index].variable;
  }
  void check_atom(Formula& formula) const {
    if (std::find(predicates_.begin(), predicates_.end(), formula.predicate) == predicates_.end())
      unknown("predicate", formula.predicate, predicates_);
    const Predicate* predicate = domain_.predicate(formula.predicate);
    if (predicate != nullptr && predicate->kind == PredicateKind::start && place_ == "--goal")
      throw Error(place_, "'" + formula.predicate + "' is only asked of starts and is no fact", "--where may name it");
    const std::size_t wanted = predicate == nullptr ? 1 : predicate->parameters.size();
    for (std::size_t i = 0; i < wanted && formula.terms.size() + 1 == wanted && hands_.size() == 1; ++i)
      if (predicate != nullptr && predicate->parameters[i].type == "hand")
        formula.terms.insert(formula.terms.begin() + static_cast<std::ptrdiff_t>(i), Term{false, hands_.front()});
    if (formula.terms.size() == wanted) return;
    std::string example = "(" + formula.predicate;
    if (predicate == nullptr) example += " X";
    if (predicate != nullptr)
      for (const Parameter& parameter : predicate->parameters) example += " " + parameter.name;
    throw Error(place_,
                "'" + formula.predicate + "' takes " + std::to_string(wanted) + " arguments, not " +
                    std::to_string(formula.terms.size()),
                "write " + example + ")");
  }
  const Domain& domain_;
  std::string place_;
  std::vector<std::string> objects_, predicates_, hands_;
};

}  // namespace

std::string related_to_itself(const Formula& formula, const Domain& domain) {
  for (const Formula& part : formula.parts)
    if (formula.kind == Formula::Kind::conjunction)
      if (std::string found = related_to_itself(part, domain); !found.empty()) return found;
  const Predicate* predicate = formula.kind == Formula::Kind::atom ? domain.predicate(formula.predicate) : nullptr;
  if (predicate == nullptr || predicate->kind != PredicateKind::basic) return {};
  const auto within = [](const Term& whole, const Term& part) {
    return part.name == whole.name || part.name.starts_with(whole.name + ".");
  };
  for (const Term& one : formula.terms)
    for (const Term& other : formula.terms)
      if (&one != &other && !one.variable && !other.variable && within(one, other))
        return formula.predicate + " of " + one.name + " and " + other.name;
  return {};
}

StaticFacts static_facts(const Scene& scene, const Domain& domain) {
  StaticFacts known;
  for (const Object& thing : scene.objects) {
    known.objects.push_back({thing.name, thing.type});
    for (const std::string& trait : thing.traits) known.facts.insert({trait, {thing.name}});
  }
  std::set<std::string> values;
  for (const auto& [fact, type] : attribute_facts(scene, domain)) {
    known.facts.insert(fact);
    if (!type.empty() && values.insert(fact.arguments[1]).second) known.objects.push_back({fact.arguments[1], type});
  }
  for (const TypedObject& constant : domain.constants) {
    const auto is_it = [&](const TypedObject& one) { return one.name == constant.name; };
    if (std::none_of(known.objects.begin(), known.objects.end(), is_it)) known.objects.push_back(constant);
  }
  std::sort(known.objects.begin(), known.objects.end());
  return known;
}

std::optional<std::vector<Literal>> draw_literals(const Formula& formula, const Symbols& symbols,
                                                  const std::vector<TypedObject>& objects, const Facts& known,
                                                  RandomKey key) {
  Drawing drawing(symbols, objects, known, key);
  const Formula wanted = symbolic::negation_normal(formula);
  if (!drawing.make(wanted)) return std::nullopt;
  return drawing.take();
}

std::set<std::string> predicates_of(const Formula& formula) {
  if (formula.kind == Formula::Kind::atom) return {formula.predicate};
  std::set<std::string> names;
  for (const Formula& part : formula.parts) names.merge(predicates_of(part));
  return names;
}

Formula checked_formula(const Formula& formula, const Domain& domain, const std::vector<TypedObject>& objects,
                        const std::string& place) {
  Formula checked = Checker(domain, objects, place).check(formula, {});
  symbolic::limit_instances(checked, {Facts{}, domain, objects}, place);
  if (const std::string found = related_to_itself(checked, domain); !found.empty())
    throw Error(place, "there is no fact " + found,
                "no thing is related to itself or its own part: name another thing");
  return checked;
}

std::vector<std::string> failing_parts(const Formula& formula, const Facts& facts, const Domain& domain,
                                       const std::vector<TypedObject>& objects) {
  std::vector<std::string> texts;
  if (formula.kind == Formula::Kind::conjunction) {
    for (const Formula& part : formula.parts)
      for (std::string& text : failing_parts(part, facts, domain, objects)) texts.push_back(std::move(text));
  } else if (!holds(formula, facts, domain, objects)) {
    texts.push_back(to_text(formula));
  }
  return texts;
}

}  // namespace stampede
