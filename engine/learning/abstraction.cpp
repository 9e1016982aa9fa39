#include "engine/learning/abstraction.h"

#include <algorithm>

#include "engine/learning/agreement.h"
#include "engine/learning/assignment.h"
#include "engine/learning/literals.h"

namespace stampede::learning {
namespace {

constexpr double kSameMeaning = 0.8;  // a second predicate with the meaning of another
constexpr double kGoodEnough = 0.9;   // no conjunction is looked for
constexpr double kConjunctionGain = 0.05;
constexpr double kFollows = 0.9;   // a part of a conjunction holds in so many of the atoms that are said to
constexpr double kSpokenOf = 0.5;  // and the table speaks of so many of its facts
constexpr std::size_t kMostParts = 24;
constexpr double kLeastOverlap = 0.5;

std::vector<const JudgedFrame*> evenly(const std::vector<JudgedFrame>& frames, std::size_t most) {
  std::vector<const JudgedFrame*> chosen;
  const std::size_t count = std::min(most, frames.size());
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(&frames[i * frames.size() / count]);
  return chosen;
}

std::map<std::string, std::size_t> said_predicates(const std::vector<const JudgedFrame*>& frames) {
  std::map<std::string, std::size_t> arities;
  for (const JudgedFrame* frame : frames)
    for (const Facts* said : {&frame->yes, &frame->no})
      for (const Fact& fact : *said) arities.insert({fact.predicate, fact.arguments.size()});
  return arities;
}

PredicateLink link_of(const std::string& learned, std::vector<LinkPart> parts, const Confusion& confusion,
                      std::size_t atoms) {
  const Counts counts = confusion.counts();
  return {learned,
          std::move(parts),
          std::max(0.0, confusion.mcc()),
          counts.precision(),
          counts.recall(),
          static_cast<std::int64_t>(atoms)};
}

// Two literals at once, where no single one will do.
void try_conjunctions(const SaidAtoms& atoms, const NumberedFrames& frames, PredicateLink& link) {
  std::vector<Meaning> parts;
  atoms.each_meaning(frames, [&](Meaning one) {
    if (one.confusion.counts().precision() >= kFollows && one.spoken_of >= kSpokenOf) parts.push_back(std::move(one));
  });
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Meaning& a, const Meaning& b) { return a.agreement > b.agreement; });
  if (parts.size() > kMostParts) parts.resize(kMostParts);
  double best = link.agreement + kConjunctionGain;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      Bits both = parts[i].holds;
      for (std::size_t word = 0; word < both.size(); ++word) both[word] &= parts[j].holds[word];
      const Confusion now = confusion(atoms.said(), both, atoms.count());
      if (now.mcc() <= best || now.mcc() < atoms.least(both)) continue;
      best = now.mcc();
      link = link_of(link.learned, {parts[i].part, parts[j].part}, now, atoms.count());
    }
}

std::vector<PredicateLink> links_of(const std::map<std::string, std::size_t>& learned, NumberedFrames& frames) {
  std::vector<std::string> truths;
  for (const auto& [name, predicate] : frames.truths()) truths.push_back(name);
  std::vector<SaidAtoms> atoms;
  std::vector<std::map<std::string, Meaning>> meanings;
  std::vector<std::vector<double>> gains;
  for (const auto& [name, arity] : learned) {
    atoms.emplace_back(name, arity, frames);
    meanings.push_back(atoms.back().meanings(frames));
    gains.emplace_back();
    for (const std::string& truth : truths) {
      const Meaning& one = meanings.back().at(truth);
      gains.back().push_back(one.gain >= atoms.back().least(one.holds) ? one.gain : 0);
    }
  }
  const std::vector<int> assigned = best_assignment(gains);
  std::vector<PredicateLink> links;
  std::size_t i = 0;
  for (const auto& [name, arity] : learned) {
    PredicateLink link{name, {}, 0, 0, 0, static_cast<std::int64_t>(atoms[i].count())};
    const auto most = std::max_element(gains[i].begin(), gains[i].end());
    int at = assigned[i];
    if (at < 0 && most != gains[i].end() && *most >= kSameMeaning) at = static_cast<int>(most - gains[i].begin());
    if (at >= 0) {
      const Meaning& one = meanings[i].at(truths[static_cast<std::size_t>(at)]);
      link = link_of(name, {one.part}, one.confusion, atoms[i].count());
    }
    if (link.agreement < kGoodEnough) try_conjunctions(atoms[i], frames, link);
    links.push_back(std::move(link));
    ++i;
  }
  return links;
}

using Extension = std::set<std::pair<const void*, std::string>>;  // scene, object

double overlap(const Extension& a, const Extension& b) {
  Extension shared;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(shared, shared.end()));
  const auto both = static_cast<double>(shared.size());
  return both / (static_cast<double>(a.size() + b.size()) - both);
}

