#include "engine/language/reading.h"

#include <algorithm>

namespace stampede {
namespace {

// `the red one last, the lime one second`: 99 and 2; 0: no turn.
int rank_of(const Word& word, const English& english) {
  const auto found = english.ranks.find(word.sense);
  return found == english.ranks.end() ? 0 : found->second;
}

void find_verb(const std::vector<Word>& words, Segment& segment) {
  const auto names = [](const Word& word) {
    return word.kind == WordKind::noun || word.kind == WordKind::own || word.kind == WordKind::colour;
  };
  for (std::size_t i = segment.begin; i < segment.end && !segment.verb && !names(words[i]); ++i)
    if (words[i].kind == WordKind::verb) segment.verb = i;
  // `get the drawer open`, `get the button pressed`
  for (std::size_t i = segment.verb.value_or(segment.end) + 1; i < segment.end; ++i)
    if (words[*segment.verb].is("getting") && words[i].kind == WordKind::verb &&
        (words[i].done || words[i].is("openness")))
      segment.verb = i;
}

}  // namespace

std::span<const Word> Reading::words_of(const Segment& segment) const {
  return std::span(words).subspan(segment.begin, segment.end - segment.begin);
}

std::span<const Mention> Reading::mentions_of(const Segment& segment) const {
  const auto number = static_cast<std::size_t>(&segment - segments.data());
  return std::span(std::ranges::equal_range(mentions, number, {}, &Mention::segment));
}

bool Reading::any(const Segment& segment, WordClass of) const {
  return std::ranges::any_of(words_of(segment), [&](const Word& word) { return word.is(of); });
}

const std::string& Reading::verb_of(const Segment& segment) const {
  static const std::string kNone;
  return segment.verb ? words[*segment.verb].sense : kNone;
}

bool Reading::is_possessor(const Mention& mention) const {
  return mention.head + 1 < words.size() && words[mention.head + 1].text == "'s";
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
  for (const Word& word : reading.words_of(segment)) {
    const bool grammar = word.kind == WordKind::grammar && !word.is("way");
    if (!grammar && word.kind != WordKind::harmless && word.kind != WordKind::order) senses.push_back(word.sense);
  }
  return senses;
}

void read_turns(Reading& reading, const English& english) {
  std::vector<Word>& words = reading.words;
  for (std::size_t i = 1; i < words.size(); ++i) {
    const Word& last = words[i - 1];
    const bool named = last.kind == WordKind::noun || last.kind == WordKind::colour || last.is("one");
    if (named && reading.ends_at(i + 1) && words[i].follows() && rank_of(words[i], english) > 0)
      words[i].kind = WordKind::order;
  }
}

void read_light_verbs(Reading& reading, const Lexicon& lexicon) {
  std::vector<Word>& words = reading.words;
  for (std::size_t i = 0; i < words.size(); ++i)
    for (const English::LightVerb& light : lexicon.english().light_verbs) {
      if (words[i].kind != WordKind::verb || !light.verbs.contains(words[i].text)) continue;
      bool with = false;
      for (std::size_t k = i + 1;
           k < words.size() && words[k].follows() && (light.unless || words[k].kind != WordKind::verb); ++k)
        with |= (light.with.contains(words[k].text) || light.with.contains(words[k].sense)) &&
                (!light.beside || k == i + 1 || reading.ends_at(k + 1));
      if (with == light.unless) continue;
      if (light.means.empty())
        words[i].kind = WordKind::grammar;
      else
        lexicon.set_kind(words[i], WordKind::verb, light.means);
    }
}

void read_segments(Reading& reading) {
  const std::vector<Word>& words = reading.words;
  std::vector<Segment>& segments = reading.segments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool joins = words[i].is("join");
    if (i > 0 && words[i].follows() && !joins) continue;
    if (!segments.empty()) {
      Segment& last = segments.back();
      last.end = i;
      if (i - last.begin <= 1 && words[last.begin].is("join") && words[i].follows()) {  // `, and then after` is one
        if (words[i].is("after") || words[i].is("before")) last.intro = i;
        last.end = words.size();
        continue;
      }
    }
    segments.push_back({i, words.size(), joins ? std::optional(i) : std::nullopt});
  }
  for (Segment& segment : segments) {
    find_verb(words, segment);
    for (const Word& word : reading.words_of(segment)) {
      segment.negated |= word.kind == WordKind::negation;
      segment.excluding |= (word.kind == WordKind::exclusion && !word.is("other")) || word.is("sparing");
    }
  }
}

void read_order(Reading& reading, const English& english) {
  std::vector<std::size_t>& order = reading.in_time;
  std::optional<std::size_t> waiting;  // until all else is done: `before c, do a and then b`
  for (std::size_t i = 0; i < reading.segments.size(); ++i) {
    const Segment& segment = reading.segments[i];
    if (reading.at(segment.intro, "after") && !order.empty())
      order.insert(order.end() - 1, i);
    else if (reading.at(segment.intro, "before") && order.empty() && i + 1 < reading.segments.size())
      waiting = i;
    else
      order.push_back(i);
  }
  if (waiting) order.push_back(*waiting);
  // A stretch without a turn comes with the one before it; before any turn, after what is first.
  std::vector<int> turns(order.size());
  int turn = 2;
  for (const std::size_t at : order) {
    for (const Word& word : reading.words_of(reading.segments[at]))
      if (const int rank = rank_of(word, english); rank > 0 && word.kind == WordKind::order) turn = rank;
    turns[at] = turn;
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t at) { return turns[at]; });
}

}  // namespace stampede
