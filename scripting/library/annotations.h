// What an editor's Lua language server (LuaLS) reads to complete and check files: three files.
#pragma once

#include <string>

#include "scripting/library/library.h"

namespace stampede {

std::string word_annotations();                        // words.lua, embedded: the one that is written by hand
std::string field_annotations();                       // stampede.lua: what each kind of file may say
std::string name_annotations(const Library& library);  // names.lua: its predicates, skills, worlds, objects …

}  // namespace stampede
