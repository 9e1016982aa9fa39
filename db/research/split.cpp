#include "db/research/split.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"

namespace stampede::research {
namespace {

constexpr const char* kWhere = "--split";
constexpr double kValidation = 0.15, kTest = 0.15;
constexpr double kComposed = 0.2;  // of the episodes that held-out pairs should test

using Pair = std::pair<std::string, std::string>;

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ",") + word;
  return text;
}

// An order that has nothing to do with how episodes were made.
std::uint64_t lot(const SplitEpisode& episode) { return hash64(episode.key, 0x73706c6974); }

std::vector<const SplitEpisode*> by_lot(const std::vector<const SplitEpisode*>& episodes) {
  std::vector<const SplitEpisode*> sorted = episodes;
  std::sort(sorted.begin(), sorted.end(), [](const SplitEpisode* a, const SplitEpisode* b) {
    return std::pair(lot(*a), a->key) < std::pair(lot(*b), b->key);
  });
  return sorted;
}

// Shares of a task's episodes, rounded, but one each as soon as there are three.
void share_out(const std::vector<const SplitEpisode*>& episodes, double test, Split& split) {
  std::map<std::string, std::vector<const SplitEpisode*>> of_task;
  for (const SplitEpisode* episode : episodes) of_task[episode->task].push_back(episode);
  for (const auto& [task, some] : of_task) {
    const std::vector<const SplitEpisode*> order = by_lot(some);
    const auto count = static_cast<double>(order.size());
    const auto part = [&](double share) {
      if (share == 0) return std::size_t{0};
      return std::max<std::size_t>(order.size() >= 3 ? 1 : 0, static_cast<std::size_t>(std::lround(share * count)));
    };
    const std::size_t tests = part(test), validations = part(kValidation);
    for (std::size_t i = 0; i < order.size(); ++i)
      split.of[order[i]->id] = i < tests ? "test" : i < tests + validations ? "validation" : "train";
  }
}

std::vector<Pair> pairs_of(const SplitEpisode& episode, const SplitRule& rule) {
  std::vector<Pair> pairs;
  if (rule.kind == SplitRule::Kind::axis_pairs) {
    const auto first = episode.axes.find(rule.axis), second = episode.axes.find(rule.other_axis);
    if (first != episode.axes.end() && second != episode.axes.end()) pairs.emplace_back(first->second, second->second);
    return pairs;
  }
  for (std::size_t i = 1; i < episode.skills.size(); ++i) pairs.emplace_back(episode.skills[i - 1], episode.skills[i]);
  return pairs;
}

// The parts of pairs that an episode shows.
std::set<Pair> singles_of(const SplitEpisode& episode, const SplitRule& rule) {
  std::set<Pair> singles;
  if (rule.kind == SplitRule::Kind::axis_pairs) {
    for (const auto& [axis, value] : episode.axes)
      if (axis == rule.axis || axis == rule.other_axis) singles.emplace(axis, value);
  } else {
    for (const std::string& skill : episode.skills) singles.emplace("skill", skill);
  }
  return singles;
}

bool trains_all(const std::vector<SplitEpisode>& episodes, const SplitRule& rule, const std::set<Pair>& held) {
  std::set<Pair> all, trained;
  for (const SplitEpisode& episode : episodes) {
    const std::set<Pair> singles = singles_of(episode, rule);
    all.insert(singles.begin(), singles.end());
    const std::vector<Pair> pairs = pairs_of(episode, rule);
    if (std::none_of(pairs.begin(), pairs.end(), [&](const Pair& pair) { return held.contains(pair); }))
      trained.insert(singles.begin(), singles.end());
  }
  return all == trained;
}

std::int64_t tested_by(const std::vector<SplitEpisode>& episodes, const SplitRule& rule, const std::set<Pair>& held) {
  return std::count_if(episodes.begin(), episodes.end(), [&](const SplitEpisode& episode) {
    const std::vector<Pair> pairs = pairs_of(episode, rule);
    return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& pair) { return held.contains(pair); });
  });
}

// Pairs whose parts are all seen in training, the rarest first, until they test a fifth of the episodes.
std::set<Pair> pairs_to_hold_out(const std::vector<SplitEpisode>& episodes, const SplitRule& rule) {
  std::map<Pair, std::int64_t> counts;
  for (const SplitEpisode& episode : episodes) {
    const std::vector<Pair> pairs = pairs_of(episode, rule);
    for (const Pair& pair : std::set<Pair>(pairs.begin(), pairs.end())) ++counts[pair];
  }
  std::vector<std::pair<std::int64_t, Pair>> rarest;
  for (const auto& [pair, count] : counts) rarest.emplace_back(count, pair);
  std::sort(rarest.begin(), rarest.end());
  std::set<Pair> held;
  const auto wanted = static_cast<std::int64_t>(std::ceil(kComposed * static_cast<double>(episodes.size())));
  for (const auto& [count, pair] : rarest) {
    if (tested_by(episodes, rule, held) >= wanted) break;
    std::set<Pair> more = held;
    more.insert(pair);
    if (trains_all(episodes, rule, more)) held = std::move(more);
  }
  return held;
}

