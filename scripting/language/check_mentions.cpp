// Whether what is named is there, and has the colours, counts and places that are said.
#include "scripting/language/one_sentence.h"

namespace stampede {

const SpokenThing* OneSentence::thing(const std::string& name) const {
  for (const SpokenThing& one : meaning_.things)
    if (one.name == name) return &one;
  return nullptr;
}

Maybe OneSentence::mentions() const {
  for (const Mention& mention : reading_.mentions) {
    const Segment& segment = reading_.segments[mention.segment];
    if (vouched(segment) && segment.negated) continue;
    if (spares(segment)) {
      if (Maybe bad = known(mention)) return bad;
      continue;
    }
    for (const auto part : {&OneSentence::known, &OneSentence::coloured, &OneSentence::counted, &OneSentence::placed,
                            &OneSentence::has_part})
      if (Maybe bad = (this->*part)(mention)) return bad;
  }
  if (Maybe bad = numbers()) return bad;
  if (Maybe bad = colours()) return bad;
  for (const auto& [before, place] : free_places(reading_))
    if (!claims_.places.contains({before, place})) return no(Rejection::wrong_side, quoted(before + " " + place));
  for (const std::string& relation : relations_in(reading_)) {
    if (relation == "around" && grain_ == Grain::motions) continue;  // the fingers
    if (!claims_.relations.contains(relation) && !(relation == "over" && (rises() || moves_above())))
      return no(Rejection::wrong_side, quoted(relation));
  }
  return {};
}

// Lifting ends in the air, above the table.
bool OneSentence::lifts() const {
  return meaning_.skills.contains("lift") || (meaning_.skills.size() == 1 && meaning_.skills.contains("pick"));
}

// What swings or slides has something to take hold of.
bool OneSentence::swings() const { return meaning_.skills.contains("open") || meaning_.skills.contains("close"); }

bool OneSentence::rises() const {
  return lifts() && std::all_of(reading_.mentions.begin(), reading_.mentions.end(), [](const Mention& mention) {
           return !says_above(mention) || mention.sense == "table";
         });
}

// Where motions are told: `move it over the bin and let go`
bool OneSentence::moves_above() const {
  return grain_ != Grain::goal &&
         std::all_of(reading_.mentions.begin(), reading_.mentions.end(),
                     [&](const Mention& mention) { return !says_above(mention) || is_above(mention); });
}

bool OneSentence::is_above(const Mention& mention) const {
  return may_be(mention, meaning_, &SpokenThing::destination) || may_be(mention, meaning_, &SpokenThing::handled);
}

// How many there are of what a noun names, and how many of these are handled.
std::pair<int, int> OneSentence::all_and_handled(const std::string& sense) const {
  int all = 0, handled = 0;
  for (const SpokenThing& one : meaning_.things) {
    if (!one.heads.contains(sense) || one.region) continue;
    ++all;
    handled += (carries() ? one.moved : one.handled) ? 1 : 0;
  }
  return {all, handled};
}

// Those that count nothing that is named. Of what is left alone: how many there are.
Maybe OneSentence::numbers() const {
  for (const Segment& segment : reading_.segments) {
    if (!spares(segment)) continue;
    for (std::size_t i = segment.begin; i < segment.end; ++i) {
      const Word& word = reading_.words[i];
      if (word.kind != WordKind::number || vouched(segment)) continue;
      std::set<std::string> kinds;
      for (const Mention& mention : reading_.mentions)
        if (mention.head < segment.begin) kinds.insert(mention.sense);
      if (std::none_of(kinds.begin(), kinds.end(), [&](const std::string& kind) {
            const auto [all, handled] = all_and_handled(kind);
            return handled > 0 && std::to_string(all - handled) == word.sense;
          }))
        return no(Rejection::wrong_count, word.sense + " others");
    }
  }
  const std::vector<std::string> ours = free_numbers(reading_, beside());
  const auto bare = [](std::vector<std::string> list) {
    for (std::string& one : list) one = one.substr(0, one.find(' '));
    return list;
  };
  const bool said = ours.empty() || std::any_of(claims_.numbers.begin(), claims_.numbers.end(), [&](const auto& own) {
                      return own == ours || bare(own) == bare(ours);
                    });
  if (!said) return no(Rejection::wrong_count, ours.front());
  return {};
}

// Those that are said of no noun too; and at least those of one of the author's sentences.
Maybe OneSentence::colours() const {
  const std::set<std::string> ours = colours_in(reading_);
  for (const std::string& colour : ours) {
    const bool borne = std::any_of(meaning_.things.begin(), meaning_.things.end(),
                                   [&](const SpokenThing& one) { return one.wanted && one.colours.contains(colour); });
    if (!borne && !claims_.senses.contains(colour)) return no(Rejection::wrong_colour, quoted(colour));
  }
  const bool enough = std::any_of(claims_.colours.begin(), claims_.colours.end(), [&](const auto& own) {
    return std::includes(ours.begin(), ours.end(), own.begin(), own.end());
  });
  if (!enough && !claims_.colours.empty()) return no(Rejection::missing_thing, "a colour is left out");
  return {};
}

Maybe OneSentence::known(const Mention& mention) const {
  static const std::set<std::string> kGeneral = {"side", "order",  "colour", "space", "thing",
                                                 "end",  "number", "hand",   "shape", "item"};
  const auto there = [&](const std::string& sense) {
    return sense.empty() || (sense == "air" && lifts()) || (sense == "handle" && swings()) ||
           kGeneral.contains(sense) || claims_.senses.contains(sense) ||
           std::any_of(meaning_.things.begin(), meaning_.things.end(),
                       [&](const SpokenThing& one) { return one.words.contains(sense); });
  };
  if (!there(mention.sense)) return no(Rejection::unknown_thing, quoted(mention.sense));
  for (const std::string& word : mention.modifiers) {
    const bool of_thing = std::any_of(mention.things.begin(), mention.things.end(),
                                      [&](const std::string& name) { return thing(name)->words.contains(word); });
    if (!of_thing && !claims_.attributes.contains({word, mention.sense}))
      return no(Rejection::unknown_thing, quoted(word + " " + mention.sense));
  }
  return {};
}

Maybe OneSentence::coloured(const Mention& mention) const {
  const std::set<std::string> different(mention.colours.begin(), mention.colours.end());
  if (different.size() < mention.colours.size()) return no(Rejection::wrong_count, "a colour twice");
  for (const std::string& colour : mention.colours) {
    if (claims_.attributes.contains({colour, mention.sense})) continue;
    const bool borne = std::any_of(mention.things.begin(), mention.things.end(),
                                   [&](const std::string& name) { return thing(name)->colours.contains(colour); });
    const bool built = mention.things.empty() && kBuilt.contains(mention.sense) && claims_.marks.ours.contains(colour);
    if (!borne && !built)
      return no(Rejection::wrong_colour, "the " + mention.sense + " is not " + colour + " in every start");
  }
  return {};
}

int OneSentence::count_of(const Mention& mention, bool SpokenThing::*role) const {
  int count = 0;
  for (const std::string& name : mention.things) {
    const std::string whole = name.substr(0, name.find('.'));
    const bool again =
        whole != name && std::find(mention.things.begin(), mention.things.end(), whole) != mention.things.end();
    count += thing(name)->*role && !again ? 1 : 0;  // a button's cap is no other button
  }
  return count;
}

Maybe OneSentence::counted(const Mention& mention) const {
  const auto own = claims_.counts.find(mention.sense);
  if (mention.count) {
    if (*mention.count == 1 && mention.plural && !mention.partitive)
      return no(Rejection::wrong_count, "one of several " + mention.sense);
    const auto [all_of_them, handled_of_them] = all_and_handled(mention.sense);
    if (mention.total && *mention.total != all_of_them)
      return no(Rejection::wrong_count, "of " + std::to_string(*mention.total) + " " + mention.sense);
    if (mention.partitive && own == claims_.counts.end() && handled_of_them > 0 && *mention.count < all_of_them &&
        may_be(mention, meaning_, &SpokenThing::handled))
      return no(Rejection::missing_thing, "which " + mention.sense + " of several");
    if (mention.partitive && mention.preposition == "of" && !mention.total && *mention.count == all_of_them)
      return {};  // `of the two jars, …`
    if (*mention.count == 1 && mention.things.empty() && kBuilt.contains(mention.sense)) return {};
    const bool all = reading_.words[mention.first].text == "all" || reading_.words[mention.first].text == "both";
    if (mention.plural && !mention.partitive && !all && *mention.count > 1 &&
        *mention.count == count_of(mention, mention.other ? &SpokenThing::moved : &SpokenThing::handled))
      return {};
    const auto of_role = claims_.counts.find(mention.sense + " " + mention.role);
    if (of_role != claims_.counts.end()) {
      if (of_role->second.contains(*mention.count)) return {};
      return no(Rejection::wrong_count, std::to_string(*mention.count) + " " + mention.sense);
    }
    if (own != claims_.counts.end() && own->second.contains(*mention.count)) return {};
    if (own == claims_.counts.end() && (*mention.count == count_of(mention, &SpokenThing::wanted) ||
                                        *mention.count == count_of(mention, &SpokenThing::moved)))
      return {};
    return no(Rejection::wrong_count, std::to_string(*mention.count) + " " + mention.sense);
  }
  if (mention.partitive || mention.other) return {};
  // One for several, or several for one, where the author never says so.
  bool ever_plural = false, ever_single = false;
  for (const Reading& reading : claims_.own)
    for (const Mention& one : reading.mentions)
      if (one.sense == mention.sense) (one.plural ? ever_plural : ever_single) = true;
  const int count = count_of(mention, &SpokenThing::wanted);
  if (mention.plural && ever_single && !ever_plural && count == 1)
    return no(Rejection::wrong_count, "several of " + quoted(mention.sense));
  if (!mention.plural && ever_plural && !ever_single && count > 1)
    return no(Rejection::wrong_count, "only one of " + quoted(mention.sense));
  return {};
}

Maybe OneSentence::placed(const Mention& mention) const {
  const std::set<std::string> different(mention.places.begin(), mention.places.end());
  if (different.size() < mention.places.size())
    return no(Rejection::wrong_side, quoted(mention.places.front()) + " twice");
  for (const std::string& place : mention.places) {
    if (claims_.attributes.contains({place, mention.sense})) continue;
    const bool named = std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& name) {
      return thing(name)->words.contains(place) && thing(name)->wanted;
    });
    if (!named) return no(Rejection::wrong_side, quoted(place));
  }
  for (const std::string& word : mention.adjectives) {
    const bool named = std::any_of(mention.things.begin(), mention.things.end(),
                                   [&](const std::string& name) { return thing(name)->words.contains(word); });
    if (!named && !claims_.attributes.contains({word, mention.sense}))
      return no(Rejection::unproved, quoted(word) + " " + mention.sense);
  }
  return {};
}

Maybe OneSentence::has_part(const Mention& mention) const {
  const Segment& segment = reading_.segments[mention.segment];
  if (mention.things.empty() || mention.other || may_be(mention, meaning_, &SpokenThing::wanted)) return {};
  if (vouched(segment) || segment.excluding || spares_others(segment)) return {};
  if (mention.partitive && (mention.plural || mention.count)) return {};  // `of all the groceries`
  if (stands_on_table(mention)) return {};
  return no(Rejection::other_thing, "the " + mention.things.front() + " has no part in this");
}

}  // namespace stampede
