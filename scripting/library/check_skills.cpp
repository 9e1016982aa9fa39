#include <algorithm>
#include <limits>

#include "scripting/library/builder.h"
#include "scripting/library/naming.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

std::vector<std::string> names_of(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

// A bound: one number for all components, or one each.
std::vector<double> bound(const Value& node, std::size_t count, double otherwise) {
  std::vector<double> result(count, node.is_number() ? node.number : otherwise);
  for (std::size_t i = 0; i < node.items.size() && i < count; ++i) result[i] = node.items[i].number;
  return result;
}

}  // namespace

void LibraryBuilder::read_skills() {
  for (const auto& [name, definition] : of(DefinitionKind::skill)) read_skill(definition);
  std::map<std::string, std::string> owner;
  for (const Action& action : library_->domain_.actions) {
    const auto [found, fresh] = owner.emplace(action.name, action.skill);
    if (fresh || found->second == action.skill) continue;
    complain(of(DefinitionKind::skill).at(action.skill), {},
             "the action '" + action.name + "' is also one of skill '" + found->second + "'",
             "rename the skill or its case");
  }
}

void LibraryBuilder::read_skill(const Definition& definition) {
  const Value& node = definition.node;
  SkillInfo info;
  info.name = definition.file->name;
  info.parameters = parameters_of(definition, true);
  info.label = node["label"].text;
  info.stiffness = node["stiffness"].number;
  check_label(definition, info.label, info.parameters);
  const std::vector<std::string> controllers = {"joint_position", "joint_impedance", "cartesian_impedance"};
  const std::string& controller = node["controller"].text;
  const auto kind = std::find(controllers.begin(), controllers.end(), controller.empty() ? controllers[0] : controller);
  if (kind == controllers.end()) {
    complain(definition, "controller", "there is no controller '" + controller + "'",
             did_you_mean(controller, controllers));
  } else {
    info.controller = static_cast<ControllerKind>(kind - controllers.begin());
  }
  std::vector<std::string> predicates;
  for (const Predicate& predicate : library_->domain_.predicates) predicates.push_back(predicate.name);
  for (const Value& forgotten : node["forgets"].items) {
    info.forgets.push_back(forgotten.text);
    if (listed(predicates, forgotten.text)) continue;
    complain(definition, "forgets", "there is no predicate '" + forgotten.text + "'",
             did_you_mean(forgotten.text, predicates));
  }
  guarded([&] { read_continuous(definition, info); });
  read_replaced(definition, info);
  const Value& cases = node["cases"];
  if (cases.present()) {
    for (const char* field : {"precondition", "effect"}) {
      if (node[field].present())
        complain(definition, field, "a skill with cases says it in each case", "move it into the cases");
    }
    for (const auto& [name, fields] : cases.fields) read_action(definition, info, fields, name);
  } else {
    read_action(definition, info, node, {});
  }
  end_moved(definition, info);
  for (const Action& action : library_->domain_.actions) {
    if (action.skill == info.name) info.actions.push_back(action.name);
  }
  library_->skills_[info.name] = std::move(info);
}

void LibraryBuilder::read_replaced(const Definition& definition, SkillInfo& info) {
  const Value& extends = definition.node["extends"];
  const Value& replaces = definition.node["replaces"];
  if (extends.present() && replaces.present())
    complain(definition, "replaces", "what extends a skill replaces that one", "take this field out");
  info.replaces = extends.is_text() ? extends.text : replaces.text;
  if (!replaces.present()) return;
  std::vector<std::string> skills;
  for (const ScriptFile* file : library_->files(DefinitionKind::skill))
    if (file->name != info.name) skills.push_back(file->name);
  if (!listed(skills, info.replaces))
    complain(definition, "replaces", "there is no other skill '" + info.replaces + "'",
             did_you_mean(info.replaces, skills));
}

// What it moves ends the facts that say so of themselves: forall others, when they hold.
void LibraryBuilder::end_moved(const Definition& definition, const SkillInfo& info) {
  Domain& domain = library_->domain_;
  for (const Value& moved : definition.node["moves"].items) {
    const auto parameter = std::find_if(info.parameters.begin(), info.parameters.end(),
                                        [&](const Parameter& one) { return one.name == moved.text; });
    if (parameter == info.parameters.end()) {
      complain(definition, "moves", "there is no parameter '" + moved.text + "'",
               did_you_mean(moved.text, names_of(info.parameters)));
      continue;
    }
    for (const Predicate& predicate : domain.predicates) {
      const auto traits = library_->predicate_traits_.find(predicate.name);
      if (traits == library_->predicate_traits_.end() || !traits->second.ends_when_moved) continue;
      for (std::size_t i = 0; i < predicate.parameters.size(); ++i) {
        const std::string& asked = predicate.parameters[i].type;
        const std::string& given = parameter->type;
        if (!asked.empty() && !given.empty() && !domain.is_a(asked, given) && !domain.is_a(given, asked)) continue;
        Effect effect;
        effect.predicate = predicate.name;
        effect.negated = true;
        for (std::size_t k = 0; k < predicate.parameters.size(); ++k) {
          Parameter other = predicate.parameters[k];
          while (k != i && listed(names_of(info.parameters), other.name)) other.name += "_of_it";
          effect.terms.push_back({true, k == i ? parameter->name : other.name});
          if (k != i) effect.forall.push_back(other);
        }
        effect.when = atom(effect.predicate, effect.terms);
        for (Action& action : domain.actions)
          if (action.skill == info.name) action.effects.push_back(effect);
      }
    }
  }
}

