#include "db/recording/json_value.h"

#include <algorithm>

#include "engine/base/naming.h"
#include "engine/base/nearest.h"
#include "engine/base/read_json.h"

namespace stampede {
namespace {

using Json = nlohmann::json;

constexpr const char* kList = "[]";  // what tells a list from an object where both are empty: tables have no text

Value converted(const Json& json, const std::string& file, const std::string& path) {
  Value value;
  value.place = file + (path.empty() ? "" : ": " + path);
  if (json.is_boolean()) {
    value.kind = Value::Kind::boolean, value.boolean = json.get<bool>();
  } else if (json.is_number()) {
    value.kind = Value::Kind::number, value.number = json.get<double>(), value.integer = json.is_number_integer();
  } else if (json.is_string()) {
    value.kind = Value::Kind::text, value.text = json.get<std::string>();
  } else if (json.is_array()) {
    value.kind = Value::Kind::table, value.text = kList;
    for (std::size_t i = 0; i < json.size(); ++i)
      value.items.push_back(converted(json[i], file, path + "[" + std::to_string(i) + "]"));
  } else if (json.is_object()) {
    value.kind = Value::Kind::table;
    for (const auto& [name, field] : json.items())
      value.fields.emplace(name, converted(field, file, path.empty() ? name : path + "." + name));
  } else {
    value.kind = Value::Kind::other, value.text = "null";  // somebody wrote it: it is not what is left out
  }
  return value;
}

}  // namespace

Value value_from_json(const std::string& text, const std::string& shown_file) {
  JsonLimits limits;
  limits.values = 2'000'000;  // a value of the tree takes half a kilobyte
  return converted(json_from_text(text, shown_file, "", limits), shown_file, "");
}

bool is_list(const Value& value) { return value.is_table() && value.text == kList; }

const std::vector<Value>& list_in(const Value& object, const std::string& field) {
  const Value& value = object[field];
  if (value.present() && !is_list(value))
    expected(value, "a list: [ … ]", "leave '" + field + "' out where there are none");
  return value.items;
}

std::vector<std::string> texts_in(const Value& value) {
  if (!is_list(value) && !value.is_text()) expected(value, "a list of texts", "write [\"cup\", \"shelf\"]");
  return value.as_texts();
}

void expected(const Value& value, const std::string& what, const std::string& cure) {
  try {
    value.expected(what);
  } catch (const Error& error) {
    throw Error(value.place, error.message(), cure);
  }
}

void require_fields(const Value& object, const std::vector<std::string>& known) {
  if (!object.is_table() || is_list(object)) expected(object, "an object: { … }", "write its fields by name");
  for (const auto& [name, field] : object.fields)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(object.place, "there is no field '" + name + "'", did_you_mean(name, known));
}

const Value& required(const Value& object, const std::string& field, const std::string& cure) {
  const Value& value = object[field];
  if (!value.present()) throw Error(object.place, "the field '" + field + "' is missing", cure);
  return value;
}

const std::string& plain_name(const Value& value) {
  const std::string& name = value.as_text();
  if (const auto fault = name_fault(name)) throw Error(value.place, "'" + name + "' cannot be a name: it " + *fault);
  return name;
}

}  // namespace stampede
