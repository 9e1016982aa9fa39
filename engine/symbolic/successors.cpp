#include "engine/symbolic/successors.h"

#include <algorithm>

namespace stampede::symbolic {

Successors::Successors(const GroundTask& task) : task_(task) {
  const std::size_t literals = 2 * static_cast<std::size_t>(task.facts);
  std::vector<int> users(literals, 0);
  for (const Operator& op : task.operators) {
    for (const Literal one : op.precondition) ++users[one];
  }
  std::vector<std::vector<int>> waiting(literals);
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const Literals& precondition = task.operators[i].precondition;
    if (precondition.empty()) {
      always_.push_back(static_cast<int>(i));
      continue;
    }
    const Literal rarest = *std::min_element(precondition.begin(), precondition.end(),
                                             [&](Literal a, Literal b) { return users[a] < users[b]; });
    waiting[rarest].push_back(static_cast<int>(i));
  }
  Literals others;
  for (std::size_t literal = 0; literal < literals; ++literal) {
    begin_.push_back(static_cast<int>(waiting_.size()));
    for (const int op : waiting[literal]) {
      waiting_.push_back(op);
      rest_begin_.push_back(static_cast<int>(rest_.size()));
      others = task.operators[op].precondition;
      std::erase(others, static_cast<Literal>(literal));
      std::stable_sort(others.begin(), others.end(), [&](Literal a, Literal b) { return users[a] < users[b]; });
      rest_.insert(rest_.end(), others.begin(), others.end());
    }
  }
  begin_.push_back(static_cast<int>(waiting_.size()));
  rest_begin_.push_back(static_cast<int>(rest_.size()));
}

void Successors::applicable(const Words& state, std::vector<int>& operators) const {
  operators = always_;
  for (int fact = 0; fact < task_.facts; ++fact) {
    const int literal = 2 * fact + (test(state.data(), fact) ? 0 : 1);
    for (int i = begin_[literal]; i < begin_[literal + 1]; ++i) {
      bool holds = true;
      for (int at = rest_begin_[i]; at < rest_begin_[i + 1] && holds; ++at)
        holds = literal_holds(state.data(), rest_[at]);
      if (holds) operators.push_back(waiting_[i]);
    }
  }
  std::sort(operators.begin(), operators.end());
}

}  // namespace stampede::symbolic
