// Masses and inertias as programs that write URDFs leave them, put right.
#pragma once

#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/model/scene.h"

namespace stampede {

inline constexpr double kUsualDensity = 500;     // kg/m3, of a link that moves and has no mass: hollow, as most things
inline constexpr double kLeastMass = 0.01;       // kg
inline constexpr double kMasslessRadius = 0.05;  // m, of the ball that a link without a solid shape weighs like

// Of each link that moves: a mass that is 0 follows from its shapes at the usual density, an inertia that no solid has
// from its mass and shapes. What cannot move needs neither, and keeps none that is unsound. `where` names the file;
// `free`: the first part moves too. Result: a remark for each link that was changed. Repeatable.
std::vector<Error> complete_inertials(const std::string& where, bool free, std::vector<Part>& parts);

double enclosed_volume(const Part& part);  // m3 of what collides, or else of what is seen; overlaps counted twice

}  // namespace stampede
