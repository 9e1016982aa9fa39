// A world that is being run and recorded: steps, frames, facts and the progress of the goal move together.
#pragma once

#include <atomic>

#include "engine/rollout/recorder.h"
#include "engine/rollout/sensors.h"
#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"
#include "engine/start/margins.h"
#include "engine/start/start.h"
#include "engine/start/task.h"

namespace stampede {

class Rollout {
 public:
  // `stop`: when true, the next frame ends with Reason::interrupted. Lifetime: refers to symbols and stop.
  Rollout(Symbols& symbols, const PreparedStart& start, SensorReader sensors, const std::atomic<bool>* stop);
  Rollout(const Rollout&) = delete;  // the view knows the facts by their address
  Rollout& operator=(const Rollout&) = delete;

  World& world() { return world_; }
  const WorldView& view() const { return view_; }
  const World& world() const { return world_; }
  FactTracker& facts() { return facts_; }
  const FactTracker& facts() const { return facts_; }
  Recorder& recorder() { return recorder_; }
  const Task& task() const { return task_; }
  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  const SensorReader& sensors() const { return sensors_; }
  const Domain& domain() const { return symbols_.domain(); }
  std::int64_t step() const { return world_.step_count(); }
  int steps_per_frame() const { return steps_per_frame_; }
  std::int64_t horizon_steps() const { return horizon_steps_; }
  double physics_wall_s() const { return physics_wall_s_; }

  // One physics step and what follows from it. A reason other than none ends the episode.
  Reason advance();
  Reason ended() const { return ended_; }  // what the last step said
  bool at_frame() const { return step() % steps_per_frame_ == 0; }
  bool goal_holds();               // formula, stages and `also`, on debounced facts
  std::string unmet_goal() const;  // for people; empty when the formula holds
  bool holds_now(const Formula& formula) const;
  // How many parts of an ordered goal have come true.
  int stage() const { return stage_; }

  // Without a record only the present frame is kept, so memory does not grow. From now on.
  void keep_record(bool wanted);
  bool keeps_record() const { return keeps_record_; }

  // Where a record is kept: what the policy of a skill asks for now, or with -1 who drives the episode.
  void note_asked(const AgentAction& action, std::int64_t segment);

  // Whom the hand has been asked to hold; lost in a motion, it is `dropped`.
  std::optional<PartRef> keep;

  // Opens the segment of a motion, here and now. Result: its ordinal.
  int open_motion(std::string kind, int parent_segment, std::string controller = {});
  void close_segment(int ordinal, Reason reason = Reason::none, std::string detail = {});  // likewise

  // A skill's call is under way; there is one at a time.
  bool calling = false;

  // What planning takes to be elsewhere: to find out what is in the way.
  std::vector<PartRef> imagined_away;

  // For a scope, the hand is taken to hold this: to find out whether what a plan does with it then is possible.
  class Imagining {
   public:
    Imagining(Rollout& rollout, const WorldView::Held& held) : rollout_(rollout), kept_(rollout.keep) {
      rollout_.keep = held.part;
      rollout_.view_.imagine(held);
    }
    ~Imagining() {
      rollout_.view_.imagine({});
      rollout_.keep = kept_;
    }
    Imagining(const Imagining&) = delete;
    Imagining& operator=(const Imagining&) = delete;

   private:
    Rollout& rollout_;
    std::optional<PartRef> kept_;
  };

  struct Checkpoint {
    Snapshot world;
    WorldView::History history;
    FactTracker::State facts;
    Recorder::Mark record;
    SensorReader::Mark sensors;
    std::optional<PartRef> keep;
    int stage = 0;
  };
  // Both between two calls, not while one is under way.
  Checkpoint checkpoint();  // contacts are found anew first
  void restore(const Checkpoint& checkpoint);

  // A checkpoint with all that was recorded so far: one can go back to it from another branch of events.
  struct Branch {
    Checkpoint checkpoint;
    Recorder recorder;
    SensorReader sensors;
    Reason ended = Reason::none;
  };
  Branch branch();
  void restore(const Branch& branch);

 private:
  Reason close_step();
  Reason close_frame();
  Reason check_stages();

  Task task_;
  std::shared_ptr<const Scene> scene_;
  Symbols& symbols_;
  const std::atomic<bool>* stop_;
  World world_;
  WorldView view_;
  FactTracker facts_;
  Recorder recorder_;
  SensorReader sensors_;
  std::optional<Margins> margins_;  // none: nobody asks for them
  int steps_per_frame_;
  std::int64_t horizon_steps_;
  int stage_ = 0;
  Reason ended_ = Reason::none;
  bool keeps_record_ = true;
  double physics_wall_s_ = 0;
};

}  // namespace stampede