// A task's choices go before its world's, where both take the place of one skill.
std::vector<std::string> LibraryBuilder::chosen_skills(const Definition& task, const std::string& world) {
  std::map<std::string, std::string> chosen;  // by what they replace
  const auto choose = [&](const Definition& definition) {
    std::vector<std::string> known;
    for (const auto& [name, info] : library_->skills_)
      if (!info.replaces.empty()) known.push_back(name);
    std::set<std::string> taken;
    for (const Value& item : definition.node["skills"].items) {
      if (library_->file(DefinitionKind::skill, item.text) == nullptr) {
        complain(definition, "skills", "there is no skill '" + item.text + "'", did_you_mean(item.text, known));
        continue;
      }
      const SkillInfo* info = library_->skill(item.text);
      if (info == nullptr) continue;  // its file has its own complaint
      if (info->replaces.empty()) {
        complain(definition, "skills", "'" + item.text + "' neither extends nor replaces another skill",
                 "leave it out: every task has it; or say in its file what it replaces");
      } else if (!taken.insert(info->replaces).second) {
        complain(
            definition, "skills",
            "'" + item.text + "' and '" + chosen[info->replaces] + "' both take the place of '" + info->replaces + "'",
            "choose one of them");
      } else {
        chosen[info->replaces] = item.text;
      }
    }
  };
  const Definitions& worlds = of(DefinitionKind::world);
  if (const auto found = worlds.find(world); found != worlds.end()) choose(found->second);
  choose(task);
  std::vector<std::string> names;
  for (const auto& [replaced, name] : chosen) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

namespace {

// Values that a formula names: `lid` of `?x.lid`.
void collect_values(const Formula& formula, const Domain& domain, std::set<std::string>& names) {
  for (const Formula& part : formula.parts) collect_values(part, domain, names);
  const Predicate* predicate = formula.kind == Formula::Kind::atom ? domain.predicate(formula.predicate) : nullptr;
  if (predicate == nullptr) return;
  for (std::size_t i = 0; i < formula.terms.size() && i < predicate->parameters.size(); ++i)
    if (!formula.terms[i].variable && predicate->parameters[i].type == "value") names.insert(formula.terms[i].name);
}

// What actions and derived predicates name is there in every problem, also where no object has such a part.
void name_constants(Domain& domain) {
  std::set<std::string> names;
  for (const Action& action : domain.actions) {
    collect_values(action.precondition, domain, names);
    for (const Effect& effect : action.effects) collect_values(effect.when, domain, names);
  }
  for (const Predicate& predicate : domain.predicates)
    if (predicate.kind == PredicateKind::derived) collect_values(predicate.derived, domain, names);
  for (const std::string& name : names) domain.constants.push_back({name, "value"});
}

}  // namespace

void LibraryBuilder::make_domains() {
  const std::map<std::string, SkillInfo, std::less<>>& skills = library_->skills_;
  Domain& base = library_->domain_;
  const Domain all = base;
  const auto replaces = [&](const Action& action) { return skills.at(action.skill).replaces; };
  std::erase_if(base.actions, [&](const Action& action) { return !replaces(action).empty(); });
  for (const auto& [name, task] : library_->tasks_) {
    if (task.skills.empty()) continue;
    std::set<std::string> replaced;
    for (const std::string& chosen : task.skills) replaced.insert(skills.at(chosen).replaces);
    const auto [made, fresh] = library_->domains_.emplace(task.skills, all);
    if (!fresh) continue;
    std::erase_if(made->second.actions, [&](const Action& action) {
      return replaced.contains(action.skill) || (!replaces(action).empty() && !listed(task.skills, action.skill));
    });
    name_constants(made->second);
  }
  name_constants(base);
}

void LibraryBuilder::read_action(const Definition& definition, const SkillInfo& info, const Value& fields,
                                 const std::string& case_name) {
  Action action;
  action.skill = info.name;
  action.case_name = case_name;
  action.name = case_name.empty() ? info.name : info.name + "_" + case_name;
  action.parameters = info.parameters;
  const Value& cost = fields["cost"].present() ? fields["cost"] : definition.node["cost"];
  if (cost.is_number()) action.cost = static_cast<int>(cost.number);
  if (action.cost < 0) complain(definition, "cost", "a cost is not negative");
  const std::string prefix = case_name.empty() ? "" : "cases." + case_name + ".";
  bool sound = guarded([&] {
    FormulaContext where = context(definition, prefix + "precondition");
    where.schema = true;
    where.parameters = info.parameters;
    if (fields["precondition"].present()) action.precondition = formula_from(fields["precondition"], where);
  });
  sound &= guarded([&] {
    FormulaContext where = context(definition, prefix + "effect");
    where.schema = true;
    where.parameters = info.parameters;
    if (fields["effect"].present()) action.effects = effects_from(fields["effect"], where);
  });
  const std::vector<std::string> names = names_of(info.parameters);
  for (const Value& pair : definition.node["may_equal"].items) {
    if (pair.items.size() != 2) {
      complain(definition, "may_equal", "a pair has two parameters", "such as may_equal = { { \"from\", \"to\" } }");
      continue;
    }
    for (const Value& name : pair.items) {
      if (!listed(names, name.text))
        complain(definition, "may_equal", "there is no parameter '" + name.text + "'", did_you_mean(name.text, names));
    }
    action.may_equal.emplace_back(pair.items[0].text, pair.items[1].text);
  }
  if (sound) library_->domain_.actions.push_back(std::move(action));
}

void LibraryBuilder::read_continuous(const Definition& definition, SkillInfo& info) {
  for (const auto& [name, node] : definition.node["continuous"].fields) {
    const std::string path = "continuous." + name;
    ContinuousInfo one;
    one.name = name;
    if (const auto fault = name_fault(name))
      complain(definition, path, "the name '" + name + "' " + *fault, "such as '" + proposed_name(name) + "'");
    if (name == "controller" || name == "stiffness") {
      complain(definition, path, "'" + name + "' is a continuous parameter of every skill already",
               "set the field " + name + " of the skill");
    }
    if (node.tag() == "stream") {
      read_stream(definition, path, info, one);
    } else if (node.is_number() || (node.is_table() && node.tag().empty())) {
      read_value(definition, path, node, one);
    } else {
      complain(definition, path, "a continuous parameter is a number, a list or a stream, this is " + node.type_name());
    }
    info.continuous.push_back(std::move(one));
  }
}

// stream("grasps", "part", "pull") or stream("sample", is.on("obj", "to")).
void LibraryBuilder::read_stream(const Definition& definition, const std::string& path, const SkillInfo& info,
                                 ContinuousInfo& one) {
  const Value& node = definition.node["continuous"][one.name];
  if (node["source"].text == "grasps") {
    const std::vector<std::string> names = names_of(info.parameters);
    one.source = ContinuousInfo::Source::grasps;
    one.object = node["object"].is_text() ? node["object"].text : names.empty() ? "" : names[0];
    if (!listed(names, one.object))
      complain(definition, path, "there is no parameter '" + one.object + "'", did_you_mean(one.object, names));
    one.to = node["to"].text;
    if (!one.to.empty() && !library_->numbers_.contains(one.to))
      add(unknown_number(error_at(definition, path, {}, {}).where(), one.to, numbers_.names()));
    return;
  }
  one.source = ContinuousInfo::Source::sample;
  FormulaContext where = context(definition, path);
  where.schema = true;
  where.parameters = info.parameters;
  const Formula literal = formula_from(node["literal"], where);
  one.literal.predicate = literal.predicate;
  for (const Term& term : literal.terms) one.literal.arguments.push_back(term.name);
  const auto predicate = of(DefinitionKind::predicate).find(literal.predicate);
  if (predicate == of(DefinitionKind::predicate).end() || !predicate->second.node["sample"].present())
    complain(definition, path, "the predicate '" + literal.predicate + "' has no sample to draw from",
             "give it one, or a fixed value here");
}

// 0.1, { 0.1, min = 0, max = 0.3, unit = "m" } or { { x, y, z }, unit = "m" }.
void LibraryBuilder::read_value(const Definition& definition, const std::string& path, const Value& node,
                                ContinuousInfo& one) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (node.is_number()) one.initial = {node.number};
  const bool vector = !node.items.empty() && node.items.front().is_table();
  for (const Value& item : vector ? node.items.front().items : node.items)
    if (item.is_number()) one.initial.push_back(item.number);
  if (one.initial.empty())
    complain(definition, path, "a continuous parameter begins with its default",
             "such as { 0.1, min = 0, max = 0.3, unit = \"m\" }");
  one.lower = bound(node["min"], one.initial.size(), -kInfinite);
  one.upper = bound(node["max"], one.initial.size(), kInfinite);
  one.unit = node["unit"].text;
  one.frame = node["frame"].text;
  for (std::size_t i = 0; i < one.initial.size(); ++i)
    if (one.initial[i] < one.lower[i] || one.initial[i] > one.upper[i])
      complain(definition, path, "its default " + std::to_string(one.initial[i]) + " lies outside min and max");
  const std::vector<std::string> known = {"min", "max", "unit", "frame"};
  for (const auto& [key, value] : node.fields)
    if (!listed(known, key))
      complain(definition, path + "." + key, "a continuous parameter has no field '" + key + "'",
               did_you_mean(key, known));
}

}  // namespace stampede
