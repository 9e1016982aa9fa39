// Which facts hold, debounced: verdicts, plans and stored intervals all read the same values.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/base/shared_list.h"
#include "engine/record/record.h"
#include "engine/start/declared.h"
#include "engine/start/predicates.h"
#include "engine/start/world_view.h"

namespace stampede {

// An attribute that a predicate of two arguments speaks of, such as (colour block1 red), and the type of its value;
// empty where that is an object of the scene, as in (part_of chest.top_drawer chest). Values that are no names in PDDL
// are left out.
struct AttributeFact {
  Fact fact;
  std::string value_type;
};
std::vector<AttributeFact> attribute_facts(const Scene& scene, const Domain& domain);

// Follows every ground atom of the domain's basic predicates, but those that relate a thing to its own parts and
// regions (unless they are static: `part_of` may be). Copy its State to undo.
class FactTracker {
 public:
  // `asked`: predicates of kind start, which nothing but a test of a start asks for, and those that are followed only
  // where they are named, which are read too.
  FactTracker(Symbols& symbols, const WorldView& view, const std::set<std::string>& asked = {});

  // Starts from values read elsewhere (after settling, in the world the start was made in).
  void begin(const std::map<Fact, Symbols::Value>& values);
  // Reads every atom that can hold; for begin() and for tests of init.
  std::map<Fact, Symbols::Value> read_all(const WorldView& view, bool filtered = true) const;

  void look(const WorldView& view);           // what can be seen at the start
  void tell(const std::vector<Fact>& facts);  // whether these hold is known, as if it had been seen at the start
  void step(const WorldView& view);           // momentary predicates; after every physics step
  void frame(const WorldView& view);          // the others; after every frame

  // All that holds now: basic, fixed, traits and attributes, and derived.
  const Facts& facts() const { return state_.facts; }
  Facts basic() const;                   // facts() without derived ones: PDDL's :init
  Facts observed() const;                // as facts(), but of what can hide only what was seen so when it was last seen
  Facts known_basic() const;             // observed() without derived ones
  bool known(const Fact& fact) const;    // is it in observed()?
  std::vector<Fact> never_seen() const;  // what can hide and could not be seen so far: nobody knows whether it holds
  bool pending(const Fact& fact) const;  // its raw value differs from the debounced one
  const Domain& domain() const { return symbols_.domain(); }
  const Symbols& symbols() const { return symbols_; }
  const Facts& fixed() const { return static_; }             // traits and attributes
  bool follows(const std::string& predicate) const;          // a basic one
  const std::vector<Fact>& atoms() const { return names_; }  // all ground atoms of basic predicates, in a fixed order
  std::int64_t changes() const { return changes_; }          // grows whenever what holds or is known changes
  // What no eye can see now: things of which a fact holds that hides, and is not observable.
  std::set<std::string> out_of_sight(const WorldView& view) const;
  void forget_closed();  // intervals that have ended
  const std::vector<TypedObject>& objects() const { return objects_; }

  // Intervals up to now; open ones end at `end_step`, and say so. Their `observed`: was it known all the time?
  std::vector<FactRecord> intervals(std::int64_t end_step, int steps_per_frame) const;
  // When facts that can hide were known to hold: what an agent knows that sees what can be seen and forgets nothing.
  std::vector<FactRecord> observed_intervals(std::int64_t end_step, int steps_per_frame) const;

  struct Atom {
    bool holds = false;
    bool raw = false;
    std::int64_t since_step = 0;  // of the debounced value
    std::int64_t raw_since_step = 0;
    std::optional<double> margin;  // the greatest since it holds
    bool seen = false;             // of predicates that can hide: could it be seen so far?
    bool known = false;            // of these: as it was when it was last seen
    std::int64_t known_since_step = 0;
    std::int64_t seen_since_step =
        -1;  // while it changes: since when it has been in sight without a break; -1: it is not
  };
  struct State {
    std::vector<Atom> atoms;
    Facts facts;
    std::map<Fact, std::int64_t> derived_since;
    SharedList<FactRecord> closed;        // finished intervals, in the order in which they ended
    SharedList<FactRecord> closed_known;  // the same of what was known
  };
  State save() const { return state_; }
  void restore(State state) {
    state_ = std::move(state);
    ++changes_;
  }

 private:
  struct Group {  // the atoms of one predicate
    std::string predicate;
    PredicateTraits traits;
    bool fixed = false;
    bool hides = false;
    std::size_t first = 0, count = 0;
  };
  void enumerate(const WorldView& view, const std::set<std::string>& asked);
  void add_static(const WorldView& view);
  void finish(std::vector<FactRecord>& records, int steps_per_frame) const;
  void update(std::size_t index, const Group& group, const Symbols::Value& value, std::int64_t step);
  void commit(std::size_t index, bool holds, std::int64_t at_step, std::optional<double> margin);
  void refresh_derived(std::int64_t step);
  // Who is near whom at one moment, by indices of scene objects.
  struct Neighbours {
    std::vector<char> touching;  // a square table
    std::vector<char> held;
    std::vector<Vector3> at;  // where they are
  };
  void index_arguments(const WorldView& view);
  Neighbours neighbours(const WorldView& view) const;
  bool can_hold(const Group& group, std::size_t atom, const Neighbours& near) const;
  int index_of(const Fact& fact) const;  // of an atom; -1: none

  Symbols& symbols_;
  double dt_ = 0;
  std::vector<TypedObject> objects_;
  std::vector<Fact> names_;  // per atom
  std::map<Fact, int> index_;
  std::vector<std::array<int, 2>> pairs_;  // per atom, its last two arguments: indices of scene objects; -1: none
  std::vector<double> radii_;              // of scene objects, m
  struct Owner {
    int part = 0;  // -1: any of the body
    int object = 0;
  };
  std::vector<std::vector<Owner>> owners_;  // of contacts, by body + 1
  std::vector<char> needs_place_;           // of scene objects: are they arguments of a predicate of near pairs?
  std::vector<Group> groups_;
  Facts static_;  // traits and attributes
  std::set<std::string> derived_names_;
  bool changed_ = false;
  std::int64_t changes_ = 0;
  State state_;
};

}  // namespace stampede
