#include "engine/sim/configuration_checker.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "engine/sim/collision_query.h"
#include "engine/sim/screen.h"

namespace stampede {
namespace {

void set_frame(float* turn, float* at, const Transform& frame) {
  for (int row = 0; row < 3; ++row) {
    at[row] = static_cast<float>(frame.translation()[row]);
    for (int column = 0; column < 3; ++column) turn[3 * row + column] = static_cast<float>(frame.linear()(row, column));
  }
}

// The row of balls inside a box or cylinder.
void set_core(ScreenShape& shape, const Vector3& half) {
  constexpr double kBallSpacing = 1.2;  // times the radius
  Eigen::Index longest = 0;
  half.maxCoeff(&longest);
  const double radius = half.minCoeff();
  shape.core_axis = static_cast<int>(longest);
  shape.core_radius = static_cast<float>(radius) + shape.rounding;
  shape.core_reach = static_cast<float>(half[longest] - radius);
  shape.core_count =
      radius + shape.rounding < 1e-3
          ? 0
          : 1 + static_cast<int>(std::ceil(2 * shape.core_reach / (kBallSpacing * (radius + shape.rounding))));
}

ScreenShape screen_shape(const Convex& convex, const Transform& frame_from_shape) {
  ScreenShape shape;
  Vector3 half = convex.box_half;
  shape.exact = true;
  switch (convex.kind) {
    case ShapeKind::box:
      break;
    case ShapeKind::sphere:
    case ShapeKind::capsule:
      half = {0, 0, convex.half_length};
      shape.rounding = static_cast<float>(convex.rounding);
      break;
    case ShapeKind::cylinder:
      shape.radius = static_cast<float>(convex.radius);
      break;
    case ShapeKind::cone:
      shape.radius = static_cast<float>(convex.radius);
      [[fallthrough]];
    case ShapeKind::hull:
    case ShapeKind::mesh:
      shape.exact = false;
      break;
  }
  for (int i = 0; i < 3; ++i) shape.half[i] = static_cast<float>(half[i]);
  const double across = shape.radius > 0 ? convex.radius : std::hypot(half.x(), half.y());
  shape.ball = static_cast<float>(std::hypot(across, half.z())) + shape.rounding;
  if (shape.exact) set_core(shape, half);
  set_frame(shape.turn, shape.at, frame_from_shape * translation(convex.box_centre));
  shape.turned = !frame_from_shape.linear().isIdentity(1e-12);
  return shape;
}

}  // namespace

struct ConfigurationChecker::Impl {
  explicit Impl(const CollisionState& state);
  void add_joints();
  void add_lumps();
  void add_meetings();
  void add_obstacles();
  void add_box(const Vector3& centre, const Vector3& half);
  void add_lump(CollisionModel::Range pieces, bool held, int frame, const Transform& frame_from_part, bool hand);
  void fill(std::span<const JointVector> configurations, std::span<const double> padding_m);
  unsigned look(std::span<const JointVector> configurations, std::span<const double> padding_m, bool any);
  bool touches(std::size_t lane, const JointVector& q, double padding_m);

