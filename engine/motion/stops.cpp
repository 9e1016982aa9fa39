#include "engine/motion/stops.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/transform.h"
#include "engine/motion/blended_path.h"

namespace stampede {
namespace {

constexpr std::int64_t kStopKnotSteps = 6;
constexpr double kStand_s = 0.2;        // four frames at the usual 20 Hz: two of them have quiet ones on both sides
constexpr double kLeast_s = 0.3;        // of slowing down, and of speeding up again
constexpr double kMost_s = 2.0;         // that are tried
constexpr double kApart_s = 0.25;       // stands nearer to an end, or to each other, are one
constexpr double kOffLine_m = 0.005;    // of the tip
constexpr double kOffLine_rad = 0.035;  // and its turn
constexpr double kMostTurn_rad = 2;     // between two stops: near half a turn nobody knows which way around

std::vector<Transform> tips(const Arm& arm, const Trajectory& trajectory, int physics_hz) {
  std::vector<Transform> all;
  for (std::int64_t step = 0; step <= trajectory.steps(); step += kStopKnotSteps)
    all.push_back(arm.world_from_tip(evaluate(trajectory, static_cast<double>(step), physics_hz).position));
  return all;
}

// How far a point is off the line between two others, as a share of what is allowed.
double off_line(const Transform& at, const Transform& from, const Transform& to) {
  const Vector3 way = to.translation() - from.translation(), here = at.translation() - from.translation();
  const Quaternion first(from.linear()), last(to.linear()), turned(at.linear());
  const double turn = angle_between(first, last);
  double share =
      way.norm() > 1e-3 ? here.dot(way) / way.squaredNorm() : angle_between(first, turned) / std::max(turn, 1e-6);
  share = std::clamp(share, 0.0, 1.0);
  return std::max((here - share * way).norm() / kOffLine_m,
                  angle_between(turned, first.slerp(share, last)) / kOffLine_rad);
}

// Halves what bends where it is furthest off, and what turns far.
void add_bends(const std::vector<Transform>& all, std::size_t first, std::size_t last,
               std::vector<std::int64_t>& stops) {
  std::size_t worst = first;
  double most = 1;
  for (std::size_t i = first + 1; i < last; ++i) {
    const double off = off_line(all[i], all[first], all[last]);
    if (off > most) most = off, worst = i;
  }
  const double turn = angle_between(Quaternion(all[first].linear()), Quaternion(all[last].linear()));
  if (worst == first && turn > kMostTurn_rad) worst = (first + last) / 2;
  if (worst == first) return;
  add_bends(all, first, worst, stops);
  stops.push_back(static_cast<std::int64_t>(worst) * kStopKnotSteps);
  add_bends(all, worst, last, stops);
}

std::vector<std::int64_t> apart(std::vector<std::int64_t> stops, std::int64_t end, int physics_hz) {
  std::sort(stops.begin(), stops.end());
  const auto least = static_cast<std::int64_t>(kApart_s * physics_hz);
  std::vector<std::int64_t> kept;
  for (const std::int64_t stop : stops)
    if (stop >= (kept.empty() ? 0 : kept.back()) + least && stop + least <= end) kept.push_back(stop);
  return kept;
}

// Time of the old motion over that of the new one: it goes at its own pace, and around each stop its pace sinks to
// nothing and rises again, smoothly (cubic), each within `ramp` steps of the new time.
class StopClock {
 public:
  StopClock(std::vector<std::int64_t> stops, std::int64_t end, double ramp, double stand) {
    double old = 0, now = 0;
    const auto go = [&](double until, bool from_stand, bool to_stand) {
      const double gap = until - old;  // a ramp takes twice the time of what it covers
      const double ends = (from_stand ? 0.5 : 0) + (to_stand ? 0.5 : 0);
      const double length = ends > 0 ? std::min(ramp, gap / ends) : 0;
      if (from_stand) add(old, now, length, Kind::rise);
      const double even = gap - ends * length;
      if (even > 1e-9) add(old, now, even, Kind::even);
      if (to_stand) add(old, now, length, Kind::fall);
      old = until;
    };
    bool stood = false;
    for (const std::int64_t stop : stops) {
      go(static_cast<double>(stop), stood, true);
      add(old, now, stand, Kind::stand);
      stood = true;
    }
    go(static_cast<double>(end), stood, false);
    end_ = now;
  }
  double end() const { return end_; }

