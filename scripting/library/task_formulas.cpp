#include "scripting/library/task_formulas.h"

#include <algorithm>

#include "engine/start/call_settings.h"
#include "engine/start/constraints.h"
#include "scripting/library/checks.h"
#include "scripting/library/source_lines.h"

namespace stampede {

TaskFormulas::TaskFormulas(LibraryDraft& draft, const Definition& definition,
                           const std::map<std::string, Value>& fields, const SceneOutline& scene)
    : draft_(draft), domain_(draft.vocabulary().domain), definition_(definition), fields_(fields), scene_(scene) {
  where_ = draft.context(definition, "init");
  where_.hand = scene.hand;
  where_.expand = [this](const std::string& group) { return members(group); };
  where_.object_fault = [this](const std::string& name) { return object_fault(name); };
}

void TaskFormulas::check() {
  check_init();
  check_told();
  if (const Value* goal = field("goal")) check_goal(*goal);
  if (const Value* subgoals = field("subgoals")) check_subgoals(*subgoals);
  if (const Value* steps = field("steps")) check_steps(*steps);
}

const Value* TaskFormulas::field(const char* name) const {
  const auto found = fields_.find(name);
  return found == fields_.end() ? nullptr : &found->second;
}

std::vector<std::string> TaskFormulas::members(const std::string& group) const {
  if (const auto found = scene_.groups.find(group); found != scene_.groups.end()) {
    if (found->second.empty() && (where_.field == "goal" || where_.field == "subgoals"))
      throw Error({}, "the group '" + group + "' has no members, so what is asked of them says nothing",
                  "give it a count of at least 1, or leave the test out where there are none");
    return found->second;
  }
  const std::string single = group.substr(0, group.size() - 1);
  throw Error({}, "there is no group '" + group + "'",
              scene_.things.contains(single) ? "'" + single + "' is one object: give it count = n to make a group"
                                             : did_you_mean(group, keys_of(scene_.groups)));
}

std::optional<std::string> TaskFormulas::object_fault(const std::string& name) const {
  if (scene_.things.contains(name)) return std::nullopt;
  if (scene_.groups.contains(name + "*"))
    return "'" + name + "' is a group: write \"" + name + "*\" or \"" + name + "1\"";
  return did_you_mean(name, keys_of(scene_.things));
}

void TaskFormulas::check_init() {
  where_.field = "init";
  std::vector<std::string> placed;
  const Value* init = field("init");
  const bool sound = init == nullptr || draft_.complaints().guarded([&] {
    const Beginning beginning = beginning_from(*init, where_);
    if (beginning.constraint) check_whole(*beginning.constraint);
    for (const Literal& literal : beginning.literals) {
      check_literal(literal);
      if (!literal.negated) said_of_start_.insert(literal.fact);
      placed.push_back(placed_by(literal));
    }
  });
  if (!sound) return;
  for (const auto& [name, object] : scene_.things)
    if (object.free && !object.positioned && !listed(placed, name))
      definition_.complain("init", "nothing places the free object '" + name + "'",
                           "name it in init, such as is.on(\"" + name + "\", \"table\"), or give it at = { x, y, z }");
}

std::string TaskFormulas::placed_by(const Literal& literal) const {
  const Definition* predicate = draft_.find(DefinitionKind::predicate, literal.fact.predicate);
  if (literal.negated || predicate == nullptr || !predicate->node["sample"].present()) return {};
  for (const std::string& argument : literal.fact.arguments)
    if (argument != where_.hand) return argument;
  return {};
}

void TaskFormulas::check_told() {
  const Value* told = field("told");
  if (told == nullptr) return;
  where_.field = "told";
  draft_.complaints().guarded([&] {
    for (const Literal& literal : beginning_from(*told, where_).literals) check_literal(literal);
  });
}

void TaskFormulas::check_goal(const Value& goal) {
  where_.field = "goal";
  draft_.complaints().guarded([&] {
    check_whole(formula_from(goal, where_));
    check_order(stages_from(goal, where_));
    check_fingers(goal);
  });
}

// Of a robot that holds nothing, nothing held is asked.
void TaskFormulas::check_fingers(const Value& goal) {
  const Definition* world = draft_.find(DefinitionKind::world, definition_.node["world"].text);
  const std::string robot =
      world == nullptr || world->node["robot"].items.empty() ? "" : world->node["robot"].items[0].text;
  const Definition* found = draft_.find(DefinitionKind::robot, robot);
  if (found != nullptr && texts_of(found->node["fingers"]).empty() && asks_for_held(goal, where_))
    definition_.complain("goal", "it asks for something held, and the robot '" + robot + "' has no fingers",
                         "fingers = { \"left\", \"right\" } in " + found->file->shown_path + ", or another goal");
}

namespace {

// Facts that literals ask for, in order.
void facts_in(const Formula& formula, std::vector<Fact>& facts) {
  if (formula.kind == Formula::Kind::atom) facts.push_back({formula.predicate, names_of(formula.terms)});
  if (formula.kind == Formula::Kind::conjunction)
    for (const Formula& part : formula.parts) facts_in(part, facts);
}

}  // namespace

// A part is met when all of it holds: one of several that have yet to come true may do so before its turn.
void TaskFormulas::check_order(const std::vector<Formula>& stages) {
  std::set<Fact> before = said_of_start_;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    std::vector<Fact> asked, fresh;
    facts_in(stages[i], asked);
    for (const Fact& fact : asked)
      if (fact.predicate != "hand_empty" && before.insert(fact).second) fresh.push_back(fact);
    if (i == 0 || fresh.size() < 2) continue;
    std::string texts;
    for (const Fact& fact : fresh) texts += (texts.empty() ? "" : " or ") + to_text(fact);
    draft_.remark(Error(definition_.place("goal"),
                        "goal: " + texts + " may come true before the parts of in_order that stand before it: part " +
                            std::to_string(i + 1) + " is met when all of it holds",
                        "what is to wait for its turn is a part by itself"));
  }
}

