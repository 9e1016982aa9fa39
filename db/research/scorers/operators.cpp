// Learned operators: their literals, the calls that they allow, plans made with them, and these run in physics.
#include <algorithm>

#include "db/research/operator_figures.h"
#include "db/research/physics.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"
#include "engine/learning/matching.h"
#include "engine/learning/operator_score.h"
#include "engine/learning/plan_score.h"
#include "engine/symbolic/pddl.h"

namespace stampede::research {
namespace {

// Of each problem; where there is no plan by then, there is none.
constexpr PlanLimits kPlanLimits = {.expansions = 100'000, .memory_bytes = 1'000'000'000, .improve = 5'000};

constexpr std::size_t kLongestReason = 160;

double part_of(std::size_t part, std::size_t of) {
  return of == 0 ? 0 : static_cast<double>(part) / static_cast<double>(of);
}

void add_operator_counts(std::vector<Figure>& figures, const std::string& name, const learning::Counts& counts,
                         const std::string& about) {
  figures.push_back({name + "_precision", counts.precision(), about + ": right of those said"});
  figures.push_back({name + "_recall", counts.recall(), about + ": right of those there are"});
  figures.push_back({name + "_f1", counts.f1(), about});
}

std::string literal_list(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : " ") + text;
  return all;
}

// What each learned action stands for, and what is wrong with it.
void add_matches(std::vector<Figure>& figures, const learning::OperatorScore& score,
                 const std::vector<learning::ActionMatch>& matches) {
  std::size_t matched = 0;
  for (const learning::ActionMatch& one : matches) matched += !one.truth.empty();
  figures.push_back({"matched", part_of(matched, matches.size()), "learned actions that stand for a true one"});
  for (const learning::LiteralScore& one : score.literals) {
    std::string about = "stands for " + one.match.truth + (one.match.by_name ? " (by name)" : "");
    if (!one.extra.empty()) about += "; too much: " + literal_list(one.extra);
    if (!one.missing.empty()) about += "; missing: " + literal_list(one.missing);
    figures.push_back({"action_" + one.match.learned, one.match.likeness, about});
  }
  for (const learning::ActionMatch& one : matches)
    if (one.truth.empty()) figures.push_back({"action_" + one.learned, 0, "stands for no true action"});
  for (const learning::CallScore& one : score.calls)
    figures.push_back({"calls_" + one.action, one.applicable.f1(),
                       "F1 of the calls of " + one.action + " that can be taken, of " + std::to_string(one.cases) +
                           " learned actions"});
}

std::vector<Figure> plan_figures(const learning::PlanScore& plans) {
  std::vector<Figure> figures = {
      {"plans_made", part_of(static_cast<std::size_t>(plans.planned), plans.problems.size()),
       "held-out problems for which the learned domain gives a plan"},
      {"plans_sound", plans.soundness(), "of these plans, valid by the true domain"},
      {"plans_complete", plans.completeness(), "of the problems that the true domain solves, those with a valid plan"},
      {"plan_cost_ratio", plans.cost_ratio, "cost of valid plans by that of the true domain's, mean (0: none is valid)",
       false},
      {"plan_expanded_ratio", plans.expanded_ratio, "states expanded for them, likewise", false}};
  std::map<std::string, int> reasons;
  for (const learning::PlannedProblem& one : plans.problems)
    if (!one.valid) ++reasons[one.reason.substr(0, kLongestReason)];
  std::vector<std::pair<int, std::string>> often;
  for (const auto& [reason, count] : reasons) often.emplace_back(-count, reason);
  std::sort(often.begin(), often.end());
  for (std::size_t i = 0; i < std::min<std::size_t>(3, often.size()); ++i)
    figures.push_back({"plans_fail_" + std::to_string(i + 1),
                       part_of(static_cast<std::size_t>(-often[i].first), plans.problems.size()), often[i].second,
                       false});
  return figures;
}

std::vector<Figure> physics_figures(const Domain& learned, const HeldOutProblems& held,
                                    const std::vector<learning::ActionMatch>& matches, const ScoringJob& job) {
  std::vector<HeldOutEpisode> some = held.episodes;
  if (some.size() > static_cast<std::size_t>(job.options.physics)) {
    const std::size_t wanted = static_cast<std::size_t>(job.options.physics);
    for (std::size_t i = 0; i < wanted; ++i) some[i] = held.episodes[i * held.episodes.size() / wanted];
    some.resize(wanted);
  }
  const TrueWordsPlanner planner = [&](const Domain& truth, const Problem& problem) {
    PlanOutcome outcome;
    try {
      outcome = solve(learned, learning::in_words_of(learned, truth, problem), kPlanLimits);
      if (outcome.solved) outcome.plan = learning::in_true_actions(outcome.plan, learned, truth, problem, matches);
    } catch (const Error& error) {
      outcome.explanation = error.where() + " " + error.message();
    }
    return outcome;
  };
  const std::vector<PhysicalRun> runs = job.options.run(some, planner);
  const std::vector<PhysicalRun> ours = job.options.run(some, {});
  const auto succeeded = [](const std::vector<PhysicalRun>& all) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const auto& one) { return one.success; }));
  };
  std::vector<Figure> figures = {
      {"physics_success", part_of(succeeded(runs), runs.size()),
       "held-out episodes that succeed when planned with the learned domain, of " + std::to_string(runs.size())},
      {"physics_reference", part_of(succeeded(ours), ours.size()), "the same planned with the true domain"}};
  std::map<std::string, std::pair<std::size_t, std::string>> reasons;
  for (const PhysicalRun& one : runs) {
    if (one.success) continue;
    auto& [count, first] = reasons[one.reason];
    if (count++ == 0) first = one.detail.substr(0, kLongestReason);
  }
  for (const auto& [reason, found] : reasons)
    figures.push_back({"physics_" + reason, part_of(found.first, runs.size()),
                       "of them failed for this reason, the first: " + found.second, false});
  return figures;
}

}  // namespace

