// A formula over the numbered atoms of one episode: asked at every frame, it costs a few comparisons each time.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede {

// Which place of a row of truth values is whose. An atom without a place holds at no time.
using AtomPlaces = std::map<Fact, std::size_t>;

// What quantifiers range over. `ever`: all facts that hold at any time; traits are read from it.
struct AtomWorld {
  const AtomPlaces& places;
  const Domain& domain;
  const std::vector<TypedObject>& objects;
  const Facts& ever;
};

class AtomFormula {
 public:
  AtomFormula(const Formula& formula, const AtomWorld& world, const Binding& binding = {});
  bool holds(const std::uint8_t* row) const { return holds(root_, row); }
  // How much of it holds, 0 … 1: of a conjunction the mean of its parts, of a disjunction the best of them. It is 1
  // exactly when the formula holds.
  double share(const std::uint8_t* row) const { return share(root_, row); }
  // 1 at the places of the atoms that it asks for, -1 at those that it rules out, in any of its parts.
  void mark(std::vector<double>& places) const { mark(root_, places); }

 private:
  enum class Kind { always, never, atom, negated_atom, all, any };
  struct Node {
    Kind kind = Kind::always;
    std::size_t place = 0;
    std::vector<Node> parts;
  };
  static Node compile(const Formula& formula, const AtomWorld& world, Binding& binding);
  static bool holds(const Node& node, const std::uint8_t* row);
  static double share(const Node& node, const std::uint8_t* row);
  static void mark(const Node& node, std::vector<double>& places);
  Node root_;
};

// Ground actions whose precondition holds in some row; `width` places a row. Sorted by action, then arguments.
struct ApplicableActions {
  std::vector<Fact> actions;         // name of the action and its arguments
  std::vector<std::uint8_t> values;  // rows x actions
};
ApplicableActions applicable_actions(const AtomWorld& world, const std::vector<std::uint8_t>& rows, std::size_t width);

}  // namespace stampede
