// Noun phrases: what a sentence names, with its colours, counts and places, and as what.
#include <algorithm>

#include "scripting/language/parser_parts.h"

namespace stampede {

const std::set<std::string> kPrepositions = {
    "on",      "onto",    "upon",   "in",           "into",    "inside", "within",  "to",      "from",
    "off",     "outof",   "of",     "with",         "at",      "over",   "above",   "under",   "below",
    "beneath", "behind",  "beside", "near",         "between", "around", "through", "against", "across",
    "toward",  "towards", "along",  "before-thing", "by",      "for"};

bool is_article(const std::string& word) {
  static const std::set<std::string> kArticles = {"a",    "an",    "the",   "its",  "their", "this",
                                                  "that", "these", "those", "your", "each",  "every",
                                                  "all",  "any",   "same",  "own",  "both"};
  return kArticles.contains(word);
}

bool is_pronoun_one(const std::vector<Word>& words, std::size_t i) {
  if (words[i].text == "ones") return true;
  if (words[i].text != "one" || i == 0 || words[i].before != ' ') return false;
  if (i + 1 < words.size() && words[i + 1].before == ' ' &&
      (words[i + 1].kind == WordKind::noun || words[i + 1].kind == WordKind::colour ||
       words[i + 1].kind == WordKind::adjective || words[i + 1].kind == WordKind::own))
    return false;  // `the one cup`
  const Word& last = words[i - 1];
  return is_article(last.text) || last.text == "other" || last.text == "which" || last.kind == WordKind::colour ||
         last.kind == WordKind::place || last.kind == WordKind::adjective;
}

namespace {

std::optional<int> number_of(const Word& word) {
  if (word.kind != WordKind::number || word.sense.size() > 4) return std::nullopt;
  int value = 0;
  for (const char c : word.sense) {
    if (c < '0' || c > '9') return std::nullopt;
    value = 10 * value + (c - '0');
  }
  return value;
}

class MentionReader {
 public:
  MentionReader(Reading& reading, const Meaning& meaning) : reading_(reading), meaning_(meaning) {}

  void read() {
    std::size_t segment = 0;
    for (std::size_t i = 0; i < reading_.words.size(); ++i) {
      while (segment + 1 < reading_.segments.size() && i >= reading_.segments[segment].end)
        ++segment, preposition_.clear();
      step(i, segment);
    }
    for (Mention& mention : reading_.mentions) resolve(mention);
    for (std::size_t i = 1; i < reading_.mentions.size(); ++i)
      if (Mention& mention = reading_.mentions[i]; mention.partitive && is_part(reading_.mentions[i - 1], mention))
        mention.partitive = false;  // `the tray of the scales`
    for (std::size_t i = 1; i < reading_.mentions.size(); ++i) reading_.mentions[i].aside |= says_where(i);
    for (std::size_t i = 0; i < reading_.mentions.size(); ++i) {
      reading_.mentions[i].role = role_of(i);
      if (i > 0 && reading_.mentions[i].role == "of") narrow(reading_.mentions[i - 1], reading_.mentions[i]);
    }
  }

