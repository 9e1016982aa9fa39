// worlds/words.lua, and the nouns and verbs that types, objects and skills have of their own, as English.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/language/lexicon.h"
#include "scripting/library/draft.h"

namespace stampede {

// Adds what the file says; a later file's entries add to those of the files before it, or take their place.
void read_english(const Definition& file, English& english);

// What types, objects and skills add, each looked up in the words that there are by then.
class WordsOfThings {
 public:
  explicit WordsOfThings(std::shared_ptr<English> english) : english_(*english), lexicon_(std::move(english)) {}
  // Blank-separated words or a list of them that name what `name` names: `cup` is also a `mug`.
  void add_nouns(const std::string& name, const Value& nouns);
  // That tell of the skill: any form of a verb, alone or with what belongs to it: `pick up`.
  void add_verbs(const std::string& skill, const std::vector<std::string>& verbs);

 private:
  English& english_;
  const Lexicon lexicon_;
};

}  // namespace stampede
