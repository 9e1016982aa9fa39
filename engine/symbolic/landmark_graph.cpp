#include "engine/symbolic/landmark_graph.h"

#include <algorithm>
#include <deque>
#include <iterator>

namespace stampede::symbolic {
namespace {

constexpr std::size_t kMostLabelWords = 16'000'000;  // 128 MB
constexpr std::size_t kMostLabelWork = 60'000'000;   // words touched when each rule is looked at a few times

// A node's label: the nodes that are true before or with it in every relaxed plan for it.
class NodeLabels {
 public:
  NodeLabels(const GroundTask& task, const Relaxation& relaxation, const Words& start)
      : words((static_cast<std::size_t>(relaxation.nodes) + 63) / 64) {
    const std::size_t nodes = static_cast<std::size_t>(relaxation.nodes);
    if (words * nodes <= kMostLabelWords && words * (relaxation.conditions.size() + nodes) <= kMostLabelWork) {
      spread(task, relaxation, start);
    }
  }
  bool empty() const { return bits_.empty(); }                    // it would be too much
  bool labelled(int node) const { return labelled_[node] != 0; }  // reached by the relaxation
  const std::uint64_t* of(int node) const { return bits_.data() + static_cast<std::size_t>(node) * words; }
  const std::size_t words;

 private:
  void spread(const GroundTask& task, const Relaxation& relaxation, const Words& start);
  std::vector<std::uint64_t> bits_;  // by node
  std::vector<char> labelled_;
};

void NodeLabels::spread(const GroundTask& task, const Relaxation& relaxation, const Words& start) {
  bits_.assign(static_cast<std::size_t>(relaxation.nodes) * words, 0);
  labelled_.assign(static_cast<std::size_t>(relaxation.nodes), 0);
  std::vector<int> open;
  std::deque<int> queue;
  std::vector<char> queued(relaxation.rules.size(), 0);
  for (const Relaxation::Rule& rule : relaxation.rules) open.push_back(rule.conditions_end - rule.conditions_begin);
  const auto enqueue = [&](int rule) {
    if (open[rule] > 0 || queued[rule]) return;
    queued[rule] = 1;
    queue.push_back(rule);
  };
  const auto now_labelled = [&](int node) {
    labelled_[node] = 1;
    for (int i = relaxation.used_begin[node]; i < relaxation.used_begin[node + 1]; ++i) --open[relaxation.used[i]];
  };
  for (int fact = 0; fact < task.facts; ++fact) {
    const int node = 2 * fact + (test(start.data(), fact) ? 0 : 1);
    if (!relaxation.needed[node]) continue;
    set_bit(bits_.data() + static_cast<std::size_t>(node) * words, node);
    now_labelled(node);
  }
  for (std::size_t rule = 0; rule < relaxation.rules.size(); ++rule) enqueue(static_cast<int>(rule));
  std::vector<std::uint64_t> joined(words);
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop_front();
    queued[at] = 0;
    const Relaxation::Rule& rule = relaxation.rules[at];
    std::fill(joined.begin(), joined.end(), 0);
    for (int i = rule.conditions_begin; i < rule.conditions_end; ++i) {
      const std::uint64_t* label = of(relaxation.conditions[i]);
      for (std::size_t w = 0; w < words; ++w) joined[w] |= label[w];
    }
    for (int i = rule.begin; i < rule.end; ++i) {
      const int node = relaxation.effects[i];
      std::uint64_t* label = bits_.data() + static_cast<std::size_t>(node) * words;
      bool changed = !labelled_[node];
      if (changed) {
        std::copy(joined.begin(), joined.end(), label);
        set_bit(label, node);
        now_labelled(node);
      } else {
        for (std::size_t w = 0; w < words; ++w) {
          std::uint64_t kept = label[w] & joined[w];
          if (static_cast<std::size_t>(node) >> 6 == w) kept |= label[w] & (std::uint64_t{1} << (node & 63));
          changed |= kept != label[w];
          label[w] = kept;
        }
      }
      if (!changed) continue;
      for (int j = relaxation.used_begin[node]; j < relaxation.used_begin[node + 1]; ++j) enqueue(relaxation.used[j]);
    }
  }
}

void choose_landmarks(const GroundTask& task, const NodeLabels& labels, LandmarkGraph& graph) {
  std::vector<std::uint64_t> all(labels.words, 0);
  for (const Literal goal : task.goal) {
    set_bit(all.data(), goal);
    if (labels.empty() || !labels.labelled(goal)) continue;
    for (std::size_t w = 0; w < labels.words; ++w) all[w] |= labels.of(goal)[w];
  }
  graph.of_node.assign(labels.words * 64, -1);
  for (int node = 0; node < 2 * task.facts; ++node) {
    if (!has_bit(all.data(), node)) continue;
    graph.of_node[node] = graph.size();
    graph.node.push_back(node);
    if (std::binary_search(task.goal.begin(), task.goal.end(), node)) graph.goals.push_back(graph.size() - 1);
  }
}

void order_landmarks(const GroundTask& task, const Relaxation& relaxation, const NodeLabels& labels,
                     LandmarkGraph& graph) {
  graph.before.resize(graph.node.size());
  graph.needed_for.resize(graph.node.size());
  graph.needs.resize(graph.node.size());
  if (labels.empty()) return;
  for (int landmark = 0; landmark < graph.size(); ++landmark) {
    if (!labels.labelled(graph.node[landmark])) continue;
    for (int node = 0; node < 2 * task.facts; ++node) {
      if (node == graph.node[landmark] || !has_bit(labels.of(graph.node[landmark]), node)) continue;
      if (graph.of_node[node] >= 0) graph.before[landmark].push_back(graph.of_node[node]);
    }
  }
  // What all operators that can be first to achieve a landmark share as a condition must hold right before.
  std::vector<std::vector<int>> shared(graph.node.size());
  std::vector<char> is_first(graph.node.size(), 1);
  for (const Relaxation::Rule& rule : relaxation.rules) {
    const auto begin = relaxation.conditions.begin() + rule.conditions_begin,
               end = relaxation.conditions.begin() + rule.conditions_end;
    if (std::any_of(begin, end, [&](int one) { return !labels.labelled(one); })) continue;
    for (int i = rule.begin; i < rule.end; ++i) {
      const int landmark = graph.of_node[relaxation.effects[i]], node = relaxation.effects[i];
      if (landmark < 0) continue;
      if (std::any_of(begin, end, [&](int one) { return has_bit(labels.of(one), node); })) continue;
      std::vector<int> both;
      if (is_first[landmark]) {
        both.assign(begin, end);
      } else {
        std::set_intersection(shared[landmark].begin(), shared[landmark].end(), begin, end, std::back_inserter(both));
      }
      is_first[landmark] = 0;
      shared[landmark] = std::move(both);
    }
  }
  for (int landmark = 0; landmark < graph.size(); ++landmark) {
    for (const int node : shared[landmark]) {
      if (graph.of_node[node] < 0) continue;
      graph.needed_for[graph.of_node[node]].push_back(landmark);
      graph.needs[landmark].push_back(graph.of_node[node]);
    }
  }
}

void find_removals(const GroundTask& task, LandmarkGraph& graph) {
  graph.takes_away.resize(graph.node.size());
  std::vector<char> is_goal(graph.node.size(), 0);
  for (const int goal : graph.goals) is_goal[goal] = 1;
  std::vector<char> is_first(graph.node.size(), 1);
  std::vector<int> removed, both;
  for (const Operator& op : task.operators) {
    removed.clear();
    for (const Literal one : op.effects) {
      if (graph.of_node[one ^ 1] >= 0) removed.push_back(graph.of_node[one ^ 1]);
    }
    std::sort(removed.begin(), removed.end());
    for (const Literal one : op.effects) {
      const int landmark = graph.of_node[one];
      if (landmark < 0 || !is_goal[landmark]) continue;
      both.clear();
      std::vector<int>& away = graph.takes_away[landmark];
      if (is_first[landmark]) {
        both = removed;
      } else {
        std::set_intersection(away.begin(), away.end(), removed.begin(), removed.end(), std::back_inserter(both));
      }
      is_first[landmark] = 0;
      away = both;
    }
  }
}

}  // namespace

LandmarkGraph::LandmarkGraph(const GroundTask& task, const Relaxation& relaxation, const Words& start) {
  const NodeLabels labels(task, relaxation, start);
  choose_landmarks(task, labels, *this);
  order_landmarks(task, relaxation, labels, *this);
  find_removals(task, *this);
}

}  // namespace stampede::symbolic
