// Words: what each of a sentence's words is, in a language's words and those that a task's things and sentences add.
#pragma once

#include <memory>

#include "engine/language/english.h"

namespace stampede {

struct Word {
  std::string text;   // lower case
  std::string sense;  // what all its synonyms share: `block` of cubes
  WordKind kind = WordKind::unknown;
  bool plural = false, done = false;              // of nouns; of verbs: `pushed`
  char before = ' ';                              // the punctuation before it: , ; : . or a blank
  std::bitset<kWordClasses.size()> classes = {};  // of its text and of its sense
  bool is(WordClass of) const { return classes.test(of.index()); }
  bool follows() const { return before == ' '; }  // nothing stands before it in its stretch but a blank
};

// Immutable after learning.
class Lexicon {
 public:
  explicit Lexicon(std::shared_ptr<const English> english = std::make_shared<English>())
      : english_(std::move(english)) {}
  const English& english() const { return *english_; }
  // What a thing is called, words with _ or blanks between them; each unknown word becomes a noun.
  void learn_noun(std::string_view name);
  void learn_colour(const std::string& name);
  // Words of a sentence that nobody knows become `own`.
  void learn_own(std::string_view sentence);
  std::vector<Word> read(std::string_view sentence) const;  // each word on its own, then by its neighbours
  // The sense of a noun: `cubes` is `block`. An unknown one is itself.
  std::string sense_of_noun(const std::string& word) const;
  // Which skills a verb may tell of; empty: none.
  const std::set<std::string>& skills_of(const std::string& verb) const;
  void set_kind(Word& word, WordKind kind, const std::string& sense) const;

 private:
  using Entries = std::vector<English::Entry>;
  struct Known {  // what a word may be
    std::string sense;
    WordKind kind;
    bool plural;
  };
  const Entries* exactly(const std::string& word) const;
  std::vector<Known> known(const std::string& word) const;  // itself first, then what it is a form of
  std::vector<WordKind> due(const std::string& text, const std::vector<Word>& before, char punctuation,
                            const std::string& next) const;
  Word choose(const std::string& text, const std::vector<Word>& before, char punctuation,
              const std::string& next) const;
  void learn(const std::string& word, const std::string& sense, WordKind kind);

  std::shared_ptr<const English> english_;
  std::map<std::string, Entries, std::less<>> learned_;  // in place of the language's own
};

// Sentences in words as people write them: lower case, no blanks at the ends, phrases of several words as one.
struct PlainWord {
  std::string text;
  char before = ' ';
};
std::vector<PlainWord> plain_words(std::string_view sentence, const English& english);
std::string spaced_name(std::string name);              // blanks for _
std::vector<std::string> name_words(std::string name);  // of `chest.top_drawer2`: chest top drawer

}  // namespace stampede
