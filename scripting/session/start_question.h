// What the task planner is asked at the start of one episode: what is known there, and what has to be assumed.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include "engine/rollout/assumptions.h"
#include "engine/start/abstract_state.h"
#include "engine/start/planning.h"
#include "engine/start/start.h"
#include "engine/symbolic/task_planner.h"
#include "scripting/runtime/episode_scripts.h"

namespace stampede {

struct StartQuestion {
  Start start;         // nothing else is filled where none was found
  PlanningTask asked;  // with the goal's order
  Problem plain;       // of the world's own domain
  Facts assumed;       // in both: what nobody can see and the plan rests on
  std::vector<NotAssumed> not_assumed;
  AbstractState state;
  std::string beside_goal;
  std::vector<std::string> instructions;
  std::optional<PlanOutcome> said;  // the steps of a task that says them itself: nothing is to be planned
};
StartQuestion question_at_start(EpisodeScripts& scripts, const RunOptions& options, const std::atomic<bool>* stop);

// The PDDL that catalogues keep: of the world's own domain; or, `sized`, cut to what the planner is asked.
struct PddlTexts {
  std::string domain, problem;
};
PddlTexts pddl_of(const StartQuestion& question, const Domain& own, bool sized);

}  // namespace stampede
