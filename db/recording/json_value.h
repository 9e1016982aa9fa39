// A JSON file as the same tree of values that Lua definitions are read into.
#pragma once

#include <string>
#include <vector>

#include "engine/geometry/value.h"

namespace stampede {

// Every value knows its place: `lab/recording.json: streams[2].clock`. Throws Error, with the line, where it is no
// JSON.
Value value_from_json(const std::string& text, const std::string& shown_file);

// All throw Error. `expected`: as Value's, with a cure. `require_fields`: for a value that is no object, and for fields
// that are not known, with the nearest name.
[[noreturn]] void expected(const Value& value, const std::string& what, const std::string& cure);
void require_fields(const Value& object, const std::vector<std::string>& known);
const Value& required(const Value& object, const std::string& field, const std::string& cure);  // throws Error

bool is_list(const Value& value);
// The items of a list; none where the field is left out. Throws Error for anything else.
const std::vector<Value>& list_in(const Value& object, const std::string& field);
std::vector<std::string> texts_in(const Value& value);  // a list, or one text; throws Error

// `a-z0-9_`, beginning with a letter: of tasks, cameras, channels. Throws Error.
const std::string& plain_name(const Value& value);

}  // namespace stampede
