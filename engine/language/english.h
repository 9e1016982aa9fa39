// What a language has by itself: words, their endings and classes, phrases. English's are in worlds/words.lua.
#pragma once

#include <array>
#include <bitset>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stampede {

enum class WordKind {
  grammar,    // says nothing of the scene
  harmless,   // manner and politeness
  exclusion,  // others, except
  negation,
  order,  // first, then, before, after, finally
  number,
  place,      // left, top, second: tells things of one kind apart
  adjective,  // claims something: `wooden`, `big`
  colour,
  noun,
  verb,
  own,      // a word that only the task's own sentences explain
  unknown,  // none of these
};
// Those that worlds/words.lua lists, in the order of the enumerators; a word of several is the first of them where
// nothing tells.
inline constexpr std::array<std::string_view, 11> kWordKinds = {
    "grammar", "harmless", "exclusion", "negation", "order", "number", "place", "adjective", "colour", "noun", "verb"};

// What rules ask of a word beside its kind; worlds/words.lua says which words these are, and what for.
inline constexpr std::array kWordClasses = std::to_array<std::string_view>(
    {"above",     "after",   "again",      "air",      "all",          "already",      "article", "assembling",
     "away",      "back",    "be",         "before",   "belonging",    "both",         "built",   "by",
     "demanding", "excuse",  "from",       "general",  "general_type", "getting",      "given",   "giving",
     "going",     "grip",    "hanging",    "holding",  "implying",     "in_state",     "inside",  "instead",
     "into",      "join",    "keeping",    "lasting",  "leaving",      "located",      "modal",   "noun_follows",
     "of",        "off",     "on",         "one",      "openness",     "other",        "others",  "painted",
     "polite",    "putting", "putting_up", "relative", "several",      "shut",         "sided",   "sparing",
     "standing",  "state",   "stating",    "stative",  "swinging",     "switching",    "table",   "taking",
     "telling",   "towards", "turning",    "until",    "upon",         "verb_follows", "way",     "where",
     "wishing",   "with"});

// One of them by name; another name does not compile.
class WordClass {
 public:
  consteval WordClass(const char* name) {  // NOLINT: a name is one
    while (index_ < kWordClasses.size() && kWordClasses[index_] != name) ++index_;
    if (index_ == kWordClasses.size()) throw "there is no such class of words";
  }
  constexpr std::size_t index() const { return index_; }

 private:
  std::size_t index_ = 0;
};

struct English {
  struct Entry {
    std::string sense;  // what all its synonyms share: `block` of cubes
    WordKind kind;
  };
  struct Ending {  // `ies` for `y`; `s`, unless it is `ss`
    std::string from, to, unless;
    bool plural = false, done = false;  // of nouns; of verbs: done to what was named
  };
  struct LightVerb {  // `get … into`, `turn … on`: what they mean comes with another word
    std::set<std::string> verbs, with;
    std::string means;
    bool beside = false;  // that word follows at once, or ends the stretch
    bool unless = false;  // where none of those words follows
  };
  struct Stem {
    std::string text;
    bool plural = false;
  };
  // What a word may be a form of, the word itself first.
  std::vector<Stem> stems(const std::string& word) const;
  bool is_done(const std::string& word) const;  // `pushed`
  void add(const std::string& word, const std::string& sense, WordKind kind);
  bool has(const std::string& word, WordClass of) const;

  std::map<std::string, std::vector<Entry>, std::less<>> words;
  std::vector<Ending> endings;
  std::map<std::string, Stem, std::less<>> irregular;  // took: take
  // By first word, the longest first.
  std::map<std::string, std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>> phrases;
  std::map<std::string, std::bitset<kWordClasses.size()>, std::less<>> classes;
  std::vector<LightVerb> light_verbs;
  std::map<std::string, int> ranks;                          // of turns: second is 2, last is 99
  std::map<std::string, std::string> prepositions;           // what a thing is after it: to, from, of, with …
  std::map<std::string, std::set<std::string>> particles;    // of a verb: switch on
  std::map<std::string, std::string> directions, opposites;  // of verbs: lift is up; open and close
  std::map<std::string, std::set<std::string>> skills;       // that a verb tells of
};

std::vector<std::string> words_in(const std::string& text);  // between blanks

}  // namespace stampede
