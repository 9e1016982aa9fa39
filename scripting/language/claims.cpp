#include "scripting/language/claims.h"

#include <algorithm>
#include <array>

namespace stampede {
namespace {

bool tells(const Word& word) {
  switch (word.kind) {
    case WordKind::colour:
    case WordKind::number:
    case WordKind::place:
    case WordKind::noun:
    case WordKind::verb:
    case WordKind::own:
    case WordKind::adjective:
      return true;
    case WordKind::order:
      return word.text == "next";  // the next channel
    case WordKind::function:
      return word.text == "up" || word.text == "down";
    case WordKind::harmless:
    case WordKind::negation:
    case WordKind::exclusion:
    case WordKind::unknown:
      return false;
  }
  return false;
}

std::set<std::string> telling_words(const Reading& reading) {
  std::set<std::string> senses;
  for (const Word& word : reading.words)
    if (tells(word)) senses.insert(word.sense);
  return senses;
}

Marks marks_of(const Meaning& meaning, const std::vector<Reading>& own) {
  Marks marks;
  std::set<std::string> said;
  for (const Reading& reading : own) said.merge(telling_words(reading));
  std::vector<std::set<std::string>> variations = {said};
  for (const OwnSentences& other : meaning.elsewhere) {
    std::set<std::string> theirs;
    for (const std::string& sentence : other.sentences) theirs.merge(telling_words(read_sentence(sentence, meaning)));
    marks.theirs.push_back(theirs);
    variations.push_back(std::move(theirs));
  }
  std::set<std::string> all;
  for (const std::set<std::string>& one : variations) all.insert(one.begin(), one.end());
  for (const std::string& sense : all)
    if (std::any_of(variations.begin(), variations.end(), [&](const auto& one) { return !one.contains(sense); }))
      marks.telling.insert(sense);
  for (const std::string& sense : said)
    if (marks.telling.contains(sense)) marks.ours.insert(sense);
  for (const Reading& reading : own) marks.own.push_back(marks_in(reading, marks.telling, totals_in(reading)));
  return marks;
}

const std::array<std::pair<const char*, const char*>, 10> kOpposites = {{{"open", "close"},
                                                                         {"up", "down"},
                                                                         {"in", "out"},
                                                                         {"switch_on", "switch_off"},
                                                                         {"push", "pull"},
                                                                         {"plus", "minus"},
                                                                         {"next", "previous"},
                                                                         {"forward", "backward"},
                                                                         {"clockwise", "anticlockwise"},
                                                                         {"insert", "remove"}}};

}  // namespace

std::vector<std::string> marks_in(const Reading& reading, const std::set<std::string>& telling,
                                  const std::set<std::size_t>& skip) {
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

std::set<std::string> relations_in(const Reading& reading) {
  static const std::map<std::string, std::string> kRelations = {
      {"under", "under"},     {"below", "under"},     {"beneath", "under"}, {"over", "over"},
      {"above", "over"},      {"behind", "behind"},   {"beside", "beside"}, {"near", "beside"},
      {"between", "between"}, {"outside", "outside"}, {"around", "around"}, {"before-thing", "front"},
      {"against", "against"}, {"through", "through"}, {"across", "across"}};
  std::set<std::string> relations;
  for (std::size_t i = 0; i < reading.words.size(); ++i) {
    const auto found = kRelations.find(reading.words[i].text);
    // `over to the table`, `fold the lid over`
    const bool way =
        reading.words[i].text == "over" &&
        (i + 1 == reading.words.size() || reading.words[i + 1].before != ' ' || reading.words[i + 1].text == "to" ||
         reading.words[i + 1].text == "until" || reading.words[i + 1].text == "and");
    if (found != kRelations.end() && !way) relations.insert(found->second);
  }
  return relations;
}

bool keeps_others(const Reading& reading, const Segment& segment) {
  static const std::set<std::string> kKeeps = {"leave", "leaving", "keep", "keeping", "stay", "stays"};
  bool keeps = false, others = false;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    keeps |= kKeeps.contains(reading.words[i].text);
    others |= reading.words[i].kind == WordKind::exclusion && reading.words[i].sense == "other";
  }
  return keeps && others && std::all_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
           return mention.other || !mention.preposition.empty() || mention.head < segment.begin ||
                  mention.head >= segment.end;
         });
}

