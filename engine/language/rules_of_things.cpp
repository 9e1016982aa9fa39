// Whether what is named is there, has the colours, counts and places that are said, and all is named that has to be:
// what is wanted, and what tells this variation from the others.
#include <algorithm>

#include "engine/language/rules.h"

namespace stampede {
namespace {

using Mentions = Fault (*)(const Sentence&, const Mention&);

// The first fault in what is named; `spared`: also where it has no part in this.
template <Mentions fault, bool spared = false>
Fault in_each(const Sentence& sentence) {
  for (const Mention& mention : sentence.reading.mentions) {
    const Segment& segment = sentence.segment(mention);
    if (sentence.vouched(segment) && segment.negated) continue;
    if (!spared && sentence.spares(segment)) continue;
    if (Fault found = fault(sentence, mention)) return found;
  }
  return {};
}

bool any_thing(const Sentence& sentence, const Mention& mention, const auto& test) {
  return std::any_of(mention.things.begin(), mention.things.end(),
                     [&](const std::string& name) { return test(*sentence.meaning.thing(name)); });
}

bool is_claimed(const Sentence& sentence, const std::string& attribute, const Mention& mention) {
  return sentence.claims.attributes.contains({attribute, mention.sense});
}

// A word of its names, or of the author's for it.
bool is_called(const Sentence& sentence, const std::string& word, const Mention& mention) {
  return is_claimed(sentence, word, mention) ||
         any_thing(sentence, mention, [&](const SpokenThing& thing) { return thing.words.contains(word); });
}

Fault not_there(const Sentence& sentence, const Mention& mention) {
  const Word& noun = sentence.head(mention);
  const bool there = mention.sense.empty() || noun.is("general") || (noun.is("air") && sentence.lifts()) ||
                     (noun.is("grip") && sentence.swings()) || sentence.claims.senses.contains(mention.sense) ||
                     std::any_of(sentence.meaning.things.begin(), sentence.meaning.things.end(),
                                 [&](const SpokenThing& one) { return one.words.contains(mention.sense); });
  return there ? std::nullopt : Fault(quoted(mention.sense));
}

Fault no_such(const Sentence& sentence, const Mention& mention) {
  for (const std::string& word : mention.modifiers)
    if (!is_called(sentence, word, mention)) return quoted(word + " " + mention.sense);
  return {};
}

Fault other_colour(const Sentence& sentence, const Mention& mention) {
  for (const std::string& colour : mention.colours) {
    const bool built =
        mention.things.empty() && sentence.head(mention).is("built") && sentence.claims.marks.ours.contains(colour);
    if (!built && !is_claimed(sentence, colour, mention) &&
        !any_thing(sentence, mention, [&](const SpokenThing& thing) { return thing.colours.contains(colour); }))
      return "the " + mention.sense + " is not " + colour + " in every start";
  }
  return {};
}

// A button's cap is no other button.
int count_of(const Sentence& sentence, const Mention& mention, ThingRole role) {
  int count = 0;
  for (const std::string& name : mention.things) {
    const std::string whole = name.substr(0, name.find('.'));
    const bool again =
        whole != name && std::find(mention.things.begin(), mention.things.end(), whole) != mention.things.end();
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

Fault side_twice(const Sentence&, const Mention& mention) {
  const bool twice = Texts(mention.places.begin(), mention.places.end()).size() < mention.places.size();
  return twice ? Fault(quoted(mention.places.front()) + " twice") : std::nullopt;
}

Fault other_side(const Sentence& sentence, const Mention& mention) {
  for (const std::string& place : mention.places)
    if (!is_claimed(sentence, place, mention) && !any_thing(sentence, mention, [&](const SpokenThing& thing) {
          return thing.words.contains(place) && thing.roles.wanted;
        }))
      return quoted(place);
  return {};
}

Fault bare_claim(const Sentence& sentence, const Mention& mention) {
  for (const std::string& word : mention.adjectives)
    if (!is_called(sentence, word, mention)) return quoted(word) + " " + mention.sense;
  return {};
}

Fault no_part(const Sentence& sentence, const Mention& mention) {
  const Segment& segment = sentence.segment(mention);
  if (mention.things.empty() || mention.other || mention.roles.wanted || sentence.vouched(segment) ||
      segment.excluding || sentence.stands_on_table(mention))
    return {};
  if (mention.partitive && (mention.plural || mention.count)) return {};  // `of all the groceries`
  return "the " + mention.things.front() + " has no part in this";
}

// Those that count nothing that is named.
Fault number_of_nothing(const Sentence& sentence) {
  const std::vector<std::string> ours = free_numbers(sentence.reading, sentence.beside());
  const auto bare = [](std::vector<std::string> list) {
    for (std::string& one : list) one = one.substr(0, one.find(' '));
    return list;
  };
  const auto& theirs = sentence.claims.numbers;
  if (ours.empty() ||
      std::any_of(theirs.begin(), theirs.end(), [&](const auto& own) { return bare(own) == bare(ours); }))
    return {};
  return ours.front();
}

// Also those that are said of no noun.
Fault colour_of_nothing(const Sentence& sentence) {
  for (const std::string& colour : colours_in(sentence.reading)) {
    const auto& things = sentence.meaning.things;
    const bool borne = std::any_of(things.begin(), things.end(), [&](const SpokenThing& one) {
      return one.roles.wanted && one.colours.contains(colour);
    });
    if (!borne && !sentence.claims.senses.contains(colour)) return quoted(colour);
  }
  return {};
}

// At least those of one of the author's sentences.
Fault missing_colour(const Sentence& sentence) {
  const Texts ours = colours_in(sentence.reading);
  const auto& theirs = sentence.claims.colours;
  const bool enough = theirs.empty() || std::any_of(theirs.begin(), theirs.end(), [&](const Texts& own) {
                        return std::includes(ours.begin(), ours.end(), own.begin(), own.end());
                      });
  return enough ? std::nullopt : Fault("a colour is left out");
}

Fault side_of_nothing(const Sentence& sentence) {
  for (const auto& [before, place] : free_places(sentence.reading))
    if (!sentence.claims.places.contains({before, place})) return quoted(before + " " + place);
  return {};
}

// What tells variations apart, as far as the sentence says it.
std::vector<std::string> said_marks(const Sentence& sentence) {
  return marks_in(sentence.reading, sentence.claims.marks.telling, sentence.beside());
}

bool is_own(const Sentence& sentence, const std::vector<std::string>& said) {
  const Marks& marks = sentence.claims.marks;
  return std::any_of(marks.own.begin(), marks.own.end(), [&](const std::vector<std::string>& own) {
    return own == said ||
           (!sentence.meaning.ordered && Texts(own.begin(), own.end()) == Texts(said.begin(), said.end()));
  });
}

// All that an author's sentence says, in another order.
bool is_shuffled(const Sentence& sentence, const std::vector<std::string>& said) {
  const auto& own = sentence.claims.marks.own;
  return sentence.meaning.ordered && !is_own(sentence, said) &&
         std::any_of(own.begin(), own.end(),
                     [&](const auto& one) { return Texts(one.begin(), one.end()) == Texts(said.begin(), said.end()); });
}

Fault other_turn(const Sentence& sentence) {
  if (!is_shuffled(sentence, said_marks(sentence))) return {};
  return "what has to be done first is not said first";
}

// Less is said than tells this variation from the others.
Fault missing_mark(const Sentence& sentence) {
  const Marks& marks = sentence.claims.marks;
  const std::vector<std::string> said = said_marks(sentence);
  if (marks.telling.empty() || is_own(sentence, said) || is_shuffled(sentence, said)) return {};
  if (sentence.meaning.ordered) return "not all of the parts are named";
  const Texts set(said.begin(), said.end());
  std::size_t least = said.size() + 1;
  for (const std::vector<std::string>& own : marks.own)
    if (!own.empty()) least = std::min(least, own.size());
  const bool alone = std::none_of(marks.theirs.begin(), marks.theirs.end(), [&](const Texts& theirs) {
    return std::includes(theirs.begin(), theirs.end(), set.begin(), set.end());
  });
  if (alone && said.size() >= least) return {};
  for (const std::string& sense : marks.ours)
    if (!set.contains(sense)) return "no word says " + quoted(sense);
  return "which variation is meant";
}

// At least what one of the author's own sentences names.
Fault too_little(const Sentence& sentence) {
  bool names = false;
  for (std::size_t i = 0; i < sentence.claims.own.size(); ++i) {
    if (sentence.names_as(i)) return {};
    const auto& theirs = sentence.claims.own[i].mentions;
    names |= std::any_of(theirs.begin(), theirs.end(), [](const Mention& one) { return one.roles.wanted; });
  }
  if (!names || sentence.names_all()) return {};
  for (const std::string& name : sentence.goal_things())
    if (!sentence.is_named(name)) return "nothing names the " + name;
  return "less is named than in any sentence of the author";
}

}  // namespace

std::span<const Rule> thing_rules() {
  using enum Rejection;
  static const Rule kRules[] = {
      {unknown_thing, "not there", in_each<not_there, true>},
      {unknown_thing, "no such", in_each<no_such, true>},
      {wrong_colour, "other colour", in_each<other_colour>},
      {missing_thing, "which of several", in_each<which_of_several>},
      {wrong_count, "other count", in_each<other_count>},
      {wrong_count, "one for several", in_each<one_for_several>},
      {wrong_side, "side twice", in_each<side_twice>},
      {wrong_side, "other side", in_each<other_side>},
      {unproved, "bare claim", in_each<bare_claim>},
      {other_thing, "no part", in_each<no_part>},
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
