#include "engine/language/rules.h"

#include <algorithm>
#include <array>

#include "engine/base/enum_names.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 21> kRejections = {
    "too_short",      "too_long",     "not_a_sentence", "refused",       "other_language", "unknown_word",
    "unknown_thing",  "other_thing",  "missing_thing",  "wrong_colour",  "wrong_count",    "wrong_side",
    "unproved",       "other_action", "swapped_roles",  "swapped_order", "negated",        "misses_steps",
    "near_duplicate", "asked_back",   "no_answer"};

std::array<std::span<const Rule>, 3> all_rules() { return {word_rules(), thing_rules(), deed_rules()}; }

// Whether each word may be there, and what is denied.

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
Rejection tongue_of(const Word& word) {
  const bool ascii = std::ranges::all_of(word.text, [](unsigned char c) { return c < 0x80; });
  return word.is("excuse") ? Rejection::refused : ascii ? Rejection::unknown_word : Rejection::other_language;
}

template <Rejection tongue>
Fault unknown(const Sentence& sentence) {
  std::ptrdiff_t unknown = 0;
  Fault found;
  for (const Word& word : sentence.reading.words) {
    if (word.kind != WordKind::unknown) continue;
    ++unknown;
    if (tongue_of(word) == tongue && !found) found = quoted(word.text);
  }
  const bool most = 2 * unknown > std::ssize(sentence.reading.words);
  return tongue == Rejection::other_language && most ? "most of its words are unknown" : found;
}

Fault said_of_the_start(const Sentence& sentence, const Segment& segment) {
  return sentence.reading.any(segment, "already") ? Fault("what is so already") : std::nullopt;
}

Fault denied(const Sentence& sentence, const Segment& segment) {
  if (!segment.negated && !segment.excluding) return {};
  for (std::size_t i = segment.begin; i < segment.end; ++i)
    if (const Word& word = sentence.reading.words[i];
        word.kind == WordKind::negation || word.kind == WordKind::exclusion)
      return quoted(word.text);
  return {};
}

// `leave the block on the table`: it has to go somewhere else.
Fault left_behind(const Sentence& sentence, const Segment& segment) {
  const Mention* object = nullptr;
  bool to = !sentence.reading.at(segment.verb, "leaving");
  for (const Mention& mention : sentence.reading.mentions_of(segment)) {
    if (object == nullptr && !mention.after) object = &mention;
    to |= mention.part == "to" && mention.roles.destination && !mention.roles.source;
  }
  if (to || object == nullptr || object->other || !object->roles.wanted) return {};
  return "the " + object->sense + " may not be left";
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
      {refused, "excuse", unknown<refused>},
      {other_language, "other language", unknown<other_language>},
      {unknown_word, "unknown word", unknown<unknown_word>},
      {Rejection::unproved, "said of the start", said_of_the_start},
      {negated, "denied", denied},
      {negated, "left behind", left_behind},
      {swapped_roles, "swapped slots", swapped_slots},
  };
  return kRules;
}

std::string_view to_string(Rejection reason) { return enum_name(kRejections, reason); }

int most_words(Grain grain) { return grain == Grain::goal ? 40 : grain == Grain::steps ? 80 : 120; }

Fault Rule::broken_by(const Sentence& sentence) const {
  if (const auto* whole = std::get_if<0>(&fault)) return (*whole)(sentence);
  const auto skipped = [&](const Segment& segment) {
    return sentence.vouched(segment) || (!of_spared && sentence.spares(segment));
  };
  if (const auto* stretch = std::get_if<1>(&fault))
    for (const Segment& segment : sentence.reading.segments)
      if (!skipped(segment))
        if (Fault found = (*stretch)(sentence, segment)) return found;
  if (const auto* named = std::get_if<2>(&fault))
    for (const Mention& mention : sentence.reading.mentions)
      if (!skipped(sentence.segment(mention)))
        if (Fault found = (*named)(sentence, mention)) return found;
  return {};
}

SentenceChecker::SentenceChecker(Meaning meaning) : meaning_(std::move(meaning)), claims_(claims_of(meaning_)) {}

Verdict SentenceChecker::check(const std::string& text, Grain grain) const {
  const Sentence sentence(text, meaning_, claims_, grain);
  for (const std::span<const Rule> rules : all_rules())
    for (const Rule& rule : rules)
      if (Fault fault = rule.broken_by(sentence)) return {rule.reason, std::move(*fault)};
  return {};
}

std::vector<std::string_view> SentenceChecker::broken(const std::string& text, Grain grain) const {
  const Sentence sentence(text, meaning_, claims_, grain);
  std::vector<std::string_view> names;
  for (const std::span<const Rule> rules : all_rules())
    for (const Rule& rule : rules)
      if (rule.broken_by(sentence)) names.push_back(rule.name);
  return names;
}

}  // namespace stampede
