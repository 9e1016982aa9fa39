#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/base/error.h"
#include "engine/motion/looked.h"
#include "engine/motion/motion.h"
#include "engine/motion/steering.h"

namespace stampede {
namespace {

const MotionResult kRunning{MotionStatus::running, Reason::none};
const MotionResult kDone{MotionStatus::done, Reason::none};
constexpr double kLost_s = 0.1;              // a grasp may flicker for this long
constexpr double kGrasped_s = 0.1;           // and must be steady for this long
constexpr double kRest_s = 0.025;            // and must stay so: it may swing
constexpr double kRest_rad_s = 0.01;         // slower joints are at rest: below 1 cm/s at the tip
constexpr double kYieldingStiffness = 3000;  // N/m: 1 cm off its way, the arm presses with 30 N

MotionResult failed(Reason reason) { return {MotionStatus::failed, reason}; }

class FollowMotion : public Motion {
 public:
  FollowMotion(Trajectory trajectory, FollowOptions options)
      : trajectory_(std::move(trajectory)), options_(std::move(options)) {}
  std::string kind() const override { return options_.kind; }
  std::vector<PlannedVia> vias() const override { return options_.vias; }
  std::int64_t clock() const override { return clock_; }

  MotionResult step(World& world) override {
    if (count_ == 0) start(world);
    const MotionResult result = look(world);
    if (result.status != MotionStatus::running) stay(world);
    return result;
  }

  void interrupt(World& world) override {
    if (stiff_) {  // on from where contact has left it, as in stay()
      world.apply(
          operation::Setpoint{world.arm_position(options_.robot), world.arm_velocity(options_.robot), options_.robot});
      world.apply(*stiff_);
    }
    world.apply(operation::Follow{brake(world, options_.robot), options_.robot});
  }

 private:
  void start(World& world) {
    watch_.emplace(world, options_.keep, options_.robot);
    if (options_.press > 0) steering_ = make_pressing(trajectory_, options_);
    if (options_.search > 0) steering_ = make_searching(trajectory_, options_);
    const operation::Controller& now = world.controller(options_.robot);
    if (steering_ || (options_.most_force > 0 && now.kind == ControllerKind::joint_position)) {
      stiff_ = now;
      world.apply(operation::Controller{ControllerKind::cartesian_impedance,
                                        steering_ ? steering_->stiffness() : kYieldingStiffness, options_.robot});
    }
    if (!steering_) world.apply(operation::Follow{trajectory_, options_.robot});
  }

  MotionResult look(World& world) {
    const std::int64_t elapsed = count_++;
    if (lost(world)) {
      world.apply(operation::Follow{brake(world, options_.robot), options_.robot});
      return failed(Reason::dropped);
    }
    if (!stopping_ && met(world)) {
      stopping_ = true;
      steering_.reset();
      trajectory_ = brake(world, options_.robot);
      world.apply(operation::Follow{trajectory_, options_.robot});
      count_ = 1;
      return kRunning;
    }
    if (steering_) return steered(world);
    if (!stopping_) {
      clock_ = elapsed + 1;
      move_fingers(world, elapsed);
    }
    return elapsed < trajectory_.steps() ? kRunning : ending(world, elapsed - trajectory_.steps());
  }

  MotionResult steered(World& world) {
    const Steering::Next next = steering_->next(world, *watch_);
    if (next.reason != Reason::none && options_.tolerate_error) return kDone;
    if (next.reason != Reason::none) return {MotionStatus::failed, next.reason, next.detail};
    world.apply(operation::Setpoint{next.position, next.velocity, options_.robot});
    clock_ = next.clock;
    move_fingers(world, next.clock);
    return next.clock < trajectory_.steps() ? kRunning : ending(world, over_++);
  }

  // `since`: steps since the end of the trajectory.
  MotionResult ending(const World& world, std::int64_t since) {
    const bool there = stopping_ || steering_ || arrived(world);
    resting_ = at_rest(world) ? resting_ + 1 : 0;
    const bool fingers_rest = !fingers_ || fingers_->arrived(world) || fingers_->stopped(world);
    if (there && fingers_rest && resting_ >= steps_of(kRest_s, world)) return kDone;
    if (since < steps_of(options_.settle_s, world) || !fingers_rest) return kRunning;
    return there || options_.tolerate_error ? kDone : failed(Reason::tracking_error);
  }

  void move_fingers(World& world, std::int64_t clock) {
    for (; next_hand_ < options_.hands.size() && options_.hands[next_hand_].step <= clock; ++next_hand_) {
      const double opening = options_.hands[next_hand_].opening;
      if (opening > world.opening(options_.robot)) {  // what was held is let go
        options_.keep.reset();
        watch_->forget_held();
      }
      world.apply(operation::Hand{opening, options_.hand_force, options_.robot});
      fingers_.emplace().begin(world, opening, options_.robot);
    }
  }

  // An arm that gave way stays where contact has left it: stiff again, it must not jump back to its reference.
  void stay(World& world) {
    if (!stiff_) return;
    world.apply(operation::Setpoint{world.arm_position(options_.robot),
                                    JointVector::Zero(world.arm(options_.robot).joints()), options_.robot});
    world.apply(*stiff_);
  }

  bool arrived(const World& world) const {
    return (world.arm_position(options_.robot) - trajectory_.knots.back().position).cwiseAbs().maxCoeff() <=
           options_.tolerance_rad;
  }