void TaskFormulas::check_subgoals(const Value& subgoals) {
  where_.field = "subgoals";
  const auto check_one = [&](const Value& formula) {
    draft_.complaints().guarded([&] { check_whole(formula_from(formula, where_)); });
  };
  for (const auto& [name, formula] : subgoals.fields) check_one(formula);
  for (const Value& one : subgoals.items)
    if (one.items.size() > 1) check_one(one.items[1]);
}

void TaskFormulas::check_steps(const Value& steps) {
  if (steps.tag() == "call") return check_step(steps);
  for (const Value& call : steps.items) check_step(call);
}

void TaskFormulas::check_step(const Value& call) {
  const int line = call.line() > 0 ? call.line() : line_of(definition_.lines, "steps");
  const std::string place = place_in(*definition_.file, line);
  const auto say = [&](const std::string& what, const std::string& hint) {
    draft_.complaints().add(Error(place, "steps: " + what, hint));
  };
  const std::string& name = call["skill"].text;
  const Library& library = *draft_.library();
  const SkillInfo* skill = library.skill(name);
  if (skill == nullptr) {
    const std::vector<std::string> skills = names_of(library.files(DefinitionKind::skill));
    if (!listed(skills, name))  // else its file has complaints
      say("there is no skill '" + name + "'", did_you_mean(name, skills));
    return;
  }
  const std::vector<std::string> chosen = chosen_skills(draft_, definition_, definition_.node["world"].text);
  for (const std::string& one : chosen)
    if (library.skill(one)->replaces == name)
      say("'" + one + "' takes the place of '" + name + "' here", "write act." + one);
  if (!skill->replaces.empty() && !listed(chosen, name))
    say("'" + name + "' is not among this task's skills", "add skills = { \"" + name + "\" }");
  if (call.items.size() > skill->parameters.size())
    say(name + " takes " + std::to_string(skill->parameters.size()) + " arguments, not " +
            std::to_string(call.items.size()),
        {});
  for (const Value& argument : call.items)
    if (!scene_.things.contains(argument.text))
      say("there is no object '" + argument.text + "'", did_you_mean(argument.text, keys_of(scene_.things)));
  for (const auto& [parameter, value] : call["set"].fields) check_setting(*skill, parameter, value, place);
}

// Poses are read when the task is.
void TaskFormulas::check_setting(const SkillInfo& skill, const std::string& name, const Value& value,
                                 const std::string& place) {
  draft_.complaints().guarded([&] {
    CallSettings set;
    if (value.is_text()) {
      add_setting(name, value.text, set, place + ": steps");
    } else if (value.is_number()) {
      set.values.push_back({name, 0, {value.number}});
    } else if (value.is_table() && !value.items.empty()) {
      set.values.push_back({name, 0, {}});
      for (const Value& item : value.items) set.values.back().values.push_back(item.number);
    }
    check_settings(skill, set, place + ": steps");
  });
}

void TaskFormulas::check_literal(const Literal& literal) {
  std::vector<Term> terms;
  for (const std::string& argument : literal.fact.arguments) terms.push_back({false, argument});
  const Formula formula = atom(literal.fact.predicate, terms);
  if (literal.negated) return check_arguments(formula);
  check_whole(formula);
}

void TaskFormulas::check_whole(const Formula& formula) {
  check_arguments(formula);
  if (const std::string found = related_to_itself(formula, domain_); !found.empty())
    draft_.complaints().add(Error(definition_.place(where_.field), "there is no fact " + found,
                                  "no thing is related to itself or its own part: name another thing"));
}

void TaskFormulas::check_arguments(const Formula& formula) {
  for (const Formula& part : formula.parts) check_arguments(part);
  const Predicate* predicate = formula.kind == Formula::Kind::atom ? domain_.predicate(formula.predicate) : nullptr;
  if (predicate == nullptr || predicate->parameters.size() != formula.terms.size()) return;
  for (std::size_t i = 0; i < formula.terms.size(); ++i)
    if (!formula.terms[i].variable) check_argument(formula, i, predicate->parameters[i]);
}

void TaskFormulas::check_argument(const Formula& named, std::size_t argument, const Parameter& parameter) {
  const auto found = scene_.things.find(named.terms[argument].name);
  if (found == scene_.things.end() || !found->second.known) return;
  const OutlinedThing& object = found->second;
  const std::string place = definition_.place(where_.field);
  const std::string what = "is." + named.predicate + ": '" + found->first + "' ";
  if (!parameter.type.empty() && !object.type.empty() && !domain_.is_a(object.type, parameter.type))
    draft_.complaints().add(
        Error(place, what + "is a " + object.type + ", the " + parameter.name + " must be a " + parameter.type));
  for (const std::string& trait : parameter.traits)
    if (!listed(object.traits, trait))
      draft_.complaints().add(
          Error(place, what + "has not the trait '" + trait + "', which the " + parameter.name + " must have",
                "add it to the traits of its object file, or name another object"));
}

}  // namespace stampede