std::set<std::size_t> totals_in(const Reading& reading) {
  std::set<std::size_t> totals;
  for (const Mention& mention : reading.mentions)
    for (std::size_t i = mention.first; mention.total && i < mention.head; ++i)
      if (reading.words[i].kind == WordKind::number) totals.insert(i);
  return totals;
}

// `fold the screen back`, `turn the hand back by …`, not `put it back on the shelf`
static bool leads_back(const Reading& reading, std::size_t i, const Segment& segment) {
  if (!segment.verb) return false;
  if (i + 1 < segment.end && reading.words[i + 1].text == "by") return true;
  return i + 1 == segment.end && reading.words[*segment.verb].sense == "swing";
}

bool moves_fingers(const Reading& reading, std::size_t verb) {
  static const std::set<std::string> kFingers = {"hand", "fingers", "finger", "gripper", "fingertips"};
  for (std::size_t i = verb + 1; i < reading.words.size() && i < verb + 4 && reading.words[i].before == ' '; ++i)
    if (kFingers.contains(reading.words[i].text)) return true;
  return false;
}

std::set<std::string> directions_in(const Reading& reading, const std::function<bool(const Segment&)>& skip) {
  std::set<std::string> directions;
  for (const Segment& segment : reading.segments) {
    if (keeps_others(reading, segment) || (skip && skip(segment))) continue;
    bool switches = false, puts = false;
    for (std::size_t i = segment.begin; i < segment.end; ++i) {
      const Word& word = reading.words[i];
      const bool leads = segment.verb == i;
      if (word.sense == "switch" || (word.sense == "turn" && leads)) switches = true;
      if (word.kind == WordKind::verb) {
        static const std::set<std::string> kIs = {"stands", "stand", "left",    "is",   "are",
                                                  "wide",   "been",  "already", "still"};
        const bool state = i > 0 && kIs.contains(reading.words[i - 1].text);  // `the box stands open`
        if ((word.sense == "open" || word.sense == "close") && !state && !moves_fingers(reading, i))
          directions.insert(word.sense);
        if (word.sense == "lift") directions.insert("up");
        if (word.sense == "lower") directions.insert("down");
        if (word.sense == "pull") directions.insert("pull");
        if (word.sense == "push") directions.insert("push");
        if (word.sense == "insert") directions.insert("insert");
        if (word.sense == "remove") directions.insert("remove");
        puts |= word.sense == "put" || word.sense == "insert" || word.sense == "drop" || word.sense == "hang";
      }
      if (word.text == "off" && switches)
        directions.insert("switch_off");
      else if (word.text == "off" || word.text == "out" || word.text == "outof" || word.text == "from")
        directions.insert("out");
      if (word.text == "on" && switches) directions.insert("switch_on");
      const bool aside = std::any_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
        const bool built = mention.things.empty() && kBuilt.contains(mention.sense);
        return (mention.aside || built) && mention.first == i + 1;  // `bring the cube in the drawer to …`
      });
      if (word.text == "back" && leads_back(reading, i, segment))
        directions.insert(i + 1 < segment.end && reading.words[i + 1].text == "by" ? "backward" : "open");
      if (!aside && (word.text == "into" || (word.text == "in" && puts))) directions.insert("in");
      if (word.text == "up" || word.text == "down") directions.insert(word.text);
      for (const auto& [one, other] : kOpposites)
        if (word.kind != WordKind::function && (word.text == one || word.text == other)) directions.insert(word.text);
    }
  }
  return directions;
}