  struct Origin {
    std::size_t piece = 0;
    bool held = false;
  };
  const CollisionState& state;
  const CollisionModel& model;
  CollisionQuery query;
  const Screen screen = fastest_screen();
  ScreenTables tables;
  ScreenBatch batch;
  std::vector<ScreenJoint> joints;
  std::vector<ScreenLump> lumps;
  std::vector<ScreenShape> shapes, obstacles;
  std::vector<ScreenBoxes> boxes;
  std::vector<ScreenMeeting> meetings;
  std::vector<Origin> origins;                 // of the shapes
  std::vector<std::uint32_t> obstacle_pieces;  // of the obstacles
  std::vector<Transform> poses;                // of the robot's parts, arm at zero
  std::vector<Transform> frames;               // of the joints' frames then
  std::vector<int> lump_of_part;               // -1: no shapes
};

ConfigurationChecker::Impl::Impl(const CollisionState& state_in)
    : state(state_in), model(*state_in.model_), query(state_in) {
  add_joints();
  add_lumps();
  add_meetings();
  add_obstacles();
  tables.joints = joints.data();
  tables.lumps = lumps.data();
  tables.shapes = shapes.data();
  tables.obstacles = obstacles.data();
  tables.boxes = boxes.data();
  tables.meetings = meetings.data();
  tables.joint_count = static_cast<int>(joints.size());
  tables.lump_count = static_cast<int>(lumps.size());
  tables.obstacle_count = static_cast<int>(obstacles.size());
  tables.meeting_count = static_cast<int>(meetings.size());
}

// Each joint's frame has the joint along its z, as it is when all joints are at zero.
void ConfigurationChecker::Impl::add_joints() {
  const Robot& robot = model.scene->robot;
  query.pose(JointVector::Zero(static_cast<Eigen::Index>(robot.arm.size())));
  poses = query.poses();
  frames.push_back(robot.body.world_from_body);
  for (const int part : robot.arm) {
    const Joint& joint = robot.body.parts[static_cast<std::size_t>(part)].joint;
    Transform along = Transform::Identity();
    along.linear() = Quaternion::FromTwoVectors(Vector3::UnitZ(), joint.axis.normalized()).toRotationMatrix();
    frames.push_back(poses[static_cast<std::size_t>(part)] * along);
    ScreenJoint& added = joints.emplace_back();
    set_frame(added.turn, added.at, frames[frames.size() - 2].inverse() * frames.back());
    added.slides = joint.kind == JointKind::slider;
  }
}

void ConfigurationChecker::Impl::add_lump(CollisionModel::Range pieces, bool held, int frame,
                                          const Transform& frame_from_part, bool hand) {
  const std::vector<CollisionModel::Piece>& all = held ? model.bodies : model.robot;
  ScreenLump& lump = lumps.emplace_back();
  lump.frame = frame;
  lump.hand = hand;
  lump.begin = static_cast<int>(shapes.size());
  Vector3 lower = Vector3::Constant(1e9), upper = -lower;
  for (std::size_t i = pieces.begin; i < pieces.end; ++i) {
    const Transform frame_from_shape = frame_from_part * all[i].part_from_shape;
    shapes.push_back(screen_shape(all[i].convex, frame_from_shape));
    origins.push_back({i, held});
    const Vector3 centre = frame_from_shape * all[i].convex.box_centre;
    const Vector3 reach = frame_from_shape.linear().cwiseAbs() * all[i].convex.box_half;
    lower = lower.cwiseMin(centre - reach);
    upper = upper.cwiseMax(centre + reach);
  }
  lump.end = static_cast<int>(shapes.size());
  const Vector3 middle = (lower + upper) / 2;
  for (int i = 0; i < 3; ++i) lump.middle[i] = static_cast<float>(middle[i]);
  lump.ball = static_cast<float>((upper - lower).norm() / 2);
}

// What hangs on the last joint first.
void ConfigurationChecker::Impl::add_lumps() {
  const Robot& robot = model.scene->robot;
  const auto parts = model.robot_parts.size();
  lump_of_part.assign(parts, -1);
  if (state.held_) {
    const Transform tip = poses[static_cast<std::size_t>(robot.tip_part)] * robot.tip_part_from_tip;
    add_lump(model.body_pieces[static_cast<std::size_t>(*state.held_)], true, static_cast<int>(robot.arm.size()),
             frames.back().inverse() * tip * state.tip_from_held_, true);
  }
  for (std::size_t p = parts; p-- > 0;) {
    if (model.robot_parts[p].begin == model.robot_parts[p].end) continue;
    lump_of_part[p] = static_cast<int>(lumps.size());
    const auto frame = static_cast<std::size_t>(model.joints[p]);
    add_lump(model.robot_parts[p], false, model.joints[p], frames[frame].inverse() * poses[p],
             CollisionQuery::arm_alone(state) ? model.hand[p] : model.grips[p] && !state.held_);
  }
}

void ConfigurationChecker::Impl::add_meetings() {
  const auto add = [&](int one, int other) {
    if (one >= 0 && other >= 0 &&
        lumps[static_cast<std::size_t>(other)].begin < lumps[static_cast<std::size_t>(other)].end)
      meetings.push_back({one, other});
  };
  for (const auto& [one, two] : model.scene->robot.checked_pairs)
    add(lump_of_part[static_cast<std::size_t>(one)], lump_of_part[static_cast<std::size_t>(two)]);
  if (state.held_)
    for (const int part : model.held_partners) add(lump_of_part[static_cast<std::size_t>(part)], 0);
}

void ConfigurationChecker::Impl::add_box(const Vector3& centre, const Vector3& half) {
  const std::size_t lane = obstacles.size() % kScreenLanes;
  if (lane == 0) {
    ScreenBoxes& empty = boxes.emplace_back();
    std::fill_n(&empty.lower[0][0], 3 * kScreenLanes, 1e30F);
    std::fill_n(&empty.upper[0][0], 3 * kScreenLanes, -1e30F);
  }
  for (int i = 0; i < 3; ++i) {
    boxes.back().lower[i][lane] = static_cast<float>(centre[i] - half[i]);
    boxes.back().upper[i][lane] = static_cast<float>(centre[i] + half[i]);
  }
}

// What the arm can reach, and a little more.
void ConfigurationChecker::Impl::add_obstacles() {
  constexpr double kBeyond = 0.3;     // m: paddings are smaller
  constexpr double kRounding = 1e-5;  // of all lengths
  const Robot& robot = model.scene->robot;
  double reach = 0, largest = 1;
  Vector3 last = frames.front().translation();
  double along = 0;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Vector3 next = frames[j + 1].translation();
    along += (next - last).norm();
    if (joints[j].slides) along += std::max(std::abs(robot.limits[j].lower), std::abs(robot.limits[j].upper));
    last = next;
    for (const ScreenLump& lump : lumps) {
      if (lump.frame != static_cast<int>(j) + 1) continue;
      reach = std::max(reach, along + std::hypot(lump.middle[0], lump.middle[1], lump.middle[2]) + lump.ball);
    }
  }
  const Transform base_from_world = frames.front().inverse();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const CollisionModel::Piece& piece = model.bodies[i];
    if (state.held_ == piece.part.body) continue;
    const Transform base_from_shape = base_from_world * state.pieces_[i].world_from_shape;
    ScreenShape shape = screen_shape(piece.convex, base_from_shape);
    const Vector3 local = base_from_shape.inverse() * Vector3::Zero() - piece.convex.box_centre;
    if ((local.cwiseAbs() - piece.convex.box_half).cwiseMax(0.0).norm() > reach + kBeyond) continue;
    shape.excused = CollisionQuery::arm_alone(state) ||
                    std::find(state.allowed_.begin(), state.allowed_.end(), piece.part) != state.allowed_.end();
    largest = std::max(largest, base_from_shape.translation().norm() + piece.convex.box_half.norm());
    add_box(base_from_shape * piece.convex.box_centre, base_from_shape.linear().cwiseAbs() * piece.convex.box_half);
    obstacles.push_back(shape);
    obstacle_pieces.push_back(static_cast<std::uint32_t>(i));
  }
  tables.slack = static_cast<float>(kRounding * (reach + largest));
}

