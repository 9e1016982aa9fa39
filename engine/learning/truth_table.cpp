#include "engine/learning/truth_table.h"

#include <algorithm>
#include <set>

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

std::map<std::string, Confusion> score_predicates(const std::vector<JudgedFrame>& frames) {
  std::map<std::string, Confusion> scores;
  for (const JudgedFrame& frame : frames) {
    std::set<std::string> asked;
    for (const Facts* said : {&frame.yes, &frame.no})
      for (const Fact& fact : *said) asked.insert(fact.predicate);
    for (const Fact& fact : frame.yes) {
      Confusion& score = scores[fact.predicate];
      (frame.truth.contains(fact) ? score.both : score.only_said) += 1;
    }
    for (const Fact& fact : frame.no) {
      Confusion& score = scores[fact.predicate];
      (frame.truth.contains(fact) ? score.only_true : score.neither) += 1;
    }
    for (const Fact& fact : frame.truth)
      if (asked.contains(fact.predicate) && !frame.yes.contains(fact) && !frame.no.contains(fact))
        ++scores[fact.predicate].only_true;
  }
  return scores;
}

}  // namespace stampede::learning
