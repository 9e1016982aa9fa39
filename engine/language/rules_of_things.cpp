// Whether what is named is there, has the colours, counts and places that are said, and all is named that has to be:
// what is wanted, and what tells this variation from the others.
#include <algorithm>

#include "engine/language/rules.h"

namespace stampede {
namespace {

bool any_thing(const Sentence& sentence, const Mention& mention, const auto& test) {
  return std::ranges::any_of(mention.things,
                             [&](const std::string& name) { return test(*sentence.meaning.thing(name)); });
}

// What is said of a thing is true of it: by the author, or by facts.
template <std::vector<std::string> Mention::*said>
Fault not_so(const Sentence& sentence, const Mention& mention) {
  const bool colour = said == &Mention::colours, place = said == &Mention::places;
  for (const std::string& one : mention.*said) {
    if (sentence.claims.attributes.contains({one, mention.sense})) continue;
    const bool built = colour && mention.things.empty() && sentence.head(mention).is("built");
    if (built && sentence.claims.senses.contains(one)) continue;
    if (!any_thing(sentence, mention, [&](const SpokenThing& thing) {
          return (colour ? thing.colours : thing.words).contains(one) && (!place || thing.roles.wanted);
        }))
      return quoted(one + " " + mention.sense);
  }
  return {};
}

Fault not_there(const Sentence& sentence, const Mention& mention) {
  const Word& noun = sentence.head(mention);
  const bool there = mention.sense.empty() || noun.is("general") || (noun.is("air") && sentence.lifts()) ||
                     (noun.is("grip") && sentence.swings()) || sentence.claims.senses.contains(mention.sense) ||
                     std::ranges::any_of(sentence.meaning.things,
                                         [&](const SpokenThing& one) { return one.words.contains(mention.sense); });
  return there ? std::nullopt : Fault(quoted(mention.sense));
}

// A button's cap is no other button.
int count_of(const Sentence& sentence, const Mention& mention, ThingRole role) {
  int count = 0;
  for (const std::string& name : mention.things) {
    const std::string whole = name.substr(0, name.find('.'));
    const bool again = whole != name && std::ranges::find(mention.things, whole) != mention.things.end();
    count += sentence.meaning.thing(name)->roles.*role && !again ? 1 : 0;
  }
  return count;
}

// `two of the jars`, where all that the author says is which.
Fault which_of_several(const Sentence& sentence, const Mention& mention) {
  const auto [all, handled] = sentence.all_and_handled(mention.sense);
  if (mention.count && mention.partitive && !sentence.claims.counts.contains(mention.sense) && handled > 0 &&
      *mention.count < all && mention.roles.handled)
    return "which " + mention.sense + " of several";
  return {};
}

Fault other_count(const Sentence& sentence, const Mention& mention) {
  if (!mention.count) return {};
  const int count = *mention.count;
  const auto& counts = sentence.claims.counts;
  const auto own = counts.find(mention.sense), of_role = counts.find(mention.sense + " " + mention.role());
  const bool of_all = mention.partitive && sentence.after(mention, "of") && !mention.total;
  if (of_all && count == sentence.all_and_handled(mention.sense).first) return {};  // `of the two jars, …`
  if (count == 1 && mention.things.empty() && sentence.head(mention).is("built")) return {};
  const bool all = sentence.reading.words[mention.first].is("all");
  if (mention.plural && !mention.partitive && !all && count > 1 &&
      count == count_of(sentence, mention, mention.other ? &ThingRoles::moved : &ThingRoles::handled))
    return {};
  const bool right = of_role != counts.end() ? of_role->second.contains(count)
                     : own != counts.end()   ? own->second.contains(count)
                                             : count == count_of(sentence, mention, &ThingRoles::wanted) ||
                                                 count == count_of(sentence, mention, &ThingRoles::moved);
  return right ? std::nullopt : Fault(std::to_string(count) + " " + mention.sense);
}

// One for several, or several for one, where the author never says so.
Fault one_for_several(const Sentence& sentence, const Mention& mention) {
  if (mention.count || mention.partitive || mention.other) return {};
  bool ever_plural = false, ever_single = false;
  for (const Reading& reading : sentence.claims.own)
    for (const Mention& one : reading.mentions)
      if (one.sense == mention.sense) (one.plural ? ever_plural : ever_single) = true;
  const int count = count_of(sentence, mention, &ThingRoles::wanted);
  if (mention.plural && ever_single && !ever_plural && count == 1) return "several of " + quoted(mention.sense);
  if (!mention.plural && ever_plural && !ever_single && count > 1) return "only one of " + quoted(mention.sense);
  return {};
}

// `left the left door`: a way to somewhere that its word is missing from.
Fault side_twice(const Sentence&, const Mention& mention) {
  const bool twice = Texts(mention.places.begin(), mention.places.end()).size() < mention.places.size();
  return twice ? Fault(quoted(mention.places.front()) + " twice") : std::nullopt;
}

Fault no_part(const Sentence& sentence, const Mention& mention) {
  if (mention.things.empty() || mention.other || mention.roles.wanted || sentence.segment(mention).excluding ||
      sentence.stands_on_table(mention))
    return {};
  if (mention.partitive && (mention.plural || mention.count)) return {};  // `of all the groceries`
  return "the " + mention.things.front() + " has no part in this";
}

// Those that count nothing that is named.
Fault number_of_nothing(const Sentence& sentence) {
  const std::vector<std::string> ours = free_numbers(sentence.reading, sentence.beside());
  const bool said =
      std::ranges::any_of(sentence.claims.own, [&](const Reading& own) { return free_numbers(own, {}) == ours; });
  return ours.empty() || said ? std::nullopt : Fault(ours.front());
}

// Also those that are said of no noun.
Fault colour_of_nothing(const Sentence& sentence) {
  for (const std::string& colour : colours_in(sentence.reading)) {
    const bool borne = std::ranges::any_of(sentence.meaning.things, [&](const SpokenThing& one) {
      return one.roles.wanted && one.colours.contains(colour);
    });
    if (!borne && !sentence.claims.senses.contains(colour)) return quoted(colour);
  }
  return {};
}

// At least those of one of the author's sentences.
Fault missing_colour(const Sentence& sentence) {
  const Texts ours = colours_in(sentence.reading);
  const bool enough = std::ranges::any_of(
      sentence.claims.own, [&](const Reading& own) { return std::ranges::includes(ours, colours_in(own)); });
  return enough ? std::nullopt : Fault("a colour is left out");
}

Fault side_of_nothing(const Sentence& sentence) {
  for (const auto& place : free_places(sentence.reading))
    if (std::ranges::none_of(sentence.claims.own, [&](const Reading& own) { return free_places(own).contains(place); }))
      return quoted(place.first + " " + place.second);
  return {};
}

Texts set_of(const std::vector<std::string>& words) { return {words.begin(), words.end()}; }

// What tells variations apart: as the sentence says it, and as each of the author's does.
std::vector<std::string> said_marks(const Sentence& sentence) {
  return marks_in(sentence.reading, sentence.claims.marks, sentence.beside());
}
std::vector<std::vector<std::string>> own_marks(const Sentence& sentence) {
  std::vector<std::vector<std::string>> all;
  for (const Reading& own : sentence.claims.own) all.push_back(marks_in(own, sentence.claims.marks, {}));
  return all;
}

// All that an author's sentence says, in another order.
Fault other_turn(const Sentence& sentence) {
  const std::vector<std::string> said = said_marks(sentence);
  bool shuffled = false;
  for (const std::vector<std::string>& own : own_marks(sentence)) {
    if (own == said || !sentence.meaning.ordered) return {};
    shuffled |= set_of(own) == set_of(said);
  }
  return shuffled ? Fault("what has to be done first is not said first") : std::nullopt;
}

// Less is said than tells this variation from the others.
Fault missing_mark(const Sentence& sentence) {
  const Claims& claims = sentence.claims;
  const Texts said = set_of(said_marks(sentence));
  std::size_t least = claims.marks.size() + 1;
  for (const std::vector<std::string>& own : own_marks(sentence)) {
    if (set_of(own) == said) return {};
    if (!own.empty()) least = std::min(least, own.size());
  }
  if (claims.marks.empty()) return {};
  if (sentence.meaning.ordered) return "not all of the parts are named";
  const bool alone =
      std::ranges::none_of(claims.elsewhere, [&](const Texts& theirs) { return std::ranges::includes(theirs, said); });
  if (alone && said.size() >= least) return {};
  for (const std::string& sense : claims.marks)
    if (claims.senses.contains(sense) && !said.contains(sense)) return "no word says " + quoted(sense);
  return "which variation is meant";
}

// At least what one of the author's own sentences names.
Fault too_little(const Sentence& sentence) {
  bool names = false;
  for (const Reading& own : sentence.claims.own) {
    if (sentence.names_as(own)) return {};
    names |= std::ranges::any_of(own.mentions, [](const Mention& one) { return one.roles.wanted; });
  }
  const std::optional<std::string> unnamed = sentence.unnamed();
  return names && unnamed ? Fault("nothing names the " + *unnamed) : std::nullopt;
}

}  // namespace

std::span<const Rule> thing_rules() {
  using enum Rejection;
  static const Rule kRules[] = {
      {unknown_thing, "not there", not_there, true},
      {unknown_thing, "no such", not_so<&Mention::modifiers>},
      {wrong_colour, "other colour", not_so<&Mention::colours>},
      {missing_thing, "which of several", which_of_several},
      {wrong_count, "other count", other_count},
      {wrong_count, "one for several", one_for_several},
      {wrong_side, "side twice", side_twice},
      {wrong_side, "other side", not_so<&Mention::places>},
      {unproved, "bare claim", not_so<&Mention::adjectives>},
      {other_thing, "no part", no_part},
      {wrong_count, "number of nothing", number_of_nothing},
      {wrong_colour, "colour of nothing", colour_of_nothing},
      {missing_thing, "missing colour", missing_colour},
      {wrong_side, "side of nothing", side_of_nothing},
      {swapped_order, "other turn", other_turn},
      {missing_thing, "missing mark", missing_mark},
      {missing_thing, "too little", too_little},
  };
  return kRules;
}

}  // namespace stampede