 private:
  void step(std::size_t i, std::size_t segment) {
    const Word& word = reading_.words[i];
    const bool one = is_pronoun_one(reading_.words, i);
    const bool others = word.text == "others" || word.text == "rest" || word.text == "remaining";
    if (word.kind == WordKind::noun || one || others) {
      begin_at(i);
      const bool more = !one && !others && i + 1 < reading_.words.size() && reading_.words[i + 1].before == ' ' &&
                        reading_.words[i + 1].kind == WordKind::noun && !word.plural;
      if (more) {
        open_.modifiers.insert(word.sense);
        return;
      }
      finish(i, segment, one || others);
      return;
    }
    if (word.kind == WordKind::colour) {
      if (reading_.mentions.empty() || !describes_last(i)) {
        begin_at(i);
        open_.colours.push_back(word.sense);
      } else {
        reading_.mentions.back().colours.push_back(word.sense);  // `blocks that are red`
      }
      return;
    }
    if (word.kind == WordKind::place && says_where_last_is(i)) {
      reading_.mentions.back().places.push_back(word.sense);  // `the drawer at the bottom`
      reading_.mentions.back().placed_by = i;
      begun_ = false;
      open_ = {};
      preposition_.clear();
      return;
    }
    if (word.kind == WordKind::place) return begin_at(i), open_.places.push_back(word.sense);
    if (word.kind == WordKind::adjective) return begin_at(i), open_.adjectives.push_back(word.sense);
    // `block 2`, `number two`: a name, and no count
    const bool named =
        i > 0 && word.before == ' ' && reading_.words[i - 1].kind == WordKind::noun && !reading_.words[i - 1].plural &&
        (i + 1 == reading_.words.size() || reading_.words[i + 1].before != ' ' ||
         reading_.words[i + 1].kind == WordKind::function || reading_.words[i + 1].kind == WordKind::verb);
    if (word.kind == WordKind::number && named) return;
    if (word.kind == WordKind::number) return begin_at(i), open_.count = number_of(word), void();
    if (word.kind == WordKind::exclusion && word.sense == "other") return begin_at(i), open_.other = true, void();
    if (is_article(word.text) && !(word.text == "that" && i > 0 && reading_.words[i - 1].kind == WordKind::noun)) {
      begin_at(i);
      if (word.text == "both") open_.count = 2;
      return;
    }
    if (is_particle(i)) {
      begun_ = false;
      open_ = {};
      preposition_.clear();
      return;
    }
    if (kPrepositions.contains(word.text)) {
      const std::optional<int> part = word.text == "of" ? open_.count : std::nullopt;
      open_ = {};
      begun_ = false;
      if (part) part_of_ = part;  // `three of the blocks`
      preposition_ = word.text;
      return;
    }
    if (word.text == "'s" && !reading_.mentions.empty()) {
      preposition_ = reading_.mentions.back().preposition;  // `on the tree's spokes`: on the spokes
      return;
    }
    aside_ |= (word.text == "that" || word.text == "that's" || word.text == "which") && i > 0 &&
              reading_.words[i - 1].kind == WordKind::noun;
    if (word.kind == WordKind::own && begun_) return open_.adjectives.push_back(word.sense);  // `the kitchen knife`
    if (word.kind == WordKind::verb || word.kind == WordKind::own) {
      open_ = {};
      begun_ = false;
      preposition_.clear();
    }
  }

  std::string role_of(std::size_t i) const {
    static const std::map<std::string, std::string> kRoles = {
        {"on", "to"},     {"onto", "to"},    {"upon", "to"}, {"in", "to"},     {"into", "to"},    {"inside", "to"},
        {"within", "to"}, {"to", "to"},      {"at", "to"},   {"toward", "to"}, {"towards", "to"}, {"from", "from"},
        {"off", "from"},  {"outof", "from"}, {"of", "of"},   {"with", "with"}, {"by", "with"}};
    const Mention& mention = reading_.mentions[i];
    const Segment& segment = reading_.segments[mention.segment];
    const auto after = [&](const char* text) {
      return mention.head + 1 < reading_.words.size() && reading_.words[mention.head + 1].text == text;
    };
    if (after("'s")) return "of";
    if (mention.partitive && mention.preposition == "of") return "part";
    if (mention.preposition == "with" && i > 0 && belongs(mention, reading_.mentions[i - 1])) return "of";
    const bool built = segment.verb && reading_.words[*segment.verb].sense == "build" && *segment.verb < mention.first;
    if (built && (mention.preposition == "from" || mention.preposition == "outof")) return "object build";
    const bool where = mention.first > 0 && reading_.words[mention.first - 1].text == "where";
    if (where) return "where";
    if (after("is") && mention.head + 2 < reading_.words.size() && reading_.words[mention.head + 2].text == "where")
      return "place";
    if (!mention.preposition.empty()) {
      const auto found = kRoles.find(mention.preposition);
      const std::string role = found == kRoles.end() ? mention.preposition : found->second;
      const bool of_verb = role != "of" && segment.verb && *segment.verb < mention.first;
      return of_verb ? role + " " + reading_.words[*segment.verb].sense : role;
    }
    if (segment.verb && *segment.verb < mention.first) return "object " + reading_.words[*segment.verb].sense;
    // `solve the puzzle`: of a verb that only the author explains
    if (mention.first > segment.begin && reading_.words[mention.first - 1].kind == WordKind::own)
      return "object " + reading_.words[mention.first - 1].sense;
    // `the blocks are to form a pyramid`
    if (const auto verb = verb_before(mention); verb && !segment.verb) return "object " + reading_.words[*verb].sense;
    // `the bowl, the fork and the glass`
    const bool listed = i > 0 && segment.begin > 0 && reading_.words[segment.begin].before != ':' &&
                        reading_.words[segment.begin].before != ';' && !verb_in(segment);
    return listed ? reading_.mentions[i - 1].role : "subject" + verb_after(mention, segment);
  }

