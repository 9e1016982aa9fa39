// Stretches of a sentence between commas and joining words, and the order in which they happen.
#include <algorithm>

#include "engine/language/reading.h"

namespace stampede {
namespace {

// `the red one last, the lime one second`: 99 and 2; 0: no turn.
int rank_of(const Word& word, const English& english) {
  const auto found = english.ranks.find(word.sense);
  return found == english.ranks.end() ? 0 : found->second;
}

int rank_of(const Reading& reading, const Segment& segment, const English& english) {
  for (std::size_t i = segment.begin; i < segment.end; ++i)
    if (const int rank = rank_of(reading.words[i], english); rank > 0 && reading.words[i].kind == WordKind::order)
      return rank;
  return 0;
}

// Those with a rank change places among themselves; the last comes last.
void rank_in_time(const Reading& reading, const English& english, std::vector<std::size_t>& order) {
  const auto rank = [&](std::size_t segment) { return rank_of(reading, reading.segments[segment], english); };
  std::vector<std::size_t> places, ranked;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (rank(order[i]) > 0) places.push_back(i), ranked.push_back(order[i]);
  std::stable_sort(ranked.begin(), ranked.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  for (std::size_t i = 0; i < places.size(); ++i) order[places[i]] = ranked[i];
  const auto last = std::find_if(order.begin(), order.end(), [&](std::size_t one) { return rank(one) == kLastRank; });
  if (last != order.end()) std::rotate(last, last + 1, order.end());
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
    for (std::size_t i = segment.begin; i < segment.end; ++i) {
      segment.negated |= words[i].kind == WordKind::negation;
      segment.excluding |= (words[i].kind == WordKind::exclusion && !words[i].is("other")) || words[i].is("sparing");
    }
  }
}

void read_order(Reading& reading, const English& english) {
  std::vector<std::size_t>& order = reading.in_time;
  std::optional<std::size_t> waiting;  // until all else is done: `before c, do a and then b`
  for (std::size_t i = 0; i < reading.segments.size(); ++i) {
    const Segment& segment = reading.segments[i];
    bool first = false;
    for (std::size_t k = segment.begin; k < segment.end; ++k)
      first |= reading.words[k].kind == WordKind::order && rank_of(reading.words[k], english) == 1;
    if (reading.at(segment.intro, "after") && !order.empty())
      order.insert(order.end() - 1, i);
    else if (reading.at(segment.intro, "before") && order.empty() && i + 1 < reading.segments.size())
      waiting = i;
    else
      order.insert(first ? order.begin() : order.end(), i);
  }
  if (waiting) order.push_back(*waiting);
  rank_in_time(reading, english, order);
}

}  // namespace stampede
