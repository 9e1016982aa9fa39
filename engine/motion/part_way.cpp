#include "engine/motion/part_way.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "engine/model/body_tree.h"
#include "engine/motion/checker.h"
#include "engine/motion/route.h"
#include "engine/sim/collision_query.h"

namespace stampede {
namespace {

constexpr int kLayers = 16;            // places of the part that are looked at, at least
constexpr double kLayerTurn = 0.25;    // rad from one to the next, at most
constexpr double kLayerJump = 0.5;     // rad of a joint from one to the next
constexpr int kMostTurns = 2;          // steps of the handle in the hand from one to the next
constexpr double kLeastStep = 0.05;    // rad, of those
constexpr double kPivotCost = 0.3;     // of a rad that the handle turns in the hand, beside one of a joint
constexpr double kLinksApart = 0.003;  // m a joint that links keep from each other: under load each trails a little
constexpr int kMostElbows = 4;         // steps of an elbow either way from where it would come to be by itself
constexpr double kElbowStep = 0.15;    // rad of all joints together, of those

struct LayerNode {
  JointVector q;
  JointVector elbow;  // how the joints go together while the tip stands still, a unit vector; empty: unknown
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

// All the way back in reach, and half of it without touching anything: the elbow, and who retreats, see to the rest.
bool can_retreat(const CollisionState& there, const JointVector& from, double way, RandomKey key) {
  if (way <= 0) return true;
  const Transform tip = there.arm().world_from_tip(from);
  const auto back = [&](double share) { return Transform(tip * translation(0, 0, -share * way)); };
  const ToolPath path = follow_tool(there.arm(), from, {back, samples_between(tip, back(1))}, key);
  if (path.reason != Reason::none) return false;
  std::vector<JointVector> waypoints{from};
  waypoints.insert(waypoints.end(), path.waypoints.begin(),
                   path.waypoints.begin() + static_cast<std::ptrdiff_t>((path.waypoints.size() + 1) / 2));
  return !first_touch_of_line(space_of_line(there, false), waypoints, certified_step({}));
}

// Corners of the turning become round; where it begins stays.
void smooth(std::vector<double>& turns) {
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<double> before = turns;
    for (std::size_t i = 1; i + 1 < turns.size(); ++i) turns[i] = (before[i - 1] + 2 * before[i] + before[i + 1]) / 4;
  }
}

CollisionState with_part_held(const CollisionState& state, const JointVector& start, const PartWay& way) {
  CollisionState holding = state;
  holding.set_opening(way.opening);
  if (way.part.body >= 0) holding.allow_touched(way.part, start);
  return holding;
}

// How the joints of an arm with one more than it needs go together while the tip stands still, towards `like`.
JointVector elbow_of(const Arm& arm, const JointVector& q, const JointVector& like) {
  // What is at right angles to all rows of the Jacobian.
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(arm.jacobian(q).transpose());
  const JointVector elbow = factors.householderQ() * Eigen::VectorXd::Unit(q.size(), q.size() - 1);
  return like.size() == elbow.size() && elbow.dot(like) < 0 ? JointVector(-elbow) : elbow;
}

std::size_t layers_of(const PartWay& way) {
  return static_cast<std::size_t>(std::max(kLayers, static_cast<int>(std::ceil(std::abs(way.turn) / kLayerTurn))));
}

double turn_step(const PartWay& way) {
  return std::max(kLeastStep, std::abs(way.turn) / static_cast<double>(layers_of(way)));
}

// Steps that the handle may turn in the hand, either way.
int most_turns(const PartWay& way) { return way.turn == 0 ? 0 : static_cast<int>(way.pivot / turn_step(way)); }

// From a layer to the next, by thirds: the part, and all else, at each.
class Passage {
 public:
  explicit Passage(std::array<CollisionState, 3> states) : states_(std::move(states)) {}
  bool free(const JointVector& from, const JointVector& to) {
    constexpr std::array kShares{1.0 / 3, 2.0 / 3, 1.0};
    for (std::size_t i = 0; i < kShares.size(); ++i)
      if (queries_[i].touches(from + kShares[i] * (to - from))) return false;
    return true;
  }

