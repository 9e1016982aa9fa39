// Noun phrases: what a sentence names, with its colours, counts and places, and as what.
#include <algorithm>

#include "engine/language/reading.h"

namespace stampede {
namespace {

// `the blue one`, not `the one cup`
bool is_pronoun_one(const std::vector<Word>& words, std::size_t i) {
  if (!words[i].is("one")) return false;
  if (i == 0 || !words[i].follows()) return false;
  if (i + 1 < words.size() && words[i + 1].follows() &&
      (words[i + 1].kind == WordKind::noun || words[i + 1].kind == WordKind::colour ||
       words[i + 1].kind == WordKind::adjective || words[i + 1].kind == WordKind::own))
    return false;
  const Word& last = words[i - 1];
  return last.is("article") || last.is("other") || last.is("relative") || last.kind == WordKind::colour ||
         last.kind == WordKind::place || last.kind == WordKind::adjective;
}

std::optional<int> number_of(const Word& word) {
  const bool digits = std::ranges::all_of(word.sense, [](char c) { return c >= '0' && c <= '9'; });
  if (word.kind != WordKind::number || word.sense.size() > 4 || !digits) return std::nullopt;
  return std::stoi(word.sense);
}

class MentionReader {
 public:
  MentionReader(Reading& reading, const Meaning& meaning)
      : reading_(reading),
        words_(reading.words),
        mentions_(reading.mentions),
        meaning_(meaning),
        english_(meaning.lexicon.english()) {}

  void read() {
    std::size_t segment = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      while (segment + 1 < reading_.segments.size() && i >= reading_.segments[segment].end) ++segment, drop();
      step(i, segment);
    }
    for (Mention& mention : mentions_) resolve(mention);
    for (std::size_t i = 1; i < mentions_.size(); ++i) {
      if (is_part(mentions_[i - 1], mentions_[i])) mentions_[i].partitive = false;  // `the tray of the scales`
      mentions_[i].aside |= says_where(i);
    }
    for (std::size_t i = 0; i < mentions_.size(); ++i) {
      find_role(i);
      if (i > 0 && mentions_[i].part == "of") narrow(mentions_[i - 1], mentions_[i]);
    }
  }

 private:
  // Words are read one after the other; a phrase is open from its first word to its noun.
  void step(std::size_t i, std::size_t segment) {
    const Word& word = words_[i];
    if (word.kind == WordKind::noun || is_pronoun_one(words_, i) || word.is("others")) return name(i, segment);
    switch (word.kind) {
      case WordKind::colour:
        return begin_at(i).colours.push_back(word.sense);
      case WordKind::place:
        if (!says_where_last_is(i)) return begin_at(i).places.push_back(word.sense);
        mentions_.back().places.push_back(word.sense);  // `the drawer at the bottom`
        mentions_.back().placed_by = i;
        return drop();
      case WordKind::adjective:
        return begin_at(i).adjectives.push_back(word.sense);
      case WordKind::number:
        begin_at(i).count = number_of(word);
        return;
      default:
        break;
    }
    if (word.is("other")) {
      begin_at(i).other = true;
    } else if (word.is("article") && !(word.is("relative") && i > 0 && words_[i - 1].kind == WordKind::noun)) {
      begin_at(i);
      if (word.is("both")) open_.count = 2;
    } else if (is_particle(i)) {
      drop();
    } else if (english_.prepositions.contains(word.text)) {
      const std::optional<int> part = word.is("of") ? open_.count : std::nullopt;
      drop();
      if (part) part_of_ = part;  // `three of the blocks`
      after_ = i;
    } else if (word.text == "'s" && !mentions_.empty()) {
      after_ = mentions_.back().after;  // `on the tree's spokes`: on the spokes
    } else {
      aside_ |= word.is("relative") && i > 0 && words_[i - 1].kind == WordKind::noun;
      if (word.kind == WordKind::own && begun_)
        open_.adjectives.push_back(word.sense);  // `the kitchen knife`
      else if (word.kind == WordKind::verb || word.kind == WordKind::own)
        drop();
    }
  }

