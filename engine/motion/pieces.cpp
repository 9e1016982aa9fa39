#include "engine/motion/pieces.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/motion/checker.h"
#include "engine/motion/route.h"

namespace stampede {
namespace {

constexpr int kProbes = 32;          // chords that measure a piece: it may bend
constexpr double kWayOfTurn = 0.25;  // m for each rad
constexpr double kTurnStep = 0.02;   // rad between samples
constexpr double kPathError = 3e-4;  // rad, of decimated paths

// The pieces with their corners rounded. Two neighbours meet half way round their corner.
class Rounded {
 public:
  Rounded(const std::vector<ToolPiece>& pieces, double blend) : pieces_(pieces) {
    for (const ToolPiece& piece : pieces) {
      lengths_.push_back(length_of(piece));
      ways_.push_back(lengths_.back().way + kWayOfTurn * lengths_.back().turn);
    }
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i)
      corners_.push_back(pieces[i].stop ? 0 : std::min({blend, ways_[i] / 2, ways_[i + 1] / 2}));
    corners_.push_back(0);
    spacing_ = blend > 0 ? std::clamp(blend / 4, 0.001, 0.005) : 0.005;
  }

  Transform at(std::size_t i, double share) const {
    const double along = share * ways_[i], before = i > 0 ? corners_[i - 1] : 0, after = corners_[i];
    if (before > 0 && along < before) return corner(i - 1, 0.5 + 0.5 * along / before);
    if (after > 0 && along > ways_[i] - after) return corner(i, 0.5 * (along - ways_[i] + after) / after);
    return pieces_[i].world_from_tip(share);
  }

  int samples(std::size_t i) const {
    return std::max(1, static_cast<int>(std::ceil(std::max(lengths_[i].way / spacing_, lengths_[i].turn / kTurnStep))));
  }

 private:
  // Of corner i, between piece i and the next, from its begin at 0 to its end at 1 (de Casteljau, two lines).
  Transform corner(std::size_t i, double t) const {
    const Transform from = pieces_[i].world_from_tip(1 - corners_[i] / ways_[i]);
    const Transform middle = pieces_[i].world_from_tip(1);
    const Transform to = pieces_[i + 1].world_from_tip(corners_[i] / ways_[i + 1]);
    return between(between(from, middle, t), between(middle, to, t), t);
  }

  const std::vector<ToolPiece>& pieces_;
  std::vector<PieceLength> lengths_;
  std::vector<double> ways_, corners_;
  double spacing_;
};

std::string name_of(const std::vector<ToolPiece>& pieces, std::size_t i) {
  return "piece " + std::to_string(i + 1) + (pieces[i].name.empty() ? "" : " '" + pieces[i].name + "'");
}

double length(const std::vector<JointVector>& waypoints) {
  double sum = 0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) sum += (waypoints[i] - waypoints[i - 1]).norm();
  return sum;
}

// Pieces between two stops.
struct Stretch {
  std::size_t first = 0;
  std::vector<std::vector<JointVector>> waypoints;  // of each piece, from where it begins to where it ends
};

// The limit of the piece that a point of the path belongs to.
PathSpeedLimit limit_of(const Arm& arm, const std::vector<ToolPiece>& pieces, const Stretch& stretch) {
  std::vector<double> ends;
  double end = 0;
  for (const std::vector<JointVector>& piece : stretch.waypoints) ends.push_back(end += length(piece));
  return [&arm, &pieces, ends, first = stretch.first](const PathPoint& point) {
    const auto at = std::upper_bound(ends.begin(), ends.end() - 1, point.s);
    const ToolPiece& piece = pieces[first + static_cast<std::size_t>(at - ends.begin())];
    return tool_limit(arm, point, piece.speed, piece.turn_speed);
  };
}

// The steps at which the trajectory passes the end of each piece: from waypoint to waypoint, for it may pass a place
// twice.
std::vector<std::int64_t> passages(const Stretch& stretch, const Trajectory& trajectory, int physics_hz) {
  std::vector<std::int64_t> steps;
  std::int64_t step = 0;
  const auto distance = [&](const JointVector& q) {
    return (evaluate(trajectory, static_cast<double>(step), physics_hz).position - q).squaredNorm();
  };
  for (const std::vector<JointVector>& piece : stretch.waypoints) {
    for (const JointVector& q : piece) {
      double here = distance(q);
      while (step < trajectory.steps()) {
        ++step;
        const double next = distance(q);
        if (next > here) {
          --step;
          break;
        }
        here = next;
      }
    }
    steps.push_back(step);
  }
  if (!steps.empty()) steps.back() = trajectory.steps();
  return steps;
}