 private:
  std::array<CollisionState, 3> states_;
  std::array<CollisionQuery, 3> queries_{CollisionQuery(states_[0]), CollisionQuery(states_[1]),
                                         CollisionQuery(states_[2])};
};

// What an arm may choose on its way, beside what the part asks: how the handle turns in the hand, or the elbow.
enum class Choice { handle, elbow };

// Dynamic programming over layers, places of the part on its way; a layer has a node for each step of what is chosen.
class WaySearch {
 public:
  WaySearch(const CollisionState& state, const JointVector& start, const PartWay& way, RandomKey key, Choice choice)
      : arm_(state.arm()),
        start_(start),
        way_(way),
        key_(key),
        held_(arm_.world_from_tip(start)),
        count_(layers_of(way)),
        step_(turn_step(way)),
        elbow_turns_(choice == Choice::elbow),
        most_(elbow_turns_ ? kMostElbows : most_turns(way)),
        next_(elbow_turns_ ? 1 : kMostTurns),
        passages_(count_ + 1),
        holding_(with_part_held(state, start, way)),
        links_(holding_) {}

  // Whether one way through is found by going on from each node at once, the handle or the elbow turned little: soon,
  // but `false` says nothing, since a node is as it was come by first.
  bool goes_straight_through() {
    if (most_ == 0) return false;  // there is one way at most: find() looks no longer for it
    begin();
    return leads_on(0, 0);
  }

  std::optional<ArmWay> find(bool whole) {
    begin();
    for (std::size_t k = 1; k <= count_ && grow(k); ++k) {
    }
    // The last layer, or the last one from which the hand gets away.
    for (std::size_t end = count_; end > 0; --end) {
      if (const auto best = best_end(end)) return traced_back(end, *best);
      if (whole) break;
    }
    return std::nullopt;
  }

 private:
  void begin() {
    layers_.assign(count_ + 1, std::vector<LayerNode>(static_cast<std::size_t>(2 * most_) + 1));
    node_at(0, 0) = {start_, elbow_turns_ ? elbow_of(arm_, start_, {}) : JointVector{}, 0, -1};
  }

  double share_of(std::size_t layer) const { return static_cast<double>(layer) / static_cast<double>(count_); }

  LayerNode& node_at(std::size_t layer, int step) { return layers_[layer][static_cast<std::size_t>(step + most_)]; }

  CollisionState with_part_at(double place) const {
    CollisionState there = holding_;
    if (way_.part.body >= 0) there.move_part(way_.part, way_.moved(place));
    return there;
  }

  Passage& passage_to(std::size_t k) {
    if (!passages_[k]) {
      const double share = share_of(k), last = share_of(k - 1);
      const auto at = [&](double place) {
        CollisionState there = with_part_at(place);
        return share > way_.stop ? space_of_line(there, false) : there;
      };
      passages_[k] = std::make_unique<Passage>(
          std::array<CollisionState, 3>{at(last + (share - last) / 3), at(last + 2 * (share - last) / 3), at(share)});
    }
    return *passages_[k];
  }

  // Finds the nodes of a layer; false: there are none.
  bool grow(std::size_t k) {
    bool any = false;
    for (int j = -most_; j <= most_; ++j) any = reach(k, j) || any;
    return any;
  }

  // A step to a node from one of the layer before: at least what it costs, and once that is known where it leads.
  struct Step {
    int from;
    double cost;
    std::optional<JointVector> q;
  };

  // Node `j` of a layer, by the cheapest free step. Joints are solved for, and looked at, in the order of costs.
  bool reach(std::size_t k, int j) {
    const Transform tip = tip_at(k, j);
    std::vector<Step> steps;
    for (int i = std::max(-most_, j - next_); i <= std::min(most_, j + next_); ++i)
      if (node_at(k - 1, i).cost < std::numeric_limits<double>::infinity())
        steps.push_back({i, least_cost(k, i, j), {}});
    while (!steps.empty()) {
      const auto step =
          std::min_element(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.cost < b.cost; });
      if (!step->q) {
        step->q = stepped(k, step->from, j, tip);
        if (step->q) {
          step->cost += (*step->q - node_at(k - 1, step->from).q).squaredNorm();
          continue;
        }
      } else if (taken(k, step->from, j, *step->q, step->cost)) {
        return true;
      }
      steps.erase(step);
    }
    return false;
  }

