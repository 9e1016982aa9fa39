#include "engine/symbolic/simplify.h"

#include <algorithm>

namespace stampede::symbolic {
namespace {

constexpr std::size_t kMostAdded = 2'000'000;  // literals put in for denied facts, in all

class Simplifier {
 public:
  explicit Simplifier(GroundTask& task) : task_(task), meanings_(static_cast<std::size_t>(task.facts - task.basic)) {}

  void run() {
    find_constants();
    find_other_names();
    find_denials();
    rewrite_axioms();
    rewrite_operators();
    drop_unused();
  }

 private:
  enum class Kind { own, always, never, renamed };
  struct Meaning {
    Kind kind = Kind::own;
    Literal literal = 0;           // renamed: what it stands for
    bool is_denied_apart = false;  // all its axioms have one condition each: denied, all of `denial` holds
    Literals denial;
  };

  Meaning& meaning(int fact) { return meanings_[fact - task_.basic]; }
  const Meaning& meaning(int fact) const { return meanings_[fact - task_.basic]; }
  bool is_derived(Literal one) const { return one >> 1 >= task_.basic; }

  std::vector<std::vector<int>> axioms_by_head() const {
    std::vector<std::vector<int>> all(meanings_.size());
    for (std::size_t i = 0; i < task_.axioms.size(); ++i) {
      all[task_.axioms[i].head - task_.basic].push_back(static_cast<int>(i));
    }
    return all;
  }

  // A layer is settled before the next: a fact with a true axiom holds always, one that no axiom is left for never.
  void find_constants() {
    std::vector<int> left(meanings_.size(), 0);
    for (const Axiom& axiom : task_.axioms) ++left[axiom.head - task_.basic];
    std::vector<char> is_gone(task_.axioms.size(), 0);
    for (std::size_t fact = 0; fact < left.size(); ++fact) {
      if (left[fact] == 0) meanings_[fact].kind = Kind::never;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < task_.axioms.size(); ++i) {
        const Axiom& axiom = task_.axioms[i];
        Meaning& head = meaning(axiom.head);
        if (is_gone[i] || head.kind != Kind::own) continue;
        const auto is_known = [&](Literal one, bool value) {
          return is_derived(one) && meaning(one >> 1).kind == (((one & 1) == 0) == value ? Kind::always : Kind::never);
        };
        const Literals& body = axiom.body;
        if (std::any_of(body.begin(), body.end(), [&](Literal one) { return is_known(one, false); })) {
          is_gone[i] = 1;
          if (--left[axiom.head - task_.basic] == 0) head.kind = Kind::never;
          changed = true;
        } else if (std::all_of(body.begin(), body.end(), [&](Literal one) { return is_known(one, true); })) {
          head.kind = Kind::always;
          changed = true;
        }
      }
    }
    std::vector<Axiom> kept;
    for (std::size_t i = 0; i < task_.axioms.size(); ++i) {
      Axiom& axiom = task_.axioms[i];
      if (is_gone[i] || meaning(axiom.head).kind != Kind::own) continue;
      std::erase_if(axiom.body, [&](Literal one) { return is_derived(one) && meaning(one >> 1).kind != Kind::own; });
      kept.push_back(std::move(axiom));
    }
    for (std::size_t fact = 0; fact < meanings_.size(); ++fact) {  // the goal may still ask for it
      if (meanings_[fact].kind == Kind::always) kept.push_back({task_.basic + static_cast<int>(fact), {}, 0});
    }
    task_.axioms = std::move(kept);
    std::stable_sort(task_.axioms.begin(), task_.axioms.end(),
                     [](const Axiom& a, const Axiom& b) { return a.layer < b.layer; });
  }

  // One axiom with one condition. Names of names are followed; a circle of them is left as it is.
  void find_other_names() {
    const std::vector<std::vector<int>> by_head = axioms_by_head();
    std::vector<Literal> other(meanings_.size(), -1);
    for (std::size_t fact = 0; fact < by_head.size(); ++fact) {
      if (meanings_[fact].kind != Kind::own || by_head[fact].size() != 1) continue;
      const Literals& body = task_.axioms[by_head[fact].front()].body;
      if (body.size() == 1) other[fact] = body.front();
    }
    for (std::size_t fact = 0; fact < other.size(); ++fact) {
      if (other[fact] < 0) continue;
      Literal at = other[fact];
      std::size_t steps = 0;
      while (is_derived(at) && other[(at >> 1) - task_.basic] >= 0 && steps <= other.size()) {
        at = other[(at >> 1) - task_.basic] ^ (at & 1);
        ++steps;
      }
      if (steps > other.size() || at >> 1 == task_.basic + static_cast<int>(fact)) continue;
      meanings_[fact].kind = Kind::renamed;
      meanings_[fact].literal = at;
    }
  }

  void find_denials() {
    const std::vector<std::vector<int>> by_head = axioms_by_head();
    for (std::size_t fact = 0; fact < by_head.size(); ++fact) {
      Meaning& own = meanings_[fact];
      if (own.kind != Kind::own || by_head[fact].empty()) continue;
      own.is_denied_apart = std::all_of(by_head[fact].begin(), by_head[fact].end(),
                                        [&](int axiom) { return task_.axioms[axiom].body.size() == 1; });
      if (!own.is_denied_apart) continue;
      for (const int axiom : by_head[fact]) own.denial.push_back(named(task_.axioms[axiom].body.front()) ^ 1);
    }
  }