  // A noun, or a word for one: with it the phrase ends, unless another noun follows.
  void name(std::size_t i, std::size_t segment) {
    const Word& word = words_[i];
    begin_at(i);
    const bool more = word.kind == WordKind::noun && !word.is("others") && i + 1 < words_.size() &&
                      words_[i + 1].follows() && words_[i + 1].kind == WordKind::noun && !word.plural;
    if (more)
      open_.modifiers.push_back(word.sense);
    else
      finish(i, segment);
  }

  void finish(std::size_t head, std::size_t segment) {
    const Word& word = words_[head];
    const bool pronoun = word.is("others") || (word.kind != WordKind::noun);
    open_.head = head;
    open_.segment = segment;
    open_.after = after_;
    open_.plural = word.plural || word.is("several");
    open_.other |= word.is("others");
    open_.sense = !pronoun ? word.sense : mentions_.empty() ? "" : mentions_.back().sense;
    const bool of = reading_.at(after_, "of");
    if (part_of_ && open_.count && of) open_.total = std::exchange(open_.count, part_of_);  // `two of the three blocks`
    if (part_of_ && !open_.count) open_.count = part_of_;
    open_.partitive = part_of_ || (of && open_.plural);
    open_.aside = std::exchange(aside_, false);
    part_of_.reset();
    mentions_.push_back(std::move(open_));
    drop();
  }

  Mention& begin_at(std::size_t i) {
    if (!begun_) open_.first = i;
    begun_ = true;
    return open_;
  }

  void drop() {
    open_ = {};
    begun_ = false;
    after_.reset();
  }

  void find_role(std::size_t i) {
    Mention& mention = mentions_[i];
    const Segment& segment = reading_.segments[mention.segment];
    const bool verb_before = segment.verb && *segment.verb < mention.first;
    const auto as = [&](std::string_view part, std::optional<std::size_t> verb = {}) {
      mention.part = part;
      if (verb) mention.verb = words_[*verb].sense;
    };
    mention.verb_at = segment.verb;
    if (reading_.is_possessor(mention)) return as("of");
    if (mention.partitive && reading_.at(mention.after, "of")) return as("part");
    if (reading_.at(mention.after, "with") && i > 0 && belongs(mention, mentions_[i - 1])) return as("of");
    if (verb_before && words_[*segment.verb].is("assembling") && reading_.at(mention.after, "from"))
      return as("object", segment.verb);
    if (mention.first > 0 && words_[mention.first - 1].is("where")) return as("where");
    if (mention.head + 2 < words_.size() && words_[mention.head + 1].is("be") && words_[mention.head + 2].is("where"))
      return as("place");
    if (mention.after) {
      const std::string& part = english_.prepositions.at(words_[*mention.after].text);
      return as(part, verb_before && part != "of" ? segment.verb : std::nullopt);
    }
    if (verb_before) return as("object", segment.verb);
    // `solve the puzzle`: of a verb that only the author explains
    if (mention.first > segment.begin && words_[mention.first - 1].kind == WordKind::own)
      return as("object", mention.first - 1);
    as("subject", next_verb(mention, segment));
  }

  std::optional<std::size_t> next_verb(const Mention& mention, const Segment& segment) const {
    for (std::size_t k = mention.head + 1; k < segment.end; ++k)
      if (words_[k].kind == WordKind::verb) return k;
    return std::nullopt;
  }

  // `switch on the lamp`, `plug in the charger`, `twist off the lid`: a part of the verb
  bool is_particle(std::size_t i) const {
    if (i == 0 || i + 1 >= words_.size() || !words_[i].follows() || !words_[i + 1].follows()) return false;
    const auto found = english_.particles.find(words_[i - 1].sense);
    return found != english_.particles.end() && words_[i - 1].kind == WordKind::verb &&
           found->second.contains(words_[i].text);
  }

