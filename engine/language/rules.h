// Whether a sentence says what it has to, as far as words and facts tell.
//
// Nothing is believed: a word that nobody knows, a thing that is not there, an attribute that no fact bears out turn a
// sentence down. What tells the task's variations apart must be said as its author says it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/language/sentence.h"

namespace stampede {

enum class Rejection {
  too_short,
  too_long,
  not_a_sentence,  // nothing is done or said in it, or signs that no sentence has
  refused,         // the model excuses itself
  other_language,
  unknown_word,
  unknown_thing,  // the scene has none
  other_thing,    // it is there, and has no part in this
  missing_thing,  // what has to be named is not
  wrong_colour,
  wrong_count,
  wrong_side,     // left for right, the bottom for the top, behind for on
  unproved,       // an attribute that no fact bears out
  other_action,   // what is done is something else, or the opposite
  swapped_roles,  // the drawer into the cube
  swapped_order,
  negated,
  misses_steps,    // the grain asks for more, or it ends before the goal
  near_duplicate,  // of the author's, or of one that was taken
  asked_back,      // the model did not know its own sentence again
  no_answer,       // the model gave none that can be read
};
std::string_view to_string(Rejection reason);

using Grain = LanguageGrain;
inline std::string quoted(const std::string& word) { return "'" + word + "'"; }
using Fault = std::optional<std::string>;  // what is wrong, for people: which word, which thing; nothing: all is well

// One way in which a sentence can be wrong: as a whole, or in a stretch or in what it mentions, where neither the
// author says the same nor it has no part in this. Each is needed: without it some wrong sentence of the tests would
// pass.
struct Rule {
  Rejection reason;
  std::string_view name;
  std::variant<Fault (*)(const Sentence&), Fault (*)(const Sentence&, const Segment&),
               Fault (*)(const Sentence&, const Mention&)>
      fault;
  bool of_spared = false;  // it holds also of what is spared
  Fault broken_by(const Sentence& sentence) const;
};
std::span<const Rule> word_rules();   // of words, whatever they name
std::span<const Rule> thing_rules();  // of what is named: it is there, and has what is said of it
std::span<const Rule> deed_rules();   // of what is done: to what, where, in which order

struct Verdict {
  std::optional<Rejection> reason;  // nothing: it passes
  std::string detail;               // for people
  bool ok() const { return !reason; }
};

// The rules, for one meaning. Repeatable, and quick: well under a millisecond a sentence.
class SentenceChecker {
 public:
  explicit SentenceChecker(Meaning meaning);
  const Meaning& meaning() const { return meaning_; }
  Verdict check(const std::string& sentence, Grain grain = Grain::goal) const;
  // All rules that it breaks, by name: `check` tells of the first.
  std::vector<std::string_view> broken(const std::string& sentence, Grain grain = Grain::goal) const;

 private:
  Meaning meaning_;
  Claims claims_;
};

// Longest sentence of a grain, in words.
int most_words(Grain grain);

}  // namespace stampede