std::string opposite_of(const std::string& direction) {
  for (const auto& [one, other] : kOpposites) {
    if (direction == one) return other;
    if (direction == other) return one;
  }
  return "";
}

std::string role_key(const Reading& reading, const Mention& mention) {
  if (mention.role.starts_with("object") || mention.role.starts_with("subject")) return mention.role;
  std::string beside;
  for (const Mention& other : reading.mentions) {
    if (&other >= &mention) break;
    if (other.segment != mention.segment) continue;
    if (mention.role == "of" || other.role.starts_with("object") || other.role.starts_with("subject"))
      beside = other.sense;
  }
  return mention.role + " " + beside;
}

std::set<std::string> colours_in(const Reading& reading) {
  std::set<std::string> colours;
  for (const Word& word : reading.words)
    if (word.kind == WordKind::colour) colours.insert(word.sense);
  return colours;
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
    const bool counts = std::any_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
      return mention.count && ((i >= mention.first && i <= mention.head) ||
                               (i + 1 < reading.words.size() && reading.words[i + 1].text == "of" && i < mention.head &&
                                i + 4 > mention.first));
    });
    if (counts) continue;
    const bool named = i + 1 < reading.words.size() &&
                       (reading.words[i + 1].kind == WordKind::own || reading.words[i + 1].kind == WordKind::noun);
    numbers.push_back(word.sense + (named ? " " + reading.words[i + 1].sense : ""));
  }
  return numbers;
}

bool may_be(const Mention& mention, const Meaning& meaning, bool SpokenThing::*of_kind) {
  return std::any_of(meaning.things.begin(), meaning.things.end(), [&](const SpokenThing& thing) {
    return thing.*of_kind &&
           std::find(mention.things.begin(), mention.things.end(), thing.name) != mention.things.end();
  });
}

Claims claims_of(const Meaning& meaning) {
  Claims claims;
  for (const std::string& sentence : meaning.own) claims.own.push_back(read_sentence(sentence, meaning));
  for (const Reading& reading : claims.own) {
    for (const Word& word : reading.words)
      if (tells(word)) claims.senses.insert(word.sense);
    for (const Segment& segment : reading.segments) {
      claims.segments.insert(content_of(reading, segment.begin, segment.end));
      if (segment.verb) claims.verbs.insert(reading.words[*segment.verb].sense);
    }
    claims.done.push_back(verbs_in(reading, [&](const Segment& one) { return keeps_others(reading, one); }));
    std::vector<Mention> wanted;
    for (const Mention& mention : reading.mentions) {
      for (const auto* words : {&mention.colours, &mention.adjectives, &mention.places})
        for (const std::string& word : *words) claims.attributes.emplace(word, mention.sense);
      const std::string role = role_key(reading, mention);
      claims.roles.emplace(role, mention.sense);
      if (mention.by_head)
        for (const std::string& name : mention.things) claims.roles.emplace(role, name);
      for (const std::string& word : mention.modifiers) claims.attributes.emplace(word, mention.sense);
      if (mention.count) claims.counts[mention.sense + " " + mention.role].insert(*mention.count);
      if (mention.count) claims.counts[mention.sense].insert(*mention.count);
      if (may_be(mention, meaning, &SpokenThing::wanted)) wanted.push_back(mention);
    }
    claims.wanted.push_back(std::move(wanted));
    claims.numbers.push_back(free_numbers(reading));
    claims.colours.push_back(colours_in(reading));
    claims.places.merge(free_places(reading));
    for (const Mention& mention : reading.mentions) {
      const Segment& segment = reading.segments[mention.segment];
      claims.others |= mention.other && !segment.negated && !segment.excluding && mention.preposition.empty();
    }
    claims.relations.merge(relations_in(reading));
    claims.directions.merge(directions_in(reading));
  }
  claims.marks = marks_of(meaning, claims.own);
  return claims;
}

}  // namespace stampede
