#include "engine/motion/part_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "engine/motion/checker.h"
#include "engine/motion/route.h"

namespace stampede {
namespace {

constexpr int kLayers = 16;          // places of the part that are looked at
constexpr double kMostJump = 0.5;    // rad of a joint from one to the next
constexpr int kMostTurns = 2;        // steps of the handle in the hand from one to the next
constexpr double kLeastStep = 0.05;  // rad, of those
constexpr double kPivotCost = 0.3;   // of a rad that the handle turns in the hand, beside one of a joint

struct Node {
  JointVector q;
  double cost = std::numeric_limits<double>::infinity();
  int from = -1;  // index in the layer before
};

// About the axis through the tip.
Transform turned(Transform tip, const Vector3& axis, double angle) {
  tip.linear() = Eigen::AngleAxisd(angle, axis) * tip.linear();
  return tip;
}

std::function<Transform(double)> tip_way(const PartWay& way, const Transform& held, std::vector<double> turns) {
  return [way, held, turns = std::move(turns)](double share) {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(turns.size() - 1);
    const std::size_t i = std::min(turns.size() - 2, static_cast<std::size_t>(place));
    const double beyond = place - static_cast<double>(i);
    const double turn = (1 - beyond) * turns[i] + beyond * turns[i + 1];
    return turned(way.moved(share) * held, way.axis, turn);
  };
}

bool can_retreat(const Arm& arm, const JointVector& from, double way, RandomKey key) {
  const Transform tip = arm.world_from_tip(from);
  const auto back = [&](double share) { return Transform(tip * translation(0, 0, -share * way)); };
  return way <= 0 || follow_tool(arm, from, back, samples_between(tip, back(1)), key).reason == Reason::none;
}

// Corners of the turning become round; where it begins stays.
void smooth(std::vector<double>& turns) {
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<double> before = turns;
    for (std::size_t i = 1; i + 1 < turns.size(); ++i) turns[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
  }
}

}  // namespace

std::optional<ArmWay> way_with_part(const CollisionState& state, const JointVector& start, const PartWay& way,
                                    RandomKey key) {
  const Arm& arm = state.arm();
  const Transform held = arm.world_from_tip(start);
  const double step = std::max(kLeastStep, std::abs(way.turn) / kLayers);
  const int most = way.turn == 0 ? 0 : static_cast<int>(way.pivot / step);
  const std::size_t width = static_cast<std::size_t>(2 * most) + 1;
  std::vector<std::vector<Node>> layers(kLayers + 1, std::vector<Node>(width));
  layers[0][static_cast<std::size_t>(most)] = {start, 0, -1};
  CollisionState holding = state;
  holding.set_opening(way.opening);
  if (way.part.body >= 0) holding.allow_touched(way.part, start);
  for (int k = 1; k <= kLayers; ++k) {
    const double share = static_cast<double>(k) / kLayers;
    const Transform moved = way.moved(share);
    CollisionState there = holding;
    if (way.part.body >= 0) there.move_part(way.part, moved);
    const std::vector<Node>& before = layers[static_cast<std::size_t>(k) - 1];
    for (int j = -most; j <= most; ++j) {
      Node& node = layers[static_cast<std::size_t>(k)][static_cast<std::size_t>(j + most)];
      const Transform tip = turned(moved * held, way.axis, j * step);
      for (int i = std::max(-most, j - kMostTurns); i <= std::min(most, j + kMostTurns); ++i) {
        const Node& from = before[static_cast<std::size_t>(i + most)];
        const double bend = kPivotCost * step * (j - i);
        if (from.cost + bend * bend >= node.cost) continue;
        const auto q = arm.solve(tip, from.q, key.with(k), 0);
        if (!q || joint_gap(*q, from.q) > kMostJump) continue;
        const double cost = from.cost + (*q - from.q).squaredNorm() + bend * bend;
        if (cost < node.cost && (share > way.stop || there.free(*q))) node = {*q, cost, i + most};
      }
    }
  }
  std::vector<Node>& ends = layers.back();
  const auto best_end = [&] {
    return std::min_element(ends.begin(), ends.end(), [](const Node& a, const Node& b) { return a.cost < b.cost; });
  };
  auto best = best_end();
  for (; best->from >= 0 && !can_retreat(arm, best->q, way.retreat, key.with("retreat")); best = best_end()) *best = {};
  if (best->from < 0) return std::nullopt;
  std::vector<double> turns(kLayers + 1);
  std::vector<JointVector> arm_at(kLayers + 1, start);
  int at = static_cast<int>(best - ends.begin());
  for (std::size_t k = kLayers; k > 0; --k) {
    const Node& node = layers[k][static_cast<std::size_t>(at)];
    turns[k] = (at - most) * step;
    arm_at[k] = node.q;
    at = node.from;
  }
  smooth(turns);
  return ArmWay{tip_way(way, held, std::move(turns)), std::move(arm_at)};
}

}  // namespace stampede
