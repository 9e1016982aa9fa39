// Whether each word may be there, and whether the words tell this variation from the others.
#include "scripting/language/one_sentence.h"

namespace stampede {

Maybe OneSentence::form() const {
  const auto count = static_cast<int>(reading_.words.size());
  if (count < 2) return no(Rejection::too_short, std::to_string(count) + " words");
  if (count > most_words(grain_)) return no(Rejection::too_long, std::to_string(count) + " words");
  for (const char c : sentence_)
    if (c == '\n' || c == '\t' || c == '<' || c == '>' || c == '[' || c == ']' || c == '|' || c == '*' || c == '#' ||
        c == '`' || c == '=' || (!meaning_.slots && (c == '{' || c == '}')) || c == '\\' || c == '_')
      if (!(meaning_.slots && c == '_')) return no(Rejection::not_a_sentence, std::string("it has a `") + c + "`");
  return {};
}

Maybe OneSentence::words() const {
  static const std::set<std::string> kExcuses = {"sorry",     "ai",     "assistant", "language", "apologize",
                                                 "apologise", "unable", "assist",    "sure"};
  int unknown = 0, foreign = 0, excuses = 0;
  const Word* first = nullptr;
  for (const Word& word : reading_.words) {
    if (std::any_of(word.text.begin(), word.text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
      ++foreign;
    excuses += kExcuses.contains(word.text) ? 1 : 0;
    if (word.kind != WordKind::unknown) continue;
    ++unknown;
    if (first == nullptr) first = &word;
  }
  const auto count = static_cast<int>(reading_.words.size());
  if (excuses > 1 || (excuses > 0 && unknown > 0)) return no(Rejection::refused, sentence_.substr(0, 60));
  if (foreign > 0 || 2 * unknown > count)
    return no(Rejection::other_language, std::to_string(unknown) + " of " + std::to_string(count) + " words unknown");
  if (first != nullptr) return no(Rejection::unknown_word, quoted(first->text));
  for (const Segment& segment : reading_.segments)
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      if (reading_.words[i].text == "already" && !vouched(segment))
        return no(Rejection::unproved, "what is so already");
  return {};
}

// Words of what tells nothing of this variation.
std::set<std::size_t> OneSentence::beside() const {
  std::set<std::size_t> words = totals_in(reading_);
  for (const Segment& segment : reading_.segments)
    if (spares(segment))
      for (std::size_t i = segment.begin; i < segment.end; ++i) words.insert(i);
  return words;
}

Maybe OneSentence::slots() const {
  if (!meaning_.slots) return {};
  const auto slots_of = [](const Reading& reading) {
    std::vector<std::string> found;
    for (const Word& word : reading.words)
      if (word.text.starts_with('{')) found.push_back(word.text);
    return found;
  };
  const std::vector<std::string> ours = slots_of(reading_), wanted = slots_of(claims_.own.front());
  if (ours == wanted) return {};
  for (const std::string& slot : wanted)
    if (std::find(ours.begin(), ours.end(), slot) == ours.end()) return no(Rejection::missing_thing, slot);
  for (const std::string& slot : ours)
    if (std::find(wanted.begin(), wanted.end(), slot) == wanted.end()) return no(Rejection::unknown_thing, slot);
  return no(ours.size() == wanted.size() ? Rejection::swapped_roles : Rejection::wrong_count, "of the slots");
}

Rejection OneSentence::kind_of_mark(const std::string& sense) const {
  for (const Word& word : reading_.words)
    if (word.sense == sense) {
      if (word.kind == WordKind::colour) return Rejection::wrong_colour;
      if (word.kind == WordKind::number) return Rejection::wrong_count;
      if (word.kind == WordKind::place) return Rejection::wrong_side;
      if (word.kind == WordKind::verb || word.kind == WordKind::function) return Rejection::other_action;
    }
  return Rejection::other_thing;
}

// What tells this variation from the others must be said, and nothing that tells another one.
Maybe OneSentence::marks() const {
  const Marks& marks = claims_.marks;
  if (marks.telling.empty()) return {};
  const std::vector<std::string> said = marks_in(reading_, marks.telling, beside());
  for (const std::string& sense : said)
    if (!marks.ours.contains(sense)) return no(kind_of_mark(sense), quoted(sense) + " is another variation's");
  for (const std::vector<std::string>& own : marks.own)
    if (own == said || (!meaning_.ordered && std::set<std::string>(own.begin(), own.end()) ==
                                                 std::set<std::string>(said.begin(), said.end())))
      return {};
  const std::set<std::string> set(said.begin(), said.end());
  if (meaning_.ordered) {
    for (const std::vector<std::string>& own : marks.own)
      if (std::set<std::string>(own.begin(), own.end()) == set)
        return no(Rejection::swapped_order, "what has to be done first is not said first");
    return no(Rejection::missing_thing, "not all of the parts are named");
  }
  std::size_t least = said.size() + 1;
  for (const std::vector<std::string>& own : marks.own)
    if (!own.empty()) least = std::min(least, own.size());
  const bool alone = std::none_of(marks.theirs.begin(), marks.theirs.end(), [&](const auto& theirs) {
    return std::includes(theirs.begin(), theirs.end(), set.begin(), set.end());
  });
  if (alone && said.size() >= least) return {};
  for (const std::string& sense : marks.ours)
    if (!set.contains(sense)) return no(Rejection::missing_thing, "no word says " + quoted(sense));
  return no(Rejection::missing_thing, "which variation is meant");
}

}  // namespace stampede
