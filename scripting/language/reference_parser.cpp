#include "scripting/language/reference_parser.h"

#include "scripting/language/parser_parts.h"

namespace stampede {

Reading read_sentence(const std::string& sentence, const Meaning& meaning) {
  Reading reading;
  reading.words = meaning.lexicon.read(sentence);
  for (std::size_t i = 0; i < reading.words.size(); ++i)
    if (is_pronoun_one(reading.words, i)) reading.words[i].kind = WordKind::function;
  read_turns(reading.words);
  read_light_verbs(reading.words);
  reading.segments = segments_of(reading.words);
  reading.in_time = order_in_time(reading.words, reading.segments);
  read_mentions(reading, meaning);
  return reading;
}

std::vector<std::string> content_of(const Reading& reading, std::size_t begin, std::size_t end) {
  std::vector<std::string> senses;
  for (std::size_t i = begin; i < end; ++i) {
    const WordKind kind = reading.words[i].kind;
    const std::string& text = reading.words[i].text;
    const bool way = kPrepositions.contains(text) || text == "up" || text == "down" || text == "out";
    if ((kind == WordKind::function && !way) || kind == WordKind::harmless || kind == WordKind::order) continue;
    senses.push_back(reading.words[i].sense);
  }
  return senses;
}

}  // namespace stampede
