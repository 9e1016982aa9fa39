#include "engine/rollout/call_follow.h"

#include "engine/base/error.h"

namespace stampede {
namespace {

namespace piece = robot_call::piece;
using robot_call::Piece;

Transform about(const Vector3& point, const Vector3& axis, double angle) {
  return translation(point) * Eigen::AngleAxisd(angle, axis) * translation(Vector3(-point));
}

// The motion with the tool's orientation left as it was.
Transform carried(const Transform& moved, const Transform& from) {
  Transform tip = from;
  tip.translation() = moved * from.translation();
  return tip;
}

// The tip at a share of a piece that begins at `from`.
struct Way {
  const WorldView& view;
  Transform from;

  std::function<Transform(double)> operator()(const piece::Line& line) const {
    return [from = from, to = line.target](double share) { return between(from, to, share); };
  }
  std::function<Transform(double)> operator()(const piece::Offset& offset) const {
    return [from = from, by = offset.by](double share) { return Transform(translation(Vector3(share * by)) * from); };
  }
  std::function<Transform(double)> operator()(const piece::Arc& arc) const {
    return [from = from, arc, axis = Vector3(arc.axis.normalized())](double share) {
      const Transform moved = about(arc.point, axis, share * arc.angle);
      return arc.turn ? moved * from : carried(moved, from);
    };
  }
  std::function<Transform(double)> operator()(const piece::PartArc& arc) const {
    const double here = view.joint(arc.part);
    const Transform part_from_world = view.part_at(arc.part, here).inverse();
    return [&view = view, from = from, arc, here, part_from_world](double share) {
      const Transform moved = view.part_at(arc.part, here + share * arc.angle) * part_from_world;
      return arc.turn ? moved * from : carried(moved, from);
    };
  }
  std::function<Transform(double)> operator()(const piece::Tilt& tilt) const {
    const Vector3 point = tilt.in_world ? tilt.point : from * tilt.point;
    const Vector3 axis = from.linear() * tilt.axis.normalized();
    return [from = from, point, axis, angle = tilt.angle](double share) {
      return Transform(about(point, axis, share * angle) * from);
    };
  }
};

}  // namespace

std::vector<ToolPiece> tool_pieces(const std::vector<Piece>& asked, const WorldView& view, const Transform& start) {
  std::vector<ToolPiece> pieces;
  Transform from = start;
  for (const Piece& piece : asked) {
    ToolPiece made;
    made.world_from_tip = std::visit(Way{view, from}, piece.way);
    made.speed = piece.speed;
    made.turn_speed = piece.turn_speed;
    made.stop = piece.stop;
    made.name = piece.name;
    made.opening = piece.opening;
    from = made.world_from_tip(1);
    pieces.push_back(std::move(made));
  }
  return pieces;
}

}  // namespace stampede
