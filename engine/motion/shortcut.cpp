#include <algorithm>
#include <cmath>

#include "engine/motion/rrt.h"

namespace stampede {
namespace {

double length_of(const std::vector<JointVector>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += (path[i] - path[i - 1]).norm();
  return sum;
}

// Leaves out all waypoints between two that see each other, the farthest first.
void skip_corners(Checker& checker, std::vector<JointVector>& path, double step_rad) {
  for (std::size_t i = 0; i + 2 < path.size(); ++i)
    for (std::size_t next = path.size() - 1; next > i + 1; --next) {
      if (!checker.edge_free(path[i], path[next], step_rad)) continue;
      const auto begin = path.begin();
      path.erase(begin + static_cast<std::ptrdiff_t>(i) + 1, begin + static_cast<std::ptrdiff_t>(next));
      break;
    }
}

// Waypoints in between, on stretches that are longer than kMost.
void divide(std::vector<JointVector>& path) {
  constexpr double kMost = 0.4;  // rad
  constexpr int kParts = 4;
  std::vector<JointVector> finer{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const JointVector way = path[i] - path[i - 1];
    const int parts = std::clamp(static_cast<int>(std::ceil(way.norm() / kMost)), 1, kParts);
    for (int k = 1; k < parts; ++k) finer.push_back(path[i - 1] + (static_cast<double>(k) / parts) * way);
    finer.push_back(path[i]);
  }
  path = std::move(finer);
}

// Pulls each waypoint towards the straight line between those beside it, all the way, half or a quarter of it.
void pull(Checker& checker, std::vector<JointVector>& path, double step_rad) {
  constexpr double kWorth = 0.01;  // rad: less is not worth the checks
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const JointVector &a = path[i - 1], &b = path[i + 1];
    const double before = (path[i] - a).norm(), after = (b - path[i]).norm();
    const JointVector straight = a + before / std::max(before + after, 1e-9) * (b - a);
    for (const double share : {1.0, 0.5, 0.25}) {
      const JointVector there = path[i] + share * (straight - path[i]);
      if (before + after - (there - a).norm() - (b - there).norm() < kWorth) break;
      if (!checker.edge_free(a, there, step_rad) || !checker.edge_free(there, b, step_rad)) continue;
      path[i] = there;
      break;
    }
  }
}

}  // namespace

std::vector<JointVector> shorten(Checker& checker, std::vector<JointVector> path, const TreeOptions& options) {
  constexpr int kPulls = 3;
  constexpr double kGain = 0.01;  // of the length: less ends it
  if (path.size() < 3) return path;
  skip_corners(checker, path, options.step_rad);
  double length = length_of(path);
  for (int round = 0; round < options.rounds && path.size() > 2; ++round) {
    divide(path);
    for (int k = 0; k < kPulls; ++k) pull(checker, path, options.step_rad);
    skip_corners(checker, path, options.step_rad);
    const double now = length_of(path);
    if (now > (1 - kGain) * length) break;
    length = now;
  }
  return path;
}

}  // namespace stampede
