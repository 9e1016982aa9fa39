// One episode as a program that embeds the engine sees it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stampede/picture.h"

namespace stampede {

// Every field has a default, so that designated initialisers name what differs and no compiler warns of the rest.
struct EpisodeRequest {
  std::string variation = {};  // canonical text, or axes of it (`colour=red`: the first that has them); empty: first
  std::int64_t seed = 0;       // from 1'000'000 up: the test split
enum class Outcome { success, failure };

// What is done about a failed skill. undo: back to the last skill boundary and the next draws; stop: the failure is the
// episode; recover: plan again.
enum class OnFailure { undo, stop, recover };

// What decides on the next skill: a plan for the goal, or seeded draws: of any skill and arguments of the right types
// and traits, or of those whose precondition holds. Draws include continuous parameters; failures stay in the episode.
enum class Behaviour { plan, random_skills, random_applicable };

  OnFailure on_failure = OnFailure::undo;
  std::string controller = {};  // joint_position, joint_impedance, cartesian_impedance; empty: each skill's own
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

}  // namespace stampede
