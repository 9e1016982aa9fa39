// An arm that an agent steers looks ahead: what it would run into, it meets slowly.
//
// A contact of rigid things bears the momentum of the arm in one step, whatever the motors do: 5 kg at 1.7 m/s are
// 2,000 N. So the arm may only be as fast as it can stop before anything that it does not touch yet (as the dynamic
// window of Fox, Burgard, Thrun 1997, doi:10.1109/100.580977, asks of a mobile robot); nearer, it goes at kMeetingPace.
#include <algorithm>
#include <array>
#include <set>

#include "engine/sim/collision_state.h"
#include "engine/sim/paces.h"
#include "engine/sim/robot_control.h"

namespace stampede {
namespace {

constexpr double kLook_s = 0.05;                      // looks so often, at the way until then and the stop after it
constexpr double kLongest_s = 0.5;                    // of a stop
constexpr int kSpacing = 4;                           // steps between two configurations that are looked at
constexpr std::array kDistances{0.001, 0.0003, 0.0};  // m, from what is ahead
constexpr double kMoved_rad = 0.001;                  // so far a way's beginning goes
constexpr std::size_t kAtOnce = 2;                    // of the places looked at
constexpr double kInto = 0.05;                        // cosine to the normal: less is along a surface
constexpr double kLight_kg = 1;                       // what lies on the arm and is free goes with it
constexpr double kStop_m = 0.02;                      // so near its stop a door or a button gives way no more
constexpr double kSlow = 2;                           // times the pace of meeting: faster, it brakes first
constexpr std::array kPaces{1.0, 0.7, 0.5, 0.35, kYieldingPace, 0.1, kMeetingPace};
// Torques say nothing of where the arm will be: the distance alone counts.
constexpr std::array<std::pair<double, double>, 3> kClearances{{{0.16, 1.0}, {0.06, 0.4}, {0.02, 0.12}}};  // m, pace

using Pairs = std::set<std::pair<PartRef, PartRef>>;

Pairs touched(const CollisionState& state, const JointVector& q, double padding) {
  Pairs pairs;
  for (const CollisionPair& pair : state.contacts(q, padding)) pairs.insert({pair.robot_part, pair.other});
  return pairs;
}

// What the arm touches, or what it holds does. Of what can move the whole part counts, which goes with it.
struct Bearing {
  Pairs pairs, lying, joined;  // that bear a force; that touch without; a lid in its thread, with what it is on
  std::set<PartRef> pushed;
  bool rigid = false;  // something that it touches does not give way
  bool contains(const std::pair<PartRef, PartRef>& pair) const {
    return pairs.contains(pair) || lying.contains(pair) || joined.contains(pair) || pushed.contains(pair.second);
  }
  bool empty() const { return pairs.empty() && lying.empty(); }
};

// What is nearer to the arm than each of the distances.
class Near {
 public:
  Near(const CollisionState& state, const JointVector& here) : state_(state) {
    for (std::size_t i = 0; i < kDistances.size(); ++i)
      if (i == 0 || !pairs_[i - 1].empty()) pairs_[i] = touched(state, here, kDistances[i]);
  }
  const Pairs& near() const { return pairs_.front(); }
  const Pairs& touching() const { return pairs_.back(); }
  // Whether nothing is met on a way but what is touched already, and nothing that is near gets nearer than the next
  // distance.
  bool clear(const std::vector<JointVector>& way, const Bearing& bearing) const {
    if (near().empty() && state_.first_touching(way, kDistances.front()) == way.size()) return true;
    return std::ranges::all_of(way, [&](const JointVector& q) { return clear(q, bearing); });
  }
  // Whether the arm gets off all that bears on it, and at once off what it touches without force: nobody knows from
  // where.
  bool leaves(const std::vector<JointVector>& way, const Bearing& bearing) const {
    for (std::size_t i = kAtOnce; i < way.size(); ++i)
      for (const auto& pair : touched(state_, way[i], kDistances[1]))
        if (!bearing.joined.contains(pair) &&
            (bearing.lying.contains(pair) || (i >= way.size() / 2 && bearing.contains(pair))))
          return false;
    return true;
  }