bool holds_out(const SplitEpisode& episode, const SplitRule& rule, const std::set<Pair>& held) {
  const auto one_of = [&](const std::string& value) {
    return std::find(rule.values.begin(), rule.values.end(), value) != rule.values.end();
  };
  switch (rule.kind) {
    case SplitRule::Kind::seeds:
      return episode.catalogue_split == "test";
    case SplitRule::Kind::axis: {
      const auto found = episode.axes.find(rule.axis);
      return found != episode.axes.end() && one_of(found->second);
    }
    case SplitRule::Kind::object:
      return std::any_of(episode.classes.begin(), episode.classes.end(), one_of);
    case SplitRule::Kind::task:
      return one_of(episode.task);
    case SplitRule::Kind::skill_pairs:
    case SplitRule::Kind::axis_pairs:
      break;
  }
  const std::vector<Pair> pairs = pairs_of(episode, rule);
  return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& pair) { return held.contains(pair); });
}

// All values that could have been meant.
std::vector<std::string> values_of(const std::vector<SplitEpisode>& episodes, const SplitRule& rule) {
  std::set<std::string> values;
  for (const SplitEpisode& episode : episodes) {
    if (rule.kind == SplitRule::Kind::task) values.insert(episode.task);
    if (rule.kind == SplitRule::Kind::object) values.insert(episode.classes.begin(), episode.classes.end());
    if (rule.kind != SplitRule::Kind::axis) continue;
    if (const auto found = episode.axes.find(rule.axis); found != episode.axes.end()) values.insert(found->second);
  }
  return {values.begin(), values.end()};
}

void check_axis(const std::vector<SplitEpisode>& episodes, const std::string& axis) {
  std::set<std::string> axes;
  for (const SplitEpisode& episode : episodes)
    for (const auto& [name, value] : episode.axes) axes.insert(name);
  if (axes.contains(axis)) return;
  std::string known;
  for (const std::string& name : axes) known += (known.empty() ? "" : ", ") + name;
  throw Error(kWhere, "no episode of this catalogue has the axis '" + axis + "'",
              known.empty() ? "its tasks have no variations" : "its axes are " + known);
}

// No pair of values can be held out of axes that no task varies together.
void check_both_axes(const std::vector<SplitEpisode>& episodes, const SplitRule& rule) {
  std::map<std::string, std::string> axes_of_task;
  for (const SplitEpisode& episode : episodes) {
    if (episode.axes.contains(rule.axis) && episode.axes.contains(rule.other_axis)) return;
    std::string& axes = axes_of_task[episode.task];
    if (axes.empty())
      for (const auto& [axis, value] : episode.axes) axes += (axes.empty() ? "" : ", ") + axis;
  }
  std::string known;
  for (const auto& [task, axes] : axes_of_task)
    known += (known.empty() ? "" : "; ") + task + " has " + (axes.empty() ? "none" : axes);
  throw Error(kWhere, "no task of this catalogue has both axes '" + rule.axis + "' and '" + rule.other_axis + "'",
              "name two axes of one task: " + known);
}

void check_rule(const std::vector<SplitEpisode>& episodes, const SplitRule& rule) {
  if (rule.kind == SplitRule::Kind::axis || rule.kind == SplitRule::Kind::axis_pairs) check_axis(episodes, rule.axis);
  if (rule.kind == SplitRule::Kind::axis_pairs) {
    check_axis(episodes, rule.other_axis);
    check_both_axes(episodes, rule);
  }
  const std::vector<std::string> known = values_of(episodes, rule);
  for (const std::string& value : rule.values)
    if (std::find(known.begin(), known.end(), value) == known.end())
      throw Error(kWhere,
                  "no episode of this catalogue has " + rule.text().substr(0, rule.text().find('=')) + "=" + value,
                  did_you_mean(value, known));
}

}  // namespace

std::string SplitRule::text() const {
  switch (kind) {
    case Kind::seeds:
      return "seeds";
    case Kind::axis:
      return axis + "=" + joined(values);
    case Kind::object:
      return "object=" + joined(values);
    case Kind::task:
      return "task=" + joined(values);
    case Kind::skill_pairs:
      return "composition";
    case Kind::axis_pairs:
      return "composition=" + axis + "+" + other_axis;
  }
  return "";
}

