#include "engine/learning/truth_table.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace stampede::learning {
namespace {

struct Said {
  bool denied = false;
  std::vector<std::set<std::string>> types;  // by place, of what it is said of
};

const std::string* type_of(const JudgedFrame& frame, const std::string& object) {
  for (const TypedObject& one : *frame.objects)
    if (one.name == object) return &one.type;
  return nullptr;
}

void add_denials(JudgedFrame& frame, const std::string& predicate, const Said& said, Fact& begun) {
  const std::size_t place = begun.arguments.size();
  if (place == said.types.size()) {
    if (!frame.yes.contains(begun)) frame.no.insert(begun);
    return;
  }
  for (const TypedObject& one : *frame.objects) {
    if (!said.types[place].contains(one.type)) continue;
    if (std::find(begun.arguments.begin(), begun.arguments.end(), one.name) != begun.arguments.end()) continue;
    begun.arguments.push_back(one.name);
    add_denials(frame, predicate, said, begun);
    begun.arguments.pop_back();
  }
}

}  // namespace

void complete(std::vector<JudgedFrame>& frames) {
  std::map<std::string, Said> predicates;
  for (const JudgedFrame& frame : frames) {
    for (const Fact& fact : frame.no) predicates[fact.predicate].denied = true;
    for (const Fact& fact : frame.yes) {
      Said& said = predicates[fact.predicate];
      if (said.types.size() < fact.arguments.size()) said.types.resize(fact.arguments.size());
      for (std::size_t i = 0; i < fact.arguments.size(); ++i)
        if (const std::string* type = type_of(frame, fact.arguments[i])) said.types[i].insert(*type);
    }
  }
  for (JudgedFrame& frame : frames)
    for (const auto& [predicate, said] : predicates) {
      Fact begun{predicate, {}};
      if (!said.denied) add_denials(frame, predicate, said, begun);
    }
}

}  // namespace stampede::learning
