// Parameters of predicates and skills, and what labels name of them.
#include "scripting/library/checks.h"

namespace stampede {

std::vector<Parameter> parameters_of(LibraryDraft& draft, const Definition& definition) {
  std::vector<Parameter> result;
  const std::string place = definition.place("params");
  for (const Value& text : definition.node["params"].items) {
    if (!text.is_text()) continue;
    Parameter parameter;
    try {
      parameter = parameter_from(text.text, draft.vocabulary().domain, place);
    } catch (const Error& error) {
      draft.complaints().add(Error(error.where(), "params: " + error.message(), error.hint()));
      parameter.name = text.text.substr(0, text.text.find(':'));  // kept, so that one fault is one complaint
    }
    if (listed(names_of(result), parameter.name))
      definition.complain("params", "two parameters are called '" + parameter.name + "'", "rename one");
    else
      result.push_back(std::move(parameter));
  }
  return result;
}

void check_label(const Definition& definition, const std::vector<Parameter>& parameters) {
  const std::vector<std::string> names = names_of(parameters);
  const std::string& label = definition.node["label"].text;
  for (std::size_t open = label.find('{'); open != std::string::npos; open = label.find('{', open + 1)) {
    const std::size_t close = label.find('}', open);
    if (close == std::string::npos) return definition.complain("label", "a { without }");
    const std::string name = label.substr(open + 1, close - open - 1);
    if (!listed(names, name)) definition.complain_unknown("label", "parameter", name, names);
  }
}

}  // namespace stampede
