// Perturbations of a scene of which something is said: what the sentences speak of keeps its look.
#pragma once

#include "engine/episode/perturbation.h"
#include "engine/model/telling.h"

namespace stampede {

void perturb(Scene& scene, const Perturbation& perturbation, RandomKey key, const Said& said);

}  // namespace stampede