 private:
  bool clear(const JointVector& q, const Bearing& bearing) const {
    for (std::size_t i = 0; i < kDistances.size(); ++i) {
      bool nearer = false;
      for (const auto& pair : touched(state_, q, kDistances[i])) {
        if (bearing.contains(pair)) continue;
        if (!pairs_[i].contains(pair)) return false;
        nearer = true;
      }
      if (!nearer) return true;
    }
    return true;
  }
  const CollisionState& state_;
  std::array<Pairs, kDistances.size()> pairs_;
};

// The arm where it is, with what it carries, and where it can come to a stand.
class Lookout {
 public:
  explicit Lookout(const RobotControl& control);
  double pace_by_distance() const;
  // That it can have until it looks again after so many steps.
  double pace(std::int64_t often) const;

 private:
  bool is_light(PartRef part) const;
  bool gives_way(PartRef part, const Vector3& point, const Vector3& push) const;
  bool meets(PartRef own, PartRef other) const;
  bool presses(const std::vector<JointVector>& way) const;
  std::vector<JointVector> way_to_a_stand(double pace, std::int64_t led) const;
  Bearing bearing(const Near& near) const;
  void add_contacts(Bearing& bearing) const;
  void add_joined(Bearing& bearing) const;

  const RobotControl& control_;
  const Bodies& bodies_;
  JointVector here_;
  std::optional<PartRef> grasped_;
  CollisionState state_;
  std::optional<int> held_;
};

Lookout::Lookout(const RobotControl& control)
    : control_(control),
      bodies_(control.bodies()),
      here_(control.position()),
      grasped_(control.grasped()),
      state_(bodies_.for_planning()) {
  if (const std::optional<PartRef> carried = control.carried()) {
    const Transform tip = control.arm().world_from_tip(here_);
    state_.hold(carried->body, tip.inverse() * bodies_.world_from_part({carried->body, 0}));
  }
  held_ = state_.held();
}

bool Lookout::is_light(PartRef part) const {
  return part.body >= 0 && bodies_.body_slot(part.body).free != nullptr &&
         bodies_.body(part.body).parts[0].mass < kLight_kg;
}

// Whether what is pushed at a point, in a direction, goes that way: it is light, or its joint has some way left.
bool Lookout::gives_way(PartRef part, const Vector3& point, const Vector3& push) const {
  if (is_light(part)) return true;
  if (part.body < 0 || bodies_.slot(part).dof < 0) return false;
  const Joint& joint = bodies_.part(part).joint;
  const Transform& pose = bodies_.world_from_part(part);
  const Vector3 axis = pose.linear() * joint.axis.normalized();
  const bool slides = joint.kind == JointKind::slider;
  const double lever = push.dot(slides ? axis : Vector3(axis.cross(point - pose.translation())));  // m, of its position
  const double left = lever > 0 ? joint.upper - bodies_.position(part) : bodies_.position(part) - joint.lower;
  return left * std::abs(lever) > kStop_m;
}

// Contact of a link, or of what the hand carries, with something else.
bool Lookout::meets(PartRef own, PartRef other) const {
  const bool carried = own.body == held_;
  return (own.body == kRobot || carried) && other.body != held_ && !(carried && other.body == kRobot);
}

// Whether a way begins into something that bears on the arm.
bool Lookout::presses(const std::vector<JointVector>& way) const {
  const auto moved = std::ranges::find_if(way, [&](const JointVector& q) { return (q - here_).norm() > kMoved_rad; });
  if (moved == way.end()) return false;
  const auto into = [&](PartRef own, PartRef other, const Contact& contact, double sign) {
    if (!meets(own, other)) return false;
    const Vector3 step = control_.motion_of(own, contact.point, *moved - here_);
    return sign * step.dot(contact.normal) < -kInto * step.norm();
  };
  return std::ranges::any_of(control_.contacts().closed(), [&](const Contact& one) {
    return into(one.a, one.b, one, 1) || into(one.b, one.a, one, -1);
  });
}

// Of the reference: so many steps by the servo at this pace, then as fast as it can on its way to a stand.
std::vector<JointVector> Lookout::way_to_a_stand(double pace, std::int64_t led) const {
  Limits ignored;
  const operation::Servo stop{operation::Servo::Of::velocity, JointVector::Zero(control_.arm().joints())};
  const Stream none;
  const StepClock& clock = control_.clock();
  const Guard guard{pace, {}}, stand{0, {}};
  const Governor governor(control_.arm(), clock.dt, stand, ignored);
  const auto longest = static_cast<std::int64_t>(kLongest_s / clock.dt);
  std::vector<JointVector> way;
  JointState at = control_.reference_now;
  for (std::int64_t i = 1; i <= led + longest; ++i) {
    at = i <= led ? control_.served(at, clock.steps + i - 1, guard, ignored) : governor.guided(at, {stop, none});
    const bool rests = i > led && at.velocity.cwiseAbs().maxCoeff() < 1e-3;
    if (i % kSpacing == 0 || rests) way.push_back(at.position);
    if (rests) break;
  }
  return way;
}

// What bears on the arm by the contacts that there were.
void Lookout::add_contacts(Bearing& bearing) const {
  for (const Contact& one : control_.contacts().closed())
    for (const auto& [own, other] : {std::pair(one.a, one.b), std::pair(one.b, one.a)}) {
      if (!meets(own, other)) continue;
      bearing.pairs.insert({own, other});
      const Vector3 push = own == one.a ? Vector3(-one.normal) : one.normal;
      bearing.rigid = bearing.rigid || !gives_way(other, one.point, push);
      if (other.body >= 0 && (bodies_.slot(other).tree != nullptr || bodies_.body_slot(other.body).free != nullptr))
        bearing.pushed.insert(other);
    }
}

void Lookout::add_joined(Bearing& bearing) const {
  if (!bodies_.joined({*held_, 0})) return;
  const int other = bodies_.scene().body_index(bodies_.body(*held_).joined_to);
  for (std::size_t p = 0; p < bodies_.body(other).parts.size(); ++p)
    bearing.joined.insert({PartRef{*held_, 0}, PartRef{other, static_cast<int>(p)}});
}

Bearing Lookout::bearing(const Near& near) const {
  Bearing bearing;
  add_contacts(bearing);
  if (held_) {
    add_joined(bearing);
    for (const auto& pair : near.near())  // it may lie in something, as a plug does
      if (pair.first.body == *held_ && !bearing.joined.contains(pair)) bearing.pairs.insert(pair);
  }
  for (const auto& pair : near.touching()) {
    if (bearing.contains(pair)) continue;
    bearing.lying.insert(pair);
    bearing.rigid = bearing.rigid || !is_light(pair.second);
  }
  return bearing;
}

double Lookout::pace_by_distance() const {
  for (const auto& [distance, pace] : kClearances)
    if (state_.free(here_, distance)) return pace;
  return kMeetingPace;
}

double Lookout::pace(std::int64_t often) const {
  const Near near(state_, here_);
  const Bearing bearing = this->bearing(near);
  const double most = bearing.empty() ? 1 : grasped_ || !bearing.rigid ? kYieldingPace : kMeetingPace;
  for (const double pace : kPaces) {
    const std::vector<JointVector> way = way_to_a_stand(pace, often);
    if (near.clear(way, bearing) && (pace <= most || (near.leaves(way, bearing) && !presses(way)))) return pace;
  }
  // The way to a stand was seen to be clear at the look before; that of the new action, slowly, need not be.
  return as_slow_as(kSlow * kMeetingPace, control_.arm(), control_.reference_now) ? kMeetingPace : 0;
}

}  // namespace

void RobotControl::look_ahead() {
  const auto often = static_cast<std::int64_t>(std::max(1.0, kLook_s / dt_ + 0.5));
  if (!reference.servo || (clock_.steps - reference.start_step) % often != 0) return;
  const Lookout lookout(*this);
  reference.pace = under_torque() ? lookout.pace_by_distance() : lookout.pace(often);
}

}  // namespace stampede
