#include "scripting/runtime/bddl_mapping_reader.h"

#include <algorithm>
#include <array>
#include <lua.hpp>

#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/text_file.h"
#include "scripting/library/lua_value.h"
#include "scripting/lua/sandbox.h"

namespace stampede {
namespace {

constexpr std::uintmax_t kLargest = 1u << 20;  // bytes

class MappingReader {
 public:
  MappingReader(const Library& library, std::string place, bool home)
      : library_(library), place_(std::move(place)), home_(home) {}

  BddlMapping read(const Value& table) {
    if (!table.is_table()) throw Error(place_, "expected a table, got " + table.type_name(), "return { … }");
    only(table, "",
         {"dialect", "extend", "domain", "problem_name", "categories", "instances", "unsaid", "unknown", "sites",
          "parts", "predicates", "support", "within", "hand", "zone", "stands", "room", "rooms"});
    const std::string& dialect = text(table["dialect"], "dialect");
    if (dialect != "libero" && dialect != "behavior")
      fail("dialect", "there is no dialect '" + dialect + "'", did_you_mean(dialect, {"behavior", "libero"}));
    const bool extend = !table["extend"].present() || table["extend"].boolean;
    if (extend && home_) fail("extend", "this file is the dialect's mapping: it has none to add to", "extend = false");
    BddlMapping mapping;
    mapping.dialect = dialect == "libero" ? BddlDialect::libero : BddlDialect::behavior;
    if (!home_) mapping = extend ? bddl_mapping_of(library_, mapping.dialect) : words_of(mapping.dialect);
    read_words(table, mapping);
    read_things(table, mapping);
    put_first(mapping.predicates, rules(table["predicates"]));
    check_mapping(mapping, place_);
    return mapping;
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& what, const std::string& hint = {}) const {
    throw Error(place_ + ": " + field, what, hint);
  }

  void only(const Value& table, const std::string& field, const std::vector<std::string>& known) const {
    for (const auto& [name, value] : table.fields)
      if (std::find(known.begin(), known.end(), name) == known.end())
        fail(field.empty() ? name : field, "there is no field '" + name + "'", did_you_mean(name, known));
  }

  const std::string& text(const Value& node, const std::string& field) const {
    if (!node.is_text()) fail(field, "expected a text, got " + node.type_name());
    return node.text;
  }

  // A mapping without rows still has its dialect's words.
  BddlMapping words_of(BddlDialect dialect) const {
    const BddlMapping all = bddl_mapping_of(library_, dialect);
    BddlMapping words;
    words.dialect = dialect;
    for (const auto& [name, member] : kWords) words.*member = all.*member;
    return words;
  }

  template <typename T>
  static void put_first(std::vector<T>& all, std::vector<T> own) {
    all.insert(all.begin(), std::make_move_iterator(own.begin()), std::make_move_iterator(own.end()));
  }

  void read_words(const Value& table, BddlMapping& mapping) const {
    for (const auto& [name, member] : kWords)
      if (table[name].present()) mapping.*member = text(table[name], name);
    known_predicate("support", mapping.support);
    known_predicate("within", mapping.within);
    known_thing("zone", mapping.zone);
  }

  void read_things(const Value& table, BddlMapping& mapping) const {
    put_first(mapping.categories, pairs(table["categories"], "categories", false));
    for (const BddlPair& pair : mapping.categories) known_thing("categories", pair.ours);
    put_first(mapping.sites, pairs(table["sites"], "sites", true));
    for (const auto& [category, name] : table["instances"].fields)
      mapping.instances[category] = text(name, "instances." + category);
    put_first(mapping.unknown, texts(table["unknown"], "unknown"));
    std::vector<std::string> unsaid = texts(table["unsaid"], "unsaid");
    for (const std::string& thing : unsaid) known_thing("unsaid", thing);
    put_first(mapping.unsaid, std::move(unsaid));
    for (const auto& [thing, stand] : table["stands"].fields) {
      known_thing("stands", thing);
      mapping.stands[thing] = stand_of(stand, "stands." + thing);
    }
    for (const auto& [thing, parts] : table["parts"].fields) {
      known_thing("parts", thing);
      std::vector<std::string>& names = mapping.parts[thing];
      names.clear();
      for (const Value& part : parts.items) names.push_back(text(part, "parts." + thing));
    }
    for (const auto& [thing, room] : table["rooms"].fields) {
      known_thing("rooms", thing);
      mapping.rooms[thing] = text(room, "rooms." + thing);
    }
  }

  std::vector<std::string> texts(const Value& list, const std::string& field) const {
    std::vector<std::string> result;
    for (const Value& item : list.items) result.push_back(text(item, field));
    return result;
  }

  // { x = { 0.52, 0.55 }, y = { 0.12, 0.16 }, z = 0.75 }, in metres of the world
  BddlStand stand_of(const Value& table, const std::string& field) const {
    only(table, field, {"x", "y", "z"});
    const auto range = [&](const char* name) {
      const Value& ends = table[name];
      if (ends.items.size() != 2 || !ends.items[0].is_number() || !ends.items[1].is_number() ||
          ends.items[0].number > ends.items[1].number)
        fail(field + "." + name, "expected { least, greatest }", "such as { 0.52, 0.55 }, in metres");
      return std::array<double, 2>{ends.items[0].number, ends.items[1].number};
    };
    if (!table["z"].is_number()) fail(field + ".z", "expected a number", "the height of what it stands on, in metres");
    return {range("x"), range("y"), table["z"].number};
  }

