#include "engine/model/inertials.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>

namespace stampede {
namespace {

constexpr double kMostExcess = 1;  // of a greatest moment beyond the sum of the others, as a share of that

std::string kilograms(double mass) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g kg", mass);
  return text;
}

// What a solid has: moments above 0, none of them far above the sum of the other two. What was measured or rounded may
// be above it, and is simulated as it is written.
bool is_solid(const Matrix3& inertia) {
  if (!inertia.allFinite()) return false;
  const Vector3 moments = Eigen::SelfAdjointEigenSolver<Matrix3>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
  const double least = 1e-12 * moments[2];
  return moments[0] > least && moments[2] <= (1 + kMostExcess) * (moments[0] + moments[1]);
}

bool has_solid(const Part& part) {
  return std::any_of(part.shapes.begin(), part.shapes.end(), [](const Shape& shape) { return shape.collides; });
}

// Spread over its shapes; where it has none, over a ball about its centre of mass.
void spread_mass(Part& part, double mass) {
  if (enclosed_volume(part) > 0) return set_uniform_mass(part, mass);
  part.mass = mass;
  part.inertia = 0.4 * mass * kMasslessRadius * kMasslessRadius * Matrix3::Identity();
}

}  // namespace

std::vector<Error> complete_inertials(const std::string& where, bool free, std::vector<Part>& parts) {
  std::vector<Error> remarks;
  std::vector<bool> moves(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Part& part = parts[i];
    const bool fixed = part.parent < 0 || part.joint.kind == JointKind::fixed;
    moves[i] = part.parent < 0 ? free : !fixed || moves[static_cast<std::size_t>(part.parent)];
    const bool carried = fixed && part.parent >= 0 && !has_solid(part);  // weighs what it weighs, if anything
    const auto remark = [&](const std::string& what) {
      remarks.emplace_back(where, "link '" + part.name + "': " + what,
                           "give it an <inertial> with mass and inertia of its own");
    };
    if (part.mass > 0) {
      if (is_solid(part.inertia)) continue;
      spread_mass(part, part.mass);
      if (moves[i])
        remark("no solid has its inertia: it is worked out from its " + kilograms(part.mass) +
               (enclosed_volume(part) > 0 ? " and its shapes" : ", as a ball's"));
      else
        remark("no solid has its inertia, which is ignored: it cannot move");
      continue;
    }
    if (!part.inertia.isZero() && (!moves[i] || carried)) remark("it has no mass, so its inertia is ignored");
    part.mass = 0;
    part.inertia.setZero();
    if (!moves[i] || carried) continue;
    const double mass = std::max(kLeastMass, kUsualDensity * enclosed_volume(part));
    spread_mass(part, mass);
    remark("it moves and has no mass: " + kilograms(mass) + " are taken, " +
           (enclosed_volume(part) > 0 ? "from its shapes at 500 kg/m3" : "as it has no solid shape"));
  }
  return remarks;
}

}  // namespace stampede
