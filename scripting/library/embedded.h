// Lua files of this folder, embedded by the build.
#pragma once

namespace stampede {

extern const char* const kPreludeSource;  // prelude.lua: what the words of the language do
extern const char* const kWordsSource;    // words.lua: what editors are told of them

}  // namespace stampede
