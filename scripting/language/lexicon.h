// Words: what each of a sentence's words is, in a lexicon of our own that a task's things and sentences add to.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stampede {

enum class WordKind {
  function,   // grammar, says nothing of the scene
  harmless,   // manner and politeness
  adjective,  // claims something: `wooden`, `big`
  colour,
  number,
  place,  // left, top, second: tells things of one kind apart
  order,  // first, then, before, after, finally
  negation,
  exclusion,  // others, except
  noun,
  verb,
  own,      // a word that only the task's own sentences explain
  unknown,  // none of these
};

struct Word {
  std::string text;   // lower case
  std::string sense;  // what all its synonyms share: `block` of cubes
  WordKind kind = WordKind::unknown;
  bool plural = false;
  char before = ' ';  // the punctuation before it: , ; : . or a blank
};

// Words by lower-case text. Immutable after learning; cheap to copy is not needed: one a task.
class Lexicon {
 public:
  Lexicon();  // what the language has by itself
  // What a thing is called, words with _ or blanks between them; each unknown word becomes a noun.
  void learn_noun(std::string_view name);
  void learn_colour(std::string_view name);
  // Words of a sentence that nobody knows become `own`.
  void learn_own(std::string_view sentence);
  std::vector<Word> read(std::string_view sentence) const;  // each word on its own, then by its neighbours
  // The sense of a noun: `cubes` is `block`. An unknown one is itself.
  std::string sense_of_noun(std::string_view word) const;
  // Which skills a verb may tell of; empty: none.
  const std::set<std::string>& skills_of(const std::string& verb) const;

 private:
  struct Entry {
    std::string sense;
    WordKind kind;
  };
  const std::vector<Entry>* entries(const std::string& word, bool& plural, WordKind wanted) const;
  Word choose(const std::string& text, const std::vector<Word>& before, char punctuation,
              const std::string& next) const;
  std::map<std::string, std::vector<Entry>, std::less<>> words_;
  std::map<std::string, std::set<std::string>> skills_;
  std::set<std::string> noun_senses_;
};

extern const char* const kLexiconText;  // lines `kind sense [skills]: words`
extern const char* const kPhraseText;   // lines `words=what they mean`

// Sentences in words as people write them: lower case, no blanks at the ends, phrases of several words as one.
struct PlainWord {
  std::string text;
  char before = ' ';
};
std::vector<PlainWord> plain_words(std::string_view sentence);
std::string spaced_name(std::string name);                   // blanks for _
std::vector<std::string> words_in(const std::string& text);  // between blanks

}  // namespace stampede
