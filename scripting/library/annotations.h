// What an editor's Lua language server (LuaLS) reads to complete and check files: made, never written by hand.
#pragma once

#include <string>

#include "scripting/library/library.h"

namespace stampede {

std::string word_annotations();                        // stampede.lua: words.lua and the field tables
std::string name_annotations(const Library& library);  // names.lua: its predicates, skills, worlds, objects …

}  // namespace stampede
