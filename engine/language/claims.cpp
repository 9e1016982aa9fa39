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

Marks marks_of(const Meaning& meaning, const std::vector<Reading>& own) {
  Marks marks;
  Texts said;
  for (const Reading& reading : own) said.merge(telling_words(reading));
  std::vector<Texts> variations = {said};
  for (const OwnSentences& other : meaning.elsewhere) {
    Texts theirs;
    for (const std::string& sentence : other.sentences) theirs.merge(telling_words(read_sentence(sentence, meaning)));
    marks.theirs.push_back(theirs);
    variations.push_back(std::move(theirs));
  }
  for (const Texts& some : variations)
    for (const std::string& sense : some)
      if (std::any_of(variations.begin(), variations.end(), [&](const Texts& one) { return !one.contains(sense); }))
        marks.telling.insert(sense);
  for (const std::string& sense : said)
    if (marks.telling.contains(sense)) marks.ours.insert(sense);
  for (const Reading& reading : own) marks.own.push_back(marks_in(reading, marks.telling, totals_in(reading)));
  return marks;
}

// Verbs of relative clauses tell where something is: `the picture that hangs on the hook`.
bool is_told(const Reading& reading, std::size_t verb) {
  return verb > 0 && (reading.words[verb - 1].is("relative") || reading.words[verb - 1].is("be"));
}

// Of `bring the cube in the drawer to …`: where the cube is now.
bool is_aside(const Reading& reading, std::size_t word) {
  return std::any_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
    const bool built = mention.things.empty() && reading.words[mention.head].is("built");
    return (mention.aside || built) && mention.first == word + 1;
  });
}

void read_directions(const Reading& reading, const Segment& segment, const English& english, Texts& directions) {
  bool switches = false, puts = false;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    const Word& word = reading.words[i];
    const bool ends = i + 1 == segment.end, by = !ends && reading.words[i + 1].is("by");
    if (word.kind == WordKind::verb) {
      switches |= word.is("switching") || (word.is("turning") && segment.verb == i);
      puts |= word.is("putting_in");
      const auto direction = english.directions.find(word.sense);
      const bool state =
          word.is("openness") && (moves_fingers(reading, i) || (i > 0 && reading.words[i - 1].is("in_state")));
      if (direction != english.directions.end() && !state) directions.insert(direction->second);
    }
    if (word.is("away")) directions.insert(word.is("off") && switches ? "switch_off" : "out");
    if (word.is("on") && switches) directions.insert("switch_on");
    if (word.is("into") && !is_aside(reading, i) && (puts || !word.is("located"))) directions.insert("in");
    if (word.is("back") && segment.verb && (by || (ends && reading.words[*segment.verb].is("swinging"))))
      directions.insert(by ? "backward" : "open");
    if (word.kind != WordKind::grammar || word.is("telling"))
      if (english.opposites.contains(word.text)) directions.insert(word.text);
  }
}

}  // namespace

std::vector<std::string> marks_in(const Reading& reading, const Texts& telling, const std::set<std::size_t>& skip) {
  std::vector<std::string> marks;
  for (const std::size_t segment : reading.in_time)
    for (std::size_t i = reading.segments[segment].begin; i < reading.segments[segment].end; ++i) {
      const Word& word = reading.words[i];
      if (tells(word) && telling.contains(word.sense) && !skip.contains(i) &&
          std::find(marks.begin(), marks.end(), word.sense) == marks.end())
        marks.push_back(word.sense);
    }
  return marks;
}

Texts verbs_in(const Reading& reading, const SegmentTest& skip) {
  Texts verbs;
  for (const Segment& segment : reading.segments) {
    if (segment.negated || skip(segment)) continue;
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      if (reading.words[i].kind == WordKind::verb && (segment.verb == i || !is_told(reading, i)))
        verbs.insert(reading.words[i].sense);
  }
  return verbs;
}

Texts colours_in(const Reading& reading) {
  Texts colours;
  for (const Word& word : reading.words)
    if (word.kind == WordKind::colour) colours.insert(word.sense);
  return colours;
}

Texts directions_in(const Reading& reading, const English& english, const SegmentTest& skip) {
  Texts directions;
  for (const Segment& segment : reading.segments)
    if (!keeps_others(reading, segment) && !(skip && skip(segment)))
      read_directions(reading, segment, english, directions);
  return directions;
}

bool keeps_others(const Reading& reading, const Segment& segment) {
  return reading.any(segment, "keeping") && reading.any(segment, "other") &&
         std::all_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
           return mention.other || mention.after || !segment.holds(mention.head);
         });
}

std::set<std::size_t> totals_in(const Reading& reading) {
  std::set<std::size_t> totals;
  for (const Mention& mention : reading.mentions)
    for (std::size_t i = mention.first; mention.total && i < mention.head; ++i)
      if (reading.words[i].kind == WordKind::number) totals.insert(i);
  return totals;
}

bool moves_fingers(const Reading& reading, std::size_t verb) {
  for (std::size_t i = verb + 1; i < reading.words.size() && i < verb + 4 && reading.words[i].follows(); ++i)
    if (reading.words[i].is("finger")) return true;
  return false;
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
    const bool tells = std::any_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
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
    const bool counts = std::any_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
      const bool part = next != nullptr && next->is("of") && i < mention.head && i + 4 > mention.first;
      return mention.count && ((i >= mention.first && i <= mention.head) || part);
    });
    if (counts) continue;
    const bool named = next != nullptr && (next->kind == WordKind::own || next->kind == WordKind::noun);
    numbers.push_back(word.sense + (named ? " " + next->sense : ""));
  }
  return numbers;
}

Claims claims_of(const Meaning& meaning) {
  const English& english = meaning.lexicon.english();
  Claims claims;
  for (const std::string& sentence : meaning.own) claims.own.push_back(read_sentence(sentence, meaning));
  for (const Reading& reading : claims.own) {
    claims.senses.merge(telling_words(reading));
    for (const Segment& segment : reading.segments) {
      claims.segments.insert(content_of(reading, segment));
      if (segment.verb) claims.verbs.insert(reading.verb_of(segment));
    }
    claims.done.push_back(verbs_in(reading, [&](const Segment& one) { return keeps_others(reading, one); }));
    for (const Mention& mention : reading.mentions) {
      for (const auto* words : {&mention.colours, &mention.adjectives, &mention.places})
        for (const std::string& word : *words) claims.attributes.emplace(word, mention.sense);
      for (const std::string& word : mention.modifiers) claims.attributes.emplace(word, mention.sense);
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
    claims.numbers.push_back(free_numbers(reading));
    claims.colours.push_back(colours_in(reading));
    claims.places.merge(free_places(reading));
    claims.directions.merge(directions_in(reading, english));
  }
  claims.marks = marks_of(meaning, claims.own);
  return claims;
}

}  // namespace stampede
