// Whether each word may be there, and what is denied.
#include <algorithm>

#include "engine/language/rules.h"

namespace stampede {
namespace {

Fault one_word(const Sentence& sentence) {
  const std::size_t count = sentence.reading.words.size();
  return count < 2 ? Fault(std::to_string(count) + " words") : std::nullopt;
}

Fault many_words(const Sentence& sentence) {
  const auto count = static_cast<int>(sentence.reading.words.size());
  return count > most_words(sentence.grain) ? Fault(std::to_string(count) + " words") : std::nullopt;
}

Fault odd_signs(const Sentence& sentence) {
  const std::string signs = sentence.meaning.slots ? "\n\t<>[]|*#`=\\" : "\n\t<>[]|*#`=\\_{}";
  const std::size_t at = sentence.text.find_first_of(signs);
  return at == std::string::npos ? std::nullopt : Fault(std::string("it has a `") + sentence.text[at] + "`");
}

// What a sentence with words that nobody knows is: an excuse, another language, or ours but for these.
enum class Tongue { known, excuse, foreign, ours };

std::pair<Tongue, std::string> tongue_of(const Sentence& sentence) {
  const std::vector<Word>& words = sentence.reading.words;
  const auto is_unknown = [](const Word& word) { return word.kind == WordKind::unknown; };
  const auto first = std::find_if(words.begin(), words.end(), is_unknown);
  const auto unknown = std::count_if(words.begin(), words.end(), is_unknown);
  const auto excuses = std::count_if(words.begin(), words.end(), [](const Word& word) { return word.is("excuse"); });
  if (excuses > 1 || (excuses > 0 && unknown > 0)) return {Tongue::excuse, sentence.text.substr(0, 60)};
  for (const Word& word : words)
    if (std::any_of(word.text.begin(), word.text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
      return {Tongue::foreign, quoted(word.text)};
  if (2 * unknown > std::ssize(words))
    return {Tongue::foreign, std::to_string(unknown) + " of " + std::to_string(words.size()) + " words unknown"};
  return unknown > 0 ? std::pair(Tongue::ours, quoted(first->text)) : std::pair(Tongue::known, std::string());
}

template <Tongue tongue>
Fault is_in(const Sentence& sentence) {
  const auto [found, detail] = tongue_of(sentence);
  return found == tongue ? Fault(detail) : std::nullopt;
}

Fault said_of_the_start(const Sentence& sentence) {
  for (const Segment& segment : sentence.reading.segments)
    if (sentence.reading.any(segment, "already") && !sentence.vouched(segment)) return "what is so already";
  return {};
}

Fault denied(const Sentence& sentence) {
  for (const Segment& segment : sentence.reading.segments) {
    if (!(segment.negated || segment.excluding) || sentence.vouched(segment) || sentence.spares_others(segment) ||
        sentence.spares_idle(segment) || sentence.leaves_idle(segment) || sentence.denies_start(segment))
      continue;
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      if (const Word& word = sentence.reading.words[i];
          word.kind == WordKind::negation || word.kind == WordKind::exclusion)
        return quoted(word.text);
  }
  return {};
}

// `leave the block on the table`: it has to go somewhere else.
Fault left_behind(const Sentence& sentence) {
  for (const Segment& segment : sentence.reading.segments) {
    if (!sentence.reading.at(segment.verb, "leaving") || sentence.vouched(segment) || sentence.denies_start(segment))
      continue;
    const Mention* object = nullptr;
    bool to = false;
    for (const Mention& mention : sentence.reading.mentions) {
      if (!segment.holds(mention.head)) continue;
      if (object == nullptr && !mention.after) object = &mention;
      to |= mention.part == "to" && mention.roles.destination && !mention.roles.source;
    }
    if (object != nullptr && !object->other && object->roles.wanted && !to)
      return "the " + object->sense + " may not be left";
  }
  return {};
}

std::vector<std::string> slots_of(const Reading& reading) {
  std::vector<std::string> found;
  for (const Word& word : reading.words)
    if (word.text.starts_with('{')) found.push_back(word.text);
  return found;
}

// All of them, in another order.
Fault swapped_slots(const Sentence& sentence) {
  if (!sentence.meaning.slots) return {};
  const std::vector<std::string> ours = slots_of(sentence.reading), theirs = slots_of(sentence.claims.own.front());
  if (ours == theirs || Texts(ours.begin(), ours.end()) != Texts(theirs.begin(), theirs.end())) return {};
  return "of the slots";
}

}  // namespace

std::span<const Rule> word_rules() {
  using enum Rejection;
  static const Rule kRules[] = {
      {too_short, "one word", one_word},
      {too_long, "many words", many_words},
      {not_a_sentence, "odd signs", odd_signs},
      {refused, "excuse", is_in<Tongue::excuse>},
      {other_language, "foreign words", is_in<Tongue::foreign>},
      {unknown_word, "unknown word", is_in<Tongue::ours>},
      {Rejection::unproved, "said of the start", said_of_the_start},
      {negated, "denied", denied},
      {negated, "left behind", left_behind},
      {swapped_roles, "swapped slots", swapped_slots},
  };
  return kRules;
}

}  // namespace stampede
