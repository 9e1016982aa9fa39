#include "engine/learning/operator_score.h"

#include <algorithm>

#include "engine/learning/calls.h"
#include "engine/learning/literals.h"
#include "engine/symbolic/pddl.h"

namespace stampede::learning {
namespace {

// A sample in the words of both domains.
struct Both {
  const std::vector<TypedObject>* objects;
  Facts truth, learned;
};

std::vector<Both> chosen(const std::vector<Sample>& samples, const Domain& learned, const Domain& truth) {
  constexpr std::size_t kMost = 200;
  std::vector<Both> both;
  const std::size_t count = std::min(kMost, samples.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Sample& one = samples[i * samples.size() / count];
    const Facts theirs = in_words_of(truth, one.facts, *one.objects);
    both.push_back({one.objects.get(), theirs, in_words_of(learned, theirs, *one.objects)});
  }
  return both;
}

// The samples in the words of one domain.
using Views = std::vector<symbolic::View>;

Views views_of(const std::vector<Both>& samples, const Domain& domain, Facts Both::*words) {
  Views views;
  for (const Both& one : samples) views.push_back({one.*words, domain, *one.objects});
  return views;
}

// Whether a formula over the parameters of one action holds wherever the other can be taken; without such a place: no.
// `slot_of`: by parameter of the formula's action, that of the other.
class Implied {
 public:
  Implied(const Action& taken, const Views& samples) {
    for (const symbolic::View& one : samples) {
      calls_.push_back(applicable_calls(taken, one));
      any_ |= !calls_.back().empty();
    }
  }
  bool holds(const Formula& formula, const Action& of, const std::vector<int>& slot_of, const Views& samples) const {
    if (!any_) return false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      for (const Call& call : calls_[i]) {
        Binding binding;
        for (std::size_t p = 0; p < of.parameters.size(); ++p)
          if (slot_of[p] >= 0) binding[of.parameters[p].name] = call[static_cast<std::size_t>(slot_of[p])];
        if (!bound(formula, binding)) return false;
        if (!symbolic::evaluate(formula, samples[i], binding)) return false;
      }
    }
    return true;
  }

 private:
  // Free variables only: those of quantifiers bind themselves.
  static bool bound(const Formula& formula, Binding binding) {
    for (const Parameter& one : formula.variables) binding[one.name] = "";
    for (const Term& term : formula.terms)
      if (term.variable && !binding.contains(term.name)) return false;
    return std::all_of(formula.parts.begin(), formula.parts.end(),
                       [&](const Formula& part) { return bound(part, binding); });
  }
  std::vector<std::set<Call>> calls_;
  bool any_ = false;
};

std::vector<int> inverse(const std::vector<int>& slot_of, std::size_t parameters) {
  std::vector<int> back(parameters, -1);
  for (std::size_t i = 0; i < slot_of.size(); ++i)
    if (slot_of[i] >= 0) back[static_cast<std::size_t>(slot_of[i])] = static_cast<int>(i);
  return back;
}

class LiteralComparison {
 public:
  LiteralComparison(const Domain& learned, const Domain& truth, const ActionMatch& match,
                    const std::vector<Both>& samples)
      : truth_(truth),
        in_learned_(views_of(samples, learned, &Both::learned)),
        in_truth_(views_of(samples, truth, &Both::truth)),
        mine_(*learned.action(match.learned)),
        theirs_(*truth.action(match.truth)),
        true_of_(inverse(match.slot_of, mine_.parameters.size())) {
    score.match = match;
    const ActionLiterals mine = literals_of(mine_), theirs = literals_of(theirs_);
    preconditions(mine, theirs);
    effects(mine, theirs);
  }
  LiteralScore score;