  // `switch on the lamp`, `plug in the charger`, `twist off the lid`: a part of the verb
  bool is_particle(std::size_t i) const {
    static const std::map<std::string, std::set<std::string>> kOf = {
        {"switch", {"on", "off"}}, {"turn", {"on", "off"}}, {"insert", {"in"}}, {"push", {"in"}},   {"slide", {"in"}},
        {"take", {"off"}},         {"pull", {"off"}},       {"lift", {"off"}},  {"remove", {"off"}}};
    if (i == 0 || i + 1 >= reading_.words.size() || reading_.words[i].before != ' ') return false;
    const auto found = kOf.find(reading_.words[i - 1].sense);
    return found != kOf.end() && reading_.words[i - 1].kind == WordKind::verb &&
           found->second.contains(reading_.words[i].text) && reading_.words[i + 1].before == ' ';
  }

  // `the cube in the drawer should …`, `bring the cube in the drawer to …`: where it is, not where it goes
  bool says_where(std::size_t i) const {
    static const std::set<std::string> kWhere = {"in", "on", "inside", "within", "behind"};
    static const std::set<std::string> kIs = {"should", "must", "needs", "has", "ought", "goes", "belongs"};
    const Mention &mention = reading_.mentions[i], &before = reading_.mentions[i - 1];
    const bool possessive =
        i > 1 && before.head + 1 < reading_.words.size() && reading_.words[before.head + 1].text == "'s";
    const Mention& last = possessive ? reading_.mentions[i - 2] : before;  // `the cup on the cabinet's shelf`
    if (last.segment != mention.segment || !last.preposition.empty() || !kWhere.contains(mention.preposition))
      return false;
    if (last.head + 1 >= reading_.words.size() || reading_.words[last.head + 1].text != mention.preposition)
      return false;
    const Segment& segment = reading_.segments[mention.segment];
    for (std::size_t k = mention.head + 1; k < segment.end; ++k)
      if (kIs.contains(reading_.words[k].text)) return true;
    if (i + 1 == reading_.mentions.size() || !segment.verb || *segment.verb > last.first) return false;
    const Mention& next = reading_.mentions[i + 1];
    return next.segment == mention.segment && (next.preposition == "to" || next.preposition == "onto");
  }

  // `the button with the navy cap`: a part of what was named just before, or that itself
  bool belongs(const Mention& part, const Mention& whole) const {
    if (part.segment != whole.segment || whole.head + 1 >= reading_.words.size() ||
        reading_.words[whole.head + 1].text != "with" ||
        (!part.colours.empty() && !whole.colours.empty() && part.colours != whole.colours))
      return false;
    return std::any_of(part.things.begin(), part.things.end(), [&](const std::string& name) {
      return std::any_of(whole.things.begin(), whole.things.end(),
                         [&](const std::string& one) { return name == one || name.starts_with(one + "."); });
    });
  }

  static bool is_part(const Mention& part, const Mention& whole) {
    return part.segment == whole.segment &&
           std::any_of(part.things.begin(), part.things.end(), [&](const std::string& name) {
             return std::any_of(whole.things.begin(), whole.things.end(),
                                [&](const std::string& one) { return name.starts_with(one + "."); });
           });
  }

  // Since the last thing that was named.
  std::optional<std::size_t> verb_before(const Mention& mention) const {
    const Segment& segment = reading_.segments[mention.segment];
    const bool first = &mention == reading_.mentions.data() || (&mention - 1)->segment != mention.segment;
    for (std::size_t k = mention.first; !first && k > segment.begin && k > (&mention - 1)->head; --k)
      if (reading_.words[k - 1].kind == WordKind::verb) return k - 1;
    return std::nullopt;
  }

