#include "engine/motion/blended_path.h"

#include <algorithm>
#include <cmath>

#include "engine/motion/checker.h"

namespace stampede {

BlendedPath::BlendedPath(std::vector<JointVector> waypoints, const std::vector<double>& blends)
    : start_(waypoints.front()), goal_(waypoints.back()) {
  const std::size_t n = waypoints.size();
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const JointVector along = waypoints[i + 1] - waypoints[i];
    const double distance = along.norm();
    const JointVector u = along / distance;
    const double before = i == 0 ? 0.0 : blends[i];
    const double after = i + 2 == n ? 0.0 : blends[i + 1];
    add({distance - before - after, waypoints[i] + before * u, u, u, false});
    if (i + 2 == n) break;
    const JointVector v = (waypoints[i + 2] - waypoints[i + 1]).normalized();
    add({2 * after, waypoints[i + 1] - after * u, u, v, true});
  }
}

void BlendedPath::add(const Piece& piece) {
  if (piece.length <= 1e-9) return;
  pieces_.push_back(piece);
  starts_.push_back(starts_.back() + piece.length);
}

PathPoint BlendedPath::at(double s) const {
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, s);
  const std::size_t index = static_cast<std::size_t>(after - starts_.begin()) - 1;
  const Piece& piece = pieces_[index];
  const double along = std::clamp(s - starts_[index], 0.0, piece.length);
  if (!piece.blend) return {piece.origin + along * piece.from, piece.from, JointVector::Zero(piece.from.size()), s};
  const double x = along / piece.length;
  const JointVector turn = piece.to - piece.from;
  return {piece.origin + along * piece.from + piece.length * x * x * x * (1 - 0.5 * x) * turn,
          piece.from + x * x * (3 - 2 * x) * turn, (6 * x * (1 - x) / piece.length) * turn, s};
}

std::vector<double> BlendedPath::grid() const {
  constexpr double kSpacing = 0.02;  // rad
  constexpr int kBlendCells = 8, kLineCells = 2;
  std::vector<double> grid{0};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const int least = pieces_[i].blend ? kBlendCells : kLineCells;
    const int cells = std::max(least, static_cast<int>(std::ceil(pieces_[i].length / kSpacing)));
    for (int k = 1; k <= cells; ++k)
      grid.push_back(k == cells ? starts_[i + 1] : starts_[i] + pieces_[i].length * k / cells);
  }
  return grid;
}

std::vector<JointVector> distinct(const std::vector<JointVector>& waypoints) {
  std::vector<JointVector> kept;
  for (const JointVector& q : waypoints)
    if (kept.empty() || joint_gap(kept.back(), q) > 1e-6) kept.push_back(q);
  // The goal is exact, so that two motions in a row meet.
  if (kept.size() > 1) kept.back() = waypoints.back();
  return kept;
}

std::vector<double> default_blends(const std::vector<JointVector>& waypoints, double most_rad) {
  std::vector<double> blends(waypoints.size(), 0.0);
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const double before = (waypoints[i] - waypoints[i - 1]).norm();
    const double after = (waypoints[i + 1] - waypoints[i]).norm();
    blends[i] = std::min(most_rad, 0.5 * std::min(before, after));
  }
  return blends;
}

}  // namespace stampede
