#include "scripting/session/bddl_mapping_file.h"

#include <algorithm>

#include "engine/base/nearest.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/sandbox.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/session/text_file.h"

namespace stampede {
namespace {

struct Reading {
  const Evaluation* how;
  Value* value;
};

int read_table(lua_State* state) {
  const auto* reading = static_cast<const Reading*>(lua_touserdata(state, 1));
  *reading->value = read_value(state, 2, *reading->how, "");
  return 0;
}

Value table_of(const std::string& source, const std::string& place) {
  Sandbox sandbox({}, [](std::string_view) { return std::string_view(); });
  sandbox.run(Sandbox::compile(source, place), place, 1);
  lua_State* state = sandbox.state();
  Evaluation how{RandomKey("mapping"), 0, place, {}};
  Value value;
  Reading reading{&how, &value};
  lua_pushcfunction(state, lua_function<read_table>);  // below what run() left
  lua_insert(state, -2);
  lua_pushlightuserdata(state, &reading);
  lua_insert(state, -2);
  sandbox.call(2, 0);
  if (value.kind != Value::Kind::table) throw Error(place, "it returns no table", "return { dialect = \"libero\", … }");
  return value;
}

BddlMeaning meaning_from(const Value& value) {
  for (const BddlMeaning meaning :
       {BddlMeaning::equal, BddlMeaning::stronger, BddlMeaning::weaker, BddlMeaning::incomparable})
    if (value.as_text() == to_string(meaning)) return meaning;
  value.expected("equal, stronger, weaker or incomparable");
}

std::vector<BddlPair> pairs_from(const Value& value) {
  std::vector<BddlPair> pairs;
  for (const Value& item : value.items) {
    if (item.items.size() != 2) item.expected("{ \"theirs\", \"ours\" }");
    pairs.push_back({item.items[0].as_text(), item.items[1].as_text()});
  }
  return pairs;
}

BddlPredicateRule rule_from(const Value& value) {
  BddlPredicateRule rule;
  rule.theirs = value["theirs"].as_text();
  rule.ours = value["ours"].as_text();
  rule.negated = value.boolean_or("negated", false);
  for (const double index : value["order"].present() ? value["order"].as_numbers() : std::vector<double>{})
    rule.order.push_back(static_cast<int>(index) - 1);  // Lua counts from 1
  if (value["meaning"].present()) rule.meaning = meaning_from(value["meaning"]);
  rule.why = value.text_or("why", "");
  return rule;
}

template <typename Row>
void put_before(std::vector<Row>& rows, std::vector<Row> own) {
  own.insert(own.end(), rows.begin(), rows.end());
  rows = std::move(own);
}

void check_fields(const Value& table) {
  static const std::vector<std::string> kFields = {"dialect", "domain", "problem_name", "categories",
                                                   "sites",   "parts",  "predicates",   "support",
                                                   "within",  "hand",   "room",         "rooms"};
  for (const auto& [name, value] : table.fields)
    if (std::find(kFields.begin(), kFields.end(), name) == kFields.end())
      throw Error(table.place, "a mapping has no field '" + name + "'", did_you_mean(name, kFields));
}

}  // namespace

BddlMapping bddl_mapping_from_lua(const std::string& source, const std::string& place) {
  const Value table = table_of(source, place);
  check_fields(table);
  const std::string dialect = table["dialect"].as_text();
  if (dialect != "libero" && dialect != "behavior") table["dialect"].expected("libero or behavior");
  BddlMapping mapping = dialect == "libero" ? default_libero_mapping() : default_behavior_mapping();
  mapping.domain = table.text_or("domain", mapping.domain);
  mapping.problem_name = table.text_or("problem_name", mapping.problem_name);
  mapping.support = table.text_or("support", mapping.support);
  mapping.within = table.text_or("within", mapping.within);
  mapping.hand = table.text_or("hand", mapping.hand);
  mapping.room = table.text_or("room", mapping.room);
  put_before(mapping.categories, pairs_from(table["categories"]));
  if (table["sites"].present()) mapping.sites = pairs_from(table["sites"]);
  if (table["parts"].present()) mapping.parts.clear();
  for (const auto& [name, parts] : table["parts"].fields) mapping.parts[name] = parts.as_texts();
  for (const auto& [name, room] : table["rooms"].fields) mapping.rooms[name] = room.as_text();
  std::vector<BddlPredicateRule> rules;
  for (const Value& rule : table["predicates"].items) rules.push_back(rule_from(rule));
  put_before(mapping.predicates, std::move(rules));
  check_mapping(mapping, place);
  return mapping;
}

BddlMapping read_bddl_mapping(const std::filesystem::path& path) {
  return bddl_mapping_from_lua(read_text_file(path), path.string());
}

}  // namespace stampede
