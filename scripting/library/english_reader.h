// worlds/words.lua, and the nouns and verbs that types, objects and skills have of their own, as English.
#pragma once

#include <functional>
#include <string>

#include "engine/language/english.h"
#include "scripting/library/fields.h"
#include "scripting/library/value.h"

namespace stampede {

// Adds what the file says; a later file's entries add to those of the files before it, or take their place.
void read_english(const Value& words, English& english, const Complain& complain);

// Blank-separated words or a list of them that name what `name` names: `cup` is also a `mug`.
void add_nouns(const std::string& name, const Value& nouns, English& english);

// That tell of the skill: any form of a verb, alone or with what belongs to it: `pick up`.
void add_verbs(const std::string& skill, const std::vector<std::string>& verbs, English& english);

}  // namespace stampede
