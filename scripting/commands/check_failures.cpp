#include "scripting/commands/check_failures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/file_name.h"

namespace stampede::program {
namespace {

// A file's name of what a step says: `init (on peg table)` is init-on-peg-table.
std::string plain(const std::string& text) {
  std::string name;
  for (const char c : text) {
    const bool kept = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
    if (kept)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  while (name.ends_with('-')) name.pop_back();
  return name;
}

void keep_nearer(const Looked& one, std::optional<Looked>& nearest) {
  const std::vector<Looked> both = nearest ? std::vector<Looked>{*nearest, one} : std::vector<Looked>{one};
  if (nearest_miss(both) == &both.back()) nearest = one;
}

}  // namespace

void FailedSteps::add(const Impasse& impasse) {
  const std::lock_guard lock(mutex_);
  Step& step = steps_[{impasse.task, impasse.step, std::string(to_string(impasse.reason))}];
  if (impasse.reason == Reason::init_impossible) {
    step.times += impasse.draws;
    starts_.insert({impasse.task, impasse.variation, impasse.seed});
  }
  if (!step.first || impasse.seed < step.first->seed) step.first = impasse;
  const bool in_vain = impasse.reason == Reason::no_grasp || impasse.reason == Reason::no_placement ||
                       impasse.reason == Reason::init_impossible;
  if (!in_vain) return;  // something was found, and failed later
  if (impasse.reason == Reason::init_impossible && impasse.looked.empty()) ++step.details[impasse.detail];
  step.looked += static_cast<std::int64_t>(impasse.looked.size());
  for (const Looked& one : impasse.looked) {
    auto& [count, nearest] = step.causes[cause_of(one)];
    ++count;
    keep_nearer(one, nearest);
    keep_nearer(one, step.nearest);
  }
}

void FailedSteps::add(const EpisodeRecord& episode) {
  const std::lock_guard lock(mutex_);
  const auto count = [&](const std::string& step, Reason reason, const std::string& detail) {
    Step& failed = steps_[{episode.task, step, std::string(to_string(reason))}];
    ++failed.times;
    if (!detail.empty()) ++failed.details[detail];
  };
  const auto add = [&](const SegmentRecord& segment) {
    if (segment.kind != SegmentKind::skill || segment.reason == Reason::none) return;
    std::string step = segment.skill;
    for (const std::string& argument : segment.arguments) step += " " + argument;
    count(step, segment.reason, segment.detail);
  };
  for (const AttemptRecord& attempt : episode.labels.attempts) add(attempt.segment);
  for (const SegmentRecord& segment : episode.labels.segments) add(segment);
  if (episode.reason == Reason::init_impossible && !starts_.contains({episode.task, episode.variation, episode.seed}))
    count("init", episode.reason, episode.detail);
}

void FailedSteps::draw(const std::filesystem::path& folder, const OutputRules& rules) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault) throw Error(folder.string(), "the folder cannot be made: " + fault.message(), "name another one");
  FileNames names;
  for (auto& [key, step] : steps_) {
    const bool nothing_to_show = step.first && step.first->reason == Reason::init_impossible && step.looked == 0;
    if (!step.first || nothing_to_show) continue;
    const auto& [task, what, reason] = key;
    const std::filesystem::path file = folder / (names.take(plain(task + " " + what + " " + reason)) + ".png");
    draw_impasse(*step.first, file, rules);
    step.picture = file.string();
  }
}

// Counted over all tries where candidates were looked at; else what was said most often.
std::string FailedSteps::why(const Step& step) const {
  if (!step.causes.empty()) {
    const auto of_hand = [](const Looked& one) { return one.opening > 0; };
    const bool grasps = step.first->reason == Reason::no_grasp || (step.nearest && of_hand(*step.nearest));
    std::vector<std::pair<std::string, std::pair<std::int64_t, std::optional<Looked>>>> sorted(step.causes.begin(),
                                                                                               step.causes.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second.first > b.second.first; });
    std::string text = fmt::format("of {} {}", step.looked, grasps ? "grasps" : "places");
    const char* comma = ": ";
    for (const auto& [cause, known] : sorted) {
      text += fmt::format("{}{} {}", std::exchange(comma, ", "), known.first, cause);
      if (known.second && !amount_of(*known.second).empty()) text += " (" + amount_of(*known.second) + " at least)";
    }
    return text;
  }
  const auto most = std::max_element(step.details.begin(), step.details.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == step.details.end() ? "" : most->first;
}

QueryResult FailedSteps::table() const {
  std::vector<std::pair<Key, const Step*>> sorted;
  for (const auto& [key, step] : steps_) sorted.emplace_back(key, &step);
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second->times > b.second->times; });
  QueryResult table;
  table.columns = {"times", "task", "step", "reason", "why", "nearest_miss"};
  const bool pictures =
      std::any_of(steps_.begin(), steps_.end(), [](const auto& s) { return !s.second.picture.empty(); });
  if (pictures) table.columns.push_back("picture");
  for (const auto& [key, step] : sorted) {
    const auto& [task, what, reason] = key;
    table.rows.push_back({step->times, task, what, reason, why(*step), SqlValue{}});
    if (step->nearest) table.rows.back().back() = miss_of(*step->nearest);
    if (pictures) table.rows.back().push_back(step->picture.empty() ? SqlValue{} : SqlValue{step->picture});
  }
  return table;
}

}  // namespace stampede::program
