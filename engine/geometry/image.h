// Pictures from bytes.
#pragma once

#include <string>
#include <string_view>

#include "engine/geometry/drawn_mesh.h"

namespace stampede {

// A PNG or JPEG picture. `where` is what errors name. Throws Error.
Image image_from_bytes(std::string_view bytes, const std::string& where);

}  // namespace stampede
