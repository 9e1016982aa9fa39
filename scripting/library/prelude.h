// prelude.lua, embedded by the build.
#pragma once

namespace stampede {

extern const char* const kPreludeSource;

}  // namespace stampede
