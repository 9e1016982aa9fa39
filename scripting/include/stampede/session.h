// Runs tasks of Lua scripts and keeps their episodes in a catalogue.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "stampede/arrays.h"
#include "stampede/basics.h"
#include "stampede/environment.h"
#include "stampede/episode.h"
#include "stampede/error.h"
#include "stampede/evaluation.h"
#include "stampede/picture.h"
#include "stampede/rows.h"
#include "stampede/world_state.h"

namespace stampede {

// What the task planner says: a plan of skills, or why there is none.
struct TaskPlanStep {
  std::string action;                  // of the domain: a skill, or skill_case
  std::vector<std::string> arguments;  // names of objects, the hand among them
};

struct TaskPlan {
  bool found = false;
  std::string end;          // "solved", "unsolvable (proved)", "gave up at the limit of expansions", "no start" …
  std::string explanation;  // not found: the goal literal that cannot be made true, and what is missing
  std::vector<TaskPlanStep> steps;
  std::string domain, problem;       // as PDDL
  std::vector<std::string> assumed;  // facts that nobody can see at the start and the plan needs; in the problem too
};

struct SessionOptions {
  std::filesystem::path root = {};  // holds tasks/, skills/, worlds/; empty: those that came with the library
  std::vector<std::filesystem::path> paths = {};  // further folders of the same shape, whose files win
  std::filesystem::path catalogue = {};  // where episodes go, a file; empty: each is kept by the Episode that run gives
};

// Lifetime: movable; one thread at a time. Two sessions never meet, but two must not write one catalogue. The file is
// opened when it is first needed and stays open until the session goes.
// Throws: Error for bad scripts, unknown names and unusable catalogues. Bad luck in physics is an Episode with a
// reason.
class STAMPEDE_EXPORT Session {
 public:
  explicit Session(SessionOptions options);
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  std::vector<std::string> tasks() const;                              // by name
  std::vector<std::string> variations(const std::string& task) const;  // canonical texts, in the task's order

  // Runs one episode and commits it, where there is a catalogue. What that has already is returned without running.
  // Repeatable: the same episode, bit for bit, in any session of the same scripts.
  Episode run(const std::string& task, const EpisodeRequest& request = {});

  // Runs many episodes in several threads and keeps each, in a fixed order: in the catalogue, where those that it has
  // already are not run again, or as the request's sink likes. The same bytes for any number of workers.
  RunTally run_all(const RunRequest& request);

  // A controller that skills may have as their body: `run = policy("grasp_net")`, or robot:policy("grasp_net") inside
  // of it. Before the first run that needs it; one of the same name takes the place of the first.
  void add_policy(const std::string& name, PolicyEntry entry);

  // How often a policy, or the planner, succeeds in these tasks, undisturbed and along axes of perturbation. Its
  // episodes go to the catalogue, where there is one. Throws Error for unknown tasks, axes and channels. Repeatable,
  // for any number of workers, where the policy is.
  Evaluation evaluate(const std::vector<std::string>& tasks, const EvaluationRequest& request = {});

  // Another sensor of every world: read while an episode runs, at its own rate, and part of it as those of the world
  // are: columns `sensor/NAME` and `sensor_time/NAME` of arrays, channels of environments and policies, view `sensors`.
  // Before the first run or environment that needs it; one of the same name takes the place of the first. `stampede
  // replay`, which does not know it, leaves it out and says so.
  void add_sensor(const std::string& name, SensorEntry entry);

  // The task as an environment that the caller steps (stampede/environment.h). It may outlive the session, and act in
  // another thread; episodes that it records go where this session's go.
  Environment environment(const std::string& task, const EnvironmentSettings& settings = {}) const;

  // Makes the start that `run` would make for the same request, reads its facts and plans, without executing anything.
  // Of the request only variation, seed, where and goal matter. Repeatable.
  TaskPlan plan(const std::string& task, const EpisodeRequest& request = {}) const;

  // One SELECT, or the name of a ready question, over the catalogue's views. `parameters`: for ?1, ?2 …
  Rows query(std::string_view question, const std::vector<SqlValue>& parameters = {}) const;

  // An episode is named by what `run` gave, or by its number in the catalogue.

  // What a camera saw at a frame, drawn now: no noise is added, and no scripts are needed.
  // Throws Error for unknown episodes, frames and cameras. Repeatable: the same pixels in any session.
  CameraPicture picture(const Episode& episode, std::int64_t frame, const PictureRequest& request = {}) const;
  CameraPicture picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request = {}) const;
  CameraPoints points(const Episode& episode, std::int64_t frame, const PictureRequest& request = {}) const;
  CameraPoints points(std::int64_t episode, std::int64_t frame, const PictureRequest& request = {}) const;

  // The same frame in symbols and numbers: what holds, what is known to hold, joints, poses.
  // Throws Error for unknown episodes and frames.
  WorldState state(const Episode& episode, std::int64_t frame) const;
  WorldState state(std::int64_t episode, std::int64_t frame) const;

  // All frames as named arrays: states, actions, facts, segments, references to pictures.
  // Throws Error for unknown episodes and columns. Repeatable: the same values from memory and from a catalogue.
  EpisodeArrays arrays(const Episode& episode, const ArrayRequest& request = {}) const;
  EpisodeArrays arrays(std::int64_t episode, const ArrayRequest& request = {}) const;

 private:
  struct Impl;
  Own<Impl> impl_;
};

// Plans for the PDDL domain and problem of any author. Throws Error with line and column for what is no PDDL.
STAMPEDE_EXPORT TaskPlan plan_pddl(const std::string& domain, const std::string& problem);

}  // namespace stampede