 private:
  void preconditions(const ActionLiterals& mine, const ActionLiterals& theirs) {
    Literals said;
    const Implied at_truth(theirs_, in_truth_), at_learned(mine_, in_learned_);
    for (LiftedLiteral one : mine.precondition) {
      if (!replaced(one, true_of_)) continue;
      said.insert(one);
      if (theirs.precondition.contains(one)) {
        ++score.preconditions.right;
        continue;
      }
      ++score.preconditions.wrong;
      const Formula formula = formula_of(one, theirs_);
      const bool implied = at_truth.holds(formula, theirs_, identity(theirs_), in_learned_);
      score.held.wrong += !implied;
      note(score.extra, to_text(one, theirs_), implied);
    }
    for (const LiftedLiteral& one : theirs.precondition)
      if (!said.contains(one)) miss(formula_of(one, theirs_), to_text(one, theirs_), at_learned);
    std::vector<Formula> compound;
    for (const Formula& one : mine.compound) compound.push_back(in_their_parameters(one));
    for (const Formula& one : compound) {
      if (std::find(theirs.compound.begin(), theirs.compound.end(), one) != theirs.compound.end()) {
        ++score.preconditions.right;
        continue;
      }
      ++score.preconditions.wrong;
      const bool implied = at_truth.holds(one, theirs_, identity(theirs_), in_learned_);
      score.held.wrong += !implied;
      note(score.extra, stampede::to_text(one), implied);
    }
    for (const Formula& one : theirs.compound)
      if (std::find(compound.begin(), compound.end(), one) == compound.end())
        miss(one, stampede::to_text(one), at_learned);
    score.held.right += score.preconditions.right;
  }

  Formula in_their_parameters(Formula formula) const {
    for (Term& term : formula.terms)
      for (std::size_t i = 0; i < mine_.parameters.size(); ++i)
        if (term.variable && term.name == mine_.parameters[i].name && true_of_[i] >= 0) {
          term.name = theirs_.parameters[static_cast<std::size_t>(true_of_[i])].name;
          break;
        }
    for (Formula& part : formula.parts) part = in_their_parameters(part);
    return formula;
  }

  void miss(const Formula& formula, const std::string& text, const Implied& at_learned) {
    ++score.preconditions.missed;
    const bool implied = at_learned.holds(formula, theirs_, score.match.slot_of, in_truth_);
    (implied ? score.held.right : score.held.missed) += 1;
    note(score.missing, text, implied);
  }

  void effects(const ActionLiterals& mine, const ActionLiterals& theirs) {
    Literals said;
    for (LiftedLiteral one : mine.effect) {
      const Predicate* predicate = truth_.predicate(one.atom.predicate);
      if (predicate != nullptr && predicate->kind == PredicateKind::derived) continue;
      const LiftedLiteral own = one;
      if (!replaced(one, true_of_)) {
        // The true action cannot say it, unless by a condition.
        ++score.effects.wrong;
        score.extra.push_back("effect " + to_text(own, mine_));
        continue;
      }
      said.insert(one);
      if (theirs.effect.contains(one)) {
        ++score.effects.right;
      } else {
        ++score.effects.wrong;
        score.extra.push_back("effect " + to_text(one, theirs_));
      }
    }
    for (const LiftedLiteral& one : theirs.effect) {
      if (said.contains(one)) continue;
      ++score.effects.missed;
      score.missing.push_back("effect " + to_text(one, theirs_));
    }
  }

  static std::vector<int> identity(const Action& action) {
    std::vector<int> slots(action.parameters.size());
    for (std::size_t i = 0; i < slots.size(); ++i) slots[i] = static_cast<int>(i);
    return slots;
  }
  static void note(std::vector<std::string>& list, const std::string& text, bool implied) {
    list.push_back(implied ? "[" + text + "]" : text);
  }

  const Domain& truth_;
  Views in_learned_, in_truth_;
  const Action &mine_, &theirs_;
  std::vector<int> true_of_;  // by learned parameter
};

// All cases of one true action on one sample.
class CallComparison {
 public:
  CallComparison(const Domain& learned, const Domain& truth, const Action& action, const Both& sample)
      : learned_(learned),
        truth_(truth),
        action_(action),
        sample_(sample),
        calls_(applicable_calls(action, {sample.truth, truth, *sample.objects})) {}

