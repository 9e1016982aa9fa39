// Validation against the field tables.
#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/naming.h"
#include "scripting/library/fields.h"

namespace stampede {
namespace {

bool is_draw(const Value& node) {
  const std::string tag = node.tag();
  return tag == "one_of" || tag == "between" || tag == "sample_of";
}

bool is_formula(const Value& node) {
  static const std::vector<std::string> kTags = {"literal", "all_of", "any_of",    "in_order", "not",
                                                 "forall",  "exists", "any_order", "at_least", "equal",
                                                 "pddl",    "when",   "call",      "stays"};
  return std::find(kTags.begin(), kTags.end(), node.tag()) != kTags.end();  // which of them: the formula reader says
}

bool all_numbers(const Value& node) {
  return std::all_of(node.items.begin(), node.items.end(), [](const Value& item) { return has_type(item, "number"); });
}

bool numbers(const Value& node, std::size_t least, std::size_t most) {
  return node.is_table() && node.items.size() >= least && node.items.size() <= most && node.tag().empty() &&
         all_numbers(node);
}

// A draw has a type when all that it may give has it.
bool draw_has_type(const Value& node, std::string_view type) {
  if (node.tag() == "between") return type == "number";
  const Value& values = node["values"];
  return std::all_of(values.items.begin(), values.items.end(),
                     [&](const Value& value) { return has_type(value, type); });
}

struct PlainType {
  std::string_view name;
  const char* words;  // for people
  bool (*holds)(const Value&);
};

// What is none of these is a record, whose own fields are checked after this.
constexpr std::array kPlainTypes{
    PlainType{"any", "any", [](const Value& node) { return node.present(); }},
    PlainType{"string", "text", [](const Value& node) { return node.is_text(); }},
    PlainType{"number", "number", [](const Value& node) { return node.is_number(); }},
    PlainType{"integer", "whole number", [](const Value& node) { return node.is_number() && node.integer; }},
    PlainType{"boolean", "true or false", [](const Value& node) { return node.kind == Value::Kind::boolean; }},
    PlainType{"function", "function", [](const Value& node) { return node.is_function(); }},
    PlainType{"on_table", "on_table { x, y }",
              [](const Value& node) { return node.tag() == "on_table" && all_numbers(node); }},
    PlainType{"vector", "{ x, y, z }", [](const Value& node) { return numbers(node, 3, 3); }},
    PlainType{"range", "{ lower, upper }", [](const Value& node) { return numbers(node, 2, 2); }},
    PlainType{"size", "{ width, height }", [](const Value& node) { return numbers(node, 2, 2); }},
    PlainType{"numbers", "list of numbers", [](const Value& node) { return numbers(node, 0, 1000); }},
    PlainType{"colour", "colour (a name or { r, g, b })",
              [](const Value& node) { return node.is_text() || numbers(node, 3, 4); }},
    PlainType{"formula", "formula", is_formula},
    PlainType{"effect", "effect", is_formula},
    PlainType{"call", "call", is_formula},
    PlainType{"literal", "literal", is_formula},
    PlainType{"shape", "shape", [](const Value& node) { return node.tag() == "shape"; }},
    PlainType{"texture", "texture such as checker { \"white\", \"black\" }",
              [](const Value& node) { return node.tag() == "texture"; }},
    PlainType{"cover", "texture (a kind, or texture { … })",
              [](const Value& node) { return node.is_text() || node.tag() == "texture"; }},
};

const PlainType* plain_type(std::string_view name) {
  const auto* found = std::ranges::find(kPlainTypes, name, &PlainType::name);
  return found == kPlainTypes.end() ? nullptr : found;
}

bool has_plain_type(const Value& node, std::string_view type) {
  const PlainType* plain = plain_type(type);
  return plain == nullptr ? node.is_table() : plain->holds(node);
}

bool has_one_type(const Value& node, std::string_view type) {
  if (type.size() > 2 && type.ends_with("[]")) {
    type.remove_suffix(2);
    return node.is_table() && node.tag().empty() && node.fields.empty() &&
           std::all_of(node.items.begin(), node.items.end(),
                       [&](const Value& item) { return has_one_type(item, type); });
  }
  if (type.front() == '{') return node.is_table() && node.items.empty();
  return is_draw(node) ? draw_has_type(node, type) : has_plain_type(node, type);
}

std::vector<std::string_view> alternatives(std::string_view type) {
  std::vector<std::string_view> result;
  while (!type.empty()) {
    const std::size_t end = std::min(type.find('|'), type.size());
    result.push_back(type.substr(0, end));
    type.remove_prefix(std::min(end + 1, type.size()));
  }
  return result;
}

// What a type asks for, for people: `a list of texts`.
std::string in_words(std::string_view type) {
  std::string text;
  for (std::string_view one : alternatives(type)) {
    if (!text.empty()) text += " or ";
    if (one.front() == '{') {
      text += "a table by names";
      continue;
    }
    const bool list = one.ends_with("[]");
    while (one.ends_with("[]")) one.remove_suffix(2);
    const PlainType* plain = plain_type(one);
    const std::string word = plain == nullptr ? std::string(one) : plain->words;
    text += list ? "a list of " + word : word;
  }
  return text;
}

std::string with_article(std::string_view word) {
  const bool vowel = std::string_view("aeiou").find(word.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + std::string(word);
}

// 90 where deg(90) was meant: nothing is turned by more than two turns.
void check_angle(const Field& field, const Value& value, const std::string& path, const Complain& complain) {
  constexpr double kMost = 12.6;  // rad
  if (field.unit != std::string_view("rad")) return;
  const auto check = [&](const Value& one) {
    if (!one.is_number() || std::abs(one.number) <= kMost) return;
    const std::string number = plain_text(one);
    complain(path, number + " rad are more than two turns", "angles are in rad: deg(" + number + ")");
  };
  check(value);
  for (const Value& item : value.items) check(item);
}

// Records inside a field's value.
void check_inner(const Field& field, const Value& node, const std::string& path, const Complain& complain) {
  for (std::string_view type : alternatives(field.type)) {
    const bool map = type.front() == '{', list = type.ends_with("[]");
    std::string_view name = type;
    if (map) name = type.substr(1, type.size() - 2);
    if (list) name.remove_suffix(2);
    const Record* inner = record(name);
    if (inner == nullptr || name == "entry" || !node.is_table()) continue;  // entries: checked with their class
    if (!has_one_type(node, type)) continue;                                // another alternative is meant
    if (map) {
      for (const auto& [key, entry] : node.fields) {
        const std::string inner_path = path + "." + key;
        check_name(key, inner_path, complain);
        if (entry.is_table()) {
          check_record(*inner, entry, inner_path, complain);
        } else {
          complain(inner_path, with_article(name) + " is a table, this is " + entry.type_name(), {});
        }
      }
    } else if (list) {
      for (std::size_t i = 0; i < node.items.size(); ++i) {
        check_record(*inner, node.items[i], path + "." + std::to_string(i + 1), complain);
      }
    } else if (is_draw(node)) {
      for (const Value& choice : node["values"].items)
        if (choice.is_table() && !is_draw(choice)) check_record(*inner, choice, path, complain);
    } else {
      check_record(*inner, node, path, complain);
    }
  }
}

}  // namespace

bool has_type(const Value& node, std::string_view type) {
  for (const std::string_view one : alternatives(type)) {
    if (has_one_type(node, one)) return true;
  }
  return false;
}

bool check_name(const std::string& name, const std::string& path, const Complain& complain, const std::string& what) {
  const auto fault = name_fault(name);
  if (fault) complain(path, "the " + what + " '" + name + "' " + *fault, "such as '" + proposed_name(name) + "'");
  return !fault;
}

void check_record(const Record& record, const Value& table, const std::string& path, const Complain& complain,
                  const std::vector<std::string>& also_known) {
  const std::string prefix = path.empty() ? "" : path + ".";
  const bool outermost = path.empty();
  std::vector<std::string> known = field_names(record);
  known.insert(known.end(), also_known.begin(), also_known.end());
  for (const auto& [key, value] : table.fields) {
    if (outermost && (key == "kind" || key == "line" || key == "name")) continue;
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    complain(prefix + key, with_article(record.name) + " has no field '" + key + "'", did_you_mean(key, known));
  }
  if (table.items.size() > 0 && std::string_view(record.head).empty()) {
    complain(path, with_article(record.name) + " has fields with names only, this one lists values", {});
  }
  for (const Field& field : record.fields) {
    const Value& value = table[field.name];
    if (!value.present()) {
      if (!field.required) continue;
      complain(
          outermost ? field.name : path,
          with_article(record.name) + " needs the field '" + field.name + "': " + field.description,
          std::string_view(field.example).empty() ? "" : std::string("such as ") + field.name + " = " + field.example);
      continue;
    }
    if (field.of_variation && value.is_function()) continue;  // its value is checked for each variation
    if (!has_type(value, field.type)) {
      complain(
          prefix + field.name, "expects " + in_words(field.type) + ", this is " + value.type_name(),
          std::string_view(field.example).empty() ? "" : std::string("such as ") + field.name + " = " + field.example);
      continue;
    }
    check_angle(field, value, prefix + field.name, complain);
    check_inner(field, value, prefix + field.name, complain);
  }
}

}  // namespace stampede
