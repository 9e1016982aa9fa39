// Light, randomisation and observation as a world (or task) file says them.
#pragma once

#include "engine/model/randomise.h"
#include "engine/record/observation.h"
#include "scripting/runtime/body_builder.h"

struct lua_State;

namespace stampede {

// All throw Error.

// worlds/colours.lua, by the language's own words: colours.names and colours.rgb(name). Runs Lua: call it inside a
// protected call.
Colours read_colours(lua_State* state, RandomKey key);

Light light_from(const Value& fields, const Colours& colours);

// Textures that it names go to context.drawn.
Randomisation randomisation_from(const Value& fields, const ShapeContext& context);

// What is not said is left open.
ObservationChoice observation_from(const Value& fields);

// { width, height } of pictures: whole numbers, 1 … 4096.
std::array<int, 2> picture_size_from(const Value& value);

}  // namespace stampede
