#include "scripting/language/reference_parser.h"

#include <algorithm>

namespace stampede {
namespace {

const std::set<std::string> kJoins = {"and",   "then",   "but",  "while", "until", "so", "because",
                                      "after", "before", "once", "when",  "or",    "if"};
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

std::vector<Segment> segments_of(const std::vector<Word>& words) {
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool joins = kJoins.contains(words[i].text) || words[i].text == "afterwards";
    if (i == 0 || words[i].before != ' ' || joins) {
      if (!segments.empty()) segments.back().end = i;
      // `, and then after` is one border
      if (!segments.empty() && segments.back().end - segments.back().begin <= 1 &&
          kJoins.contains(words[segments.back().begin].text) && words[i].before == ' ') {
        if (words[i].text == "after" || words[i].text == "before") segments.back().intro = words[i].text;
        segments.back().end = words.size();
        continue;
      }
      segments.push_back({i, words.size(), joins ? words[i].text : "", {}, false, false});
    }
  }
  for (Segment& segment : segments) {
    for (std::size_t i = segment.begin; i < segment.end; ++i) {
      const Word& word = words[i];
      segment.negated |= word.kind == WordKind::negation;
      segment.excluding |= word.kind == WordKind::exclusion && word.sense != "other";
      if (word.text == "spare" || word.text == "alone" || word.text == "untouched") segment.excluding = true;
    }
    for (std::size_t i = segment.begin; i < segment.end; ++i) {
      if (words[i].kind == WordKind::verb) {
        segment.verb = i;
        break;
      }
      if (words[i].kind == WordKind::noun || words[i].kind == WordKind::own || words[i].kind == WordKind::colour) break;
    }
    // `get the drawer open`: to open
    for (std::size_t i = segment.verb.value_or(segment.end) + 1; i < segment.end; ++i)
      if (words[*segment.verb].text == "get" && words[i].kind == WordKind::verb &&
          (words[i].sense == "open" || words[i].sense == "close"))
        segment.verb = i;
  }
  return segments;
}

// `the red one last, the lime one second`: those with a rank change places among themselves; the last comes last.
void rank_in_time(const std::vector<Word>& words, const std::vector<Segment>& segments,
                  std::vector<std::size_t>& order) {
  static const std::map<std::string, int> kRanks = {
      {"first", 1}, {"second", 2}, {"third", 3}, {"fourth", 4}, {"last", 99}};
  const auto rank = [&](std::size_t segment) {
    for (std::size_t k = segments[segment].begin; k < segments[segment].end; ++k)
      if (words[k].kind == WordKind::order && kRanks.contains(words[k].sense)) return kRanks.at(words[k].sense);
    return 0;
  };
  std::vector<std::size_t> places, ranked;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (rank(order[i]) > 0) places.push_back(i), ranked.push_back(order[i]);
  std::stable_sort(ranked.begin(), ranked.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
  for (std::size_t i = 0; i < places.size(); ++i) order[places[i]] = ranked[i];
  for (std::size_t i = 0; i + 1 < order.size(); ++i)
    if (rank(order[i]) == 99) {
      std::rotate(order.begin() + static_cast<std::ptrdiff_t>(i), order.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                  order.end());
      break;
    }
}

// `the red button first, the lime button second`: a turn, and no place.
void read_turns(std::vector<Word>& words) {
  static const std::set<std::string> kTurns = {"first", "second", "third", "fourth", "last"};
  for (std::size_t i = 1; i < words.size(); ++i) {
    const bool ends = i + 1 == words.size() || words[i + 1].before != ' ' || kJoins.contains(words[i + 1].text);
    const bool named = words[i - 1].kind == WordKind::noun || words[i - 1].kind == WordKind::colour ||
                       words[i - 1].text == "one" || words[i - 1].text == "ones";
    if (ends && named && words[i].before == ' ' && kTurns.contains(words[i].text)) words[i].kind = WordKind::order;
  }
}

std::vector<std::size_t> order_in_time(const std::vector<Word>& words, const std::vector<Segment>& segments) {
  std::vector<std::size_t> order;
  std::optional<std::size_t> waiting;  // `before putting it in, open the drawer`
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Segment& segment = segments[i];
    bool first = false;
    for (std::size_t k = segment.begin; k < segment.end; ++k)
      first |= words[k].kind == WordKind::order && words[k].sense == "first";
    if ((segment.intro == "after" || segment.intro == "once") && !order.empty()) {
      order.insert(order.end() - 1, i);
    } else if (segment.intro == "before" && order.empty() && i + 1 < segments.size()) {
      waiting = i;  // until all else is done: `before c, do a and then b`
      continue;
    } else if (first) {
      order.insert(order.begin(), i);
    } else {
      order.push_back(i);
    }
  }
  if (waiting) order.push_back(*waiting);
  rank_in_time(words, segments, order);
  return order;
}

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
      while (segment + 1 < reading_.segments.size() && i >= reading_.segments[segment].end) ++segment;
      step(i, segment);
    }
    for (Mention& mention : reading_.mentions) resolve(mention);
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
        i > 0 && word.before == ' ' && reading_.words[i - 1].kind == WordKind::noun && !reading_.words[i - 1].plural;
    if (word.kind == WordKind::number && named) return;
    if (word.kind == WordKind::number) return begin_at(i), open_.count = number_of(word), void();
    if (word.kind == WordKind::exclusion && word.sense == "other") return begin_at(i), open_.other = true, void();
    if (is_article(word.text) && !(word.text == "that" && i > 0 && reading_.words[i - 1].kind == WordKind::noun)) {
      begin_at(i);
      if (word.text == "both") open_.count = 2;
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
    aside_ |= (word.text == "that" || word.text == "which") && i > 0 && reading_.words[i - 1].kind == WordKind::noun;
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
        reading_.words[whole.head + 1].text != "with")
      return false;
    return std::any_of(part.things.begin(), part.things.end(), [&](const std::string& name) {
      return std::any_of(whole.things.begin(), whole.things.end(),
                         [&](const std::string& one) { return name == one || name.starts_with(one + "."); });
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

Reading read_sentence(const std::string& sentence, const Meaning& meaning) {
  Reading reading;
  reading.words = meaning.lexicon.read(sentence);
  for (std::size_t i = 0; i < reading.words.size(); ++i)
    if (is_pronoun_one(reading.words, i)) reading.words[i].kind = WordKind::function;
  read_turns(reading.words);
  reading.segments = segments_of(reading.words);
  reading.in_time = order_in_time(reading.words, reading.segments);
  MentionReader(reading, meaning).read();
  return reading;
}

std::vector<std::string> content_of(const Reading& reading, std::size_t begin, std::size_t end) {
  std::vector<std::string> senses;
  for (std::size_t i = begin; i < end; ++i) {
    const WordKind kind = reading.words[i].kind;
    const std::string& text = reading.words[i].text;
    const bool way = kPrepositions.contains(text) || text == "up" || text == "down" || text == "out";
    if ((kind == WordKind::function && !way) || kind == WordKind::harmless || kind == WordKind::order) continue;
    senses.push_back(reading.words[i].sense);
  }
  return senses;
}

}  // namespace stampede
