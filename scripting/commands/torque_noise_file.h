// The file of `--noise torque=FILE.json`.
#pragma once

#include <filesystem>

#include "engine/record/torque_noise.h"

namespace stampede::program {

// As `python -m stampede.torque_noise` writes it. Throws Error with the file, the place in it and the cure.
TorqueNoise load_torque_noise(const std::filesystem::path& file);

}  // namespace stampede::program
