// One draw of a task: a scene, what holds in it, what is wanted, and how.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/model/randomise.h"
#include "engine/model/scene.h"
#include "engine/record/observation_choice.h"
#include "engine/start/call_settings.h"
#include "engine/symbolic/symbols.h"

namespace stampede {

class WorldView;

struct Literal {
  Fact fact;
  bool negated = false;
};

struct TaskStep {
  PlanStep step;  // action or skill; trailing arguments may be missing or empty
  CallSettings set;
};

// A part of a task that an episode's frames are told apart by.
struct Subgoal {
  std::string name;
  Formula formula;
  std::string sentence;  // of the author, filled in for this variation; may be empty
};

// One draw of a task: all that is decided before physics runs. What a run asks for changes these values (altered_task).
struct Task {
  std::string name;
  std::string variation;  // canonical text
  std::map<std::string, std::string> axes;
  Scene scene;                                 // all drawn values in it; literals of init then place what has no pose
  std::optional<Randomisation> randomisation;  // of the world
  ObservationChoice observation;               // what the run asks for goes before it
  std::vector<std::string> unplaced;           // free objects that a literal of init must place
  std::vector<std::string> clutter;            // of these, things that have no part in the task and keep out of its way
  std::vector<Literal> init;                   // in the order in which they are made true
  // Must hold at the start too; bindings and alternatives are drawn, and go before a literal of init about the same.
  std::optional<Formula> where;
  std::set<std::string> named;  // predicates that its functions, below, read by name
  std::vector<Fact> told;       // of what nobody can see at the start, that which the instructions tell
  Formula goal;
  std::vector<Formula> stages;  // in_order { … }; goal is their conjunction
  std::optional<std::vector<TaskStep>> steps;
  std::vector<Subgoal> subgoals;  // in the order in which they come true
  bool empty_hand = false;        // the goal asks for it because all do, not by a word of its own
  double hold_s = 1.0;            // the goal must stay true for this long at the end
  double horizon_s = 120;
  std::string motion_planner;             // of the world; empty: our own. What the run asks for goes before it
  std::vector<std::string> instructions;  // filled in for this variation

  // What only the running world tells. Empty: asks for nothing, never, 0.
  std::function<bool(const WorldView&)> also;      // a further test beside the goal
  std::function<bool(const WorldView&)> fails;     // ends the episode as failed
  std::function<double(const WorldView&)> reward;  // shaped, added to 1 at success
};

// Draw number `draw` of one task, variation and seed. Repeatable; other draws may be asked for in between.
using TaskDraw = std::function<Task(int draw)>;

}  // namespace stampede