  bool at_rest(const World& world) const {
    return world.arm_velocity(options_.robot).cwiseAbs().maxCoeff() <= kRest_rad_s;
  }

  bool lost(const World& world) {
    if (!options_.keep) return false;
    missing_ = world.grasped(options_.robot) == options_.keep ? 0 : missing_ + 1;
    return missing_ > steps_of(kLost_s, world);
  }

  bool met(const World& world) const {
    const double new_force = options_.stop_on_contact ? std::max(1e-9, options_.contact_force) : 0;
    return watch_->met(world, new_force, options_.most_force);
  }

  Trajectory trajectory_;
  FollowOptions options_;
  std::optional<ContactWatch> watch_;
  std::unique_ptr<Steering> steering_;
  std::optional<FingerWatch> fingers_;  // that were set going on the way
  std::size_t next_hand_ = 0;
  std::optional<operation::Controller> stiff_;  // to return to
  bool stopping_ = false;
  std::int64_t count_ = 0, clock_ = 0, missing_ = 0, resting_ = 0, over_ = 0;
};

class HandMotion : public Motion {
 public:
  HandMotion(double opening_m, double force, std::optional<PartRef> expect, int robot)
      : opening_m_(opening_m), force_(force), expect_(expect), robot_(robot) {}

  std::string kind() const override { return expect_ || opening_m_ < 0.01 ? "close_hand" : "open_hand"; }

  MotionResult step(World& world) override {
    if (!begun_) {
      world.apply(operation::Hand{opening_m_, force_, robot_});
      fingers_.begin(world, opening_m_, robot_);
      begun_ = true;
    }
    const bool stopped = fingers_.stopped(world);
    if (!expect_) return fingers_.arrived(world) || stopped ? kDone : kRunning;
    held_ = world.grasped(robot_) == expect_ ? held_ + 1 : 0;
    if (held_ > steps_of(kGrasped_s, world)) return kDone;
    return stopped && held_ == 0 ? MotionResult{MotionStatus::failed, Reason::grasp_missed, met(world)} : kRunning;
  }

 private:
  // What the fingers are at instead of holding it.
  std::string met(const World& world) const {
    const Scene& scene = world.scene();
    const auto& pads = scene.robot.pads;
    std::set<int> on_it;
    std::string other;
    for (const Contact& contact : world.contacts()) {
      if (!contact.a.on_robot() || std::find(pads.begin(), pads.end(), contact.a.part) == pads.end()) continue;
      if (contact.b == *expect_)
        on_it.insert(contact.a.part);
      else if (other.empty() && !contact.b.on_robot())
        other = name_of_part(scene, contact.b);
    }
    const std::string name = name_of_part(scene, *expect_);
    if (on_it.size() > 1) return "both fingers touch " + name + ", but do not hold it between them";
    if (on_it.size() == 1) return "only one finger touches " + name;
    return other.empty() ? "the hand closed on nothing" : "the fingers touch " + other + ", not " + name;
  }

  double opening_m_, force_;
  std::optional<PartRef> expect_;
  int robot_;
  FingerWatch fingers_;
  bool begun_ = false;
  std::int64_t held_ = 0;
};

class BrakeMotion : public Motion {
 public:
  explicit BrakeMotion(int robot) : robot_(robot) {}
  std::string kind() const override { return "brake"; }
  MotionResult step(World& world) override {
    if (count_++ == 0) {
      const Trajectory stop = brake(world, robot_);
      steps_ = stop.steps();
      world.apply(operation::Follow{stop, robot_});
    }
    return count_ > steps_ ? kDone : kRunning;
  }

 private:
  int robot_;
  std::int64_t count_ = 0, steps_ = 0;
};

class WaitMotion : public Motion {
 public:
  explicit WaitMotion(std::int64_t steps) : left_(steps) {}
  std::string kind() const override { return "wait"; }
  MotionResult step(World&) override { return left_-- > 0 ? kRunning : kDone; }

 private:
  std::int64_t left_;
};

}  // namespace

std::unique_ptr<Motion> make_follow(Trajectory trajectory, FollowOptions options) {
  if (trajectory.knots.empty()) throw Error("follow", "the trajectory has no knots", "was its plan a success?");
  if (options.press > 0 && options.search > 0) throw Error("follow", "it either presses or searches");
  if (options.search > 0 && !(options.search_pitch > 0 && options.search_force > 0))
    throw Error("follow", "the pitch and force of a search must be positive");
  return std::make_unique<FollowMotion>(std::move(trajectory), std::move(options));
}

std::unique_ptr<Motion> make_hand(double opening_m, double force, std::optional<PartRef> expect, int robot) {
  if (!(opening_m >= 0) || !(force > 0)) throw Error("hand", "the opening must not be negative, the force positive");
  return std::make_unique<HandMotion>(opening_m, force, expect, robot);
}

std::unique_ptr<Motion> make_brake(int robot) { return std::make_unique<BrakeMotion>(robot); }

bool reference_moves(const World& world, int robot) {
  constexpr double kStill = 1e-9;  // rad/s
  return world.steered(robot) || world.reference(robot).velocity.cwiseAbs().maxCoeff() > kStill;
}

std::unique_ptr<Motion> make_wait(std::int64_t steps) {
  if (steps < 0) throw Error("wait", "the number of steps must not be negative");
  return std::make_unique<WaitMotion>(steps);
}

}  // namespace stampede