  Transform tip_at(std::size_t k, int j) const {
    const Transform with_part = way_.moved(share_of(k)) * held_;
    return elbow_turns_ ? with_part : turned(with_part, way_.axis, j * step_);
  }

  // The joints at node `j` of a layer, where the tip is, coming from node `i` of the one before.
  std::optional<JointVector> stepped(std::size_t k, int i, int j, const Transform& tip) {
    const LayerNode& from = node_at(k - 1, i);
    const JointVector guess = elbow_turns_ ? JointVector(from.q + (j - i) * kElbowStep * from.elbow) : from.q;
    std::optional<JointVector> q = arm_.solve(tip, guess, key_.with(static_cast<std::int64_t>(k)), 0);
    if (q && joint_gap(*q, from.q) > kLayerJump) return std::nullopt;
    return q;
  }

  // Makes it the node, if the arm is free there and on its way there.
  bool taken(std::size_t k, int i, int j, const JointVector& q, double cost) {
    const LayerNode& from = node_at(k - 1, i);
    if (links_.links_within(q, kLinksApart) || !passage_to(k).free(from.q, q)) return false;
    node_at(k, j) = {q, elbow_turns_ ? elbow_of(arm_, q, from.elbow) : JointVector{}, cost, i + most_};
    return true;
  }

  bool leads_on(std::size_t k, int i) {
    if (k == count_) return can_retreat(with_part_at(1), node_at(k, i).q, way_.retreat, key_.with("retreat"));
    for (int turn = 0; turn <= 2 * next_; ++turn) {  // on, a little to either side, more
      const int j = i + (turn % 2 == 0 ? turn / 2 : -(turn + 1) / 2);
      if (std::abs(j) > most_ || node_at(k + 1, j).from >= 0) continue;
      const std::optional<JointVector> q = stepped(k + 1, i, j, tip_at(k + 1, j));
      if (q && taken(k + 1, i, j, *q, 0) && leads_on(k + 1, j)) return true;
    }
    return false;
  }

  // Of a step, before the arm's own motion is known.
  double least_cost(std::size_t k, int i, int j) {
    const double bend = elbow_turns_ ? 0 : kPivotCost * step_ * (j - i);
    return node_at(k - 1, i).cost + bend * bend;
  }

  // The cheapest node of a layer from which the hand gets away.
  std::optional<int> best_end(std::size_t end) {
    std::vector<LayerNode>& ends = layers_[end];
    const CollisionState there = with_part_at(share_of(end));
    for (;;) {
      const auto best = std::min_element(ends.begin(), ends.end(),
                                         [](const LayerNode& a, const LayerNode& b) { return a.cost < b.cost; });
      if (best->from < 0) return std::nullopt;
      if (can_retreat(there, best->q, way_.retreat, key_.with("retreat"))) return static_cast<int>(best - ends.begin());
      *best = {};
    }
  }

  ArmWay traced_back(std::size_t end, int at) const {
    std::vector<double> turns(end + 1);
    std::vector<JointVector> arm_at(end + 1, start_);
    for (std::size_t k = end; k > 0; --k) {
      const LayerNode& node = layers_[k][static_cast<std::size_t>(at)];
      turns[k] = elbow_turns_ ? 0 : (at - most_) * step_;
      arm_at[k] = node.q;
      at = node.from;
    }
    smooth(turns);
    const double reach = end == count_ ? 1.0 : share_of(end);
    return ArmWay{tip_way(first_of(way_, reach), held_, std::move(turns)), std::move(arm_at), reach};
  }

