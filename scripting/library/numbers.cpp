#include "scripting/library/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

#include "engine/base/naming.h"
#include "scripting/library/draft.h"

namespace stampede {
namespace {

struct Unit {
  const char* name;
  double most;  // beyond it another unit was meant, where nobody says otherwise
  const char* cure;
};
constexpr std::array kUnits{
    Unit{"", std::numeric_limits<double>::infinity(), ""},
    Unit{"m", 5, "lengths are in m: mm(60), cm(6) or 0.06"},
    Unit{"rad", 4 * std::numbers::pi, "angles are in rad: deg(60)"},
    Unit{"m or rad", 4 * std::numbers::pi, "a slider's position is in m, mm(60); a hinge's in rad, deg(60)"},
    Unit{"s", 1000, "times are in s"},
    Unit{"kg", 100, "masses are in kg"},
    Unit{"N", 1000, "forces are in N"},
    Unit{"N m", 1000, "torques are in N m"},
};

const Unit* unit_named(const std::string& name) {
  const auto* found = std::ranges::find_if(kUnits, [&](const Unit& one) { return name == one.name; });
  return found == kUnits.end() ? nullptr : found;
}

std::string in_words(const NumberInfo& number) {
  std::string text = number.unit.empty() ? "no unit" : number.unit;
  if (number.otherwise) text += fmt::format(", default {:g}", *number.otherwise);
  if (number.optional) text += ", optional";
  return text;
}

std::string nearest_or(const std::string& name, const std::vector<std::string>& known, std::string otherwise) {
  std::string nearest = did_you_mean(name, known);
  return nearest.empty() ? std::move(otherwise) : nearest;
}

bool same(const NumberInfo& a, const NumberInfo& b) {
  return a.unit == b.unit && a.otherwise == b.otherwise && a.optional == b.optional && a.least == b.least &&
         a.most == b.most;
}

}  // namespace

bool NumberDeclaration::is_reference() const {
  return node.items.empty() && std::ranges::all_of(node.fields, [](const auto& field) { return field.first == "of"; });
}

void NumberTable::take_read(const std::string& name, const std::string& place) {
  NumberInfo info;
  info.description = "not declared: it is read there";
  info.place = place;
  numbers_.emplace(name, std::move(info));
}

void NumberTable::refer(const NumberDeclaration& number) {
  const std::string& name = number.name;
  const auto found = numbers_.find(name);
  if (found == numbers_.end())
    return number.definition.complain(
        number.path, "no other file declares the number '" + name + "', and this one does not say what it is",
        nearest_or(name, keys_of(numbers_), name + " = { \"what it says\", unit = \"m\" }"));
  if (!number.trait.empty() && found->second.needed()) needed_by_[number.trait].push_back(name);
}

void NumberTable::declare(const NumberDeclaration& number) {
  const Value& node = number.node;
  const std::string& name = number.name;
  if (!check_name(name, number.path, number.definition.complainer())) return;
  NumberInfo info;
  if (!node.items.empty()) info.description = node.items.front().text;
  info.unit = node["unit"].text;
  info.optional = node["optional"].boolean;
  if (node["default"].is_number()) info.otherwise = node["default"].number;
  info.trait = number.trait;
  info.place = number.definition.place(number.path);
  const Unit* unit = unit_named(info.unit);
  if (unit == nullptr) info.unit.clear();  // so that values have one that there is
  info.most = node["max"].plain_number(unit == nullptr ? kUnits[0].most : unit->most);
  info.least = node["min"].plain_number(-info.most);
  const auto fault = [&](const char* field, const std::string& what, const std::string& cure) {
    numbers_.emplace(name, info);  // so that one fault is one complaint
    number.definition.complain(number.path + field, what, cure);
  };
  if (info.description.empty())
    return fault("", "a declared number begins with what it says",
                 name + " = { \"how deep a thing goes in\", unit = \"m\", default = 0 }");
  if (unit == nullptr)
    return fault(".unit", "'" + node["unit"].text + "' is none of the units that numbers are in",
                 "m, rad, m or rad, s, kg, N, N m, or none for a count; write mm(5), cm(5), deg(5) in values");
  if (info.least > info.most) return fault(".min", "is greater than max", "turn them round");
  if (info.otherwise && info.optional)
    return fault("", "a number with a default is there for all things", "leave out default, or optional");
  if (info.otherwise && (*info.otherwise < info.least || *info.otherwise > info.most))
    return fault(".default", fmt::format("{:g} lies outside {:g} … {:g}", *info.otherwise, info.least, info.most),
                 unit->cure);
  const auto [found, fresh] = numbers_.emplace(name, info);
  if (!fresh && !same(found->second, info))
    return number.definition.complain(number.path,
                                      fmt::format("'{}' is another number here ({}) than in {} ({})", name,
                                                  in_words(info), found->second.place, in_words(found->second)),
                                      "give one of them another name; to read the same, write " + name + " = {}");
  if (!number.trait.empty() && info.needed()) needed_by_[number.trait].push_back(name);
}

void NumberTable::check_values(const Value& numbers, const std::string& path, const Complain& complain) const {
  for (const auto& [name, value] : numbers.fields) {
    const auto found = numbers_.find(name);
    if (found == numbers_.end()) {
      const Error error = unknown_number({}, name, keys_of(numbers_));
      complain(path + name, error.message(), error.hint());
    } else if (value.is_number() && !(value.number >= found->second.least && value.number <= found->second.most)) {
      complain(path + name,
               fmt::format("{:g} lies outside {:g} … {:g}{}", value.number, found->second.least, found->second.most,
                           found->second.unit.empty() ? "" : " " + found->second.unit),
               unit_named(found->second.unit)->cure);
    }
  }
}

void NumberTable::check_needed(const std::vector<std::string>& traits, const std::vector<std::string>& has,
                               const std::string& path, const Complain& complain) const {
  for (const std::string& trait : traits) {
    const auto needed = needed_by_.find(trait);
    if (needed == needed_by_.end()) continue;
    for (const std::string& name : needed->second) {
      if (listed(has, name)) continue;
      const NumberInfo& info = numbers_.at(name);
      const std::string unit = info.unit.empty() ? "" : " [" + info.unit + "]";
      complain(path, "what is " + trait + " needs the number '" + name + "': " + info.description + unit,
               "numbers = { " + name + " = … }");
    }
  }
}

Error unknown_number(const std::string& where, const std::string& name, const std::vector<std::string>& known) {
  return Error(where, "nobody declares a number '" + name + "'",
               nearest_or(name, known,
                          "where it is read, in the predicate or skill: reads = { " + name +
                              " = { \"what it says\", of = …, unit = \"m\" } }"));
}

}  // namespace stampede
