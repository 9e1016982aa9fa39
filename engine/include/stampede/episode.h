// Episodes as a program that embeds the engine asks for them and sees them: one, or many.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stampede/picture.h"

namespace stampede {

enum class Outcome { success, failure };

// What is done about a failed skill. undo: back to the last skill boundary and the next draws; stop: the failure is the
// episode; recover: plan again.
enum class OnFailure { undo, stop, recover };

// What decides on the next skill: a plan for the goal, or seeded draws: of any skill and arguments of the right types
// and traits, or of those whose precondition holds. Draws include continuous parameters; failures stay in the episode.
enum class Behaviour { plan, random_skills, random_applicable };

// Every field has a default, so that designated initialisers name what differs and no compiler warns of the rest.
struct EpisodeRequest {
  std::string variation = {};  // canonical text, or axes of it (`colour=red`: the first that has them); empty: first
  std::int64_t seed = 0;       // from 1'000'000 up: the test split
  OnFailure on_failure = OnFailure::undo;
  std::string controller = {};  // joint_position, joint_impedance, cartesian_impedance; empty: each skill's own
  std::string motion_planner =
      {};  // of joint paths, a planner of OMPL: ompl:RRTConnect; empty: the world's, or our own
  // Continuous parameters and controllers of skills, instead of what is drawn: `pick.height=0.2`, `push.direction=1,0`,
  // `push.direction.2=0.5`, `pick.controller=joint_impedance`.
  std::vector<std::string> set = {};
  std::optional<PictureStorage> pictures = {};  // nothing: what the task and its world say in `observe`
  std::string where = {};  // PDDL: what must hold at the start, beside the task's init: `(not (open chest.top_drawer))`
  std::string goal = {};   // PDDL: instead of the task's own
  Behaviour behaviour = Behaviour::plan;
  int skills = 20;         // of a random behaviour: how many it draws
  bool randomise = false;  // looks, light, cameras and dynamics, where the world has no ranges of its own
};

struct EpisodeRecord;  // the engine's own

struct Episode {
  std::int64_t id = 0;   // in the catalogue; 0 when there is none
  std::string key = {};  // of definitions, task, variation, seed and options
  std::string task = {}, variation = {};
  std::int64_t seed = 0;
  Outcome outcome = Outcome::failure;
  std::string reason = {};  // `none`, or why it failed, as in the catalogue
  std::string detail = {};  // for people
  std::int64_t frames = 0;
  double duration_s = 0;  // simulated
  int undone = 0;         // tries that were taken back
  // The whole episode, of a session without a catalogue: Session::state, picture, points and arrays read it. Lifetime:
  // shared by copies, gone with the last.
  std::shared_ptr<const EpisodeRecord> record = {};
};

// Told of each episode of a run once it has been kept, in the run's order.
struct RunProgress {
  const Episode& episode;
  // Places in the run's order: those before it were kept, were there already, or were cut off by `stop`.
  std::int64_t done = 0, total = 0;
};

// The `index`-th of `count` parts of a run: every `count`-th episode. All parts together are the whole, whoever runs
// them.
struct Shard {
  std::int64_t index = 1, count = 1;  // 1 <= index <= count
};

// Many episodes of tasks. Episode i of a task has the seed `each.seed` + i and the task's variations in turn, in a
// shuffled order that is always the same; the run's order is by task, variation and seed. As `stampede run` does it.
struct RunRequest {
  std::vector<std::string> tasks = {};
  std::int64_t episodes = 1;  // of each task, good or bad
  int workers = 1;            // cores to use; neither the episodes nor their order depend on them
  Shard shard = {};           // of this run, `--shard 2/8`
  EpisodeRequest each = {};   // `seed`: the first one's; `variation`: which are used, empty: all
  // Both are called by the thread that called run_all, one at a time, and may use the session. What they throw ends the
  // run and comes out of it. What is finished or under way by then is kept all the same, unless it was the sink that
  // threw: that is not called again.
  std::function<void(const RunProgress&)> progress = {};
  // Gets each finished episode in the run's order, instead of the catalogue. It holds its record: Session::arrays,
  // state, picture and points read it. Lifetime: its memory goes with the last copy.
  std::function<void(const Episode&)> sink = {};
  // Once true, the run ends: what is finished is kept, what is under way leaves no trace. Looked at every frame; a
  // signal handler, another thread or `progress` may set it. Lifetime: longer than the run's.
  const std::atomic<bool>* stop = nullptr;
};

struct TaskTally {
  std::int64_t episodes = 0, succeeded = 0, existing = 0;                   // of this run; that were there already
  std::map<std::string, std::int64_t> reasons;                              // of the failed ones
  std::map<std::string, std::pair<std::int64_t, std::int64_t>> variations;  // succeeded, episodes
  std::int64_t simulated_us = 0;  // whole numbers: their sum does not depend on who is done first
};

struct RunTally {
  std::int64_t total = 0;      // asked for
  std::int64_t finished = 0;   // in this run
  std::int64_t succeeded = 0;  // of these
  std::int64_t existing = 0;   // were there already
  bool interrupted = false;    // by `stop`, before all were done
  std::map<std::string, TaskTally> tasks;
  std::int64_t done() const { return finished + existing; }
};

}  // namespace stampede
