#include "scripting/session/constraints_fit.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "engine/start/altered_task.h"
#include "engine/start/constraints.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr int kEqualDraws = 3;  // when so many draws agree in all that the formula speaks of, none will differ

// Which static facts bear on a formula: of an atom, those of its objects; with variables, all.
bool bears_on(const Formula& formula, const Fact& fact) {
  if (!formula.variables.empty()) return true;
  if (formula.kind == Formula::Kind::atom)
    return fact.arguments.empty() || std::any_of(formula.terms.begin(), formula.terms.end(),
                                                 [&](const Term& term) { return term.name == fact.arguments[0]; });
  return std::any_of(formula.parts.begin(), formula.parts.end(),
                     [&](const Formula& part) { return bears_on(part, fact); });
}

// The parts that cannot be met by themselves, or the whole where only together they cannot; nothing when they can.
std::vector<std::string> contradictions(const Formula& where, const Symbols& symbols, const StaticFacts& known) {
  const RandomKey key("where");
  const auto with_reason = [&](const Formula& part) {
    const std::string why = part.kind == Formula::Kind::atom
                                ? atom_fault(symbolic::ground_atom(part.predicate, part.terms, {}), symbols.domain(),
                                             known.objects, known.facts)
                                : "";
    return to_text(part) + (why.empty() ? "" : ": " + why);
  };
  std::vector<std::string> texts;
  if (draw_literals(where, symbols, known.objects, known.facts, key)) return texts;
  if (where.kind == Formula::Kind::conjunction)
    for (const Formula& part : where.parts)
      if (!draw_literals(part, symbols, known.objects, known.facts, key)) texts.push_back(with_reason(part));
  if (texts.empty()) texts.push_back(with_reason(where));
  return texts;
}

}  // namespace

Formula formula_option(const std::string& text, const std::string& place) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw Error(place, "the formula is empty", "write one such as " + place + " '(on block1 table)'");
  Formula formula = formula_from_pddl(text, place);
  if (formula.kind == Formula::Kind::always || formula.kind == Formula::Kind::never)
    throw Error(place, text + " says nothing about the world",
                "name what must hold: " + place + " '(on block1 table)'");
  return formula;
}

std::string misfit(const std::shared_ptr<const Library>& library, const EpisodeJob& job, const RunOptions& options) {
  EpisodeScripts scripts(library, job);
  const TaskDraw task = scripts.task();
  Task drawn = task(0);
  const std::optional<Formula> asked = altered(drawn, scripts.symbols(), options).where;
  if (!asked) return {};
  const Domain& domain = scripts.symbols().domain();
  std::set<Facts> seen;
  std::map<std::string, int> failures;  // draws in which a part failed
  for (int draw = 0; draw < options.draws && (draw < kEqualDraws || seen.size() > 1); ++draw) {
    if (draw > 0) drawn = task(draw);
    const StaticFacts known = static_facts(drawn.scene, domain);  // the rest is open: no world is needed
    const Formula where = checked_formula(*asked, domain, known.objects, "--where");
    const std::vector<std::string> failed = contradictions(where, scripts.symbols(), known);
    if (failed.empty()) return {};
    for (const std::string& part : failed) ++failures[part];
    Facts bearing;
    for (const Fact& fact : known.facts)
      if (bears_on(where, fact)) bearing.insert(fact);
    seen.insert(std::move(bearing));
  }
  return std::max_element(failures.begin(), failures.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

std::vector<std::string> fitting_variations(const std::shared_ptr<const Library>& library, const std::string& task,
                                            const std::vector<std::string>& variations, std::int64_t seed,
                                            const RunOptions& options) {
  if (!options.where && !options.goal) return variations;
  std::vector<std::string> fitting;
  std::optional<Error> mistake;
  std::string why;
  for (const std::string& variation : variations) try {
      const std::string own = misfit(library, {task, variation, seed}, options);
      if (own.empty()) fitting.push_back(variation);
      if (why.empty()) why = own;
    } catch (const Error& error) {  // what one variation lacks another may have
      if (!mistake) mistake = error;
    }
  if (!fitting.empty()) return fitting;
  if (why.empty() && mistake) throw *mistake;
  throw Error("--where",
              "no start of " + task +
                  (variations.size() == 1 ? (variations[0].empty() ? "" : " " + variations[0])
                                          : ", in none of " + std::to_string(variations.size()) + " variations,") +
                  " can meet " + why,
              "it contradicts itself or what never changes there; `stampede list " + task + "` says what there is");
}

}  // namespace stampede
