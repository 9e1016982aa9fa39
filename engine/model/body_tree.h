// How the parts of a body hang on one another.
#pragma once

#include "engine/model/scene.h"

namespace stampede {

// Is `part` the ancestor itself, or does it move with it? A part's parent comes before it.
inline bool hangs_on(const Body& body, int part, int ancestor) {
  while (part > ancestor) part = body.parts[static_cast<std::size_t>(part)].parent;
  return part == ancestor;
}

}  // namespace stampede
