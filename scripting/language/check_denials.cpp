// What is denied, left alone or kept as it is.
#include "scripting/language/one_sentence.h"

namespace stampede {

bool OneSentence::vouched(const Segment& segment) const {
  return claims_.segments.contains(content_of(reading_, segment.begin, segment.end));
}

// `and no others`, `leave the other blocks alone`
bool OneSentence::spares_others(const Segment& segment) const {
  bool others = false;
  for (std::size_t i = segment.begin; i < segment.end; ++i)
    others |= (reading_.words[i].kind == WordKind::exclusion && reading_.words[i].sense == "other") ||
              reading_.words[i].text == "else";
  return others && !claims_.others &&
         std::none_of(reading_.mentions.begin(), reading_.mentions.end(),
                      [&](const Mention& mention) { return within(mention, segment) && !mention.other; });
}

// What is said of it holds anyway: it has no part in this.
bool OneSentence::spares(const Segment& segment) const {
  return spares_others(segment) || keeps_others(reading_, segment) || leaves_idle(segment) || denies_start(segment);
}

// `leave the chicken where it is`, `the steak still on the grill`, `the left one shut`
bool OneSentence::leaves_idle(const Segment& segment) const {
  static const std::set<std::string> kKeeps = {"leave", "leaving", "leaves", "keep", "keeping",
                                               "keeps", "stay",    "stays",  "still"};
  if (segment.negated) return false;
  const Mention* first = nullptr;
  for (const Mention& mention : reading_.mentions)
    if (first == nullptr && within(mention, segment)) first = &mention;
  if (first == nullptr || !first->preposition.empty() || first->things.empty() ||
      may_be(*first, meaning_, &SpokenThing::wanted))
    return false;
  bool keeps = false, state = false;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    keeps |= kKeeps.contains(reading_.words[i].text);
    state |= i > first->head && (reading_.words[i].text == "shut" || reading_.words[i].text == "closed");
  }
  return keeps || (state && segment.verb.value_or(segment.end) > first->head);
}

// `leave the block on the table`: it has to go somewhere else.
Maybe OneSentence::left() const {
  for (const Segment& segment : reading_.segments) {
    if (!segment.verb || !reading_.words[*segment.verb].text.starts_with("lea") || vouched(segment) ||
        denies_start(segment))
      continue;
    const Mention* object = nullptr;
    bool to = false;
    for (const Mention& mention : reading_.mentions) {
      if (!within(mention, segment)) continue;
      if (object == nullptr && mention.preposition.empty()) object = &mention;
      to |= mention.role.starts_with("to") && may_be(mention, meaning_, &SpokenThing::destination) &&
            !may_be(mention, meaning_, &SpokenThing::source);
    }
    if (object != nullptr && !object->other && may_be(*object, meaning_, &SpokenThing::wanted) && !to)
      return no(Rejection::negated, "the " + object->sense + " may not be left");
  }
  return {};
}

bool OneSentence::within(const Mention& mention, const Segment& segment) const {
  return mention.head >= segment.begin && mention.head < segment.end;
}

Maybe OneSentence::denials() const {
  for (const Segment& segment : reading_.segments)
    if ((segment.negated || segment.excluding) && !vouched(segment) && !spares_others(segment) &&
        !spares_idle(segment) && !leaves_idle(segment) && !denies_start(segment))
      for (std::size_t i = segment.begin; i < segment.end; ++i)
        if (reading_.words[i].kind == WordKind::negation || reading_.words[i].kind == WordKind::exclusion)
          return no(Rejection::negated, quoted(reading_.words[i].text));
  return left();
}

// `it should no longer be on its stand`, `the door must not stay open`, `in the block instead of on the board`: what
// holds at the start and has to end
bool OneSentence::denies_start(const Segment& segment) const {
  static const std::set<std::string> kStays = {"belong", "lie", "stand", "hang", "leave", "open", "close"};
  static const std::map<std::string, std::string> kStates = {{"open", "close"}, {"closed", "open"}, {"shut", "open"}};
  const bool instead = std::any_of(reading_.words.begin() + static_cast<std::ptrdiff_t>(segment.begin),
                                   reading_.words.begin() + static_cast<std::ptrdiff_t>(segment.end),
                                   [](const Word& word) { return word.text == "instead"; });
  if (!segment.negated && !instead) return false;
  std::size_t from = segment.begin;
  for (std::size_t i = segment.begin; i < segment.end; ++i)
    if (reading_.words[i].kind == WordKind::negation) from = i;
  bool state = false, place = false, is = instead;
  for (std::size_t i = segment.begin; i < segment.end; ++i) {
    const Word& word = reading_.words[i];
    is |= word.text == "be" || word.text == "is" || word.text == "are" || word.text == "stay" ||
          word.text == "remain" || word.sense == "belong" || word.text.starts_with("lea") || word.text == "left";
    if (i <= from) continue;
    if (word.kind == WordKind::verb && !kStays.contains(word.sense) && word.sense != "put") return false;
    const auto opposite = kStates.find(word.text);
    if (opposite == kStates.end()) continue;
    if (!claims_.directions.contains(opposite->second)) return false;
    state = true;
  }
  for (const Mention& mention : reading_.mentions) {
    if (!within(mention, segment) || mention.head < from) continue;
    if (state && mention.preposition.empty() && may_be(mention, meaning_, &SpokenThing::wanted)) continue;
    if (may_be(mention, meaning_, &SpokenThing::destination) || !may_be(mention, meaning_, &SpokenThing::source))
      return false;
    place = true;
  }
  return (state || place) && is;
}

// `spare the tomatoes`: things that have no part in it
bool OneSentence::spares_idle(const Segment& segment) const {
  if (segment.negated) return false;
  bool any = false;
  for (const Mention& mention : reading_.mentions) {
    if (!within(mention, segment)) continue;
    if (may_be(mention, meaning_, &SpokenThing::wanted)) return false;
    any |= !mention.things.empty();
  }
  return any;
}

}  // namespace stampede
