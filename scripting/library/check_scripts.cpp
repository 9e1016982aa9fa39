// What scripts call, as far as their texts tell: nothing of it runs here.
#include <algorithm>

#include "scripting/library/checks.h"
#include "scripting/library/embedded.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

// Of `w`, `robot` or `rng`, as words.lua tells editors.
std::vector<std::string> methods_of(std::string_view of) {
  const std::string head = "function stampede_" + std::string(of) + ":";
  const std::string_view words = kWordsSource;
  std::vector<std::string> names;
  for (std::size_t at = words.find(head); at != std::string_view::npos; at = words.find(head, at)) {
    at += head.size();
    names.emplace_back(words.substr(at, words.find('(', at) - at));
  }
  return names;
}

// The names of a function's parameters: `run = function(robot, p, c)`.
std::vector<std::string> parameters_of_run(std::string_view source) {
  std::vector<std::string> names;
  for (const std::string_view head : {"run = function(", "run=function("}) {
    std::size_t at = source.find(head);
    if (at == std::string_view::npos) continue;
    at += head.size();
    std::string name;
    for (; at < source.size(); ++at) {
      const char c = source[at];
      if (c == ',' || c == ')') names.push_back(std::exchange(name, {}));
      if (c == ')') break;
      if (c != ',' && c != ' ') name += c;
    }
    return names;
  }
  return names;
}

// Is the name given to something of the script's own too?
bool is_local(std::string_view source, const std::string& name) {
  for (const std::string& form : {"local " + name + " ", "local " + name + ",", "local " + name + "\n",
                                  ", " + name + " =", "for " + name + " ", "for " + name + ","})
    if (source.find(form) != std::string_view::npos) return true;
  return false;
}

// What a skill's run takes of its parameters: run = function(robot, p, c).
void check_run(LibraryDraft& draft, const Definition& skill) {
  const std::string& source = skill.file->source;
  const std::vector<std::string> names = parameters_of_run(source);
  const Mentions mentions = mentions_in(source);
  std::vector<std::string> parameters = skill.parameter_names(), continuous = {"controller", "stiffness"};
  parameters.emplace_back("hand");
  for (const auto& [name, value] : skill.node["continuous"].fields) continuous.push_back(name);
  const auto check = [&](std::size_t place, const std::vector<std::string>& known, const char* field) {
    if (names.size() <= place || is_local(source, names[place])) return;
    for (const auto& [member, line] : mentions.members)
      if (member.first == names[place] && !listed(known, member.second))
        draft.complaints().add(
            Error(place_in(*skill.file, line),
                  "run: " + member.first + "." + member.second + " is nothing that the skill declares in " + field,
                  did_you_mean(member.second, known)));
  };
  check(1, parameters, "params");
  check(2, continuous, "continuous");
}

}  // namespace

void check_scripts(LibraryDraft& draft) {
  const std::map<std::string, std::vector<std::string>> known = {
      {"w", methods_of("world_view")}, {"robot", methods_of("robot_view")}, {"rng", methods_of("random")}};
  for (const ScriptFile& file : draft.files()) {
    if (file.kind == DefinitionKind::object || file.kind == DefinitionKind::world) continue;
    for (const auto& [call, line] : mentions_in(file.source).methods) {
      const auto owner = known.find(call.first);
      if (owner == known.end() || listed(owner->second, call.second)) continue;
      if (file.source.find("function " + call.first + ":") != std::string::npos) continue;  // its own, of that name
      draft.complaints().add(Error(place_in(file, line), call.first + " has no method '" + call.second + "'",
                                   did_you_mean(call.second, owner->second)));
    }
  }
  for (const auto& [name, definition] : draft.of(DefinitionKind::skill)) check_run(draft, definition);
}

}  // namespace stampede