void ConfigurationChecker::Impl::fill(std::span<const JointVector> configurations, std::span<const double> padding_m) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (std::size_t lane = 0; lane < kScreenLanes; ++lane) {
    const std::size_t i = std::min(lane, configurations.size() - 1);
    batch.padding[lane] = static_cast<float>(padding_m[i]);
    for (std::size_t j = 0; j < joints.size(); ++j) {
      double value = configurations[i][static_cast<Eigen::Index>(j)];
      if (!joints[j].slides && std::abs(value) > std::numbers::pi) value -= kTurn * std::round(value / kTurn);
      batch.positions[j][lane] = static_cast<float>(value);
    }
  }
}

// The lanes, among the lowest `count`, that touch; none above the first counts.
unsigned ConfigurationChecker::Impl::look(std::span<const JointVector> configurations,
                                          std::span<const double> padding_m, bool any) {
  fill(configurations, padding_m);
  const unsigned asked = (1U << configurations.size()) - 1;
  unsigned touching = screen(tables, batch, any) & asked;
  if (any && touching != 0) return touching;
  unsigned doubtful = batch.overflowing;
  for (int i = 0; i < batch.doubt_count; ++i) doubtful |= batch.doubts[i].lanes;
  doubtful &= asked;
  for (std::size_t lane = 0; lane < configurations.size(); ++lane) {
    const unsigned bit = 1U << lane;
    if (!any && (touching & (bit - 1)) != 0) break;
    if ((doubtful & bit & ~touching) == 0) continue;
    if (touches(lane, configurations[lane], padding_m[lane])) touching |= bit;
    if (any && touching != 0) break;
  }
  return touching;
}

bool ConfigurationChecker::Impl::touches(std::size_t lane, const JointVector& q, double padding_m) {
  const unsigned bit = 1U << lane;
  query.pose(q);
  if ((batch.overflowing & bit) != 0) return query.touches(q, padding_m);
  for (int i = 0; i < batch.doubt_count; ++i) {
    const ScreenDoubt& doubt = batch.doubts[i];
    if ((doubt.lanes & bit) == 0) continue;
    const Origin& mine = origins[static_cast<std::size_t>(doubt.shape)];
    const auto other = static_cast<std::size_t>(doubt.other);
    if (doubt.of_body ? query.meets_body(mine.piece, mine.held, obstacle_pieces[other], padding_m)
                      : query.meets_itself(mine.piece, mine.held, origins[other].piece, origins[other].held))
      return true;
  }
  return false;
}

ConfigurationChecker::ConfigurationChecker(const CollisionState& state) : impl_(std::make_unique<Impl>(state)) {}
ConfigurationChecker::~ConfigurationChecker() = default;
ConfigurationChecker::ConfigurationChecker(ConfigurationChecker&&) noexcept = default;

std::size_t ConfigurationChecker::first_touching(std::span<const JointVector> configurations,
                                                 std::span<const double> padding_m) {
  for (std::size_t begin = 0; begin < configurations.size(); begin += kScreenLanes) {
    const std::size_t count = std::min<std::size_t>(kScreenLanes, configurations.size() - begin);
    const unsigned touching = impl_->look(configurations.subspan(begin, count), padding_m.subspan(begin, count), false);
    if (touching != 0) return begin + static_cast<std::size_t>(std::countr_zero(touching));
  }
  return configurations.size();
}

bool ConfigurationChecker::all_free(std::span<const JointVector> configurations, std::span<const double> padding_m) {
  for (std::size_t begin = 0; begin < configurations.size(); begin += kScreenLanes) {
    const std::size_t count = std::min<std::size_t>(kScreenLanes, configurations.size() - begin);
    if (impl_->look(configurations.subspan(begin, count), padding_m.subspan(begin, count), true) != 0) return false;
  }
  return true;
}

}  // namespace stampede
