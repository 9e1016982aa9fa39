#include "scripting/library/task_formulas.h"

#include <algorithm>

#include "engine/base/nearest.h"
#include "engine/start/call_settings.h"
#include "scripting/library/source_lines.h"

namespace stampede {

LibraryBuilder::TaskFormulas::TaskFormulas(LibraryBuilder& builder, const Definition& definition,
                                           const std::map<std::string, Value>& fields, const SceneObjects& objects,
                                           const Groups& groups)
    : builder_(builder), definition_(definition), fields_(fields), objects_(objects), groups_(groups) {
  for (const auto& [name, unused] : objects) known_.push_back(name);
  where_ = builder.context(definition, "init");
  where_.hand = builder.hand_of(definition.node["world"].text);
  where_.expand = [this](const std::string& group) { return members(group); };
  where_.object_fault = [this](const std::string& name) { return object_fault(name); };
}

void LibraryBuilder::TaskFormulas::check() {
  check_init();
  check_told();
  if (const Value* goal = field("goal")) check_goal(*goal);
  if (const Value* subgoals = field("subgoals")) check_subgoals(*subgoals);
  if (const Value* steps = field("steps")) check_steps(*steps);
}

const Value* LibraryBuilder::TaskFormulas::field(const char* name) const {
  const auto found = fields_.find(name);
  return found == fields_.end() ? nullptr : &found->second;
}

std::vector<std::string> LibraryBuilder::TaskFormulas::members(const std::string& group) const {
  if (const auto found = groups_.find(group); found != groups_.end()) {
    if (found->second.empty() && (where_.field == "goal" || where_.field == "subgoals"))
      throw Error({}, "the group '" + group + "' has no members, so what is asked of them says nothing",
                  "give it a count of at least 1, or leave the test out where there are none");
    return found->second;
  }
  std::vector<std::string> names;
  for (const auto& [name, unused] : groups_) names.push_back(name);
  const std::string single = group.substr(0, group.size() - 1);
  throw Error({}, "there is no group '" + group + "'",
              objects_.contains(single) ? "'" + single + "' is one object: give it count = n to make a group"
                                        : did_you_mean(group, names));
}

std::optional<std::string> LibraryBuilder::TaskFormulas::object_fault(const std::string& name) const {
  if (objects_.contains(name)) return std::nullopt;
  if (groups_.contains(name + "*")) return "'" + name + "' is a group: write \"" + name + "*\" or \"" + name + "1\"";
  return did_you_mean(name, known_);
}

void LibraryBuilder::TaskFormulas::check_init() {
  where_.field = "init";
  std::vector<std::string> placed;
  const Value* init = field("init");
  const bool sound = init == nullptr || builder_.guarded([&] {
    const Beginning beginning = beginning_from(*init, where_);
    if (beginning.constraint) check_arguments(*beginning.constraint);
    for (const Literal& literal : beginning.literals) {
      check_literal(literal);
      placed.push_back(placed_by(literal));
    }
  });
  if (!sound) return;
  for (const auto& [name, object] : objects_)
    if (object.free && !object.positioned && std::find(placed.begin(), placed.end(), name) == placed.end())
      builder_.complain(definition_, "init", "nothing places the free object '" + name + "'",
                        "name it in init, such as is.on(\"" + name + "\", \"table\"), or give it at = { x, y, z }");
}

std::string LibraryBuilder::TaskFormulas::placed_by(const Literal& literal) const {
  const Definitions& predicates = builder_.of(DefinitionKind::predicate);
  const auto predicate = predicates.find(literal.fact.predicate);
  if (literal.negated || predicate == predicates.end() || !predicate->second.node["sample"].present()) return {};
  for (const std::string& argument : literal.fact.arguments)
    if (argument != where_.hand) return argument;
  return {};
}

void LibraryBuilder::TaskFormulas::check_told() {
  const Value* told = field("told");
  if (told == nullptr) return;
  where_.field = "told";
  builder_.guarded([&] {
    for (const Literal& literal : beginning_from(*told, where_).literals) check_literal(literal);
  });
}

void LibraryBuilder::TaskFormulas::check_goal(const Value& goal) {
  where_.field = "goal";
  builder_.guarded([&] { check_arguments(formula_from(goal, where_)); });
}

void LibraryBuilder::TaskFormulas::check_subgoals(const Value& subgoals) {
  where_.field = "subgoals";
  const auto check_one = [&](const Value& formula) {
    builder_.guarded([&] { check_arguments(formula_from(formula, where_)); });
  };
  for (const auto& [name, formula] : subgoals.fields) check_one(formula);
  for (const Value& one : subgoals.items)
    if (one.items.size() > 1) check_one(one.items[1]);
}

void LibraryBuilder::TaskFormulas::check_steps(const Value& steps) {
  if (steps.tag() == "call") return check_step(steps);
  for (const Value& call : steps.items) check_step(call);
}

void LibraryBuilder::TaskFormulas::check_step(const Value& call) {
  const int line = call.line() > 0 ? call.line() : line_of(definition_.lines, "steps");
  const std::string place = definition_.file->shown_path + ":" + std::to_string(line);
  const std::string& name = call["skill"].text;
  const Library& library = *builder_.library_;
  const SkillInfo* skill = library.skill(name);
  if (skill == nullptr) {
    std::vector<std::string> skills;
    for (const ScriptFile* file : library.files(DefinitionKind::skill)) skills.push_back(file->name);
    if (std::find(skills.begin(), skills.end(), name) == skills.end())  // else its file has complaints
      builder_.add(Error(place, "steps: there is no skill '" + name + "'", did_you_mean(name, skills)));
    return;
  }
  const std::vector<std::string> chosen = builder_.chosen_skills(definition_, definition_.node["world"].text);
  for (const std::string& one : chosen)
    if (library.skill(one)->replaces == name)
      builder_.add(Error(place, "steps: '" + one + "' takes the place of '" + name + "' here", "write act." + one));
  if (!skill->replaces.empty() && std::find(chosen.begin(), chosen.end(), name) == chosen.end())
    builder_.add(
        Error(place, "steps: '" + name + "' is not among this task's skills", "add skills = { \"" + name + "\" }"));
  if (call.items.size() > skill->parameters.size())
    builder_.add(Error(place, "steps: " + name + " takes " + std::to_string(skill->parameters.size()) +
                                  " arguments, not " + std::to_string(call.items.size())));
  for (const Value& argument : call.items)
    if (!objects_.contains(argument.text))
      builder_.add(
          Error(place, "steps: there is no object '" + argument.text + "'", did_you_mean(argument.text, known_)));
  for (const auto& [parameter, value] : call["set"].fields) check_setting(*skill, parameter, value, place);
}

// Poses are read when the task is.
void LibraryBuilder::TaskFormulas::check_setting(const SkillInfo& skill, const std::string& name, const Value& value,
                                                 const std::string& place) {
  builder_.guarded([&] {
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

void LibraryBuilder::TaskFormulas::check_literal(const Literal& literal) {
  std::vector<Term> terms;
  for (const std::string& argument : literal.fact.arguments) terms.push_back({false, argument});
  check_arguments(atom(literal.fact.predicate, terms));
}

void LibraryBuilder::TaskFormulas::check_arguments(const Formula& formula) {
  for (const Formula& part : formula.parts) check_arguments(part);
  const Predicate* predicate =
      formula.kind == Formula::Kind::atom ? builder_.library_->domain_.predicate(formula.predicate) : nullptr;
  if (predicate == nullptr || predicate->parameters.size() != formula.terms.size()) return;
  for (std::size_t i = 0; i < formula.terms.size(); ++i)
    if (!formula.terms[i].variable) check_argument(formula, i, predicate->parameters[i]);
}

void LibraryBuilder::TaskFormulas::check_argument(const Formula& named, std::size_t argument,
                                                  const Parameter& parameter) {
  const auto found = objects_.find(named.terms[argument].name);
  if (found == objects_.end() || !found->second.known) return;
  const SceneObject& object = found->second;
  const std::string place =
      definition_.file->shown_path + ":" + std::to_string(line_of(definition_.lines, where_.field));
  const std::string what = "is." + named.predicate + ": '" + found->first + "' ";
  if (!parameter.type.empty() && !object.type.empty() && !builder_.library_->domain_.is_a(object.type, parameter.type))
    builder_.add(
        Error(place, what + "is a " + object.type + ", the " + parameter.name + " must be a " + parameter.type));
  for (const std::string& trait : parameter.traits)
    if (std::find(object.traits.begin(), object.traits.end(), trait) == object.traits.end())
      builder_.add(Error(place, what + "has not the trait '" + trait + "', which the " + parameter.name + " must have",
                         "add it to the traits of its object file, or name another object"));
}

}  // namespace stampede
