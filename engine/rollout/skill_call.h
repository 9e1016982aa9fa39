// A call of a skill as it is asked for, as its parts see it, and how it ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "engine/start/call_settings.h"
#include "engine/start/declared.h"
#include "engine/symbolic/task_planner.h"

namespace stampede {

struct SkillResult {
  Reason reason = Reason::none;
  std::string detail;
  bool ends_episode = false;  // interrupted, timeout, out_of_order, failed_by_task
  int segment = -1;           // ordinal of the skill's segment
  // Ways to clear what was in the way, nearest first: without these things (free bodies, drawers, doors) the reason
  // would not be.
  std::vector<std::vector<std::string>> blockers = {};
  std::optional<PlanStep> step = {};  // what was tried
  bool ok() const { return reason == Reason::none; }
};

// How a skill is called; the first two are for who draws skills instead of planning them.
struct CallMode {
  bool refuse = true;               // a false precondition ends the call; else it is noted and the skill runs
  bool random_parameters = false;   // continuous parameters within their bounds, any of the grasps and placements
  bool find_blockers = false;       // where nothing reaches: look what is in the way
  bool explain = false;             // the same, and count the causes, for people
  std::vector<PlanStep> then = {};  // what the plan does after it: grasps are chosen so that it stays possible
};

struct SkillRequest {
  PlanStep step;                       // an action of the domain, with all its arguments
  RandomKey key = RandomKey("skill");  // of all that the call draws
  int attempt = 0;                     // which of equal candidates: the first, the next …
  int parent_segment = -1;             // of the segment that is opened
  CallSettings set;                    // what is not to be drawn
  ChosenBy set_by = ChosenBy::task;
  CallMode mode;
};

// Settings of one call, and who made them.
struct GivenSettings {
  CallSettings set;
  ChosenBy by = ChosenBy::caller;
};

// A call under way, as those who draw and plan for it see it.
struct SkillContext {
  const Action* action = nullptr;
  const SkillInfo* info = nullptr;
  std::vector<std::string> arguments;
  RandomKey key = RandomKey("skill");
  int attempt = 0;
  int segment = -1;
  std::vector<GivenSettings> given = {};  // later ones win
  CallMode mode = {};
};

}  // namespace stampede
