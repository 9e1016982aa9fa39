#include "engine/rollout/symbol_channels.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/rollout/assumptions.h"
#include "engine/start/effects.h"
#include "engine/start/language.h"
#include "engine/start/planning.h"
#include "engine/symbolic/drawn_choice.h"
#include "engine/symbolic/instances.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

template <typename Value>
ChannelValue list_of(std::vector<Value> values) {
  ChannelValue value;
  value.shape = {static_cast<std::int64_t>(values.size())};
  value.data = std::move(values);
  return value;
}

std::vector<std::string> texts_of(const std::vector<PlanStep>& steps) {
  std::vector<std::string> names;
  for (const PlanStep& step : steps) names.push_back(to_text(Fact{step.action, step.arguments}));
  return names;
}

bool has_quantifier(const Formula& formula) {
  return formula.kind == Formula::Kind::exists || formula.kind == Formula::Kind::forall ||
         std::any_of(formula.parts.begin(), formula.parts.end(), has_quantifier);
}

// Of a conjunction, those with quantifiers, or those without.
Formula parts_of(const Formula& formula, bool quantified) {
  std::vector<Formula> all = {formula}, parts;
  if (formula.kind == Formula::Kind::conjunction) all = formula.parts;
  std::copy_if(all.begin(), all.end(), std::back_inserter(parts),
               [&](const Formula& part) { return has_quantifier(part) == quantified; });
  return conjunction(std::move(parts));
}

}  // namespace

SymbolChannels::SymbolChannels(Rollout& rollout, const RunOptions& options, const EnvironmentSettings& settings)
    : rollout_(rollout), options_(options), settings_(settings) {
  enumerate_atoms();
  enumerate_skills();
}

std::span<const SymbolChannels::Channel> SymbolChannels::all() {
  static constexpr std::array<Channel, 10> channels{{
      {"facts", [](SymbolChannels& of) { return list_of(of.row()); }},
      {"known",
       [](SymbolChannels& of) {
         return list_of(of.settings_.hidden ? of.row_of(of.rollout_.facts().observed()) : of.row());
       }},
      {"applicable", [](SymbolChannels& of) { return list_of(of.feasible()); }},
      {"fact_names",
       [](SymbolChannels& of) {
         std::vector<std::string> names;
         for (const Fact& fact : of.facts()) names.push_back(to_text(fact));
         return list_of(std::move(names));
       }},
      {"feasible_skills",
       [](SymbolChannels& of) {
         std::vector<PlanStep> list;
         const std::vector<std::uint8_t>& mask = of.feasible();
         for (std::size_t i = 0; i < mask.size(); ++i)
           if (mask[i] != 0) list.push_back(of.skills_[i]);
         return list_of(texts_of(list));
       }},
      {"pddl", [](SymbolChannels& of) { return list_of(std::vector<std::string>{of.pddl()}); }},
      {"sentences", [](SymbolChannels& of) { return list_of(of.sentences()); }},
      {"plan", [](SymbolChannels& of) { return list_of(of.plan()); }},
      {"progress",
       [](SymbolChannels& of) {
         ChannelValue value;
         value.data = std::vector<double>{of.progress()};
         return value;
       }},
      {"goal", [](SymbolChannels& of) { return list_of(of.goal()); }},
  }};
  return channels;
}

const SymbolChannels::Channel* SymbolChannels::find(std::string_view name) {
  const auto found = std::ranges::find(all(), name, &Channel::name);
  return found == all().end() ? nullptr : &*found;
}

void SymbolChannels::enumerate_atoms() {
  atoms_ = rollout_.facts().atoms();
  auto things = rollout_.facts().objects();  // not the colours drawn at this start, whose number is another each time
  std::erase_if(things, [&](const auto& thing) { return rollout_.scene()->object(thing.name) == nullptr; });
  const symbolic::View view{rollout_.facts().facts(), rollout_.domain(), things};
  for (const Predicate& predicate : rollout_.domain().predicates) {
    if (predicate.kind != PredicateKind::derived) continue;
    symbolic::limit_instances(predicate.name, predicate.parameters, view, "predicate " + predicate.name);
    Binding binding;
    symbolic::for_each_binding(predicate.parameters, view, binding, [&] {
      Fact fact{predicate.name, {}};
      for (const Parameter& parameter : predicate.parameters) fact.arguments.push_back(binding.at(parameter.name));
      atoms_.push_back(std::move(fact));
      return true;
    });
  }
  for (const Fact& atom : atoms_) places_.emplace(atom, places_.size());
}

