// Negated preconditions: what failures of a skill have in common that its successes lack, and what it makes true.
#include <algorithm>
#include <cmath>

#include "engine/learning/calls.h"
#include "engine/learning/clusters.h"

namespace stampede::learning {
namespace {

constexpr double kByChance = 0.05;

struct Failure {
  LiftedAtoms before;  // over the arguments
};

// Of the preconditions those over the arguments alone.
bool refuses(const Cluster& cluster, double tolerance, const LiftedAtoms& before) {
  for (const LiftedAtom& one : preconditions(cluster, tolerance)) {
    const bool own = std::all_of(one.slots.begin(), one.slots.end(),
                                 [&](int slot) { return static_cast<std::size_t>(slot) < cluster.arguments; });
    if (own && !before.contains(one)) return true;
  }
  return std::any_of(cluster.denied.begin(), cluster.denied.end(),
                     [&](const LiftedAtom& one) { return before.contains(one); });
}

// The chance that a literal which `of_failures` of the failures have is in none of the successes, were it all the same.
double chance(std::size_t of_failures, std::size_t failures, std::size_t successes) {
  double result = 1;
  for (std::size_t i = 0; i < of_failures; ++i)
    result *= static_cast<double>(failures - i) / static_cast<double>(failures + successes - i);
  return result;
}

void deny(Cluster& cluster, const std::vector<Failure>& failures, const LearningOptions& options) {
  for (;;) {
    std::vector<const Failure*> open;
    for (const Failure& one : failures)
      if (!refuses(cluster, options.tolerance, one.before)) open.push_back(&one);
    std::map<LiftedAtom, std::size_t> counts;
    for (const Failure* one : open)
      for (const LiftedAtom& atom : one->before) ++counts[atom];
    std::erase_if(counts, [&](const auto& one) {
      const auto held = cluster.held.find(one.first);
      const double allowed = options.tolerance * static_cast<double>(cluster.members.size()) + 1e-9;
      return held != cluster.held.end() && held->second > allowed;
    });
    const auto best = std::max_element(counts.begin(), counts.end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    if (best == counts.end() || best->second < static_cast<std::size_t>(options.support) ||
        chance(best->second, open.size(), cluster.members.size()) > kByChance)
      return;
    cluster.denied.insert(best->first);
  }
}

// The atoms of `made` that hold in some state where the cluster's action can be taken.
LiftedAtoms held_already(const Cluster& cluster, LiftedAtoms made, const Experience& experience,
                         const LearningOptions& options) {
  Domain domain;
  domain.types = experience.types;
  const Action action = action_of(cluster, experience, options);
  LiftedAtoms found;
  const std::size_t count = std::min(kMostStates, experience.transitions.size());
  for (std::size_t i = 0; i < count && !made.empty(); ++i) {
    const Transition& one = experience.transitions[i * experience.transitions.size() / count];
    if (one.objects == nullptr) continue;
    for (const Call& call : applicable_calls(action, {one.before, domain, *one.objects}))
      std::erase_if(made, [&](const LiftedAtom& atom) {
        return one.before.contains(ground(atom, call)) && found.insert(atom).second;
      });
  }
  return found;
}

}  // namespace

void deny_what_is_made(const Experience& experience, std::vector<Cluster>& clusters, const LearningOptions& options) {
  for (Cluster& one : clusters) one.denied.merge(held_already(one, one.added, experience, options));
}

void deny_what_failed(const Experience& experience, std::vector<Cluster>& clusters, const LearningOptions& options,
                      LearnedOperators& counts) {
  std::map<std::string, std::vector<Failure>> failures;
  for (const Transition& one : experience.transitions)
    if (!one.success && !one.skill.empty()) failures[one.skill].push_back({lifted(one.before, one.arguments)});
  for (Cluster& one : clusters)
    if (failures.contains(one.skill)) deny(one, failures[one.skill], options);
  for (const auto& [skill, of_skill] : failures) {
    counts.failures += static_cast<int>(of_skill.size());
    for (const Failure& failure : of_skill)
      counts.explained += std::all_of(clusters.begin(), clusters.end(), [&](const Cluster& one) {
        return one.skill != skill || refuses(one, options.tolerance, failure.before);
      });
  }
}

}  // namespace stampede::learning
