// Behaviour with undo: a depth-first search over draws, whose states are snapshots at skill boundaries.
#include <algorithm>
#include <map>

#include "engine/episode/drivers.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

// Nothing to take, nowhere to put it: what was done before changes that seldom, and other draws never where a thing is
// out of reach. So often it is tried again; then another way is looked for, and in the end the plan is given up.
constexpr int kSameBeforeOtherWay = 6, kSameAtMost = 12;

constexpr std::size_t kMostDetours = 3;  // one within the other: what is in the way of what is in the way

// Where an undone episode stands. places_[i] is before step i of the plan, failures_[i] counts what failed there.
class Undo {
 public:
  explicit Undo(Drive& drive) : drive_(drive), plan_(drive.plan), track_(drive.track), start_(drive.track.here()) {}
  SkillResult run();

 private:
  using Place = SkillTrack::Place;
  struct Detour {  // a plan that moves something out of the way first
    std::size_t index = 0;
    CurrentPlan::Course before;  // what it took the place of
    std::size_t obstructions = 0;
  };

  SkillResult step();
  void restart();
  void step_done();
  bool try_again(const SkillResult& failed);
  bool another_way(const SkillResult& failed);
  bool go_round(const SkillResult& blocked);
  void leave_detour(int most);
  bool other_plan();
  SkillResult with_bottleneck(SkillResult last, int tries) const;

  Drive& drive_;
  CurrentPlan& plan_;
  SkillTrack& track_;
  const Place start_;
  std::vector<Place> places_;
  std::vector<int> failures_;
  std::map<std::size_t, SkillResult> blocked_;  // what was found in the way of a step
  std::vector<Detour> detours_;                 // the later ones within the earlier ones
  std::map<PlanStep, int> blame_, failed_;      // failures of each ground action: since a plan did without it; in all
  std::map<PlanStep, int> same_;                // of these, how often it found nothing to take or no place
  std::size_t i_ = 0;
};

void Undo::restart() {
  places_ = {start_};
  failures_.assign(plan_.size() + 1, 0);
  blocked_.clear();
  detours_.clear();
  i_ = 0;
}

SkillResult Undo::step() {
  if (i_ == plan_.size()) return track_.finish_goal(i_);
  return track_.run(plan_.next(i_), i_, plan_.set(i_), plan_.mode(i_));
}

SkillResult Undo::run() {
  SkillResult last;
  int tries = 0;
  for (int plans = 0; plans < drive_.options.plans; ++plans) {
    same_.clear();
    restart();
    while (true) {
      last = step();
      const bool step_failed = !last.ok();  // else it went well, and what came of it leaves no plan
      if (last.ok() && i_ == plan_.size()) return last;
      if (last.ok()) last = plan_.watch(i_ + 1, last.segment);
      if (last.ok()) {
        step_done();
        continue;
      }
      const bool hopeless = last.reason == Reason::interrupted || last.reason == Reason::sensor_error ||
                            last.reason == Reason::script_error;
      if (hopeless) return last;
      if (i_ == plan_.size() && i_ > 0) --i_;
      if (i_ < plan_.size()) ++blame_[plan_.steps[i_]];
      if (i_ < plan_.size() && step_failed) ++failed_[plan_.steps[i_]];
      if (++tries >= drive_.options.tries_per_episode) return with_bottleneck(std::move(last), tries);
      if (another_way(last)) continue;
      if (!try_again(last)) break;
    }
    const CurrentPlan::Course failed = plan_.course();
    drive_.documents.push_back(
        {DocumentKind::failed_plan,
         to_text(failed.steps) + "; " + std::string(to_string(last.reason)) + ": " + last.detail + "\n"});
    if (plan_.given() || plan_.steps.empty()) return last;
    if (!other_plan()) {
      plan_.take(failed);  // no other way: what failed stays the episode's result
      const SkillResult again = follow_plan(drive_);
      return again.ok() ? again : with_bottleneck(std::move(last), tries);
    }
  }
  return with_bottleneck(std::move(last), tries);
}

void Undo::step_done() {
  places_.resize(++i_);
  places_.push_back(track_.here());
  failures_.resize(plan_.size() + 1, 0);
  failures_[i_] = 0;
  blocked_.erase(blocked_.lower_bound(i_), blocked_.end());
  if (detours_.empty()) return;
  const std::size_t first = detours_.back().obstructions;  // of those that the last detour is for
  if (first < plan_.obstructions.size() && plan_.steps[i_ - 1] == plan_.obstructions[first].action)
    detours_.pop_back();  // it led where it should
}

