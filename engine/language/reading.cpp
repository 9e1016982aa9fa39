#include "engine/language/reading.h"

#include <algorithm>

namespace stampede {

bool Reading::any(const Segment& segment, WordClass of) const {
  return std::any_of(words.begin() + static_cast<std::ptrdiff_t>(segment.begin),
                     words.begin() + static_cast<std::ptrdiff_t>(segment.end),
                     [&](const Word& word) { return word.is(of); });
}

const std::string& Reading::verb_of(const Segment& segment) const {
  static const std::string kNone;
  return segment.verb ? words[*segment.verb].sense : kNone;
}

bool Reading::ends_at(std::size_t word) const {
  return word >= words.size() || !words[word].follows() || words[word].is("join");
}

Reading read_sentence(const std::string& sentence, const Meaning& meaning) {
  Reading reading;
  reading.words = meaning.lexicon.read(sentence);
  read_pronouns(reading.words);
  read_turns(reading, meaning.lexicon.english());
  read_light_verbs(reading, meaning.lexicon);
  read_segments(reading);
  read_order(reading, meaning.lexicon.english());
  read_mentions(reading, meaning);
  return reading;
}

std::vector<std::string> content_of(const Reading& reading, const Segment& segment) {
  std::vector<std::string> senses;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    const Word& word = reading.words[i];
    const bool grammar = word.kind == WordKind::grammar && !word.is("way");
    if (!grammar && word.kind != WordKind::harmless && word.kind != WordKind::order) senses.push_back(word.sense);
  }
  return senses;
}

}  // namespace stampede