// Types, traits and distinctness: what a planner would ground. In the order of the domain and of the objects.
void SymbolChannels::enumerate_skills() {
  const symbolic::View view{rollout_.facts().facts(), rollout_.domain(), rollout_.facts().objects()};
  for (const Action& action : rollout_.domain().actions) {
    symbolic::limit_instances(action.name, action.parameters, view, "skill " + action.skill);
    Binding binding;
    symbolic::for_each_binding(action.parameters, view, binding, [&] {
      PlanStep step{action.name, {}};
      for (const Parameter& parameter : action.parameters) step.arguments.push_back(binding.at(parameter.name));
      const auto may_equal = [&](std::size_t i, std::size_t k) {
        const std::string &a = action.parameters[i].name, &b = action.parameters[k].name;
        return std::any_of(action.may_equal.begin(), action.may_equal.end(), [&](const auto& pair) {
          return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
        });
      };
      for (std::size_t i = 0; action.distinct && i < step.arguments.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (step.arguments[i] == step.arguments[k] && !may_equal(i, k)) return true;
      skills_.push_back(std::move(step));
      return true;
    });
  }
}

const Facts& SymbolChannels::facts() {
  if (facts_at_ == rollout_.facts().changes()) return facts_;
  facts_at_ = rollout_.facts().changes();
  return facts_ = settings_.hidden ? rollout_.facts().facts() : rollout_.facts().observed();
}

std::vector<std::uint8_t> SymbolChannels::row_of(const Facts& facts) const {
  std::vector<std::uint8_t> row(atoms_.size(), 0);
  for (const Fact& fact : facts)
    if (const auto place = places_.find(fact); place != places_.end()) row[place->second] = 1;
  return row;
}

const std::vector<std::uint8_t>& SymbolChannels::row() {
  if (row_at_ == rollout_.facts().changes()) return row_;
  row_at_ = rollout_.facts().changes();
  return row_ = row_of(facts());
}

const std::vector<std::uint8_t>& SymbolChannels::feasible() {
  if (feasible_at_ == rollout_.facts().changes()) return feasible_;
  std::optional<Facts> ever;
  const auto compiled = [&](const PlanStep& step, bool quantified) {
    if (!ever) {
      ever = rollout_.facts().facts();  // what is no atom here never changes
      ever->insert(atoms_.begin(), atoms_.end());
    }
    const Action& action = *rollout_.domain().action(step.action);
    return AtomFormula(parts_of(action.precondition, quantified),
                       {places_, rollout_.domain(), rollout_.facts().objects(), *ever},
                       binding_of(action, step.arguments));
  };
  if (preconditions_.empty())
    for (const PlanStep& step : skills_) preconditions_.push_back({compiled(step, false), std::nullopt});
  const std::uint8_t* now = row().data();
  feasible_at_ = rollout_.facts().changes();
  feasible_.assign(skills_.size(), 0);
  for (std::size_t i = 0; i < skills_.size(); ++i) {
    Precondition& one = preconditions_[i];
    if (!one.plain.holds(now)) continue;
    if (!one.quantified) one.quantified = compiled(skills_[i], true);
    feasible_[i] = one.quantified->holds(now) ? 1 : 0;
  }
  return feasible_;
}

AtomFormula SymbolChannels::compiled(const Formula& formula) const {
  Facts ever = rollout_.facts().facts();  // what is no atom here never changes
  ever.insert(atoms_.begin(), atoms_.end());
  return {formula, AtomWorld{places_, rollout_.domain(), rollout_.facts().objects(), ever}};
}

double SymbolChannels::progress() {
  if (!goal_) goal_ = compiled(rollout_.task().goal);
  return goal_->share(row().data());
}

const std::vector<double>& SymbolChannels::goal() {
  if (wanted_at_ == rollout_.stage()) return wanted_;
  wanted_at_ = rollout_.stage();
  const Task& task = rollout_.task();
  const auto stage = static_cast<std::size_t>(wanted_at_);
  wanted_.assign(atoms_.size(), 0);
  compiled(stage < task.stages.size() ? task.stages[stage] : task.goal).mark(wanted_);
  return wanted_;
}

// What the planner would do from here, on what is known.
std::vector<std::string> SymbolChannels::plan() {
  if (plan_at_ == rollout_.facts().changes()) return plan_;
  plan_at_ = rollout_.facts().changes();
  const auto key = [&](const char* purpose) {
    return RandomKey(purpose).with(rollout_.task().name).with(rollout_.task().variation).with(options_.seed);
  };
  PlanningTask asked = planning_task(rollout_.task(), rollout_.domain(), rollout_.facts(), rollout_.stage());
  keep_known(asked.problem, rollout_.facts(), {});
  const AssumingPlan found =
      plan_assuming(asked, conceivable(rollout_.facts()), key("assume"), [&](const PlanningTask& planning) {
        if (options_.planner) return options_.planner.plan(planning.domain, planning.problem);
        return solve_drawn(planning.domain, planning.problem, {}, key("plan"));
      });
  return plan_ = texts_of(found.outcome.plan);
}

std::string SymbolChannels::pddl() const {
  Problem problem = world_problem(rollout_.task(), rollout_.facts());
  if (!settings_.hidden) problem.init = rollout_.facts().known_basic();
  return to_pddl(problem, named_by_content(rollout_.domain()), beside_goal(rollout_.task()));
}

std::vector<std::string> SymbolChannels::sentences() {
  const Domain& domain = rollout_.domain();
  const Scene& scene = *rollout_.scene();
  return describe_world(settings_.hidden ? facts() : mentionable(rollout_.facts().facts(), facts(), domain, scene),
                        domain, scene);
}

void SymbolChannels::forget() { facts_at_ = row_at_ = feasible_at_ = plan_at_ = -1; }

}  // namespace stampede