Domain answered_domain(const ScoringJob& job) {
  const auto text = job.answers.texts.find("domain");
  if (text == job.answers.texts.end() || text->second.find_first_not_of(" \t\r\n") == std::string::npos)
    throw Error(job.answers.where, "its domain is empty", "put a PDDL domain, as text, into \"domain\"");
  Domain domain = domain_from_pddl(text->second, job.answers.where + ", domain");
  if (domain.actions.empty())
    throw Error(job.answers.where, "its domain has no action", "say with (:action …) what can be done");
  return domain;
}

std::vector<Figure> operator_figures(const Domain& learned, const HeldOutProblems& held, const ScoringJob& job) {
  const std::vector<learning::ActionMatch> matches = learning::match_actions(learned, held.truth, held.actions);
  const learning::OperatorScore score =
      learning::score_operators(learned, held.truth, matches, held.actions, held.samples);
  std::vector<Figure> figures;
  add_operator_counts(figures, "preconditions", score.preconditions, "literals of preconditions, as written");
  add_operator_counts(figures, "effects", score.effects, "literals of effects, as written");
  add_operator_counts(figures, "implied", score.held,
                      "literals of preconditions, as written or true on all held-out states");
  add_operator_counts(figures, "applicable", score.applicable, "calls that can be taken in held-out states");
  add_operator_counts(figures, "changes", score.changes, "facts that these calls change there");
  add_matches(figures, score, matches);
  std::vector<learning::PlannedProblem> planned;
  for (const HeldOutEpisode& one : held.episodes)
    planned.push_back(learning::plan_with(learned, held.truth, one.problem, matches, kPlanLimits));
  for (Figure& one : plan_figures(learning::summary(std::move(planned)))) figures.push_back(std::move(one));
  if (job.options.physics > 0)
    for (Figure& one : physics_figures(learned, held, matches, job)) figures.push_back(std::move(one));
  return figures;
}

std::vector<Figure> score_operators(const ScoringJob& job) {
  const Domain learned = answered_domain(job);
  return operator_figures(learned, held_out_problems(job.hidden, job.test_units), job);
}

// Both at once: who cuts and learns without labels is scored for both.
std::vector<Figure> score_segments_and_operators(const ScoringJob& job) {
  const Domain learned = answered_domain(job);
  std::vector<Figure> figures = score_segments(job);
  for (Figure& one : operator_figures(learned, held_out_problems(job.hidden, job.test_units), job))
    figures.push_back(std::move(one));
  return figures;
}

}  // namespace stampede::research
