#include "engine/episode/altered_task.h"

#include "engine/episode/constraints.h"
#include "engine/episode/language.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

// `the red block is on the table and the hand is empty`; nothing for what templates cannot say.
std::string sentence(const Formula& formula, const Domain& domain, const Scene& scene) {
  if (formula.kind == Formula::Kind::conjunction) {
    std::string text;
    for (const Formula& part : formula.parts) {
      const std::string one = sentence(part, domain, scene);
      if (one.empty()) return {};
      text += (text.empty() ? "" : " and ") + one;
    }
    return text;
  }
  const bool negated = formula.kind == Formula::Kind::negation;
  const Formula& inner = negated ? formula.parts[0] : formula;
  const Predicate* predicate = inner.kind == Formula::Kind::atom ? domain.predicate(inner.predicate) : nullptr;
  if (predicate == nullptr || predicate->label.empty()) return {};
  std::vector<std::string> names;
  for (const Term& term : inner.terms) {
    if (term.variable) return {};
    names.push_back(term.name);
  }
  const std::string text = fill(predicate->label, predicate->parameters, names, scene);
  return negated ? "it is not so that " + text : text;
}

}  // namespace

AlteredTask::AlteredTask(Task& task, const Symbols& symbols, const RunOptions& options) : task_(task) {
  where_ = task.where();
  if (options.where) where_ = where_ ? conjunction({*options.where, *where_}) : *options.where;
  if (!options.goal) return;
  const Scene scene = task.scene(0);
  goal_ = checked_formula(*options.goal, symbols.domain(), static_facts(scene, symbols.domain()).objects, "--goal");
  const std::string text = sentence(*goal_, symbols.domain(), scene);
  instructions_ = {text.empty() ? "make this true: " + to_text(*goal_) : "make sure that " + text};
}

}  // namespace stampede