  // { { "theirs", "ours" }, … }
  std::vector<BddlPair> pairs(const Value& list, const std::string& field, bool may_be_empty) const {
    if (list.present() && (!list.is_table() || !list.fields.empty()))
      fail(field, "expected a list of pairs", "{ { \"theirs\", \"ours\" } }: the first that fits is taken");
    std::vector<BddlPair> result;
    for (const Value& item : list.items) {
      if (item.items.size() != 2) fail(field, "expected a pair, got " + item.type_name(), "{ \"theirs\", \"ours\" }");
      result.push_back({text(item.items[0], field), text(item.items[1], field)});
      if (result.back().ours.empty() && !may_be_empty)
        fail(field, "'" + result.back().theirs + "' is mapped to nothing");
    }
    return result;
  }

  std::vector<BddlPredicateRule> rules(const Value& list) const {
    std::vector<BddlPredicateRule> result;
    for (const Value& item : list.items) {
      const std::string field = "predicates[" + std::to_string(result.size() + 1) + "]";
      only(item, field, {"theirs", "ours", "negated", "order", "meaning", "toggles", "why"});
      BddlPredicateRule rule;
      rule.theirs = text(item["theirs"], field + ".theirs");
      rule.ours = text(item["ours"], field + ".ours");
      known_predicate(field + ".ours", rule.ours);
      rule.negated = item["negated"].boolean;
      rule.toggles = item["toggles"].boolean;
      for (const Value& place : item["order"].items) {
        if (!place.integer) fail(field + ".order", "expected whole numbers from 1", "{ 2, 1 } swaps two arguments");
        rule.order.push_back(static_cast<int>(place.number) - 1);  // Lua counts from 1
      }
      rule.meaning = meaning(item["meaning"], field + ".meaning");
      if (item["why"].present()) rule.why = text(item["why"], field + ".why");
      result.push_back(std::move(rule));
    }
    return result;
  }

  BddlMeaning meaning(const Value& node, const std::string& field) const {
    using enum BddlMeaning;
    if (!node.present()) return equal;
    std::vector<std::string> names;
    for (const BddlMeaning one : {equal, stronger, weaker, incomparable}) {
      if (text(node, field) == to_string(one)) return one;
      names.emplace_back(to_string(one));
    }
    fail(field, "'" + node.text + "' is no relation of meanings", did_you_mean(node.text, names));
  }

  void known_predicate(const std::string& field, const std::string& name) const {
    if (library_.domain().predicate(name) != nullptr) return;
    fail(field, "there is no predicate '" + name + "'", did_you_mean(name, names_of(library_.domain().predicates)));
  }

  // An object file or a type.
  void known_thing(const std::string& field, const std::string& name) const {
    if (library_.domain().types.contains(name) || library_.file(DefinitionKind::object, name) != nullptr) return;
    std::vector<std::string> names = names_of(library_.files(DefinitionKind::object));
    for (const auto& [type, parent] : library_.domain().types) names.push_back(type);
    fail(field, "there is no object or type '" + name + "'", did_you_mean(name, names));
  }

  static constexpr std::pair<const char*, std::string BddlMapping::*> kWords[] = {
      {"domain", &BddlMapping::domain},   {"problem_name", &BddlMapping::problem_name},
      {"support", &BddlMapping::support}, {"within", &BddlMapping::within},
      {"hand", &BddlMapping::hand},       {"zone", &BddlMapping::zone},
      {"room", &BddlMapping::room}};

  const Library& library_;
  std::string place_;
  bool home_;  // it is the dialect's own file
};

std::string source_of(const std::string& path) {
  try {
    return read_text_file(path, kLargest);
  } catch (const Error& error) {
    throw Error(path, error.message(), "name a file of worlds/bddl, or a path to one");
  }
}

}  // namespace

BddlMapping read_bddl_mapping(const Library& library, const std::string& path) {
  const bool named = path.find_first_of("/.") == std::string::npos;
  const ScriptFile* own = named ? library.module("worlds.bddl." + path) : nullptr;
  const std::string place = own != nullptr ? own->shown_path : path;
  const std::string bytecode = own != nullptr ? own->bytecode : Sandbox::compile(source_of(path), path);
  Sandbox sandbox({}, [&](std::string_view name) {
    const ScriptFile* file = library.module(name);
    return file == nullptr ? std::string_view() : std::string_view(file->bytecode);
  });
  sandbox.run(bytecode, "@" + place, 1);
  const bool home = own != nullptr && (path == "libero" || path == "behavior");
  return MappingReader(library, place, home).read(value_as_written(sandbox.state(), -1, place));
}

std::string dialect_name(BddlDialect dialect) { return dialect == BddlDialect::libero ? "libero" : "behavior"; }

BddlMapping bddl_mapping_of(const Library& library, BddlDialect dialect) {
  const std::string name = dialect_name(dialect);
  if (library.module("worlds.bddl." + name) == nullptr)
    throw Error("worlds/bddl/" + name + ".lua", "no root has this file", "name the library with --root");
  BddlMapping mapping = read_bddl_mapping(library, name);
  if (mapping.dialect != dialect) throw Error("worlds/bddl/" + name + ".lua", "this is another dialect's mapping");
  return mapping;
}

std::vector<BddlMapping> bddl_mappings_of(const Library& library, const std::string& dialect) {
  std::vector<BddlMapping> mappings;
  for (const BddlDialect one : {BddlDialect::libero, BddlDialect::behavior})
    if (dialect == dialect_name(one) || (dialect != "libero" && dialect != "behavior"))
      mappings.push_back(bddl_mapping_of(library, one));
  return mappings;
}

}  // namespace stampede
