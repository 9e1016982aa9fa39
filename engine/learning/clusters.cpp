#include "engine/learning/clusters.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/base/error.h"

namespace stampede::learning {
namespace {

bool distinct(const std::vector<std::string>& objects) {
  return std::set<std::string>(objects.begin(), objects.end()).size() == objects.size();
}

// Adds a transition with the order of its further objects that keeps the most of what held of the others.
void add_member(Cluster& cluster, const Transition& transition, const LiftedChange& change) {
  const std::vector<std::string>* best = nullptr;
  LiftedAtoms held;
  int most = -1;
  for (const std::vector<std::string>& order : change.orders) {
    LiftedAtoms here = lifted(transition.before, order);
    const int kept = static_cast<int>(std::count_if(here.begin(), here.end(), [&](const LiftedAtom& one) {
      const auto known = cluster.held.find(one);
      return known != cluster.held.end() && known->second == static_cast<int>(cluster.members.size());
    }));
    if (kept <= most) continue;
    most = kept;
    best = &order;
    held = std::move(here);
  }
  for (const LiftedAtom& one : held) ++cluster.held[one];
  cluster.members.push_back({&transition, *best});
}

std::vector<std::string> ancestors(const std::string& type, const std::map<std::string, std::string>& types) {
  std::vector<std::string> chain = {type};
  for (auto at = types.find(type); at != types.end() && at->second != "object" && chain.size() <= types.size();
       at = types.find(at->second))
    chain.push_back(at->second);
  if (chain.back() != "object") chain.emplace_back("object");
  return chain;
}

const std::string& type_of(const std::string& object, const Objects& objects) {
  static const std::string kAny = "object";
  if (objects == nullptr) return kAny;
  for (const TypedObject& one : *objects)
    if (one.name == object) return one.type.empty() ? kAny : one.type;
  return kAny;
}

// The only object of each type, where there is just one.
std::map<std::string, std::string> only_ones(const Transition& transition) {
  std::map<std::string, std::string> found;
  if (transition.objects == nullptr) return found;
  std::map<std::string, int> counts;
  for (const TypedObject& one : *transition.objects) {
    ++counts[one.type];
    found[one.type] = one.name;
  }
  std::erase_if(found, [&](const auto& one) { return counts[one.first] != 1; });
  return found;
}

// Types with just one object in the scene of every member, none of which is a slot already.
std::set<std::string> types_of_only_ones(const Cluster& cluster) {
  std::set<std::string> shared;
  for (std::size_t i = 0; i < cluster.members.size(); ++i) {
    std::set<std::string> here;
    for (const auto& [type, object] : only_ones(*cluster.members[i].transition)) {
      const std::vector<std::string>& slots = cluster.members[i].objects;
      if (std::find(slots.begin(), slots.end(), object) == slots.end() && (i == 0 || shared.contains(type)))
        here.insert(type);
    }
    shared = std::move(here);
  }
  return shared;
}

}  // namespace

std::vector<Cluster> cluster_by_effects(const Experience& experience, const LearningOptions& options) {
  std::map<std::tuple<std::string, LiftedAtoms, LiftedAtoms>, Cluster> found;
  std::map<std::string, int> of_skill;
  for (const Transition& one : experience.transitions) {
    if (!one.success || !distinct(one.arguments)) continue;
    ++of_skill[one.skill];
    const LiftedChange change = lifted_change(one.before, one.after, one.arguments, options.further);
    if (change.orders.empty() || (change.added.empty() && change.removed.empty())) continue;
    Cluster& cluster = found[{one.skill, change.added, change.removed}];
    cluster.skill = one.skill;
    cluster.arguments = one.arguments.size();
    cluster.added = change.added;
    cluster.removed = change.removed;
    add_member(cluster, one, change);
  }
  std::vector<Cluster> clusters;
  for (auto& [key, cluster] : found) {
    const auto seen = static_cast<double>(cluster.members.size());
    if (seen >= options.support && seen >= options.share * of_skill[cluster.skill])
      clusters.push_back(std::move(cluster));
  }
  std::stable_sort(clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
    return a.skill != b.skill ? a.skill < b.skill : a.members.size() > b.members.size();
  });
  return clusters;
}

LiftedAtoms preconditions(const Cluster& cluster, double tolerance) {
  const double needed = (1 - tolerance) * static_cast<double>(cluster.members.size()) - 1e-9;
  LiftedAtoms kept;
  for (const auto& [one, count] : cluster.held)
    if (count >= needed) kept.insert(one);
  return kept;
}

std::vector<std::string> slot_types(const Cluster& cluster, const std::map<std::string, std::string>& types) {
  std::vector<std::string> result;
  for (std::size_t slot = 0; slot < cluster.members.front().objects.size(); ++slot) {
    std::vector<std::string> shared;
    for (const Cluster::Member& member : cluster.members) {
      const std::vector<std::string> chain =
          ancestors(type_of(member.objects[slot], member.transition->objects), types);
      if (shared.empty()) shared = chain;
      std::erase_if(shared,
                    [&](const std::string& one) { return std::find(chain.begin(), chain.end(), one) == chain.end(); });
    }
    result.push_back(shared.empty() ? "object" : shared.front());
  }
  return result;
}

std::set<std::string> changing_predicates(const Experience& experience) {
  std::set<std::string> changing;
  for (const Transition& one : experience.transitions) {
    Facts differ;
    std::set_symmetric_difference(one.before.begin(), one.before.end(), one.after.begin(), one.after.end(),
                                  std::inserter(differ, differ.end()));
    for (const Fact& fact : differ) changing.insert(fact.predicate);
  }
  return changing;
}

void add_only_ones(Cluster& cluster, const std::set<std::string>& changing, double tolerance) {
  for (const std::string& type : types_of_only_ones(cluster)) {
    Cluster wider = cluster;
    const int slot = static_cast<int>(cluster.members.front().objects.size());
    wider.held.clear();
    for (Cluster::Member& member : wider.members) {
      member.objects.push_back(only_ones(*member.transition).at(type));
      for (const LiftedAtom& one : lifted(member.transition->before, member.objects)) ++wider.held[one];
    }
    const LiftedAtoms kept = preconditions(wider, tolerance);
    const bool matters = std::any_of(kept.begin(), kept.end(), [&](const LiftedAtom& one) {
      return changing.contains(one.predicate) && std::find(one.slots.begin(), one.slots.end(), slot) != one.slots.end();
    });
    if (matters) cluster = std::move(wider);
  }
}

}  // namespace stampede::learning
