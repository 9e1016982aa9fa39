#include "engine/language/claims.h"

#include <algorithm>

namespace stampede {
namespace {

bool tells(const Word& word) {
  using enum WordKind;
  return word.kind == colour || word.kind == number || word.kind == place || word.kind == noun || word.kind == verb ||
         word.kind == own || word.kind == adjective || word.is("telling");
}

Texts telling_words(const Reading& reading) {
  Texts senses;
  for (const Word& word : reading.words)
    if (tells(word)) senses.insert(word.sense);
  return senses;
}

void find_marks(const Meaning& meaning, Claims& claims) {
  std::map<std::string, std::size_t> variations;  // that say it
  for (const std::string& sense : claims.senses) ++variations[sense];
  for (const OwnSentences& other : meaning.elsewhere) {
    Texts& theirs = claims.elsewhere.emplace_back();
    for (const std::string& sentence : other.sentences) theirs.merge(telling_words(read_sentence(sentence, meaning)));
    for (const std::string& sense : theirs) ++variations[sense];
  }
  for (const auto& [sense, count] : variations)
    if (count <= claims.elsewhere.size()) claims.marks.insert(sense);
}

// Of `bring the cube in the drawer to …`: where the cube is now.
bool is_aside(const Reading& reading, std::size_t word) {
  return std::ranges::any_of(reading.mentions, [&](const Mention& mention) {
    const bool built = mention.things.empty() && reading.words[mention.head].is("built");
    return (mention.aside || built) && mention.first == word + 1;
  });
}

void claim(const Reading& reading, const Mention& mention, Claims& claims) {
  for (const auto* said : {&mention.colours, &mention.places, &mention.adjectives, &mention.modifiers})
    for (const std::string& one : *said) claims.attributes.emplace(one, mention.sense);
  const std::string role = role_key(reading, mention);
  claims.roles.emplace(role, mention.sense);
  if (mention.by_head)
    for (const std::string& name : mention.things) claims.roles.emplace(role, name);
  if (mention.count)
    for (const std::string& key : {mention.sense, mention.sense + " " + mention.role()})
      claims.counts[key].insert(*mention.count);
  const Segment& segment = reading.segments[mention.segment];
  claims.others |= mention.other && !segment.negated && !segment.excluding && !mention.after;
}

}  // namespace

std::vector<std::string> marks_in(const Reading& reading, const Texts& marks, const std::set<std::size_t>& skip) {
  std::vector<std::string> said;
  for (const std::size_t segment : reading.in_time)
    for (std::size_t i = reading.segments[segment].begin; i < reading.segments[segment].end; ++i) {
      const Word& word = reading.words[i];
      if (tells(word) && marks.contains(word.sense) && !skip.contains(i) &&
          std::ranges::find(said, word.sense) == said.end())
        said.push_back(word.sense);
    }
  return said;
}

Texts verbs_in(const Reading& reading) {
  Texts verbs;
  for (const Segment& segment : reading.segments) {
    if (segment.negated || keeps_others(reading, segment)) continue;
    for (const Word& word : reading.words_of(segment))
      if (word.kind == WordKind::verb) verbs.insert(word.sense);
  }
  return verbs;
}

Texts colours_in(const Reading& reading) {
  Texts colours;
  for (const Word& word : reading.words)
    if (word.kind == WordKind::colour) colours.insert(word.sense);
  return colours;
}

Texts directions_in(const Reading& reading, const Segment& segment, const English& english) {
  Texts directions;
  bool switches = false;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    const Word& word = reading.words[i];
    const bool ends = i + 1 == segment.end, by = !ends && reading.words[i + 1].is("by");
    if (word.kind == WordKind::verb) {
      switches |= word.is("switching") || (word.is("turning") && segment.verb == i);
      const auto direction = english.directions.find(word.sense);
      const bool state = word.is("openness") && i > 0 && reading.words[i - 1].is("in_state");
      if (direction != english.directions.end() && !state) directions.insert(direction->second);
    }
    if (word.is("away")) directions.insert(word.is("off") && switches ? "switch_off" : "out");
    if (word.is("on") && switches) directions.insert("switch_on");
    if (word.is("into") && !is_aside(reading, i)) directions.insert("in");
    if (word.is("back") && segment.verb && (by || (ends && reading.words[*segment.verb].is("swinging"))))
      directions.insert(by ? "backward" : "open");
    if (word.kind != WordKind::grammar || word.is("telling"))
      if (english.opposites.contains(word.text)) directions.insert(word.text);
  }
  return directions;
}

bool keeps_others(const Reading& reading, const Segment& segment) {
  return reading.any(segment, "keeping") && reading.any(segment, "other") &&
         std::ranges::all_of(reading.mentions_of(segment),
                             [](const Mention& mention) { return mention.other || mention.after; });
}

std::string role_key(const Reading& reading, const Mention& mention) {
  if (mention.acts()) return mention.role();
  std::string beside;
  for (const Mention& other : reading.mentions) {
    if (&other >= &mention) break;
    if (other.segment == mention.segment && (mention.part == "of" || other.acts())) beside = other.sense;
  }
  return mention.role() + " " + beside;
}

std::set<std::pair<std::string, std::string>> free_places(const Reading& reading) {
  std::set<std::pair<std::string, std::string>> places;
  for (std::size_t i = 0; i < reading.words.size(); ++i) {
    if (reading.words[i].kind != WordKind::place) continue;
    const bool tells = std::ranges::any_of(reading.mentions, [&](const Mention& mention) {
      return (i >= mention.first && i <= mention.head) || mention.placed_by == i;
    });
    if (!tells) places.emplace(i == 0 ? "" : reading.words[i - 1].text, reading.words[i].sense);
  }
  return places;
}

std::vector<std::string> free_numbers(const Reading& reading, const std::set<std::size_t>& skip) {
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < reading.words.size(); ++i) {
    const Word& word = reading.words[i];
    if (word.kind != WordKind::number || word.sense.size() > 4 || skip.contains(i)) continue;
    const Word* next = i + 1 < reading.words.size() ? &reading.words[i + 1] : nullptr;
    const bool counts = std::ranges::any_of(reading.mentions, [&](const Mention& mention) {
      const bool part = next != nullptr && next->is("of") && i < mention.head && i + 4 > mention.first;
      return mention.count && ((i >= mention.first && i <= mention.head) || part);
    });
    if (!counts) numbers.push_back(word.sense);
  }
  return numbers;
}

Claims claims_of(const Meaning& meaning) {
  Claims claims;
  for (const std::string& sentence : meaning.own) {
    const Reading& reading = claims.own.emplace_back(read_sentence(sentence, meaning));
    claims.senses.merge(telling_words(reading));
    for (const Mention& mention : reading.mentions) claim(reading, mention, claims);
    for (const Segment& segment : reading.segments) {
      claims.segments.insert(content_of(reading, segment));
      if (!keeps_others(reading, segment))
        claims.directions.merge(directions_in(reading, segment, meaning.lexicon.english()));
    }
  }
  find_marks(meaning, claims);
  return claims;
}

}  // namespace stampede