  Literal named(Literal one) const {
    if (!is_derived(one) || meaning(one >> 1).kind != Kind::renamed) return one;
    return meaning(one >> 1).literal ^ (one & 1);
  }

  // False where the conjunction can never hold.
  bool rewrite(Literals& literals) {
    if (std::none_of(literals.begin(), literals.end(), [&](Literal one) { return is_derived(one); })) return true;
    Literals out;
    for (const Literal before : literals) {
      const Literal one = named(before);
      if (!is_derived(one)) {
        out.push_back(one);
        continue;
      }
      const Meaning& what = meaning(one >> 1);
      const bool is_negated = (one & 1) != 0;
      if (what.kind == Kind::always || what.kind == Kind::never) {
        if ((what.kind == Kind::always) == is_negated) return false;
      } else if (is_negated && what.is_denied_apart && added_ + what.denial.size() <= kMostAdded) {
        out.insert(out.end(), what.denial.begin(), what.denial.end());
        added_ += what.denial.size();
      } else {
        out.push_back(one);
      }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    literals = std::move(out);
    for (std::size_t i = 1; i < literals.size(); ++i) {
      if ((literals[i] ^ 1) == literals[i - 1]) return false;
    }
    return true;
  }

  void rewrite_axioms() {
    std::erase_if(task_.axioms, [&](Axiom& axiom) { return !rewrite(axiom.body); });
  }

  void rewrite_operators() {
    std::erase_if(task_.operators, [&](Operator& op) { return !rewrite(op.precondition); });
    for (Operator& op : task_.operators) {
      std::erase_if(op.conditional, [&](ConditionalEffect& effect) { return !rewrite(effect.when); });
      for (const ConditionalEffect& effect : op.conditional) {
        if (effect.when.empty()) op.effects.push_back(effect.effect);
      }
      std::erase_if(op.conditional, [](const ConditionalEffect& effect) { return effect.when.empty(); });
      std::sort(op.effects.begin(), op.effects.end());
      op.effects.erase(std::unique(op.effects.begin(), op.effects.end()), op.effects.end());
      Literals kept;
      for (const Literal one : op.effects) {  // an addition wins over a removal of the same fact
        if ((one & 1) == 0 || kept.empty() || kept.back() != one - 1) kept.push_back(one);
      }
      op.effects = std::move(kept);
    }
  }

  void drop_unused() {
    std::vector<char> is_used(meanings_.size(), 0);
    const auto use = [&](const Literals& literals) {
      for (const Literal one : literals) {
        if (is_derived(one)) is_used[(one >> 1) - task_.basic] = 1;
      }
    };
    use(task_.goal);
    for (const Operator& op : task_.operators) {
      use(op.precondition);
      for (const ConditionalEffect& effect : op.conditional) use(effect.when);
    }
    const std::vector<std::vector<int>> by_head = axioms_by_head();
    std::vector<int> open;
    for (std::size_t fact = 0; fact < is_used.size(); ++fact) {
      if (is_used[fact]) open.push_back(static_cast<int>(fact));
    }
    while (!open.empty()) {
      const int fact = open.back();
      open.pop_back();
      for (const int axiom : by_head[fact]) {
        for (const Literal one : task_.axioms[axiom].body) {
          if (!is_derived(one) || is_used[(one >> 1) - task_.basic]) continue;
          is_used[(one >> 1) - task_.basic] = 1;
          open.push_back((one >> 1) - task_.basic);
        }
      }
    }
    renumber(is_used);
  }

  void renumber(const std::vector<char>& is_used) {
    std::vector<int> number(is_used.size(), -1);
    int next = task_.basic;
    for (std::size_t fact = 0; fact < is_used.size(); ++fact) {
      if (!is_used[fact]) continue;
      task_.atoms[next] = task_.atoms[task_.basic + static_cast<int>(fact)];
      number[fact] = next++;
    }
    task_.atoms.resize(static_cast<std::size_t>(next));
    const auto put = [&](Literals& literals) {  // numbers keep their order
      for (Literal& one : literals) {
        if (is_derived(one)) one = 2 * number[(one >> 1) - task_.basic] + (one & 1);
      }
    };
    std::erase_if(task_.axioms, [&](const Axiom& axiom) { return !is_used[axiom.head - task_.basic]; });
    for (Axiom& axiom : task_.axioms) {
      axiom.head = number[axiom.head - task_.basic];
      put(axiom.body);
    }
    for (Operator& op : task_.operators) {
      put(op.precondition);
      for (ConditionalEffect& effect : op.conditional) put(effect.when);
    }
    put(task_.goal);
    task_.facts = next;
  }

  GroundTask& task_;
  std::vector<Meaning> meanings_;  // of the derived facts
  std::size_t added_ = 0;
};

}  // namespace

void simplify(GroundTask& task) {
  if (task.facts > task.basic) Simplifier(task).run();
}

}  // namespace stampede::symbolic