void append(Trajectory& all, const Trajectory& further) {
  const std::int64_t from = all.steps();
  for (const Trajectory::Knot& knot : further.knots) {
    if (!all.knots.empty() && knot.step == 0) continue;  // at rest where the last one came to rest
    all.knots.push_back(knot);
    all.knots.back().step += from;
  }
}

void check(const std::vector<ToolPiece>& pieces, const PiecesOptions& options) {
  if (pieces.empty()) throw Error("motion planning", "a way of the tool needs at least one piece");
  if (!(options.blend >= 0)) throw Error("motion planning", "blend must not be negative");
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (!(pieces[i].speed > 0) || !(pieces[i].turn_speed > 0))
      throw Error("motion planning", name_of(pieces, i) + ": the tool's speed limits must be positive");
}

}  // namespace

PieceLength length_of(const ToolPiece& piece) {
  PieceLength length;
  Transform last = piece.world_from_tip(0);
  for (int i = 1; i <= kProbes; ++i) {
    const Transform next = piece.world_from_tip(static_cast<double>(i) / kProbes);
    if (!next.matrix().allFinite()) throw Error("motion planning", "a tool target must be finite");
    length.way += (next.translation() - last.translation()).norm();
    length.turn += angle_between(Quaternion(last.linear()), Quaternion(next.linear()));
    last = next;
  }
  return length;
}

PlannedMotion plan_pieces(const MotionProblem& problem, const std::vector<ToolPiece>& pieces,
                          const PiecesOptions& options) {
  const auto& [state, start, limits, key] = problem;
  check(pieces, options);
  const Rounded rounded(pieces, options.blend);
  const int physics_hz = state.scene().physics_hz;
  PlannedMotion motion;
  const auto fail = [&](Reason reason, std::string detail) {
    PlannedMotion failed;
    failed.reason = reason;
    failed.detail = std::move(detail);
    return failed;
  };
  CollisionState space = space_of_line(state, options.keep_clear);
  if (options.keep_clear)
    if (const std::string contact = describe_contact(space, start); !contact.empty())
      return fail(Reason::start_in_collision, "at the start " + contact);
  Stretch stretch;
  JointVector last = start;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i].opening && *pieces[i].opening > space.opening()) {
      space.set_opening(*pieces[i].opening);
      space.release();
    }
    const ToolPath path =
        follow_tool(state.arm(), last, {[&](double share) { return rounded.at(i, share); }, rounded.samples(i)},
                    key.with(static_cast<std::int64_t>(i)));
    if (path.reason != Reason::none) {
      const std::string detail = path.detail.substr(0, path.detail.rfind(" of the line")) + " of it";
      return fail(path.reason, name_of(pieces, i) + ": " + detail);
    }
    std::vector<JointVector> waypoints{last};
    waypoints.insert(waypoints.end(), path.waypoints.begin(), path.waypoints.end());
    if (const auto touch = first_touch_of_line(space, waypoints, certified_step(limits)))
      return fail(Reason::no_path, name_of(pieces, i) + ": " + describe_contact(space, *touch));
    waypoints = decimate(waypoints, kPathError);
    last = waypoints.back();
    stretch.waypoints.push_back(std::move(waypoints));
    if (!pieces[i].stop && i + 1 < pieces.size()) continue;

    std::vector<JointVector> all;
    for (const std::vector<JointVector>& piece : stretch.waypoints) all.insert(all.end(), piece.begin(), piece.end());
    const PlannedMotion part =
        certify(space, all, limits, space.free(all.front()) ? 0.0 : -1.0, limit_of(state.arm(), pieces, stretch));
    if (part.reason != Reason::none)
      return fail(part.reason, "on to the end of " + name_of(pieces, i) + " " + part.detail);
    std::int64_t begin = motion.trajectory.steps();
    const std::int64_t from = begin;
    append(motion.trajectory, part.trajectory);
    const std::vector<std::int64_t> ends = passages(stretch, part.trajectory, physics_hz);
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const ToolPiece& piece = pieces[stretch.first + k];
      if (piece.opening) motion.hands.push_back({begin, *piece.opening});
      begin = from + ends[k];
      if (!piece.name.empty()) motion.vias.push_back({piece.name, piece.world_from_tip(1), begin, true});
    }
    stretch = {i + 1, {}};
  }
  return motion;
}

}  // namespace stampede
