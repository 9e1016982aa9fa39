// What no renderer draws.
#pragma once

#include "engine/render/renderer.h"

namespace stampede {

// Throw Error.
void check(const Camera& camera);
void check(const DrawOptions& options);

}  // namespace stampede
