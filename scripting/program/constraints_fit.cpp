#include "scripting/program/constraints_fit.h"

#include <optional>
#include <set>

#include "engine/episode/altered_task.h"
#include "engine/episode/constraints.h"
#include "engine/episode/fact_tracker.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

constexpr int kEqualDraws = 5;  // when so many draws differ in nothing static, none will

// The first part that cannot be met by itself; empty when all together can be.
std::string contradiction(const Formula& where, const Domain& domain, const FactTracker& tracker) {
  const RandomKey key("where");
  if (draw_literals(where, domain, tracker.objects(), tracker.facts(), key)) return {};
  if (where.kind == Formula::Kind::conjunction)
    for (const Formula& part : where.parts)
      if (!draw_literals(part, domain, tracker.objects(), tracker.facts(), key)) return to_pddl(part);
  return to_pddl(where);
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
  EpisodeScripts scripts(library, job.task, job.variation, job.seed);
  const AlteredTask altered(scripts.task(), scripts.symbols(), options);
  if (!options.where) return {};
  const Domain& domain = scripts.symbols().domain();
  std::set<Facts> seen;
  std::string why;
  for (int draw = 0; draw < options.draws && (draw < kEqualDraws || seen.size() > 1); ++draw) {
    World world(std::make_shared<const Scene>(scripts.task().scene(draw)));
    const WorldView view(world);
    FactTracker tracker(scripts.symbols(), view);
    tracker.begin({});  // what never changes is known, the rest open
    why = contradiction(checked_formula(*options.where, domain, tracker.objects(), "--where"), domain, tracker);
    if (why.empty()) return why;
    seen.insert(tracker.facts());
  }
  return why;
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
              "it contradicts what never changes there; `stampede list " + task + "` says what there is");
}

}  // namespace stampede
