// What an episode asks of predicates. Implemented by scripting for Lua, by tests in C++.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/transform.h"
#include "engine/start/declared.h"
#include "engine/symbolic/symbols.h"

namespace stampede {

class CollisionState;
struct Looked;
class WorldView;

// A way to make a fact true when a scene is made: a pose of a body or region, or a joint position.
struct Placement {
  std::string object;
  std::variant<Transform, double> value;  // world_from_object, or position of the part's joint
};

class Symbols {
 public:
  virtual ~Symbols() = default;
  virtual const Domain& domain() const = 0;
  virtual PredicateTraits traits(const std::string& predicate) const = 0;
  struct Value {
    bool holds = false;
    std::optional<double> margin;
    bool asked_arm = false;  // what the arm can do was asked for, which takes long
  };
  // Of a basic or fixed predicate. Repeatable: reads the view only.
  virtual Value value(const Fact& fact, const WorldView& view) = 0;
  // Can facts of this predicate be hidden from everybody's eyes, and is this one to be seen now?
  virtual bool can_hide(const std::string&) const { return false; }
  virtual bool observable(const Fact&, const WorldView&) { return true; }
  // Ways to make the fact true, best or random first, at most `most`; empty when the predicate has no sample.
  virtual std::vector<Placement> sample(const Fact& fact, const WorldView& view, const CollisionState& state,
                                        RandomKey key, int most) = 0;
  // From now on places that sampling turns down, and grasps that keep a fact from holding, are added there, for people:
  // that takes longer; null: nobody asks.
  virtual void watch(std::vector<Looked>* /*turned_down*/) {}
  // Where the author asks for the fact: `tasks/stack.lua:8`; empty: not known.
  virtual std::string asked_at(const Fact&) const { return {}; }
  class Watching {  // for a scope
   public:
    Watching(Symbols& symbols, std::vector<Looked>* turned_down) : symbols_(symbols) { symbols.watch(turned_down); }
    ~Watching() { symbols_.watch(nullptr); }
    Watching(const Watching&) = delete;
    Watching& operator=(const Watching&) = delete;

   private:
    Symbols& symbols_;
  };
};

}  // namespace stampede
