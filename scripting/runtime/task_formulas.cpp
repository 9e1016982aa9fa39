// The symbolic half of a task: init, goal, subgoals and steps.
#include <algorithm>
#include <lua.hpp>

#include "engine/base/names.h"
#include "engine/base/naming.h"
#include "scripting/library/formula_reader.h"
#include "scripting/library/lua_value.h"
#include "scripting/runtime/task_reader.h"

namespace stampede {

std::vector<std::string> TaskReader::members(const std::string& group) const {
  const std::string name = group.ends_with('*') ? group.substr(0, group.size() - 1) : group;
  const auto found = drawn_.groups.find(name);
  if (found != drawn_.groups.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [one, names] : drawn_.groups) known.push_back(one + "*");
  throw Error({}, "there is no group '" + name + "*'", did_you_mean(name + "*", known));
}

FormulaContext TaskReader::context_of(const std::string& field) const {
  FormulaContext context;
  context.file = file_.shown_path;
  context.field = field;
  context.domain = &scripts_.library().domain();
  context.traits = &scripts_.library().predicate_traits();
  context.hand = drawn_.hand;
  context.expand = [this](const std::string& group) { return members(group); };
  context.object_fault = [this](const std::string& name) -> std::optional<std::string> {
    if (drawn_.task.scene.object(name) != nullptr) return std::nullopt;
    return did_you_mean(name, names_of(drawn_.task.scene.objects));
  };
  return context;
}

void TaskReader::read_init() {
  if (!push_field("init")) return;
  Beginning beginning = beginning_from(value_as_written(state_, -1, file_.shown_path + ": init"), context_of("init"));
  drawn_.task.init = std::move(beginning.literals);
  drawn_.task.where = std::move(beginning.constraint);
  lua_pop(state_, 1);
}

void TaskReader::read_told() {
  if (!push_field("told")) return;
  for (Literal& literal :
       beginning_from(value_as_written(state_, -1, file_.shown_path + ": told"), context_of("told")).literals)
    drawn_.task.told.push_back(std::move(literal.fact));
  lua_pop(state_, 1);
}

namespace {

bool is_implied(const Value& formula) {
  return formula["implied"].boolean || std::any_of(formula.items.begin(), formula.items.end(), is_implied);
}

}  // namespace

void TaskReader::read_goal() {
  if (!push_field("goal")) throw Error(file_.shown_path, "a task needs a goal");
  const Value goal = value_as_written(state_, -1, file_.shown_path + ": goal");
  const FormulaContext context = context_of("goal");
  drawn_.task.goal = formula_from(goal, context);
  drawn_.task.stages = stages_from(goal, context);
  drawn_.task.empty_hand = is_implied(goal) && !asks_for_held(goal, context);
  lua_pop(state_, 1);
}

// Named formulas in the order in which they are written: a table of names has none of its own, lines do.
void TaskReader::read_subgoals() {
  if (!push_field("subgoals")) return;
  const std::string place = file_.shown_path + ": subgoals";
  const Value subgoals = value_as_written(state_, -1, place);
  lua_pop(state_, 1);
  const auto add = [&](const std::string& name, const Value& formula, std::string sentence) {
    if (name.find_first_of(" \t\n") != std::string::npos)
      throw Error(place, "'" + name + "' is no name: it has blanks", "put _ in their place");
    drawn_.task.subgoals.push_back({name, formula_from(formula, context_of("subgoals." + name)), std::move(sentence)});
  };
  std::vector<std::pair<int, std::string>> order;
  for (const auto& [name, node] : subgoals.fields) order.emplace_back(node.line(), name);
  std::sort(order.begin(), order.end());
  for (const auto& [line, name] : order) add(name, subgoals[name], "");
  for (const Value& one : subgoals.items) {  // { { "open_it", is.open(…), "open the drawer" }, … }
    const bool said = one.items.size() == 3 && one.items[2].is_text();
    if ((one.items.size() != 2 && !said) || !one.items[0].is_text())
      throw Error(place, "expected { \"name\", formula } or { \"name\", formula, \"sentence\" }");
    add(one.items[0].text, one.items[1], said ? filled(one.items[2].text) : "");
  }
}

void TaskReader::read_steps() {
  if (!push_field("steps")) return;
  const int steps = lua_gettop(state_);
  const std::string place = file_.shown_path + ": steps";
  drawn_.task.steps.emplace();
  lua_getfield(state_, steps, "tag");
  const bool single = !lua_isnil(state_, -1);  // one call, not a list of them
  lua_pop(state_, 1);
  const auto count = single ? 1 : static_cast<lua_Integer>(lua_rawlen(state_, steps));
  for (lua_Integer i = 1; i <= count; ++i) {
    if (single) {
      lua_pushvalue(state_, steps);
    } else {
      lua_rawgeti(state_, steps, i);
    }
    AskedCall call = asked_call_at(state_, lua_gettop(state_), scripts_.library(), place);
    drawn_.task.steps->push_back({{call.skill, std::move(call.arguments)}, std::move(call.set)});
    lua_pop(state_, 1);
  }
  lua_pop(state_, 1);
}

}  // namespace stampede