SplitRule split_rule(std::string_view text) {
  constexpr const char* kCure =
      "it is seeds, AXIS=VALUE,…, object=CLASS,…, task=NAME,…, composition, or composition=AXIS+AXIS";
  SplitRule rule;
  if (text == "seeds") return rule;
  if (text == "composition") return {.kind = SplitRule::Kind::skill_pairs};
  const std::size_t at = text.find('=');
  if (at == std::string_view::npos || at == 0 || at + 1 == text.size())
    throw Error(kWhere, "'" + std::string(text) + "' is no split", kCure);
  const std::string name(text.substr(0, at));
  if (name == "composition") {
    const std::vector<std::string> axes = split(text.substr(at + 1), '+');
    if (axes.size() != 2 || axes[0].empty() || axes[1].empty() || axes[0] == axes[1])
      throw Error(kWhere, "composition takes two axes, as in composition=colour+height", kCure);
    return {.kind = SplitRule::Kind::axis_pairs, .axis = axes[0], .other_axis = axes[1]};
  }
  rule.kind = name == "object" ? SplitRule::Kind::object
              : name == "task" ? SplitRule::Kind::task
                               : SplitRule::Kind::axis;
  if (rule.kind == SplitRule::Kind::axis) rule.axis = name;
  rule.values = split(text.substr(at + 1), ',');
  std::sort(rule.values.begin(), rule.values.end());
  rule.values.erase(std::unique(rule.values.begin(), rule.values.end()), rule.values.end());
  for (const std::string& value : rule.values)
    if (value.find('=') != std::string::npos)
      throw Error(kWhere, "'" + value + "' is no value of " + name + ": one split holds out values of one axis",
                  "hold out pairs of values with composition=AXIS+AXIS");
  if (rule.values.front().empty()) throw Error(kWhere, "'" + std::string(text) + "' names an empty value", kCure);
  return rule;
}

std::vector<SplitEpisode> episodes_to_split(const Catalogue& catalogue, bool demos_only, const std::string& where) {
  const std::string which = demos_only ? "demos" : "episodes";
  std::map<std::int64_t, SplitEpisode> all;
  const Rows rows = catalogue.query("SELECT episode, key, task, split FROM " + which + " WHERE frames > 0" +
                                    (where.empty() ? "" : " AND (" + where + ")"));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    SplitEpisode& one = all[rows.integer(i, "episode")];
    one.id = rows.integer(i, "episode"), one.key = rows.text(i, "key");
    one.task = rows.text(i, "task"), one.catalogue_split = rows.text(i, "split");
  }
  const auto each = [&](const std::string& select, auto take) {
    const Rows found = catalogue.query(select);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (const auto one = all.find(found.integer(i, "episode")); one != all.end()) take(one->second, found, i);
  };
  each("SELECT episode, axis, value FROM axes", [](SplitEpisode& one, const Rows& found, std::size_t i) {
    one.axes[found.text(i, "axis")] = found.text(i, "value");
  });
  each("SELECT DISTINCT episode, class FROM objects WHERE class <> ''",
       [](SplitEpisode& one, const Rows& found, std::size_t i) { one.classes.insert(found.text(i, "class")); });
  each("SELECT episode, skill FROM segments WHERE kind = 'skill' ORDER BY episode, segment",
       [](SplitEpisode& one, const Rows& found, std::size_t i) { one.skills.push_back(found.text(i, "skill")); });
  std::vector<SplitEpisode> list;
  for (auto& [id, one] : all) list.push_back(std::move(one));
  std::sort(list.begin(), list.end(), [](const SplitEpisode& a, const SplitEpisode& b) { return a.key < b.key; });
  return list;
}

Split split_episodes(const std::vector<SplitEpisode>& episodes, const SplitRule& rule) {
  check_rule(episodes, rule);
  Split result;
  std::set<Pair> held;
  if (rule.kind == SplitRule::Kind::skill_pairs || rule.kind == SplitRule::Kind::axis_pairs)
    if (held = pairs_to_hold_out(episodes, rule); held.empty())
      throw Error(kWhere, "no pair can be held out by " + rule.text() + " such that each of its parts is still trained",
                  "make episodes of more tasks or variations, or split by seeds");
  for (const std::string& value : rule.values)
    result.held_out.push_back({rule.text().substr(0, rule.text().find('=')), value, ""});
  for (const Pair& pair : held)
    result.held_out.push_back({rule.kind == SplitRule::Kind::axis_pairs ? rule.axis + "+" + rule.other_axis : "skills",
                               pair.first, pair.second});
  std::vector<const SplitEpisode*> rest;
  for (const SplitEpisode& episode : episodes) {
    if (holds_out(episode, rule, held))
      result.of[episode.id] = "test";
    else
      rest.push_back(&episode);
  }
  const bool tested = rest.size() < episodes.size();
  share_out(rest, !tested && rule.kind == SplitRule::Kind::seeds ? kTest : 0, result);
  const auto count = [&](const char* name) {
    return std::count_if(result.of.begin(), result.of.end(), [&](const auto& one) { return one.second == name; });
  };
  if (count("train") == 0)
    throw Error(kWhere,
                "nothing is left to train on: " + rule.text() + " holds out " +
                    (rest.empty() ? "all " : std::to_string(episodes.size() - rest.size()) + " of ") +
                    std::to_string(episodes.size()) + " episodes",
                "hold out less, or make more episodes");
  if (count("test") == 0)
    throw Error(kWhere,
                "nothing is left to test on: " + std::to_string(episodes.size()) + " episodes, split by " + rule.text(),
                "make more episodes (three of each task at least), of more tasks or variations");
  return result;
}

}  // namespace stampede::research
