// Behaviour with undo: a depth-first search over draws, whose states are snapshots at skill boundaries.
#include <algorithm>

#include "engine/episode/episode_runner.h"

namespace stampede {
namespace {

constexpr std::size_t kMostDetours = 3;  // one within the other: what is in the way of what is in the way

}  // namespace

// Where an undone episode stands. places[i] is before step i of the plan, failures[i] counts what failed there.
struct EpisodeRunner::Undo {
  struct Detour {  // a plan that moves something out of the way first
    std::size_t index = 0;
    Plan before;  // the plan that it took the place of
    std::size_t obstructions = 0;
  };
  std::vector<Place> places;
  std::vector<int> failures;
  std::map<std::size_t, SkillResult> blocked;  // what was found in the way of a step
  std::vector<Detour> detours;                 // the later ones within the earlier ones
  std::size_t i = 0;

  void restart(const Place& start, std::size_t steps) {
    places = {start};
    failures.assign(steps + 1, 0);
    blocked.clear();
    detours.clear();
    i = 0;
  }
};

SkillResult EpisodeRunner::with_undo() {
  const Place start = here();
  SkillResult last;
  Undo undo;
  int tries = 0;
  std::map<PlanStep, int> blame;  // failures of each ground action
  for (int plans = 0; plans < options_.plans; ++plans) {
    undo.restart(start, plan_.size());
    while (true) {
      last = undo.i == plan_.size() ? finish_goal(undo.i) : one_step(undo.i, undo.i);
      if (last.ok() && undo.i == plan_.size()) return last;
      if (last.ok()) last = watch(undo.i + 1);
      if (last.ok()) {
        step_done(undo);
        continue;
      }
      if (last.reason == Reason::interrupted || ++tries >= options_.tries_per_episode) return last;
      if (undo.i == plan_.size() && undo.i > 0) --undo.i;
      if (undo.i < plan_.size()) ++blame[plan_[undo.i]];
      if (!try_again(undo, last)) break;
    }
    const Plan failed = plan_;
    record_.documents.push_back(
        {"failed_plan", to_text(failed) + "; " + std::string(to_string(last.reason)) + ": " + last.detail + "\n"});
    if (explicit_steps_ || plan_.empty()) return last;
    if (!other_plan(start, blame)) {
      plan_ = failed;  // no other way: what failed stays the episode's result
      SkillResult again = straight();
      return again.ok() ? again : last;
    }
  }
  return last;
}

void EpisodeRunner::step_done(Undo& undo) {
  undo.places.resize(++undo.i);
  undo.places.push_back(here());
  undo.failures.resize(plan_.size() + 1, 0);
  undo.failures[undo.i] = 0;
  undo.blocked.erase(undo.blocked.lower_bound(undo.i), undo.blocked.end());
  if (undo.detours.empty()) return;
  const std::size_t first = undo.detours.back().obstructions;  // of those that the last detour is for
  if (first < obstructions_.size() && plan_[undo.i - 1] == obstructions_[first].action)
    undo.detours.pop_back();  // it led where it should
}

// Chooses where to go on after a failure, and goes there: the same step with other draws; a detour around what was
// found in the way; back from a detour that did not work; else the step before. False: this plan is used up.
bool EpisodeRunner::try_again(Undo& undo, const SkillResult& failed) {
  std::size_t& i = undo.i;
  // Where nothing can be grasped, other draws seldom help: what came before has to change.
  const int most = failed.reason == Reason::no_grasp ? std::min(2, options_.tries_per_skill) : options_.tries_per_skill;
  if (!failed.blockers.empty()) undo.blocked[i] = failed;
  if (++undo.failures[i] < most) {
    back_to(undo.places[i]);
    return true;
  }
  if (const auto found = undo.blocked.find(i); found != undo.blocked.end() && undo.detours.size() < kMostDetours) {
    const SkillResult blocked = found->second;
    undo.blocked.erase(found);
    back_to(undo.places[i]);
    Undo::Detour detour{i, plan_, obstructions_.size()};
    if (avoid_obstacles(blocked, i)) {
      undo.detours.push_back(std::move(detour));
      undo.failures.assign(plan_.size() + 1, 0);
      return true;
    }
  }
  if (!undo.detours.empty()) {
    const Undo::Detour failed_detour = std::move(undo.detours.back());
    undo.detours.pop_back();
    i = std::min(i, failed_detour.index);  // it may have been left backwards
    plan_ = failed_detour.before;
    obstructions_.resize(std::min(obstructions_.size(), failed_detour.obstructions));
    undo.failures.assign(plan_.size() + 1, 0);
    undo.places.resize(i + 1);
    undo.failures[i] = most;
  }
  while (undo.failures[i] >= most && i > 0) {
    undo.failures[i--] = 0;
    ++undo.failures[i];
  }
  if (undo.failures[i] >= most) return false;
  undo.places.resize(i + 1);
  back_to(undo.places[i]);
  return true;
}

// The next plan does without the action that failed most.
bool EpisodeRunner::other_plan(const Place& start, std::map<PlanStep, int>& blame) {
  const auto worst =
      std::max_element(blame.begin(), blame.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  forbidden_.insert(worst == blame.end() ? plan_.front() : worst->first);
  if (worst != blame.end()) blame.erase(worst);
  obstructions_.clear();
  back_to(start);
  return plan_rest(0).ok();
}

}  // namespace stampede