  void add(const ActionMatch& match, CallScore& score) {
    const Action& mine = *learned_.action(match.learned);
    for (const Call& call : applicable_calls(mine, {sample_.learned, learned_, *sample_.objects})) {
      Call said(action_.parameters.size());
      for (std::size_t i = 0; i < said.size(); ++i)
        if (match.slot_of[i] >= 0) said[i] = call[static_cast<std::size_t>(match.slot_of[i])];
      std::vector<const Call*> meant;
      for (const Call& one : calls_)
        if (agrees(said, one)) meant.push_back(&one);
      if (meant.empty()) wrong_.insert(said);
      for (const Call* one : meant) {
        right_.insert(*one);
        compare(mine, call, *one, score.changes);
      }
    }
  }

  void finish(CallScore& score) const {
    score.applicable.right += static_cast<std::int64_t>(right_.size());
    score.applicable.wrong += static_cast<std::int64_t>(wrong_.size());
    score.applicable.missed += static_cast<std::int64_t>(calls_.size() - right_.size());
  }

 private:
  static bool agrees(const Call& said, const Call& call) {
    for (std::size_t i = 0; i < said.size(); ++i)
      if (!said[i].empty() && said[i] != call[i]) return false;
    return true;
  }

  // Basic facts, and derived ones that the learned domain has a word for.
  bool counts(const Fact& fact) const {
    const Predicate* predicate = truth_.predicate(fact.predicate);
    const bool derived = predicate != nullptr && predicate->kind == PredicateKind::derived;
    return !derived || learned_.predicate(fact.predicate) != nullptr;
  }

  void compare(const Facts& said, const Facts& truth, Counts& changes) const {
    for (const Fact& fact : said) {
      if (!counts(fact)) continue;
      (truth.contains(fact) ? changes.right : changes.wrong) += 1;
    }
    for (const Fact& fact : truth) changes.missed += counts(fact) && !said.contains(fact);
  }

  void compare(const Action& mine, const Call& call, const Call& meant, Counts& changes) {
    const GroundChange said = change_by(mine, call, learned_, sample_.learned, *sample_.objects);
    auto known = changes_.find(meant);
    if (known == changes_.end())
      known = changes_.insert({meant, change_by(action_, meant, truth_, sample_.truth, *sample_.objects)}).first;
    compare(said.added, known->second.added, changes);
    compare(said.removed, known->second.removed, changes);
  }

  const Domain &learned_, &truth_;
  const Action& action_;
  const Both& sample_;
  std::set<Call> calls_, right_, wrong_;
  std::map<Call, GroundChange> changes_;  // of the true action
};

CallScore score_calls(const Domain& learned, const Domain& truth, const std::vector<ActionMatch>& matches,
                      const Action& action, const std::vector<Both>& samples) {
  CallScore score;
  score.action = action.name;
  for (const ActionMatch& one : matches) score.cases += one.truth == action.name;
  for (const Both& sample : samples) {
    CallComparison comparison(learned, truth, action, sample);
    for (const ActionMatch& one : matches)
      if (one.truth == action.name) comparison.add(one, score);
    comparison.finish(score);
  }
  return score;
}

}  // namespace

OperatorScore score_operators(const Domain& learned, const Domain& truth, const std::vector<ActionMatch>& matches,
                              const std::set<std::string>& among, const std::vector<Sample>& samples) {
  const std::vector<Both> both = chosen(samples, learned, truth);
  OperatorScore score;
  score.samples = static_cast<int>(both.size());
  for (const ActionMatch& one : matches) {
    if (one.truth.empty()) continue;
    score.literals.push_back(LiteralComparison(learned, truth, one, both).score);
    score.preconditions += score.literals.back().preconditions;
    score.effects += score.literals.back().effects;
    score.held += score.literals.back().held;
  }
  for (const std::string& name : among) {
    const Action* action = truth.action(name);
    if (action == nullptr) continue;
    score.calls.push_back(score_calls(learned, truth, matches, *action, both));
    score.applicable += score.calls.back().applicable;
    score.changes += score.calls.back().changes;
    if (score.calls.back().cases > 0) continue;
    const ActionLiterals all = literals_of(*action);
    const auto parts = static_cast<std::int64_t>(all.precondition.size() + all.compound.size());
    score.preconditions.missed += parts;
    score.held.missed += parts;
    score.effects.missed += static_cast<std::int64_t>(all.effect.size());
    score.changes.missed += static_cast<std::int64_t>(all.effect.size());
  }
  return score;
}

}  // namespace stampede::learning
