#include "engine/motion/steering.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace stampede {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kDamping = 1e-4;  // of the inverse of the Jacobian: nothing jumps near a singularity

// The joint motion that moves the tip by a twist.
JointVector joints_for(const Arm& arm, const JointVector& q, const Vector6& twist) {
  const auto jacobian = arm.jacobian(q);
  Matrix6 squared = jacobian * jacobian.transpose();
  squared.diagonal().array() += kDamping;
  return jacobian.transpose() * squared.ldlt().solve(twist);
}

// Rotation vector from one frame to another, small angles, world axes.
Vector3 small_turn(const Matrix3& from, const Matrix3& to) {
  const Matrix3 turn = to * from.transpose();
  return 0.5 * Vector3(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
}

class Pressing : public Steering {
 public:
  Pressing(Trajectory trajectory, const FollowOptions& options)
      : trajectory_(std::move(trajectory)), force_(options.press), along_(options.press_along), robot_(options.robot) {}

  double stiffness() const override { return kStiffness; }

  Next next(const World& world, const ContactWatch& watch) override {
    const Arm& arm = world.arm(robot_);
    const int hz = world.scene().physics_hz;
    const JointState here = evaluate(trajectory_, static_cast<double>(clock_), hz);
    const Vector3 into = along_.isZero() ? Vector3(arm.world_from_tip(here.position).linear().col(2)) : along_;
    const double pressed = -watch.force_along(world, into);
    const double lacking = force_ - pressed;
    const double rate = std::clamp(lacking / (kStiffness * kTime_s), -kFastest, kFastest);
    const double before = shift_;
    shift_ = std::clamp(shift_ + rate * world.dt(), -kBack_m, kAhead_m);
    near_ = std::abs(lacking) <= kNear * force_ ? near_ + 1 : 0;  // more than the blow with which it came down
    presses_ = presses_ || near_ > steps_of(kSteady_s, world);
    touched_ = touched_ || pressed > kNear * force_;
    if (presses_ || ++waited_ > steps_of(kPatience_s, world)) clock_ = std::min(clock_ + 1, trajectory_.steps());

    const JointState there = evaluate(trajectory_, static_cast<double>(clock_), hz);
    // Across, what friction holds back is made up as well.
    const Vector3 off = arm.world_from_tip(here.position).translation() - world.world_from_tip(robot_).translation();
    aside_ += world.dt() / kTime_s * (off - off.dot(into) * into);
    if (aside_.norm() > kAside_m) aside_ *= kAside_m / aside_.norm();
    Vector6 creep = Vector6::Zero();
    creep.head<3>() = (shift_ - before) / world.dt() * into;
    Next next{shifted(arm, there.position, shift_ * into + aside_),
              there.velocity + joints_for(arm, there.position, creep), clock_};
    if (clock_ == trajectory_.steps() && !touched_) {
      next.reason = Reason::tracking_error;
      next.detail = "there was nothing to press on within " + std::to_string(std::lround(1000 * kAhead_m)) + " mm";
    }
    return next;
  }

 private:
  static constexpr double kStiffness = 1200;  // N/m: a bump of 1 mm is 1.2 N at once
  static constexpr double kTime_s = 0.2;      // in which a lack of force is made up
  static constexpr double kFastest = 0.04;    // m/s, to where it presses
  static constexpr double kAhead_m = 0.03, kBack_m = 0.02;
  static constexpr double kAside_m = 0.01;
  static constexpr double kNear = 0.3;  // of the force
  static constexpr double kSteady_s = 0.15, kPatience_s = 2;
  Trajectory trajectory_;
  double force_;
  Vector3 along_;
  int robot_;
  double shift_ = 0;  // m
  Vector3 aside_ = Vector3::Zero();
  bool presses_ = false, touched_ = false;
  std::int64_t clock_ = 0, waited_ = 0, near_ = 0;
};

class Searching : public Steering {
 public:
  Searching(Trajectory trajectory, const FollowOptions& options)
      : trajectory_(std::move(trajectory)),
        radius_(options.search),
        pitch_(options.search_pitch),
        ahead_(options.search_force / kStiffness),
        robot_(options.robot) {}

  double stiffness() const override { return kStiffness; }

  Next next(const World& world, const ContactWatch&) override {
    const Arm& arm = world.arm(robot_);
    if (clock_ < 0) begin(world);
    const int hz = world.scene().physics_hz;
    const Transform planned = arm.world_from_tip(evaluate(trajectory_, clock_, hz).position);
    const Vector3 off = world.world_from_tip(robot_).translation() - planned.translation();
    const double got_to = (world.world_from_tip(robot_).translation() - from_).dot(way_);
    const bool held_up = -off.dot(way_) >= ahead_;
    const double last = static_cast<double>(trajectory_.steps());
    pace_ = held_up ? 0 : std::min(1.0, pace_ + world.dt() / kRamp_s);
    clock_ = std::min(last, clock_ + pace_);
    Next next;
    const Vector3 before = beside_;
    if (turning_) {
      if (got_to > blocked_at_ + kAdvance_m) {
        turning_ = false;
        still_ = 0;
        beside_ = off - off.dot(way_) * way_;
        centre_ = beside_;
      } else {
        go_round(world.dt());
        if (wide_) give_up(next, got_to);
      }
    } else {
      still_ = held_up && clock_ < last ? still_ + 1 : 0;
      if (still_ > steps_of(kStands_s, world)) start_turning(next, got_to);
    }
    const JointState there = evaluate(trajectory_, clock_, hz);
    Vector6 aside = Vector6::Zero();
    aside.head<3>() = (turning_ ? 1.0 : 0.0) * (beside_ - before) / world.dt();
    next.position = shifted(arm, there.position, beside_);
    next.velocity = pace_ * there.velocity + joints_for(arm, there.position, aside);
    next.clock = static_cast<std::int64_t>(clock_);
    return next;
  }

 private:
  static constexpr double kStiffness = 6000;  // N/m: friction of 3 N holds the tool back by half a millimetre
  static constexpr double kAdvance_m = 0.0015;
  static constexpr double kSpeed = 0.010;   // m/s around
  static constexpr double kRamp_s = 0.15;   // back to the full pace
  static constexpr double kStands_s = 0.2;  // held up for so long, it begins to search
  static constexpr int kMostSpirals = 8;

  void begin(const World& world) {
    const Arm& arm = world.arm(robot_);
    const Transform first = arm.world_from_tip(trajectory_.knots.front().position);
    const Transform last = arm.world_from_tip(trajectory_.knots.back().position);
    from_ = first.translation();
    length_ = (last.translation() - from_).norm();
    way_ = length_ > 1e-6 ? Vector3((last.translation() - from_) / length_) : Vector3(first.linear().col(2));
    const Vector3 sideways = first.linear().col(0) - first.linear().col(0).dot(way_) * way_;
    across_ = sideways.norm() > 0.3
                  ? sideways.normalized()
                  : Vector3(first.linear().col(1) - first.linear().col(1).dot(way_) * way_).normalized();
    clock_ = 0;
  }

  void start_turning(Next& next, double got_to) {
    room_ = radius_ - centre_.norm();
    if (++spirals_ > kMostSpirals || room_ < pitch_) return give_up(next, got_to);
    turning_ = true;
    angle_ = 0;
    blocked_at_ = got_to;
  }

  void go_round(double dt) {
    const double per_rad = pitch_ / (2 * M_PI);
    angle_ += kSpeed * dt / std::hypot(per_rad * angle_, per_rad);
    const double out = per_rad * angle_;
    wide_ = out > room_;
    beside_ = centre_ + out * (std::cos(angle_) * across_ + std::sin(angle_) * way_.cross(across_));
  }

  void give_up(Next& next, double got_to) const {
    const auto millimetres = [](double m) { return std::to_string(std::lround(1000 * m)) + " mm"; };
    next.reason = Reason::stuck;
    next.detail = "blocked " + millimetres(length_ - got_to) + " before the end, with no way on within " +
                  millimetres(radius_) + " around";
  }

  Trajectory trajectory_;
  double radius_, pitch_, ahead_;
  int robot_;
  Vector3 from_ = Vector3::Zero(), way_ = Vector3::UnitZ(), across_ = Vector3::UnitX();  // the straight way
  double length_ = 0;
  double clock_ = -1, pace_ = 0;                                 // steps along the trajectory; steps a step
  Vector3 beside_ = Vector3::Zero(), centre_ = Vector3::Zero();  // of the reference, across the way, m
  bool turning_ = false, wide_ = false;
  double angle_ = 0, room_ = 0, blocked_at_ = 0;
  int spirals_ = 0;
  std::int64_t still_ = 0;
};

}  // namespace

JointVector shifted(const Arm& arm, const JointVector& q, const Vector3& offset) {
  const Transform target = translation(offset) * arm.world_from_tip(q);
  JointVector found = q;
  for (int round = 0; round < 3; ++round) {
    const Transform here = arm.world_from_tip(found);
    Vector6 twist;
    twist << target.translation() - here.translation(), small_turn(here.linear(), target.linear());
    found += joints_for(arm, found, twist);
  }
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const JointLimits& limits = arm.limits()[static_cast<std::size_t>(i)];
    found[i] = std::clamp(found[i], limits.lower, limits.upper);
  }
  return found;
}

std::unique_ptr<Steering> make_pressing(Trajectory trajectory, const FollowOptions& options) {
  return std::make_unique<Pressing>(std::move(trajectory), options);
}

std::unique_ptr<Steering> make_searching(Trajectory trajectory, const FollowOptions& options) {
  return std::make_unique<Searching>(std::move(trajectory), options);
}

}  // namespace stampede
