// An arm that an agent steers looks ahead: what it would run into, it meets slowly.
//
// A contact of rigid things bears the momentum of the arm in one step, whatever the motors do: 5 kg at 1.7 m/s are
// 2,000 N. So the arm may only be as fast as it can stop before anything that it does not touch yet (as the dynamic
// window of Fox, Burgard, Thrun 1997, doi:10.1109/100.580977, asks of a mobile robot); nearer, it goes at kMeeting.
#include <algorithm>
#include <array>
#include <set>

#include "engine/sim/collision_state.h"
#include "engine/sim/impl.h"
#include "engine/sim/paces.h"

namespace stampede {
namespace {

constexpr double kLook_s = 0.05;    // looks so often, at the way until then and the stop after it
constexpr double kLongest_s = 0.5;  // of a stop
constexpr int kSpacing = 4;         // steps between two configurations that are looked at
constexpr double kClear_m = 0.001;  // from what is ahead
constexpr double kMeeting = 0.025;  // share of the speeds: 4 cm/s of the tip
constexpr double kSlow = 2;         // times that: faster, it brakes first
constexpr std::array kPaces{1.0, 0.4, kHoldingPace, kPushingPace};
// Torques say nothing of where the arm will be: the distance alone counts.
constexpr std::array<std::pair<double, double>, 3> kClearances{{{0.16, 1.0}, {0.06, 0.4}, {0.02, 0.12}}};  // m, pace

using Pairs = std::set<std::pair<PartRef, PartRef>>;

Pairs touched(const CollisionState& state, const JointVector& q, double padding) {
  Pairs pairs;
  for (const CollisionPair& pair : state.contacts(q, padding)) pairs.insert({pair.robot_part, pair.other});
  return pairs;
}

// What the arm touches now: pairs, and of what can move the whole part, which goes with it.
struct Known {
  Pairs pairs;
  std::set<PartRef> moving;
  bool contains(const std::pair<PartRef, PartRef>& pair) const {
    return moving.contains(pair.second) || pairs.contains(pair);
  }
};

// Whether nothing is met at any of these places that is not touched already.
bool clear(const CollisionState& state, const std::vector<JointVector>& way, const Known& known) {
  if (known.pairs.empty()) return state.first_touching(way, kClear_m) == way.size();
  return std::all_of(way.begin(), way.end(), [&](const JointVector& q) {
    const Pairs met = touched(state, q, kClear_m);
    return std::all_of(met.begin(), met.end(), [&](const auto& pair) { return known.contains(pair); });
  });
}

}  // namespace

void World::Impl::look_ahead() {
  const auto often = static_cast<std::int64_t>(std::max(1.0, kLook_s / dt + 0.5));
  if (!reference.servo || (steps - reference.start_step) % often != 0) return;
  CollisionState state = now_for_planning();
  if (const auto held = contacts.grasped(scene->robot.pads); held && body(held->body).free) {
    const Transform tip = arm.world_from_tip(arm_position_now());
    state.hold(held->body, tip.inverse() * world_from_part({held->body, 0}));
  }
  const JointVector here = arm_position_now();
  if (under_torque()) {
    reference.pace = kMeeting;
    for (const auto& [distance, pace] : kClearances)
      if (state.free(here, distance)) {
        reference.pace = pace;
        break;
      }
    return;
  }
  Known known{touched(state, here, kClear_m), {}};
  for (const auto& [own, other] : known.pairs)
    if (other.body >= 0 && (slot(other).tree != nullptr || body_slot(other.body).free != nullptr))
      known.moving.insert(other);
  const double most = known.pairs.empty() ? 1 : contacts.grasped(scene->robot.pads) ? kHoldingPace : kPushingPace;
  Limits ignored;
  const operation::Servo stop{operation::Servo::Of::velocity, JointVector::Zero(here.size())};
  for (const double pace : kPaces) {
    if (pace > most) continue;
    reference.pace = pace;
    std::vector<JointVector> way;
    JointState at = reference_now;
    const auto longest = static_cast<std::int64_t>(kLongest_s / dt);
    for (std::int64_t i = 1; i <= often + longest; ++i) {
      at = guided(at, i <= often ? *reference.servo : stop, arm, dt, {pace, {}}, ignored);
      const bool rests = i > often && at.velocity.cwiseAbs().maxCoeff() < 1e-3;
      if (i % kSpacing == 0 || rests) way.push_back(at.position);
      if (rests) break;
    }
    if (clear(state, way, known)) return;
  }
  // The way to a stand was seen to be clear at the look before; that of the new action, slowly, need not be.
  const std::vector<JointLimits>& limits = arm.limits();
  bool slow = true;
  for (Eigen::Index i = 0; i < here.size(); ++i)
    slow =
        slow && std::abs(reference_now.velocity[i]) <= kSlow * kMeeting * speed_of(limits[static_cast<std::size_t>(i)]);
  reference.pace = slow ? kMeeting : 0;
}

}  // namespace stampede
