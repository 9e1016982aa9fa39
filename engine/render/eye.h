// Cameras as OpenGL's matrices.
#pragma once

#include "engine/render/picture.h"
#include "engine/render/scene_drawing.h"

namespace stampede {

// A pinhole camera; its lens is left to Lens. The picture is drawn as if each pixel's centre lay (right, down) pixels
// further.
Eye eye_of(const View& view, double right = 0, double down = 0);

}  // namespace stampede
