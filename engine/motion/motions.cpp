#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/base/error.h"
#include "engine/motion/motion.h"

namespace stampede {
namespace {

const MotionResult kRunning{MotionStatus::running, Reason::none};
const MotionResult kDone{MotionStatus::done, Reason::none};
constexpr double kLost_s = 0.1;     // a grasp may flicker for this long
constexpr double kGrasped_s = 0.1;  // and must be steady for this long
constexpr double kStopped_s = 0.3;  // fingers that have not moved for this long have stopped
constexpr double kHandTimeout_s = 3;
constexpr double kStill_m = 2e-4;
constexpr double kOpeningTolerance_m = 1e-3;
constexpr double kRest_s = 0.025;            // and must stay so: it may swing
constexpr double kRest_rad_s = 0.01;         // slower joints are at rest: below 1 cm/s at the tip
constexpr double kYieldingStiffness = 1500;  // N/m: 1 cm off its way, the arm presses with 15 N

MotionResult failed(Reason reason) { return {MotionStatus::failed, reason}; }

std::int64_t steps_of(double seconds, const World& world) {
  return static_cast<std::int64_t>(std::llround(seconds / world.dt()));
}

// From the reference's present state to rest, at a tenth of a second or as fast as the joints can.
Trajectory brake(const World& world, int robot) {
  const JointState now = world.reference(robot);
  double time_s = 0.1;
  const auto& limits = world.arm(robot).limits();
  for (Eigen::Index i = 0; i < now.position.size(); ++i) {
    const double acceleration = limits[static_cast<std::size_t>(i)].acceleration;
    if (acceleration > 0) time_s = std::max(time_s, 2 * std::abs(now.velocity[i]) / acceleration);
  }
  const std::int64_t steps = std::max<std::int64_t>(1, steps_of(time_s, world));
  const double span = static_cast<double>(steps) * world.dt();
  const JointVector still = JointVector::Zero(now.position.size());
  Trajectory stop;
  stop.knots.push_back({0, now.position, now.velocity, now.acceleration});
  stop.knots.push_back({steps, now.position + 0.5 * span * now.velocity, still, still});
  return stop;
}

// The parts that hang on the arm's last joint: the last link and the hand.
std::set<PartRef> hand_parts(const Robot& robot, int index) {
  std::set<PartRef> parts;
  if (robot.arm.empty()) return parts;
  for (int part = 0; part < static_cast<int>(robot.body.parts.size()); ++part) {
    int up = part;
    while (up >= 0 && up != robot.arm.back()) up = robot.body.parts[static_cast<std::size_t>(up)].parent;
    if (up >= 0) parts.insert(PartRef::of_robot(part, index));
  }
  return parts;
}

class FollowMotion : public Motion {
 public:
  FollowMotion(Trajectory trajectory, FollowOptions options)
      : trajectory_(std::move(trajectory)), options_(std::move(options)) {}
  std::string kind() const override { return options_.kind; }
  std::vector<PlannedVia> vias() const override { return options_.vias; }

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
    hand_ = hand_parts(world.scene().robot, options_.robot);
    if (options_.stop_on_contact)
      for (const Contact& contact : world.contacts()) known_.insert({contact.a, contact.b});
    if (options_.most_force > 0 && world.controller(options_.robot).kind == ControllerKind::joint_position) {
      stiff_ = world.controller(options_.robot);
      world.apply(operation::Controller{ControllerKind::cartesian_impedance, kYieldingStiffness, options_.robot});
    }
    world.apply(operation::Follow{trajectory_, options_.robot});
  }

  MotionResult look(World& world) {
    const std::int64_t elapsed = count_++;
    if (lost(world)) {
      world.apply(operation::Follow{brake(world, options_.robot), options_.robot});
      return failed(Reason::dropped);
    }
    if (!stopping_ && met(world)) {
      stopping_ = true;
      trajectory_ = brake(world, options_.robot);
      world.apply(operation::Follow{trajectory_, options_.robot});
      count_ = 1;
      return kRunning;
    }
    if (elapsed < trajectory_.steps()) return kRunning;
    const bool there = stopping_ || arrived(world);
    resting_ = at_rest(world) ? resting_ + 1 : 0;
    if (there && resting_ >= steps_of(kRest_s, world)) return kDone;
    if (elapsed - trajectory_.steps() < steps_of(options_.settle_s, world)) return kRunning;
    return there || options_.tolerate_error ? kDone : failed(Reason::tracking_error);
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

  // A contact of the hand, or of what it holds, with anything else: one that was not there at the start, or one that
  // is harder than this motion may press.
  bool met(const World& world) const {
    if (!options_.stop_on_contact && options_.most_force <= 0) return false;
    const auto mine = [&](PartRef part) { return hand_.contains(part) || options_.keep == part; };
    return std::any_of(world.contacts().begin(), world.contacts().end(), [&](const Contact& contact) {
      if (mine(contact.a) == mine(contact.b)) return false;
      if (options_.most_force > 0 && contact.mean_force > options_.most_force) return true;
      return options_.stop_on_contact && contact.mean_force > options_.contact_force &&
             !known_.contains({contact.a, contact.b});
    });
  }

  Trajectory trajectory_;
  FollowOptions options_;
  std::set<PartRef> hand_;
  std::set<std::pair<PartRef, PartRef>> known_;
  std::optional<operation::Controller> stiff_;  // to return to
  bool stopping_ = false;
  std::int64_t count_ = 0, missing_ = 0, resting_ = 0;
};

class HandMotion : public Motion {
 public:
  HandMotion(double opening_m, double force, std::optional<PartRef> expect, int robot)
      : opening_m_(opening_m), force_(force), expect_(expect), robot_(robot) {}

  std::string kind() const override { return expect_ || opening_m_ < 0.01 ? "close_hand" : "open_hand"; }

  MotionResult step(World& world) override {
    if (count_ == 0) {
      world.apply(operation::Hand{opening_m_, force_, robot_});
      last_m_ = world.opening(robot_);
    }
    const std::int64_t elapsed = count_++;
    still_ = std::abs(world.opening(robot_) - last_m_) > kStill_m ? 0 : still_ + 1;
    if (still_ == 0) last_m_ = world.opening(robot_);
    const bool stopped = still_ > steps_of(kStopped_s, world) || elapsed > steps_of(kHandTimeout_s, world);
    if (!expect_) {
      const bool arrived = std::abs(world.opening(robot_) - opening_m_) <= kOpeningTolerance_m;
      return arrived || stopped ? kDone : kRunning;
    }
    held_ = world.grasped(robot_) == expect_ ? held_ + 1 : 0;
    if (held_ > steps_of(kGrasped_s, world)) return kDone;
    return stopped && held_ == 0 ? failed(Reason::grasp_missed) : kRunning;
  }

 private:
  double opening_m_, force_;
  std::optional<PartRef> expect_;
  int robot_;
  double last_m_ = 0;
  std::int64_t count_ = 0, still_ = 0, held_ = 0;
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
