// What alters a run, as values, and as the text that keys and catalogues hold.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/model/randomise.h"
#include "engine/record/observation_choice.h"
#include "engine/record/record.h"
#include "engine/start/call_settings.h"
#include "engine/start/perturbation.h"
#include "engine/symbolic/symbols.h"
#include "stampede/environment.h"

namespace stampede {

class Renderer;
struct Impasse;
struct PlanOutcome;

using SensorEntries = std::shared_ptr<const std::map<std::string, SensorEntry>>;  // by name; null: none

// Is told of each, by the thread that runs the episode, in the order in which they happen.
using Witness = std::function<void(const Impasse&)>;

std::string_view to_string(OnFailure value);
std::optional<OnFailure> on_failure_from(std::string_view text);

std::string_view to_string(Behaviour value);
std::optional<Behaviour> behaviour_from(std::string_view text);

// A sentence that a model made and checks let pass. `of`: the variation; of a subgoal its name, a blank and the
// variation (subgoal_key); of other levels the skill, predicate or kind of motion whose label it says in other words,
// with the label's {slots}.
struct MadeSentence {
  LanguageLevel level = LanguageLevel::task;
  std::string of, text;
  LanguageGrain grain = LanguageGrain::goal;
  std::string model;
};

// A task without variations: the name alone.
inline std::string subgoal_key(const std::string& name, const std::string& variation) {
  return variation.empty() ? name : name + " " + variation;
}

// Instead of our own planner; the name stands for it in the episode's key.
struct NamedPlanner {
  std::string name;
  std::function<PlanOutcome(const Domain& domain, const Problem& problem)> plan;
  explicit operator bool() const { return plan != nullptr; }
};

// What serves a run, and alters no data.
struct RunServices {
  Renderer* renderer = nullptr;  // draws the images; null: one is made for the episode
  int encoders = 0;              // threads that encode its images beside the drawing
  bool explain = false;          // every failed try says why, not only the first of its kind
  Witness witness;               // told of each step that finds no grasp or place
};

// Everything here but `services` alters data and is part of the episode's key. Budgets are counts, never seconds.
struct RunOptions {
  std::int64_t seed = 0;
  Split split = Split::train;
  OnFailure on_failure = OnFailure::undo;
  int tries_per_skill = 6;  // runs of one skill before the one before it is undone too
  int tries_per_episode = 60;
  int plans = 4;                            // different plans tried
  int draws = 100;                          // starts drawn until init holds
  std::string controller;                   // empty: each skill's own
  std::string motion_planner;               // of joint paths, `ompl:RRTConnect`; empty: the world's, or our own
  std::map<std::string, CallSettings> set;  // by skill: of all its calls, before what tasks and scripts say
  std::optional<Formula> where;             // must hold at the start, beside the task's init
  std::optional<Formula> goal;              // instead of the task's
  Behaviour behaviour = Behaviour::plan;
  int physics_hz = 0, frame_hz = 0;  // 0: the world's
  double horizon_s = 0;              // 0: the task's
  int skills = 20;                   // of a random behaviour: how many it draws
  NamedPlanner planner;
  // By name: bodies of skills. Their names and versions are in the key. Null: none but those that come with the engine.
  std::shared_ptr<const std::map<std::string, PolicyEntry>> policies;
  // Sensors of the program, likewise.
  SensorEntries sensors;
  ObservationChoice observation;
  std::optional<Randomisation> randomise;                      // where the world has none of its own
  Perturbation perturb;                                        // beside that
  std::shared_ptr<const std::vector<MadeSentence>> sentences;  // beside the task's own; null: none
  std::vector<Camera> cameras;  // beside those of the world, or instead of one of the same name
  RunServices services;
  std::map<std::string, std::string> as_text() const;
};

// The options of which as_text() says this. Throws Error, by its name, for one of which the text says too little to
// have it again: cameras, sentences, sensors and policies of a program, a planner, ranges of its own.
RunOptions options_from(const std::map<std::string, std::string>& text);

}  // namespace stampede
