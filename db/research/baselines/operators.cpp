// Baselines that learn operators from facts.
#include "engine/learning/operators.h"

#include <algorithm>
#include <set>

#include "db/research/baselines/functions.h"
#include "db/research/symbols_of.h"
#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"

namespace stampede::research {
namespace {

// Physics is not clean: of the transitions of a case some miss a precondition that it has, and what a skill does once
// in twenty times is an accident; without labels, one event in a hundred.
constexpr learning::LearningOptions kLabelled = {.support = 2, .share = 0.05, .tolerance = 0.02};
constexpr learning::LearningOptions kUnlabelled = {.support = 2, .share = 0.01, .tolerance = 0.02};

// Test episodes are cut where their events end: by the action that the event is like.
void cut_by_events(const ResearchProblem& problem, const PlainFile& given, std::int64_t gap,
                   const learning::LearnedOperators& learned, Answers& answers) {
  if (problem.answer.empty()) return;
  const Rows rows = given.query("SELECT episode FROM episodes WHERE split = 'test' ORDER BY episode");
  std::vector<std::int64_t> tests;
  for (std::size_t i = 0; i < rows.size(); ++i) tests.push_back(rows.integer(i, "episode"));
  for (const auto& [episode, history] : histories_of(given, tests)) {
    std::int64_t from = 0;
    const std::vector<learning::TimedEvent> events = learning::timed_events(history, gap);
    for (const learning::TimedEvent& event : events) {
      const bool last = &event == &events.back();
      const std::int64_t end = last ? history.frames : event.last + 1;
      const std::string name = learning::like_action(event.transition, learned.domain);
      answers.rows.rows.push_back({episode, from, end, name.empty() ? std::string("other") : name});
      from = end;
    }
    if (events.empty()) answers.rows.rows.push_back({episode, std::int64_t{0}, history.frames, std::string("other")});
  }
}

}  // namespace

Answers operators_with_labels(const ResearchProblem&, const PlainFile& given) {
  Answers answers;
  answers.texts["domain"] = to_pddl(learning::learn_operators(labelled_experience(given), kLabelled).domain);
  return answers;
}

Answers operators_without_labels(const ResearchProblem& problem, const PlainFile& given) {
  learning::Experience experience;
  std::vector<learning::History> histories;
  for (auto& [episode, history] : histories_of(given, episodes_to_learn_from(given)))
    histories.push_back(std::move(history));
  const std::int64_t gap = learning::natural_gap(histories);
  for (const learning::History& history : histories) {
    for (const TypedObject& one : *history.objects) experience.types[one.type] = "object";
    for (learning::Transition& one : learning::events(history, gap)) experience.transitions.push_back(std::move(one));
  }
  const learning::LearnedOperators learned = learning::learn_operators(experience, kUnlabelled);
  Answers answers;
  answers.texts["domain"] = to_pddl(learned.domain);
  cut_by_events(problem, given, gap, learned, answers);
  return answers;
}

Answers actions_of_plans(const ResearchProblem&, const PlainFile& given) {
  const std::string where = given.path().string();
  std::set<std::string> used;
  const Rows plans = given.query("SELECT plan FROM plans");
  for (std::size_t i = 0; i < plans.size(); ++i)
    for (const PlanStep& step : plan_from_text(plans.text(i, "plan"), where)) used.insert(step.action);
  Answers answers;
  const Rows problems = given.query("SELECT domain FROM problems WHERE domain IS NOT NULL ORDER BY episode LIMIT 1");
  if (problems.size() == 0) throw Error(where, "no episode has a planning problem");
  Domain domain = domain_from_pddl(problems.text(0, "domain"), where);
  std::erase_if(domain.actions, [&](const Action& action) { return !used.contains(action.name); });
  answers.texts["domain"] = to_pddl(domain);
  return answers;
}

}  // namespace stampede::research
