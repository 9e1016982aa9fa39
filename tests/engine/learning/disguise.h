// The domain that made the data, so changed that only its meaning is left, and what its classifiers would say.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/learning/operator_score.h"
#include "engine/learning/truth_table.h"

namespace stampede::test {

struct Mask {
  std::string name;
  bool turned = false;   // arguments in reverse order
  bool negated = false;  // says when it does not hold
  bool dropped = false;  // there is no such classifier
};

// Everything has another name, types too; predicates as `masks` say (those without one keep their own).
class Disguise {
 public:
  Disguise(const Domain& truth, std::map<std::string, Mask> masks) : truth_(truth), masks_(std::move(masks)) {}

  Domain domain() const {
    Domain result;
    result.name = "disguised";
    for (const auto& [type, parent] : truth_.types)
      result.types["k" + type] = parent == "object" ? parent : "k" + parent;
    for (Predicate one : truth_.predicates) {
      const Mask mask = of(one.name);
      if (mask.dropped) continue;
      rename(one.parameters);
      one.derived = mask.negated ? negation(disguised(one.derived)) : disguised(one.derived);
      if (mask.turned) std::reverse(one.parameters.begin(), one.parameters.end());
      one.name = mask.name;
      result.predicates.push_back(std::move(one));
    }
    std::sort(result.predicates.begin(), result.predicates.end(), by_name);
    int count = 0;
    for (Action one : truth_.actions) {
      one.name = "act" + std::to_string(++count);
      one.skill.clear();
      rename(one.parameters);
      one.precondition = disguised(one.precondition);
      std::vector<Effect> effects;
      for (Effect effect : one.effects) {
        const Mask mask = of(effect.predicate);
        if (mask.dropped) continue;
        effect.when = disguised(effect.when);
        rename(effect.forall);
        effect.predicate = mask.name;
        effect.negated = effect.negated != mask.negated;
        if (mask.turned) std::reverse(effect.terms.begin(), effect.terms.end());
        effects.push_back(std::move(effect));
      }
      one.effects = std::move(effects);
      result.actions.push_back(std::move(one));
    }
    return result;
  }

  // Every atom over objects of the right types, no object twice; `wrong` in a thousand answers are false.
  learning::JudgedFrame judge(const learning::Sample& sample, int wrong, Random& random) const {
    learning::JudgedFrame frame{{}, {}, sample.facts, sample.objects};
    for (const TypedObject& one : *sample.objects)
      for (const auto& [type, parent] : truth_.types)
        if (truth_.is_a(one.type, type)) frame.yes.insert({"k" + type, {one.name}});
    for (const Predicate& predicate : truth_.predicates) {
      Fact atom{predicate.name, {}};
      if (!of(predicate.name).dropped) say(predicate, atom, wrong, random, frame);
    }
    return frame;
  }

 private:
  static bool by_name(const Predicate& a, const Predicate& b) { return a.name < b.name; }
  Mask of(const std::string& predicate) const {
    const auto at = masks_.find(predicate);
    return at == masks_.end() ? Mask{predicate} : at->second;
  }
  static void rename(std::vector<Parameter>& parameters) {
    for (Parameter& one : parameters)
      if (one.type != "object") one.type = "k" + one.type;
  }
  Formula disguised(Formula formula) const {
    rename(formula.variables);
    for (Formula& part : formula.parts) part = disguised(part);
    if (formula.kind != Formula::Kind::atom) return formula;
    const Mask mask = of(formula.predicate);
    if (mask.dropped) return {};
    formula.predicate = mask.name;
    if (mask.turned) std::reverse(formula.terms.begin(), formula.terms.end());
    return mask.negated ? negation(formula) : formula;
  }
  void say(const Predicate& predicate, Fact& atom, int wrong, Random& random, learning::JudgedFrame& frame) const {
    const std::size_t place = atom.arguments.size();
    if (place == predicate.parameters.size()) {
      const Mask mask = of(predicate.name);
      bool truth = frame.truth.contains(atom) != mask.negated;
      if (random.below(1000) < wrong) truth = !truth;
      Fact said{mask.name, atom.arguments};
      if (mask.turned) std::reverse(said.arguments.begin(), said.arguments.end());
      (truth ? frame.yes : frame.no).insert(std::move(said));
      return;
    }
    for (const TypedObject& one : *frame.objects) {
      if (!truth_.is_a(one.type, predicate.parameters[place].type)) continue;
      if (std::find(atom.arguments.begin(), atom.arguments.end(), one.name) != atom.arguments.end()) continue;
      atom.arguments.push_back(one.name);
      say(predicate, atom, wrong, random, frame);
      atom.arguments.pop_back();
    }
  }

  const Domain& truth_;
  std::map<std::string, Mask> masks_;
};

}  // namespace stampede::test