  const Arm& arm_;
  const JointVector& start_;
  const PartWay& way_;
  RandomKey key_;
  Transform held_;  // world_from_tip at the start
  std::size_t count_;
  double step_;  // rad, from a turn of the handle to the next
  bool elbow_turns_;
  int most_, next_;  // steps either way in all, and from a layer to the next
  std::vector<std::vector<LayerNode>> layers_;
  std::vector<std::unique_ptr<Passage>> passages_;  // to each layer
  CollisionState holding_;
  CollisionQuery links_;
};

// Where the handle cannot turn in the hand, the elbow is all that an arm can choose.
bool elbow_may_turn(const Arm& arm, const PartWay& way) { return arm.joints() > 6 && most_turns(way) == 0; }

}  // namespace

bool free_at_end(const CollisionState& state, const JointVector& start, const PartWay& way, const JointVector& q) {
  CollisionState there = with_part_held(state, start, way);
  if (way.part.body >= 0) there.move_part(way.part, way.moved(1));
  return there.free(q);
}

std::vector<PartRef> with_mounted(const Scene& scene, PartRef part) {
  std::vector<PartRef> parts{part};
  if (part.body < 0) return parts;
  const Body& body = scene.bodies[static_cast<std::size_t>(part.body)];
  for (int i = part.part + 1; i < static_cast<int>(body.parts.size()); ++i)
    if (hangs_on(body, i, part.part)) parts.push_back({part.body, i});
  return parts;
}

PartWay rest_of(const PartWay& way, double share) {
  if (share == 0) return way;
  PartWay rest = way;
  const Transform there = way.moved(share);
  rest.moved = [moved = way.moved, back = Transform(there.inverse()), share](double of_it) {
    return Transform(moved(share + of_it * (1 - share)) * back);
  };
  rest.before = there * way.before;
  rest.axis = there.linear() * way.axis;
  rest.turn *= 1 - share;
  rest.stop = way.stop <= share ? 0 : (way.stop - share) / (1 - share);
  return rest;
}

PartWay first_of(const PartWay& way, double share) {
  if (share == 1) return way;
  PartWay part = way;
  part.moved = [moved = way.moved, share](double of_it) { return moved(share * of_it); };
  part.turn *= share;
  part.stop = std::min(1.0, way.stop / share);
  return part;
}

ArmWay first_of(const ArmWay& way, double share) {
  ArmWay part = way;
  part.world_from_tip = [whole = way.world_from_tip, share](double of_it) { return whole(share * of_it); };
  const std::size_t last = way.arm.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    const double place = share * static_cast<double>(k);
    const std::size_t i = std::min(last == 0 ? 0 : last - 1, static_cast<std::size_t>(place));
    const JointVector& next = way.arm[std::min(last, i + 1)];
    part.arm[k] = way.arm[i] + (place - static_cast<double>(i)) * (next - way.arm[i]);
  }
  part.reach *= share;
  return part;
}

std::optional<ArmWay> way_with_part(const CollisionState& state, const JointVector& start, const PartWay& way,
                                    RandomKey key) {
  auto found = WaySearch(state, start, way, key, Choice::handle).find(true);
  if (found || !elbow_may_turn(state.arm(), way)) return found;
  return WaySearch(state, start, way, key, Choice::elbow).find(true);
}

bool can_go_with_part(const CollisionState& state, const JointVector& start, const PartWay& way, RandomKey key) {
  WaySearch search(state, start, way, key, Choice::handle);
  return search.goes_straight_through() || search.find(true) ||
         (elbow_may_turn(state.arm(), way) && WaySearch(state, start, way, key, Choice::elbow).find(true));
}

std::optional<ArmWay> furthest_with_part(const CollisionState& state, const JointVector& start, const PartWay& way,
                                         RandomKey key) {
  auto found = WaySearch(state, start, way, key, Choice::handle).find(false);
  if ((found && found->reach == 1) || !elbow_may_turn(state.arm(), way)) return found;
  auto other = WaySearch(state, start, way, key, Choice::elbow).find(false);
  return other && (!found || other->reach > found->reach) ? other : found;
}

}  // namespace stampede