  std::string verb_after(const Mention& mention, const Segment& segment) const {
    for (std::size_t k = mention.head + 1; k < segment.end; ++k)
      if (reading_.words[k].kind == WordKind::verb) return " " + reading_.words[k].sense;
    return "";
  }

  bool verb_in(const Segment& segment) const {
    for (std::size_t k = segment.begin; k < segment.end; ++k)
      if (reading_.words[k].kind == WordKind::verb || reading_.words[k].text == "is" || reading_.words[k].text == "are")
        return true;
    return false;
  }

  // `the door on the left`, `the drawer at the top of the chest`, not `put it on the left shelf`
  bool says_where_last_is(std::size_t i) const {
    const std::vector<Word>& words = reading_.words;
    if (i < 3 || words[i - 1].text != "the" || words[i].before != ' ' || words[i - 1].before != ' ') return false;
    if (words[i - 2].text != "on" && words[i - 2].text != "at" && words[i - 2].text != "in") return false;
    if (reading_.mentions.empty() || reading_.mentions.back().head + 3 != i) return false;
    return i + 1 == words.size() || words[i + 1].before != ' ' || words[i + 1].text == "of" ||
           words[i + 1].kind == WordKind::function || words[i + 1].kind == WordKind::order;
  }

  // `blocks that are red`, `the box is blue`
  bool describes_last(std::size_t i) const {
    static const std::set<std::string> kIs = {"is", "are", "coloured", "colored", "painted"};
    return i > 0 && kIs.contains(reading_.words[i - 1].text);
  }

  void begin_at(std::size_t i) {
    if (begun_) return;
    open_.first = i;
    begun_ = true;
  }

  void finish(std::size_t head, std::size_t segment, bool pronoun) {
    const Word& word = reading_.words[head];
    open_.head = head;
    open_.segment = segment;
    open_.preposition = preposition_;
    open_.plural = word.plural || word.text == "ones" || word.text == "others";
    open_.other |= word.text == "others" || word.text == "rest" || word.text == "remaining";
    open_.sense = pronoun ? (reading_.mentions.empty() ? "" : reading_.mentions.back().sense) : word.sense;
    if (part_of_) {
      open_.partitive = true;
      if (!open_.count)
        open_.count = part_of_;
      else if (preposition_ == "of")
        open_.total = std::exchange(open_.count, part_of_);  // `two of the three blocks`: two
    } else if (preposition_ == "of" && open_.plural) {
      open_.partitive = true;
    }
    open_.aside = std::exchange(aside_, false);
    part_of_.reset();
    reading_.mentions.push_back(std::move(open_));
    open_ = {};
    begun_ = false;
    preposition_.clear();
  }

  // Things whose names fit: those that the noun names, or else those of which it is a word at all.
  void resolve(Mention& mention) const {
    for (const bool by_head : {true, false}) {
      for (const SpokenThing& thing : meaning_.things) {
        if (!(by_head ? thing.heads : thing.words).contains(mention.sense)) continue;
        const bool modified = std::all_of(mention.modifiers.begin(), mention.modifiers.end(), [&](const auto& word) {
          return thing.words.contains(word) || !meaning_names(word);
        });
        const bool placed = std::all_of(mention.places.begin(), mention.places.end(), [&](const auto& word) {
          return thing.words.contains(word) || !meaning_names(word);
        });
        if (modified && placed) mention.things.push_back(thing.name);
      }
      mention.by_head = by_head;
      if (!mention.things.empty()) return;
    }
  }

  // `the rod of the rack`: no other rod.
  static void narrow(Mention& part, const Mention& whole) {
    std::vector<std::string> of_it;
    for (const std::string& name : part.things)
      for (const std::string& one : whole.things)
        if (name.starts_with(one + ".")) {
          of_it.push_back(name);
          break;
        }
    if (!of_it.empty()) part.things = std::move(of_it);
  }

  bool meaning_names(const std::string& word) const {
    return std::any_of(meaning_.things.begin(), meaning_.things.end(),
                       [&](const SpokenThing& thing) { return thing.words.contains(word); });
  }

  Reading& reading_;
  const Meaning& meaning_;
  Mention open_;
  bool begun_ = false, aside_ = false;
  std::string preposition_;
  std::optional<int> part_of_;
};

}  // namespace

void read_mentions(Reading& reading, const Meaning& meaning) { MentionReader(reading, meaning).read(); }

}  // namespace stampede
