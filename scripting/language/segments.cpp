// Stretches of a sentence between commas and joining words, and the order in which they happen.
#include <algorithm>

#include "scripting/language/parser_parts.h"

namespace stampede {

const std::set<std::string> kJoins = {"and",   "then",   "but",  "while", "until", "so", "because",
                                      "after", "before", "once", "when",  "or",    "if"};
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
    // `get the drawer open`, `get the button pressed`
    for (std::size_t i = segment.verb.value_or(segment.end) + 1; i < segment.end; ++i)
      if (words[*segment.verb].text == "get" && words[i].kind == WordKind::verb &&
          (words[i].sense == "open" || words[i].sense == "close" || words[i].text.ends_with("ed")))
        segment.verb = i;
  }
  return segments;
}

namespace {

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

}  // namespace

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

void read_light_verbs(std::vector<Word>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].sense == "build" && words[i].text.starts_with("mak")) {  // `make the lamp shine`
      bool built = false;
      for (std::size_t k = i + 1; k < words.size() && words[k].before == ' '; ++k)
        built |= kBuilt.contains(words[k].sense);
      const bool goes = std::any_of(words.begin() + static_cast<std::ptrdiff_t>(i), words.end(),
                                    [](const Word& word) { return word.text == "go"; });  // `make it go dark`
      if (!built && !goes) words[i].kind = WordKind::function;
    }
    const bool gets = words[i].text == "get" || words[i].text == "getting", turns = words[i].text.starts_with("turn");
    if (words[i].kind != WordKind::verb || !(gets || turns)) continue;
    for (std::size_t k = i + 1; k < words.size() && words[k].before == ' ' && words[k].kind != WordKind::verb; ++k) {
      const bool ends = k + 1 == words.size() || words[k + 1].before != ' ' || kJoins.contains(words[k + 1].text);
      if (turns && (words[k].text == "on" || words[k].text == "off") && (k == i + 1 || ends)) words[i].sense = "switch";
      if (gets && (words[k].text == "into" || words[k].text == "onto" || words[k].text == "to")) words[i].sense = "put";
    }
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

}  // namespace stampede
