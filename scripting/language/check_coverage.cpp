// Whether all is named that has to be.
#include "scripting/language/one_sentence.h"

namespace stampede {

// All that the author's sentence `own` names of what is wanted.
bool OneSentence::names_as(std::size_t own) const {
  const std::vector<Mention>& theirs = claims_.wanted[own];
  for (const Mention& one : claims_.own[own].mentions)  // `into the marked area`
    if (one.role.starts_with("to") && one.things.empty() &&
        std::none_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& ours) {
          return ours.sense == one.sense ||
                 (ours.role.starts_with("to") && may_be(ours, meaning_, &SpokenThing::destination));
        }))
      return false;
  if (theirs.empty()) return says_all_of(claims_.own[own]);
  return std::all_of(theirs.begin(), theirs.end(), [&](const Mention& one) {
    return std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& ours) {
      return std::any_of(ours.things.begin(), ours.things.end(), [&](const std::string& name) {
        return std::find(one.things.begin(), one.things.end(), name) != one.things.end();
      });
    });
  });
}

// At least what one of the author's own sentences names.
Maybe OneSentence::coverage() const {
  bool names = false;
  for (std::size_t i = 0; i < claims_.wanted.size(); ++i) {
    if (names_as(i)) return {};
    names |= !claims_.wanted[i].empty();
  }
  if (!names || names_all()) return {};
  for (const std::string& name : goal_things())
    if (!is_named(name)) return no(Rejection::missing_thing, "nothing names the " + name);
  return no(Rejection::missing_thing, "less is named than in any sentence of the author");
}

// All nouns of a sentence that names nothing by the scene's words: `bin the paper`.
bool OneSentence::says_all_of(const Reading& own) const {
  return !own.mentions.empty() && std::all_of(own.mentions.begin(), own.mentions.end(), [&](const Mention& one) {
    return std::any_of(reading_.mentions.begin(), reading_.mentions.end(),
                       [&](const Mention& ours) { return ours.sense == one.sense; });
  });
}

bool OneSentence::carries() const {
  return std::any_of(meaning_.things.begin(), meaning_.things.end(), [](const auto& one) { return one.moved; });
}

// What is carried, and to where; else what is handled. The table goes without saying.
std::vector<std::string> OneSentence::goal_things() const {
  std::vector<std::string> names;
  for (const SpokenThing& one : meaning_.things)
    if (carries() ? one.moved || (one.destination && !one.heads.contains("table")) : one.handled)
      names.push_back(one.name);
  return names;
}

bool OneSentence::is_named(const std::string& name) const {
  return std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& mention) {
    return std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& one) {
      return one == name || one.starts_with(name + ".") || name.starts_with(one + ".");
    });
  });
}

// `hang up the picture`, `plug in the charger`: where there is one place for it
bool OneSentence::is_implied(const std::string& name) const {
  static const std::map<std::string, std::string> kImply = {{"hang", "hang"}, {"insert", "insert"}};
  for (const Segment& segment : reading_.segments) {
    const auto skill = segment.verb ? kImply.find(reading_.words[*segment.verb].sense) : kImply.end();
    if (skill == kImply.end()) continue;
    const SpokenThing* place = thing(name);
    for (const PlanStep& step : meaning_.steps)
      for (std::size_t i = 1; i < step.arguments.size() && step.action == skill->second; ++i)
        if ((step.arguments[i] == name || step.arguments[i].starts_with(name + ".")) &&
            std::none_of(meaning_.things.begin(), meaning_.things.end(), [&](const SpokenThing& other) {
              return other.name != name && !other.name.starts_with(name + ".") && !name.starts_with(other.name + ".") &&
                     std::any_of(other.heads.begin(), other.heads.end(),
                                 [&](const std::string& head) { return place->heads.contains(head); });
            }))
          return true;
  }
  return false;
}

bool OneSentence::names_all() const {
  const std::vector<std::string> names = goal_things();
  return !names.empty() &&
         std::all_of(names.begin(), names.end(), [&](const auto& name) { return is_named(name) || is_implied(name); });
}

}  // namespace stampede