// A plan for the rest that does without a step which keeps failing for the same reason, whatever was done before it.
bool Undo::another_way(const SkillResult& failed) {
  const bool nothing = failed.reason == Reason::no_grasp || failed.reason == Reason::no_placement;
  if (!nothing || plan_.given() || i_ >= plan_.size()) return false;
  const PlanStep step = plan_.steps[i_];
  if (++same_[step] != kSameBeforeOtherWay || !detours_.empty()) return false;
  track_.back_to(places_[i_]);
  plan_.forbidden.insert(step);
  if (!plan_.again(i_).ok()) {
    plan_.forbidden.erase(step);
    return false;
  }
  blame_.erase(step);
  failures_.resize(plan_.size() + 1, 0);
  std::fill(failures_.begin() + static_cast<std::ptrdiff_t>(i_), failures_.end(), 0);
  blocked_.erase(blocked_.lower_bound(i_), blocked_.end());
  return true;
}

// Chooses where to go on after a failure, and goes there: the same step with other draws; a detour around what was
// found in the way; back from a detour that did not work; else the step before. False: this plan is used up.
bool Undo::try_again(const SkillResult& failed) {
  // Where nothing can be grasped, other draws seldom help: what came before has to change.
  const int allowed = drive_.options.tries_per_skill;
  const int most = failed.reason == Reason::no_grasp ? std::min(2, allowed) : allowed;
  if (!failed.blockers.empty()) blocked_[i_] = failed;
  if (const auto same = same_.find(i_ < plan_.size() ? plan_.steps[i_] : PlanStep{});
      same != same_.end() && same->second >= kSameAtMost && detours_.empty())
    return false;
  if (++failures_[i_] < most) {
    track_.back_to(places_[i_]);
    return true;
  }
  if (const auto found = blocked_.find(i_); found != blocked_.end() && detours_.size() < kMostDetours) {
    const SkillResult blocked = found->second;
    blocked_.erase(found);
    if (go_round(blocked)) return true;
  }
  leave_detour(most);
  while (failures_[i_] >= most && i_ > 0) {
    failures_[i_--] = 0;
    ++failures_[i_];
  }
  if (failures_[i_] >= most) return false;
  places_.resize(i_ + 1);
  track_.back_to(places_[i_]);
  return true;
}

// What is put down beside something has nowhere else to go: then from before the step that took it.
bool Undo::go_round(const SkillResult& blocked) {
  const std::size_t here = i_;
  Detour detour{i_, plan_.course(), plan_.obstructions.size()};
  const auto found = [&] {
    track_.back_to(places_[i_]);
    return plan_.avoid(blocked, i_);
  };
  if (!found() && (!plan_.relates() || i_-- == 0 || !found())) {
    i_ = here;
    track_.back_to(places_[i_]);
    return false;
  }
  detour.index = i_;
  places_.resize(i_ + 1);
  detours_.push_back(std::move(detour));
  failures_.assign(plan_.size() + 1, 0);
  return true;
}

void Undo::leave_detour(int most) {
  if (detours_.empty()) return;
  Detour failed = std::move(detours_.back());
  detours_.pop_back();
  i_ = std::min(i_, failed.index);  // it may have been left backwards
  plan_.take(std::move(failed.before));
  plan_.obstructions.resize(std::min(plan_.obstructions.size(), failed.obstructions));
  failures_.assign(plan_.size() + 1, 0);
  places_.resize(i_ + 1);
  failures_[i_] = most;
}

// The next plan does without the action that failed most.
bool Undo::other_plan() {
  const auto worst =
      std::max_element(blame_.begin(), blame_.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  plan_.forbidden.insert(worst == blame_.end() ? plan_.steps.front() : worst->first);
  if (worst != blame_.end()) blame_.erase(worst);
  plan_.obstructions.clear();
  track_.back_to(start_);
  return plan_.again(0).ok();
}

// Says which step failed most, where that is not the one that failed last. What left no plan was no step's failure.
SkillResult Undo::with_bottleneck(SkillResult last, int tries) const {
  const auto worst = std::max_element(failed_.begin(), failed_.end(),
                                      [](const auto& a, const auto& b) { return a.second < b.second; });
  if (worst == failed_.end() || (i_ < plan_.size() && worst->first == plan_.steps[i_])) return last;
  last.detail += "; of " + std::to_string(tries) + " failures " + std::to_string(worst->second) + " were of " +
                 to_text(Fact{worst->first.action, worst->first.arguments});
  return last;
}

}  // namespace

SkillResult follow_with_undo(Drive& drive) { return Undo(drive).run(); }

}  // namespace stampede
