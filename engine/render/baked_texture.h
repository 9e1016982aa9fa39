// Textures as pictures that repeat without a seam.
#pragma once

#include <string>

#include "engine/model/scene.h"

namespace stampede {

// A texture of kind image as it is; of the others one repeat, drawn into a picture. A function of the texture alone.
// Throws Error, naming the texture, for missing, broken and huge (over 4096 pixels a side) pictures.
Image baked(const Texture& texture, const std::string& name);

}  // namespace stampede
