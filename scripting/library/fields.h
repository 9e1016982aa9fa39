// The fields of every kind of file, written once: validation, help and editor annotations are derived from this table.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/value.h"

namespace stampede {

// `type` is alternatives joined by `|`: string number integer boolean function vector (three numbers) range (two)
// size (two whole numbers) numbers (a list) colour (a name or three to four numbers) literal formula effect call shape
// texture cover (a texture or a text) table any, the name of a record (`joint`), each with [] for a list, or {record}
// for a table by names.
struct Field {
  const char* name;
  const char* type;
  bool required = false;
  const char* otherwise = "";  // the default, as written in Lua; empty: none
  const char* unit = "";
  const char* description = "";  // a sentence without a full stop
  const char* example = "";
  bool of_variation = false;  // may be a function of the variation
};

struct Record {
  const char* name;  // task skill predicate object world robot, and the tables inside them: joint, camera …
  const char* description;
  std::vector<Field> fields;
  const char* head = "";  // type of the items [1], [2] …; empty: none allowed
};

const std::vector<Record>& records();
const Record* record(std::string_view name);
std::vector<std::string> field_names(const Record& record);

// A complaint about a field: its path (`objects.block.count`), what is wrong, the cure.
using Complain = std::function<void(const std::string& path, const std::string& what, const std::string& hint)>;

// Compares a definition's table with its record: unknown and missing fields, wrong types. `also_known`: further names.
void check_record(const Record& record, const Value& table, const std::string& path, const Complain& complain,
                  const std::vector<std::string>& also_known = {});
bool has_type(const Value& node, std::string_view type);
// Is this a sound name? `what`: of what, where it is more than a name.
bool check_name(const std::string& name, const std::string& path, const Complain& complain,
                const std::string& what = "name");

}  // namespace stampede
