// The symbolic half of a task: init, goal, subgoals and steps.
#include <algorithm>
#include <lua.hpp>

#include "scripting/runtime/task_reader.h"

namespace stampede {
namespace {

int raw_items(lua_State* state, int index) { return static_cast<int>(lua_rawlen(state, index)); }

std::string tag_at(lua_State* state, int index) {
  if (!lua_istable(state, index)) return {};
  index = lua_absindex(state, index);
  lua_pushstring(state, "tag");
  lua_rawget(state, index);
  const std::string tag = lua_type(state, -1) == LUA_TSTRING ? lua_tostring(state, -1) : "";
  lua_pop(state, 1);
  return tag;
}

int line_at(lua_State* state, int index) {
  if (!lua_istable(state, index)) return 0;
  lua_getfield(state, index, "line");
  const int line = static_cast<int>(lua_tointeger(state, -1));
  lua_pop(state, 1);
  return line;
}

// The hand is left out by authors where the world has one: it is put where the predicate has it.
void add_hand(const Domain& domain, const std::string& hand, Fact& fact) {
  const Predicate* predicate = domain.predicate(fact.predicate);
  if (predicate == nullptr || fact.arguments.size() + 1 != predicate->parameters.size()) return;
  for (std::size_t i = 0; i < predicate->parameters.size(); ++i) {
    if (predicate->parameters[i].type != "hand") continue;
    fact.arguments.insert(fact.arguments.begin() + static_cast<std::ptrdiff_t>(i), hand);
    return;
  }
}

bool is_hand_variable(const Term& term) { return term.name == "hand" || term.name == "?hand"; }

// A goal speaks of the world's hand: free mentions of the parameter `hand` are that object.
void bind_hand(const std::string& hand, Formula& formula) {
  const auto own = [](const Parameter& variable) { return variable.name == "hand"; };
  if (std::any_of(formula.variables.begin(), formula.variables.end(), own)) return;
  for (Term& term : formula.terms) {
    if (is_hand_variable(term)) term = {false, hand};
  }
  for (Formula& part : formula.parts) bind_hand(hand, part);
}

}  // namespace

std::vector<std::string> TaskReader::members(const std::string& group) const {
  const std::string name = group.ends_with('*') ? group.substr(0, group.size() - 1) : group;
  const auto found = drawn_.groups.find(name);
  if (found == drawn_.groups.end()) {
    throw Error(file_.shown_path, "there is no group '" + name + "'", "a group is an entry of objects with a count");
  }
  return found->second;
}

// is.on("block*", "table") is one literal for each member; is_not: none of them.
std::vector<Literal> TaskReader::expanded(const Literal& literal) const {
  std::vector<Literal> all{literal};
  for (std::size_t i = 0; i < literal.fact.arguments.size(); ++i) {
    if (!literal.fact.arguments[i].ends_with('*')) continue;
    std::vector<Literal> next;
    for (const Literal& one : all) {
      for (const std::string& member : members(literal.fact.arguments[i])) {
        next.push_back(one);
        next.back().fact.arguments[i] = member;
      }
    }
    all = std::move(next);
  }
  return all;
}

void TaskReader::read_init() {
  if (!push_field("init")) return;
  const int init = lua_gettop(state_);
  const std::string place = file_.shown_path + ": init";
  const bool single = !tag_at(state_, init).empty();
  for (int i = 1; i <= (single ? 1 : raw_items(state_, init)); ++i) {
    single ? lua_pushvalue(state_, init) : static_cast<void>(lua_rawgeti(state_, init, i));
    Literal literal = read_literal(state_, lua_gettop(state_), place);
    lua_pop(state_, 1);
    add_hand(scripts_.library().domain(), drawn_.hand, literal.fact);
    for (Literal& one : expanded(literal)) drawn_.init.push_back(std::move(one));
  }
  lua_pop(state_, 1);
}

Formula TaskReader::formula_at(int index, const std::string& place) {
  Formula formula = read_formula(state_, index, place, {}, scripts_.library().domain(),
                                 [this](const std::string& group) { return members(group); });
  bind_hand(drawn_.hand, formula);
  return formula;
}

void TaskReader::read_goal() {
  const std::string place = file_.shown_path + ": goal";
  if (!push_field("goal")) throw Error(file_.shown_path, "a task needs a goal");
  const int goal = lua_gettop(state_);
  if (tag_at(state_, goal) == "in_order" || tag_at(state_, goal).empty()) {
    const bool staged = !tag_at(state_, goal).empty();
    std::vector<Formula> parts;
    for (int i = 1; i <= raw_items(state_, goal); ++i) {
      lua_rawgeti(state_, goal, i);
      parts.push_back(formula_at(lua_gettop(state_), place));
      lua_pop(state_, 1);
    }
    if (staged) drawn_.stages = parts;
    drawn_.goal = conjunction(std::move(parts));
  } else {
    drawn_.goal = formula_at(goal, place);
  }
  lua_pop(state_, 1);
}

// Named formulas in the order in which they are written: a table of names has none of its own, lines do.
void TaskReader::read_subgoals() {
  if (!push_field("subgoals")) return;
  const int subgoals = lua_gettop(state_);
  std::vector<std::pair<int, std::string>> order;
  lua_pushnil(state_);
  while (lua_next(state_, subgoals) != 0) {
    const int line = line_at(state_, lua_gettop(state_));
    lua_pop(state_, 1);
    if (lua_type(state_, -1) == LUA_TSTRING) order.emplace_back(line, lua_tostring(state_, -1));
  }
  std::sort(order.begin(), order.end());
  for (const auto& [line, name] : order) {
    lua_getfield(state_, subgoals, name.c_str());
    drawn_.subgoals.emplace_back(name, formula_at(lua_gettop(state_), file_.shown_path + ": subgoals." + name));
    lua_pop(state_, 1);
  }
  for (int i = 1; i <= raw_items(state_, subgoals); ++i) {  // { { "open_it", is.open(…) }, … }
    lua_rawgeti(state_, subgoals, i);
    lua_rawgeti(state_, -1, 1);
    lua_rawgeti(state_, -2, 2);
    const char* name = lua_tostring(state_, -2);
    if (name == nullptr) throw Error(file_.shown_path + ": subgoals", "expected { name, formula }");
    drawn_.subgoals.emplace_back(name, formula_at(lua_gettop(state_), file_.shown_path + ": subgoals." + name));
    lua_pop(state_, 3);
  }
  lua_pop(state_, 1);
}

void TaskReader::read_steps() {
  if (!push_field("steps")) return;
  const int steps = lua_gettop(state_);
  drawn_.steps.emplace();
  for (int i = 1; i <= raw_items(state_, steps); ++i) {
    lua_rawgeti(state_, steps, i);
    SkillCall call = skill_call_at(state_, lua_gettop(state_), scripts_.library(), file_.shown_path + ": steps");
    drawn_.steps->push_back({call.skill, std::move(call.arguments)});
    lua_pop(state_, 1);
  }
  lua_pop(state_, 1);
}

}  // namespace stampede
