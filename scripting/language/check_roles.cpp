// Whether each thing is in the sentence what it is in the plan.
#include "scripting/language/one_sentence.h"

namespace stampede {

// What each thing is in the sentence (what is handled, where to, where from) must be what it is in the plan, or in a
// sentence of the author.
Maybe OneSentence::roles() const {
  if (Maybe bad = prefaces()) return bad;
  if (Maybe bad = twice()) return bad;
  if (Maybe bad = pronouns()) return bad;
  for (const Mention& mention : reading_.mentions) {
    if (mention.things.empty() || vouched(reading_.segments[mention.segment])) continue;
    if (mention.other) {
      const bool place = mention.role.starts_with("to");  // `from this rail to the other one`
      const bool alike = std::any_of(meaning_.things.begin(), meaning_.things.end(), [&](const SpokenThing& one) {
        return (place ? one.destination : one.handled) && one.words.contains(mention.sense);
      });
      if (!alike) return no(Rejection::other_thing, "the other " + mention.sense);
      continue;
    }
    if (spares(reading_.segments[mention.segment])) continue;
    const bool until = reading_.segments[mention.segment].intro == "until";
    if (!until && (has_role(mention) || stands_on_table(mention))) continue;
    const std::string role = role_key(reading_, mention);
    if (meaning_.slots && !meaning_.skills.empty() && same_part(role, mention.sense)) continue;
    if (role.starts_with("subject ") && claims_.roles.contains({"object " + role.substr(8), mention.sense}))
      continue;  // `the television should be switched on`
    const bool vouched_for =
        (!mention.by_head && claims_.roles.contains({role, mention.sense})) ||
        (mention.by_head && std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& name) {
           return claims_.roles.contains({role, name});
         }));
    if (!vouched_for) return no(Rejection::swapped_roles, "the " + mention.sense + " as " + quoted(mention.role));
  }
  return {};
}

// Of a label: the same part with another verb, which is looked at by itself.
bool OneSentence::same_part(const std::string& role, const std::string& sense) const {
  const auto part = [](const std::string& text) { return text.substr(0, text.find(' ')); };
  return std::any_of(claims_.roles.begin(), claims_.roles.end(),
                     [&](const auto& one) { return one.second == sense && part(one.first) == part(role); });
}

// `the lamp is dark: …` is the author's to say: no fact tells.
Maybe OneSentence::prefaces() const {
  for (const Segment& segment : reading_.segments) {
    const bool preface = segment.end < reading_.words.size() && reading_.words[segment.end].before == ':';
    if (!preface || vouched(segment)) continue;
    bool verb = false;
    for (std::size_t i = segment.begin; i < segment.end; ++i) verb |= reading_.words[i].kind == WordKind::verb;
    if (!verb) return no(Rejection::unproved, "what comes before the colon");
  }
  return {};
}

// `put the cup on the cup`; of a thing that a short sentence names twice, one is another's place.
Maybe OneSentence::twice() const {
  const auto times = [](const Reading& reading, const std::string& sense) {
    return std::count_if(reading.mentions.begin(), reading.mentions.end(),
                         [&](const Mention& one) { return one.sense == sense; });
  };
  for (const Mention& mention : reading_.mentions) {
    if (grain_ != Grain::goal || mention.things.empty() || mention.other || mention.partitive) continue;
    const auto ours = times(reading_, mention.sense);
    if ((mention.modifiers.contains(mention.sense) && !claims_.attributes.contains({mention.sense, mention.sense})) ||
        (ours > 1 && std::none_of(claims_.own.begin(), claims_.own.end(),
                                  [&](const Reading& own) { return times(own, mention.sense) >= ours; })))
      return no(Rejection::swapped_roles, "the " + mention.sense + " twice");
  }
  for (std::size_t i = 0; i < reading_.mentions.size(); ++i)
    for (std::size_t k = i + 1; k < reading_.mentions.size(); ++k) {
      const Mention &a = reading_.mentions[i], &b = reading_.mentions[k];
      if (a.segment != b.segment || a.sense != b.sense || a.things.empty() || vouched(reading_.segments[a.segment]))
        continue;
      const bool different = a.other != b.other || a.colours != b.colours || a.places != b.places || a.count ||
                             b.count || a.partitive || b.partitive || a.modifiers != b.modifiers;
      if (!different) return no(Rejection::swapped_roles, "the " + a.sense + " and itself");
    }
  return {};
}

// `…: put it on the table`: what was spoken of last is what is moved.
Maybe OneSentence::pronouns() const {
  static const std::set<std::string> kCarrying = {"put", "insert", "stack", "hang", "drop", "take"};
  for (const Segment& segment : reading_.segments) {
    if (!segment.verb || *segment.verb + 1 >= segment.end || !kCarrying.contains(reading_.words[*segment.verb].sense))
      continue;
    const std::string& text = reading_.words[*segment.verb + 1].text;
    if (text != "it" && text != "them") continue;
    const Mention* last = nullptr;
    bool itself = false;
    for (const Mention& mention : reading_.mentions)
      if (mention.head < segment.begin && (mention.role.starts_with("subject") || mention.role.starts_with("object ")))
        last = &mention;
    for (const Mention& mention : reading_.mentions)
      itself |=
          last != nullptr && within(mention, segment) && mention.sense == last->sense && mention.role.starts_with("to");
    if (itself) return no(Rejection::swapped_roles, "the " + last->sense + " and itself");
    if (last != nullptr && vouched(segment) && vouched(reading_.segments[last->segment])) continue;
    if (last != nullptr && !last->things.empty() && !may_be(*last, meaning_, &SpokenThing::moved))
      return no(Rejection::swapped_roles, "the " + last->sense + " is not carried");
  }
  return {};
}

// `the button on the table`: that it stands there goes without saying.
bool OneSentence::stands_on_table(const Mention& mention) const {
  static const std::set<std::string> kPutting = {"put",   "insert", "drop",  "stack", "hang",
                                                 "stand", "lower",  "point", "lift"};
  const Word* verb = verb_of(mention);
  return mention.sense == "table" && mention.preposition == "on" && !carries() &&
         (verb == nullptr || !kPutting.contains(verb->sense)) && &mention != reading_.mentions.data() &&
         (&mention - 1)->segment == mention.segment && !(&mention - 1)->things.empty();
}

// The thing that the stretch says is handled; null: none, or a pronoun.
const Mention* OneSentence::object_of(const Mention& mention) const {
  for (const Mention& other : reading_.mentions)
    if (other.segment == mention.segment && &other < &mention && !kBuilt.contains(other.sense) &&
        (other.role.starts_with("subject") || other.role.starts_with("object ")))
      return &other;
  return nullptr;
}

}  // namespace stampede
