// What scripts call, as far as their texts tell: nothing of it runs here.
#include <algorithm>
#include <cctype>
#include <set>

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

// What a method gives, as words.lua tells editors: `number x, number y, number z`.
std::string given_by(std::string_view method) {
  const std::string_view words = kWordsSource;
  constexpr std::string_view kReturn = "---@return ";
  const std::size_t at = words.find(":" + std::string(method) + "(");
  const std::size_t line = at == std::string_view::npos ? at : words.rfind('\n', at);
  if (line == std::string_view::npos || line == 0) return {};
  const std::size_t before = words.rfind('\n', line - 1) + 1;
  const std::string_view last = words.substr(before, line - before);
  return std::string(last.starts_with(kReturn) ? last.substr(kReturn.size()) : std::string_view());
}

// Is it a parameter of some function, or a variable of a loop?
bool is_bound(std::string_view source, const std::string& name) {
  for (const std::string_view word : {"function", "for "})
    for (std::size_t at = source.find(word); at != std::string_view::npos; at = source.find(word, at + 1)) {
      const std::string_view rest = source.substr(at + word.size());
      std::string bound;
      for (const char c : rest.substr(0, rest.find(word == "for " ? '\n' : ')')))
        bound += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ? c : ' ';
      if ((" " + bound + " ").find(" " + name + " ") != std::string::npos) return true;
    }
  return false;
}

// The last method of the calls that a text begins with: `position` of `robot:view():position(p.obj)`. Empty: no call.
std::string last_method(std::string_view value) {
  std::string method;
  for (;;) {
    const std::size_t colon = value.find_first_of(":({\n ."), open = value.find_first_of("({\n ", colon);
    if (colon == std::string_view::npos || open == std::string_view::npos || value[colon] != ':' || value[open] != '(')
      return method;
    method = value.substr(colon + 1, open - colon - 1);
    int depth = 0;
    std::size_t end = open;
    for (; end < value.size(); ++end) {
      depth += value[end] == '(' ? 1 : value[end] == ')' ? -1 : 0;
      if (depth == 0) break;
    }
    value.remove_prefix(std::min(end + 1, value.size()));
  }
}

// The method whose value has this name: `local at = w:position(`. Empty: another value has it, perhaps too.
std::string method_behind(std::string_view source, const std::string& name) {
  if (is_bound(source, name)) return {};
  std::string found;
  const std::string head = name + " = ";
  for (std::size_t at = source.find(head); at != std::string_view::npos; at = source.find(head, at + 1)) {
    const char before = at == 0 ? '\n' : source[at - 1];
    if (std::isalnum(static_cast<unsigned char>(before)) != 0 || before == '_' || before == '.') continue;
    const std::string method = last_method(source.substr(at + head.size()));
    if (method.empty() || (!found.empty() && found != method)) return {};
    found = method;
  }
  return found;
}

// pos.x where pos = w:position(…), whose numbers come one by one; at.x where at = w:pose(…). The first of each.
void check_values(LibraryDraft& draft, const ScriptFile& file, const Mentions& mentions) {
  const std::vector<std::string> of_poses = methods_of("pose");
  std::set<std::string> told;
  for (const auto& [member, line] : mentions.members) {
    const auto& [owner, name] = member;
    const std::string method = method_behind(file.source, owner), given = method.empty() ? "" : given_by(method);
    const bool numbers = given.starts_with("number "), pose = given == "stampede.pose" && !listed(of_poses, name);
    if ((!numbers && !pose) || !told.insert(owner).second) continue;
    const std::string what = owner + "." + name + ": ";
    if (numbers)
      draft.complaints().add(Error(place_in(file, line),
                                   what + "'" + method + "' gives its numbers one by one, and no table",
                                   "local x, y, z = …:" + method + "(…)"));
    else
      draft.complaints().add(Error(place_in(file, line), what + "a pose has no field '" + name + "'",
                                   "local x, y, z = " + owner + ":position()"));
  }
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
    const Mentions mentions = mentions_in(file.source);
    check_values(draft, file, mentions);
    for (const auto& [call, line] : mentions.methods) {
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