  struct Moment {
    double old, pace, change;  // steps, steps per step, per step^2
  };
  Moment at(double now) const {
    const Part* part = &parts_.front();
    for (const Part& one : parts_)
      if (one.now <= now) part = &one;
    const double t = std::min(now - part->now, part->length), share = part->length > 0 ? t / part->length : 0;
    switch (part->kind) {
      case Kind::stand:
        return {part->old, 0, 0};
      case Kind::even:
        return {part->old + t, 1, 0};
      case Kind::rise:
        return {part->old + part->length * area(share), smooth(share), slope(share) / part->length};
      case Kind::fall:
        return {part->old + t - part->length * area(share), 1 - smooth(share), -slope(share) / part->length};
    }
    return {};
  }
  // When the old motion is at `old` first.
  double when(double old) const {
    double low = 0, high = end_;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (at(middle).old < old - 1e-6 ? low : high) = middle;
    }
    return high;
  }

 private:
  enum class Kind { even, fall, stand, rise };
  struct Part {
    double old, now, length;  // begins at, in steps of both times; its length in the new one
    Kind kind;
  };
  static double smooth(double x) { return x * x * (3 - 2 * x); }
  static double slope(double x) { return 6 * x * (1 - x); }
  static double area(double x) { return x * x * x * (1 - x / 2); }
  void add(double& old, double& now, double length, Kind kind) {
    parts_.push_back({old, now, length, kind});
    now += length;
    old += kind == Kind::stand ? 0 : kind == Kind::even ? length : length / 2;
  }
  std::vector<Part> parts_;
  double end_ = 0;
};

Trajectory slowed_down(const Trajectory& old, const StopClock& clock, int physics_hz) {
  Trajectory trajectory;
  const auto last = static_cast<std::int64_t>(std::ceil(clock.end() / kStopKnotSteps - 1e-9));
  for (std::int64_t k = 0; k <= last; ++k) {
    const StopClock::Moment moment = clock.at(static_cast<double>(k * kStopKnotSteps));
    const JointState state = evaluate(old, moment.old, physics_hz);
    trajectory.knots.push_back(
        {k * kStopKnotSteps, state.position, moment.pace * state.velocity,
         moment.pace * moment.pace * state.acceleration + moment.change * physics_hz * state.velocity});
  }
  trajectory.knots.back() = old.knots.back();  // to the last bit, so that the next motion starts where this one ends
  trajectory.knots.back().step = last * kStopKnotSteps;
  return trajectory;
}

}  // namespace

void stop_at_vias(const Arm& arm, const MotionLimits& limits, int physics_hz, std::int64_t lines_from,
                  PlannedMotion& motion) {
  const std::int64_t end = motion.trajectory.steps();
  std::vector<std::int64_t> stops;
  for (const PlannedVia& via : motion.vias) stops.push_back(via.step);
  if (lines_from < end) {
    const std::vector<Transform> all = tips(arm, motion.trajectory, physics_hz);
    std::vector<std::size_t> marks{static_cast<std::size_t>(lines_from / kStopKnotSteps)};
    for (const std::int64_t via : stops)
      if (via > lines_from) marks.push_back(static_cast<std::size_t>(via / kStopKnotSteps));
    marks.push_back(all.size() - 1);
    for (std::size_t i = 1; i < marks.size(); ++i) add_bends(all, marks[i - 1], marks[i], stops);
  }
  stops = apart(std::move(stops), end, physics_hz);
  if (stops.empty()) return;
  const double most = std::max(1.0, limit_usage(motion.trajectory, arm.limits(), limits, physics_hz)) + 1e-6;
  for (double ramp_s = kLeast_s; ramp_s <= kMost_s; ramp_s *= 1.3) {
    const StopClock clock(stops, end, ramp_s * physics_hz, kStand_s * physics_hz);
    Trajectory slowed = slowed_down(motion.trajectory, clock, physics_hz);
    if (ramp_s * 1.3 <= kMost_s && limit_usage(slowed, arm.limits(), limits, physics_hz) > most) continue;
    for (PlannedVia& via : motion.vias) via.step = std::llround(clock.when(static_cast<double>(via.step)));
    for (PlannedHand& hand : motion.hands) hand.step = std::llround(clock.when(static_cast<double>(hand.step)));
    motion.trajectory = std::move(slowed);
    return;
  }
}

}  // namespace stampede
