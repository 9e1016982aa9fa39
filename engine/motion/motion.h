// A motion: what the robot does between two decisions, advanced once per physics step.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/reason.h"
#include "engine/sim/world.h"

namespace stampede {

enum class MotionStatus { running, done, failed };

struct MotionResult {
  MotionStatus status = MotionStatus::running;
  Reason reason = Reason::none;  // set when failed
  std::string detail = {};       // for people; empty: what the reason says
};

// A point the tool passes without stopping, as planned; the recorder finds the step of closest passage.
struct PlannedVia {
  std::string name;  // `approach`
  Transform world_from_tip;
  std::int64_t step = 0;  // planned passage, in steps from the motion's start
  bool by_time = false;   // passed when that step of the plan is done: a way may lead through one place twice
};

// The fingers begin to move while the arm does.
struct PlannedHand {
  std::int64_t step = 0;  // from the motion's start
  double opening = 0;     // m
};

class Motion {
 public:
  virtual ~Motion() = default;
  virtual std::string kind() const = 0;  // `move_through`, `close_hand` …: the label of its segment
  // Called before each physics step, the first time at the motion's first step. May apply operations to the world
  // (and nothing else). done/failed: no further call; the motion ends before that step.
  virtual MotionResult step(World& world) = 0;
  virtual std::vector<PlannedVia> vias() const { return {}; }
  // How many steps of its plan are done after the coming step: fewer than were made where it had to wait.
  virtual std::int64_t clock() const { return 0; }
  // Between two steps: it is over now, before its end. What it set going must come to rest by itself.
  virtual void interrupt(World&) {}
};

// Follows a planned trajectory; done when its end is reached and the arm is within tolerance of it (or fails with
// tracking_error after a settle allowance). With `keep` set, losing the held part fails with `dropped`.
struct FollowOptions {
  std::string kind = "move";
  std::vector<PlannedVia> vias;
  std::optional<PartRef> keep;  // must stay grasped
  double tolerance_rad = 0.01;
  double settle_s = 0.5;         // allowance after the trajectory's end
  bool stop_on_contact = false;  // done at the first new contact of hand or held part above contact_force
  double contact_force = 3;      // N
  int robot = 0;
  bool tolerate_error = false;  // arriving short of the target is no failure (pressing, pushing, pulling)
  // N, above 0: the arm gives way to contact (Cartesian impedance for the time of this motion), and the motion is done
  // where the hand or what it holds meets more than this. It stays where contact has left it.
  double most_force = 0;
  std::vector<PlannedHand> hands;  // in order; the motion ends when the fingers have come to rest too
  double hand_force = 20;          // N
  // N, above 0: the arm presses with this force while it moves, see steering.h; done when the trajectory is and the arm
  // rests, tracking_error where there is nothing to press on.
  double press = 0;
  Vector3 press_along = Vector3::Zero();  // world, a unit vector; zero: the tool's own z, as it turns
  // m, above 0: where contact stops the arm on its straight way it searches around it, see steering.h; stuck where
  // nothing within this distance lets it go on.
  double search = 0;
  double search_pitch = 0.0008;  // m from one turn of the spiral to the next
  double search_force = 6;       // N
};
std::unique_ptr<Motion> make_follow(Trajectory trajectory, FollowOptions options);

// Opens or closes the hand. Closing on an object (`expect`) is done when it is grasped steadily for 0.1 s and
// fails with grasp_missed when the fingers stop without it.
std::unique_ptr<Motion> make_hand(double opening_m, double force, std::optional<PartRef> expect, int robot = 0);

std::unique_ptr<Motion> make_wait(std::int64_t steps);

// Brings a moving reference, or one that an agent steers, to rest, in a tenth of a second or as fast as the joints can;
// done when it is.
std::unique_ptr<Motion> make_brake(int robot = 0);
bool reference_moves(const World& world, int robot = 0);

}  // namespace stampede
