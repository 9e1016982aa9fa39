// What an evaluation changes about the episodes in which a policy is tried: the seven axes of LIBERO-Plus (Fei et al.,
// 2025, arXiv:2510.13626). What is drawn depends on task, variation, seed and axis: one axis alone changes the same
// things as it does among others.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/randomise.h"
#include "engine/model/scene.h"

namespace stampede {

// What each does at strength 1, and what strengths are: EvaluationRequest::perturb.
enum class PerturbationAxis { layout, camera, start, sentence, light, texture, noise };
inline constexpr std::array kPerturbationAxes{
    PerturbationAxis::layout, PerturbationAxis::camera,  PerturbationAxis::start, PerturbationAxis::sentence,
    PerturbationAxis::light,  PerturbationAxis::texture, PerturbationAxis::noise};
std::string_view to_string(PerturbationAxis axis);

using Perturbation = std::map<PerturbationAxis, double>;  // strength of each axis

// Of `camera,light=2`; an axis by itself has strength 1. Throws Error, with the nearest axis as cure; `where`: what to
// complain of.
Perturbation perturbation_from(const std::string& text, const std::string& where);
std::string to_text(const Perturbation& perturbation);  // canonical: `camera=1,light=2`

// Cameras, the arm's start, light and looks. Those of the scene's draw number `draw`. What is said of the scene keeps
// its look.
void perturb(Scene& scene, const Perturbation& perturbation, RandomKey key, const std::vector<std::string>& said = {});

// Instructions in other words.
std::string perturbed(const std::string& sentence, const Perturbation& perturbation, RandomKey key);

int further_things(const Perturbation& perturbation);

struct SensorNoise {
  double rgb = 0, depth = 0, torque = 0;  // units of EnvironmentSettings
};
SensorNoise further_noise(const Perturbation& perturbation);

}  // namespace stampede