// The objects of each true type, those above it among them, and of each trait.
std::pair<std::map<std::string, Extension>, std::map<std::string, Extension>> true_extensions(
    const Domain& truth, const std::vector<const JudgedFrame*>& frames, const NumberedFrames& numbered) {
  std::map<std::string, Extension> types, traits;
  for (const JudgedFrame* frame : frames) {
    const void* scene = frame->objects.get();
    for (const TypedObject& one : *frame->objects) {
      types[one.type].insert({scene, one.name});
      for (const auto& [type, parent] : truth.types)
        if (truth.is_a(one.type, type)) types[type].insert({scene, one.name});
    }
    for (const Fact& fact : frame->truth)
      if (fact.arguments.size() == 1 && !numbered.truths().at(fact.predicate).changes)
        traits[fact.predicate].insert({scene, fact.arguments[0]});
  }
  return {std::move(types), std::move(traits)};
}

std::vector<TypeLink> type_links(const Domain& learned, const Domain& truth,
                                 const std::vector<const JudgedFrame*>& frames, const NumberedFrames& numbered) {
  std::map<std::string, Extension> mine;
  for (const JudgedFrame* frame : frames)
    for (const Fact& fact : frame->yes)
      if (learned.types.contains(fact.predicate) && fact.arguments.size() == 1)
        mine[fact.predicate].insert({frame->objects.get(), fact.arguments[0]});
  const auto [types, traits] = true_extensions(truth, frames, numbered);
  std::vector<TypeLink> links;
  for (const auto& [type, objects] : mine) {
    TypeLink link{type, {}, 0};
    for (const auto* theirs : {&types, &traits})
      for (const auto& [name, others] : *theirs) {
        const double shared = overlap(objects, others);
        if (shared >= kLeastOverlap && shared > link.overlap) link = {type, name, shared};
      }
    links.push_back(link);
  }
  return links;
}

double best_agreement(const Mapping& mapping, const std::string& truth) {
  double best = 0;
  for (const PredicateLink& link : mapping.links)
    for (const LinkPart& part : link.parts)
      if (part.truth == truth) best = std::max(best, link.agreement);
  return best;
}

std::string part_text(const LinkPart& part) {
  std::string text = "(" + part.truth;
  for (std::size_t i = 0; i < part.argument_of.size(); ++i) {
    if (part.argument_of[i] >= 0) {
      text += " ?" + std::to_string(part.argument_of[i] + 1);
    } else {
      text += part.only_of[i].empty() ? " some" : " the " + part.only_of[i];
    }
  }
  return part.negated ? "(not " + text + "))" : text + ")";
}

void collect(const Formula& formula, std::set<std::string>& names) {
  if (formula.kind == Formula::Kind::atom) names.insert(formula.predicate);
  for (const Parameter& one : formula.variables) names.insert(one.traits.begin(), one.traits.end());
  for (const Formula& part : formula.parts) collect(part, names);
}

}  // namespace

Mapping find_mapping(const Domain& learned, const Domain& truth, const std::vector<JudgedFrame>& frames,
                     const std::set<std::string>& needed, std::size_t most) {
  const std::vector<const JudgedFrame*> chosen = evenly(frames, most);
  NumberedFrames numbered(chosen);
  std::map<std::string, std::size_t> said = said_predicates(chosen);
  std::erase_if(said, [&](const auto& one) { return learned.types.contains(one.first); });
  Mapping mapping;
  mapping.links = links_of(said, numbered);
  mapping.types = type_links(learned, truth, chosen, numbered);
  for (const std::string& name : needed)
    if (best_agreement(mapping, name) == 0) mapping.missing.push_back(name);
  mapping.coverage = coverage_of(mapping, needed);
  return mapping;
}

double coverage_of(const Mapping& mapping, const std::set<std::string>& truths) {
  double sum = 0;
  for (const std::string& name : truths) sum += best_agreement(mapping, name);
  return truths.empty() ? 1 : sum / static_cast<double>(truths.size());
}

std::set<std::string> predicates_of_actions(const Domain& domain, const std::set<std::string>& actions) {
  std::set<std::string> names;
  for (const Action& action : domain.actions) {
    if (!actions.contains(action.name)) continue;
    collect(action.precondition, names);
    for (const Parameter& one : action.parameters) names.insert(one.traits.begin(), one.traits.end());
    for (const Effect& effect : action.effects) {
      names.insert(effect.predicate);
      collect(effect.when, names);
    }
  }
  return names;
}

std::string to_text(const PredicateLink& link) {
  if (link.parts.empty()) return link.learned + " = nothing";
  std::string text;
  for (const LinkPart& part : link.parts) text += (text.empty() ? "" : " and ") + part_text(part);
  return link.learned + " = " + text;
}

}  // namespace stampede::learning
