// Whether all is named that has to be.
#include "scripting/language/one_sentence.h"

namespace stampede {

// At least what one of the author's own sentences names.
Maybe OneSentence::coverage() const {
  bool names = false;
  for (std::size_t i = 0; i < claims_.wanted.size(); ++i) {
    const std::vector<Mention>& own = claims_.wanted[i];
    if (own.empty() && says_all_of(claims_.own[i])) return {};
    if (own.empty()) continue;
    names = true;
    const bool all = std::all_of(own.begin(), own.end(), [&](const Mention& one) {
      return std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& ours) {
        return std::any_of(ours.things.begin(), ours.things.end(), [&](const std::string& name) {
          return std::find(one.things.begin(), one.things.end(), name) != one.things.end();
        });
      });
    });
    if (all) return {};
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

bool OneSentence::names_all() const {
  const std::vector<std::string> names = goal_things();
  return !names.empty() && std::all_of(names.begin(), names.end(), [&](const auto& name) { return is_named(name); });
}

}  // namespace stampede
