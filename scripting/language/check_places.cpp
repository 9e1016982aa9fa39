// What a thing is: handled, a place to put something, where something is taken from.
#include "scripting/language/one_sentence.h"

namespace stampede {

bool OneSentence::has_role(const Mention& mention) const {
  const std::string role = mention.role.substr(0, mention.role.find(' '));
  const bool accessory = may_be(mention, meaning_, &SpokenThing::accessory);
  if (mention.role == "subject belong" && carries()) return may_be(mention, meaning_, &SpokenThing::moved);
  const bool above = says_above(mention);
  if (above && mention.sense == "table" && lifts()) return true;
  if (above && grain_ != Grain::goal && is_above(mention)) return true;
  if (role == "to" && arrives(mention)) return may_be(mention, meaning_, &SpokenThing::handled);
  if (mention.role == "subject hold" && may_be(mention, meaning_, &SpokenThing::destination)) return true;
  if (role == "subject") return accessory || (may_be(mention, meaning_, &SpokenThing::handled) && !shows(mention));
  if (role == "object" && verb_of(mention) != nullptr && takes_part(reading_.segments[mention.segment])) return true;
  if (role == "object") return accessory || steps_have(mention, false);
  const bool handle = &mention != reading_.mentions.data() && (&mention - 1)->sense == "handle";
  if (role == "of")
    return accessory || is_whole(mention) || (handle && swings() && may_be(mention, meaning_, &SpokenThing::handled));
  if (role == "part")
    return mention.count && may_be(mention, meaning_, carries() ? &SpokenThing::moved : &SpokenThing::handled);
  if (role == "with") return accessory || may_be(mention, meaning_, &SpokenThing::tool) || steps_have(mention, true);
  const Mention* object = object_of(mention);
  const bool known = object == nullptr || object->by_head || may_be(*object, meaning_, &SpokenThing::moved) ||
                     (is_handled_by_author(object->sense) && (role == "to" || left_by_author(mention)));
  if (!known && object->role.starts_with("object") && !object->sense.empty()) return false;
  if ((role == "to" || role == "in") && mention.sense == "table" && mention.preposition.starts_with("in")) return false;
  if (role == "from")
    return may_be(mention, meaning_, hangs(mention) ? &SpokenThing::destination : &SpokenThing::source);
  if (role != "to") return false;
  if (mention.aside) return may_be(mention, meaning_, &SpokenThing::source);
  const bool fetched = verb_of(mention) != nullptr && fetches(verb_of(mention)->sense) &&
                       !mention.preposition.starts_with("in") && mention.preposition != "on";
  const bool builds = verb_of(mention) != nullptr && verb_of(mention)->sense == "build";
  const bool up = lifts() && verb_of(mention) != nullptr && verb_of(mention)->sense == "put" &&
                  mention.preposition != "on" && !may_be(mention, meaning_, &SpokenThing::source);
  if (verb_of(mention) == nullptr || fetched || builds || up ? may_be(mention, meaning_, &SpokenThing::destination)
                                                             : steps_have(mention, true))
    return true;
  return may_be(mention, meaning_, &SpokenThing::source) && takes(mention);
}

// A word of the author for what is handled: `the crumpled paper`
bool OneSentence::is_handled_by_author(const std::string& sense) const {
  return std::any_of(claims_.roles.begin(), claims_.roles.end(), [&](const auto& one) {
    return one.second == sense && (one.first.starts_with("object ") || one.first.starts_with("subject"));
  });
}

bool OneSentence::left_by_author(const Mention& mention) const {
  return std::any_of(claims_.roles.begin(), claims_.roles.end(), [&](const auto& one) {
    return one.first.starts_with("from") &&
           (one.second == mention.sense ||
            std::find(mention.things.begin(), mention.things.end(), one.second) != mention.things.end());
  });
}

Maybe OneSentence::contained() const {
  static const std::map<std::string, std::string> kClasses = {
      {"on", "on"}, {"onto", "on"}, {"upon", "on"}, {"in", "in"}, {"into", "in"}, {"inside", "in"}, {"within", "in"}};
  for (const Mention& mention : reading_.mentions) {
    const auto found = kClasses.find(mention.preposition);
    if (found == kClasses.end() || !mention.role.starts_with("to") || mention.aside || mention.things.empty() ||
        !may_be(mention, meaning_, &SpokenThing::destination) || vouched(reading_.segments[mention.segment]))
      continue;
    std::set<std::string> classes;
    for (const Reading& own : claims_.own)
      for (const Mention& one : own.mentions)
        if (one.sense == mention.sense && one.role.starts_with("to") && kClasses.contains(one.preposition))
          classes.insert(kClasses.at(one.preposition));
    bool inside = false;
    for (const PlanStep& step : meaning_.steps)
      for (std::size_t i = 1; i < step.arguments.size(); ++i)
        for (const std::string& name : mention.things) {
          const bool whole = step.arguments[i].starts_with(name + ".");
          const bool into = step.action == "put_in" || step.action == "put_on_shelf" || step.action == "insert";
          if (!into || !(whole || step.arguments[i] == name)) continue;
          inside = true;
          classes.insert("in");
          if (step.action == "put_on_shelf" && !whole) classes.insert("on");
        }
    if (inside && !classes.contains(found->second))
      return no(Rejection::wrong_side, quoted(mention.preposition) + " the " + mention.sense);
  }
  return {};
}

// `go to the button and …`
bool OneSentence::arrives(const Mention& mention) const {
  const Segment& segment = reading_.segments[mention.segment];
  return segment.verb && reading_.words[*segment.verb].text == "go" &&
         std::any_of(reading_.segments.begin(), reading_.segments.end(),
                     [&](const Segment& one) { return one.verb && one.begin > segment.begin; });
}

bool OneSentence::shows(const Mention& mention) const {
  static const std::set<std::string> kSays = {"show", "contain", "mark", "complete"};
  const Segment& segment = reading_.segments[mention.segment];
  for (std::size_t i = mention.head + 1; i < segment.end; ++i)
    if (reading_.words[i].kind == WordKind::verb) return kSays.contains(reading_.words[i].sense);
  return false;
}

bool OneSentence::fetches(const std::string& verb) { return verb == "take" || verb == "remove" || verb == "lift"; }

const Word* OneSentence::verb_of(const Mention& mention) const {
  const Segment& segment = reading_.segments[mention.segment];
  if (segment.verb) return &reading_.words[*segment.verb];
  if (!mention.role.starts_with("object ")) return nullptr;
  for (std::size_t k = mention.first; k > segment.begin; --k)
    if (reading_.words[k - 1].kind == WordKind::verb && mention.role.substr(7) == reading_.words[k - 1].sense)
      return &reading_.words[k - 1];
  return nullptr;
}

// A step that the verb may tell of has it as what is handled, or as where that goes.
bool OneSentence::steps_have(const Mention& mention, bool as_place) const {
  static const std::set<std::string> kWhole = {"open", "close", "press", "turn", "press_with", "push", "unscrew"};
  const Word* verb = verb_of(mention);
  if (verb == nullptr) return false;
  const std::set<std::string>& skills = meaning_.lexicon.skills_of(verb->sense);
  for (const PlanStep& step : meaning_.steps) {
    if (!skills.contains(step.action) || (as_place && kTakes.contains(step.action))) continue;
    // Of what is pressed or dragged with a thing, the thing comes first.
    const std::size_t handled = step.action == "press_with" || step.action == "drag" ? 1 : 0;
    for (std::size_t i = 0; i < step.arguments.size(); ++i) {
      if ((i == handled) == as_place || (step.action == "point" && i > 1)) continue;
      for (const std::string& name : mention.things) {
        const std::string& argument = step.arguments[i];
        if (argument == name || (argument.starts_with(name + ".") && (as_place || kWhole.contains(step.action))))
          return true;
        if (as_place && name.starts_with(argument + ".")) return true;
      }
    }
  }
  return false;
}

// `the drawer of the chest`, `the chest's drawer`
bool OneSentence::is_whole(const Mention& mention) const {
  const bool possessive = mention.head + 1 < reading_.words.size() && reading_.words[mention.head + 1].text == "'s";
  const Mention* other = possessive ? &mention + 1 : &mention - 1;
  if (other < reading_.mentions.data() || other >= reading_.mentions.data() + reading_.mentions.size()) return false;
  const bool with = mention.preposition == "with";  // `the button with the navy cap`
  for (const std::string& part : with ? mention.things : other->things)
    for (const std::string& whole : with ? other->things : mention.things)
      if (part.starts_with(whole + ".") || (with && part == whole)) return true;
  return false;
}

// `let it dangle from the hook`: that is where it goes.
bool OneSentence::hangs(const Mention& mention) const {
  const Segment& segment = reading_.segments[mention.segment];
  return std::any_of(reading_.words.begin() + static_cast<std::ptrdiff_t>(segment.begin),
                     reading_.words.begin() + static_cast<std::ptrdiff_t>(mention.first),
                     [](const Word& word) { return word.sense == "hang"; });
}

// `take the cup on the table`: that is where it is.
bool OneSentence::takes(const Mention& mention) const {
  static const std::set<std::string> kTaking = {"take", "remove", "lift", "find", "hold", "pull", "clear"};
  const Segment& segment = reading_.segments[mention.segment];
  const bool at = mention.preposition == "on" || mention.preposition == "in" || mention.preposition == "inside";
  return at && segment.verb && *segment.verb < mention.first && kTaking.contains(reading_.words[*segment.verb].sense);
}

}  // namespace stampede
