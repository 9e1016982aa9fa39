#include "engine/record/atom_formula.h"

#include <algorithm>
#include <cstring>

#include "engine/symbolic/evaluation.h"

namespace stampede {
namespace {

bool may_be_equal(const Action& action, const std::string& a, const std::string& b) {
  if (!action.distinct) return true;
  return std::any_of(action.may_equal.begin(), action.may_equal.end(), [&](const auto& pair) {
    return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
  });
}

// The bindings of an action's parameters that can ever meet its precondition.
class Bindings {
 public:
  Bindings(const Action& action, const AtomWorld& world)
      : action_(action), world_(world), view_{world.ever, world.domain, world.objects} {
    collect(action.precondition);
  }
  template <typename Visit>
  void each(const Visit& visit) {
    extend(0, visit);
  }

 private:
  void collect(const Formula& formula) {
    if (formula.kind == Formula::Kind::atom) needed_.push_back(&formula);
    if (formula.kind == Formula::Kind::conjunction)
      for (const Formula& part : formula.parts) collect(part);
  }
  bool bound(const Formula& formula) const {
    return std::all_of(formula.terms.begin(), formula.terms.end(),
                       [&](const Term& term) { return !term.variable || binding_.contains(term.name); });
  }
  // No atom that must hold, and is ground by now, is one that never does.
  bool hopeful() const {
    return std::all_of(needed_.begin(), needed_.end(), [&](const Formula* formula) {
      return !bound(*formula) ||
             world_.places.contains(symbolic::ground_atom(formula->predicate, formula->terms, binding_));
    });
  }
  template <typename Visit>
  void extend(std::size_t index, const Visit& visit) {
    if (index == action_.parameters.size()) return visit(binding_);
    const Parameter& parameter = action_.parameters[index];
    for (const TypedObject& object : world_.objects) {
      if (!symbolic::admits(parameter, object, view_)) continue;
      const bool taken = std::any_of(binding_.begin(), binding_.end(), [&](const auto& one) {
        return one.second == object.name && !may_be_equal(action_, one.first, parameter.name);
      });
      if (taken) continue;
      binding_[parameter.name] = object.name;
      if (hopeful()) extend(index + 1, visit);
      binding_.erase(parameter.name);
    }
  }
  const Action& action_;
  const AtomWorld& world_;
  symbolic::View view_;
  std::vector<const Formula*> needed_;
  Binding binding_;
};

}  // namespace

AtomFormula::AtomFormula(const Formula& formula, const AtomWorld& world, const Binding& binding) {
  Binding local = binding;
  root_ = compile(symbolic::negation_normal(formula), world, local);
}

AtomFormula::Node AtomFormula::compile(const Formula& formula, const AtomWorld& world, Binding& binding) {
  using From = Formula::Kind;
  const auto constant = [](bool value) { return Node{value ? Kind::always : Kind::never, 0, {}}; };
  switch (formula.kind) {
    case From::always:
      return constant(true);
    case From::never:
      return constant(false);
    case From::atom: {
      const auto place = world.places.find(symbolic::ground_atom(formula.predicate, formula.terms, binding));
      return place == world.places.end() ? constant(false) : Node{Kind::atom, place->second, {}};
    }
    case From::equal:
      return constant(symbolic::value_of(formula.terms.at(0), binding) ==
                      symbolic::value_of(formula.terms.at(1), binding));
    case From::negation: {  // of an atom or an equality
      Node node = compile(formula.parts.at(0), world, binding);
      if (node.kind == Kind::atom) return {Kind::negated_atom, node.place, {}};
      return constant(node.kind == Kind::never);
    }
    default:
      break;
  }
  Node node{formula.kind == From::conjunction || formula.kind == From::forall ? Kind::all : Kind::any, 0, {}};
  if (formula.kind == From::conjunction || formula.kind == From::disjunction) {
    for (const Formula& part : formula.parts) node.parts.push_back(compile(part, world, binding));
    return node;
  }
  symbolic::for_each_binding(formula.variables, {world.ever, world.domain, world.objects}, binding, [&] {
    node.parts.push_back(compile(formula.parts.at(0), world, binding));
    return true;
  });
  return node;
}

bool AtomFormula::holds(const Node& node, const std::uint8_t* row) {
  const auto part_holds = [&](const Node& part) { return holds(part, row); };
  switch (node.kind) {
    case Kind::always:
      return true;
    case Kind::never:
      return false;
    case Kind::atom:
      return row[node.place] != 0;
    case Kind::negated_atom:
      return row[node.place] == 0;
    case Kind::all:
      return std::all_of(node.parts.begin(), node.parts.end(), part_holds);
    case Kind::any:
      return std::any_of(node.parts.begin(), node.parts.end(), part_holds);
  }
  return false;
}

double AtomFormula::share(const Node& node, const std::uint8_t* row) {
  if (node.kind == Kind::all && !node.parts.empty()) {
    double sum = 0;
    for (const Node& part : node.parts) sum += share(part, row);
    return sum / static_cast<double>(node.parts.size());
  }
  if (node.kind == Kind::any) {
    double best = 0;
    for (const Node& part : node.parts) best = std::max(best, share(part, row));
    return best;
  }
  return holds(node, row) ? 1 : 0;
}

void AtomFormula::mark(const Node& node, std::vector<double>& places) {
  if (node.kind == Kind::atom) places[node.place] = 1;
  if (node.kind == Kind::negated_atom) places[node.place] = -1;
  for (const Node& part : node.parts) mark(part, places);
}

ApplicableActions applicable_actions(const AtomWorld& world, const std::vector<std::uint8_t>& rows, std::size_t width) {
  const std::size_t count = width == 0 ? 0 : rows.size() / width;
  std::map<Fact, std::vector<std::uint8_t>> found;
  for (const Action& action : world.domain.actions)
    Bindings(action, world).each([&](const Binding& binding) {
      const AtomFormula precondition(action.precondition, world, binding);
      std::vector<std::uint8_t> values(count);
      bool any = false;
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* row = &rows[i * width];
        const bool same = i > 0 && std::memcmp(row, row - width, width) == 0;
        values[i] = same ? values[i - 1] : precondition.holds(row) ? 1 : 0;
        any = any || values[i] != 0;
      }
      if (!any) return;
      Fact call{action.name, {}};
      for (const Parameter& parameter : action.parameters) call.arguments.push_back(binding.at(parameter.name));
      found.emplace(std::move(call), std::move(values));
    });
  ApplicableActions result;
  result.values.resize(count * found.size());
  std::size_t place = 0;
  for (auto& [call, values] : found) {
    result.actions.push_back(call);
    for (std::size_t i = 0; i < count; ++i) result.values[i * found.size() + place] = values[i];
    ++place;
  }
  return result;
}

}  // namespace stampede