  // `the cube in the drawer should …`, `bring the cube in the drawer to …`: where it is, not where it goes
  bool says_where(std::size_t i) const {
    const Mention& mention = mentions_[i];
    const std::size_t owner =
        i > 1 && reading_.is_possessor(mentions_[i - 1]) ? i - 2 : i - 1;  // `on the cabinet's shelf`
    const Mention& last = mentions_[owner];
    if (last.segment != mention.segment || last.after || !reading_.at(mention.after, "located") ||
        *mention.after != last.head + 1)
      return false;
    const Segment& segment = reading_.segments[mention.segment];
    for (std::size_t k = mention.head + 1; k < segment.end; ++k)
      if (words_[k].is("demanding")) return true;
    if (i + 1 == mentions_.size() || !segment.verb || *segment.verb > last.first) return false;
    return mentions_[i + 1].segment == mention.segment && reading_.at(mentions_[i + 1].after, "towards");
  }

  // `the button with the navy cap`: a part of what was named just before, or that itself
  bool belongs(const Mention& part, const Mention& whole) const {
    if (part.segment != whole.segment || part.after != whole.head + 1 ||
        (!part.colours.empty() && !whole.colours.empty() && part.colours != whole.colours))
      return false;
    return any_pair(part, whole,
                    [](const auto& name, const auto& one) { return name == one || is_part_of(name, one); });
  }

  static bool is_part(const Mention& part, const Mention& whole) {
    return part.segment == whole.segment && any_pair(part, whole, is_part_of);
  }

  template <typename Test>
  static bool any_pair(const Mention& a, const Mention& b, const Test& test) {
    return std::ranges::any_of(a.things, [&](const std::string& one) {
      return std::ranges::any_of(b.things, [&](const std::string& other) { return test(one, other); });
    });
  }

  // `the door on the left`, `the drawer at the top of the chest`, not `put it on the left shelf`
  bool says_where_last_is(std::size_t i) const {
    if (i < 3 || !words_[i - 1].is("article") || !words_[i].follows() || !words_[i - 1].follows()) return false;
    if (!words_[i - 2].is("sided") || mentions_.empty() || mentions_.back().head + 3 != i) return false;
    return reading_.ends_at(i + 1) || words_[i + 1].kind == WordKind::grammar || words_[i + 1].kind == WordKind::order;
  }

  // Things whose names fit: those that the noun names, or else those of which it is a word at all.
  void resolve(Mention& mention) const {
    const auto unfit = [&](const SpokenThing& thing, const std::string& word) {
      return !thing.words.contains(word) &&
             std::ranges::any_of(meaning_.things, [&](const auto& one) { return one.words.contains(word); });
    };
    for (const bool by_head : {true, false}) {
      mention.by_head = by_head;
      for (const SpokenThing& thing : meaning_.things) {
        if (!(by_head ? thing.heads : thing.words).contains(mention.sense)) continue;
        const auto wrong = [&](const std::string& word) { return unfit(thing, word); };
        if (std::ranges::any_of(mention.modifiers, wrong) || std::ranges::any_of(mention.places, wrong)) continue;
        mention.things.push_back(thing.name);
        mention.roles |= thing.roles;
      }
      if (!mention.things.empty()) return;
    }
  }

  // `the rod of the rack`: no other rod.
  void narrow(Mention& part, const Mention& whole) const {
    std::vector<std::string> of_it;
    for (const std::string& name : part.things)
      if (std::ranges::any_of(whole.things, [&](const auto& one) { return is_part_of(name, one); }))
        of_it.push_back(name);
    if (of_it.empty()) return;
    part.things = std::move(of_it);
    part.roles = {};
    for (const std::string& name : part.things) part.roles |= meaning_.thing(name)->roles;
  }

  Reading& reading_;
  std::vector<Word>& words_;
  std::vector<Mention>& mentions_;
  const Meaning& meaning_;
  const English& english_;
  Mention open_;
  bool begun_ = false, aside_ = false;
  std::optional<std::size_t> after_;
  std::optional<int> part_of_;
};

}  // namespace

void read_pronouns(std::vector<Word>& words) {
  for (std::size_t i = 0; i < words.size(); ++i)
    if (is_pronoun_one(words, i)) words[i].kind = WordKind::grammar;
}

void read_mentions(Reading& reading, const Meaning& meaning) { MentionReader(reading, meaning).read(); }

}  // namespace stampede
