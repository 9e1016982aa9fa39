// Whether what is done is what the plan does: to what, with what, where, in which order, and to its end.
#include <algorithm>

#include "engine/language/rules.h"

namespace stampede {
namespace {

const std::set<std::string>& skills_of(const Sentence& sentence, const std::string& verb) {
  return sentence.meaning.lexicon.skills_of(verb);
}

Fault no_verb(const Sentence& sentence) {
  const auto& words = sentence.reading.words;
  const bool any = std::ranges::any_of(words, [](const Word& word) {
    return word.kind == WordKind::verb || word.kind == WordKind::own || word.is("wishing");
  });
  return any ? std::nullopt : Fault("there is no verb");
}

// `up` for `down`, `open` for `close`
Fault other_direction(const Sentence& sentence, const Segment& segment) {
  const Texts& own = sentence.claims.directions;
  for (const std::string& direction : directions_in(sentence.reading, segment, sentence.english)) {
    const auto opposite = sentence.english.opposites.find(direction);
    if (own.contains(direction) || opposite == sentence.english.opposites.end() || !own.contains(opposite->second))
      continue;
    if (std::ranges::none_of(sentence.meaning.skills,
                             [&](const auto& one) { return one.second.directions.contains(direction); }))
      return quoted(direction);
  }
  return {};
}

// `the lamp is dark: …` is the author's to say: no fact tells.
Fault preface(const Sentence& sentence, const Segment& segment) {
  const auto& words = sentence.reading.words;
  if (segment.end >= words.size() || words[segment.end].before != ':') return {};
  for (std::size_t i = segment.begin; i < segment.end; ++i)
    if (words[i].kind == WordKind::verb) return {};
  return "what comes before the colon";
}

// Of a thing that a short sentence names twice, one is another's place.
Fault named_twice(const Sentence& sentence) {
  const auto times = [](const Reading& reading, const std::string& sense) {
    return std::ranges::count_if(reading.mentions, [&](const Mention& one) { return one.sense == sense; });
  };
  const auto& own = sentence.claims.own;
  for (const Mention& mention : sentence.reading.mentions)
    if (const auto ours = times(sentence.reading, mention.sense);
        sentence.grain == Grain::goal && ours > 1 && !mention.things.empty() &&
        std::ranges::none_of(own, [&](const Reading& one) { return times(one, mention.sense) >= ours; }))
      return "the " + mention.sense + " twice";
  return {};
}

Fault other_others(const Sentence& sentence, const Mention& mention) {
  const auto& things = sentence.meaning.things;
  if (mention.things.empty() || !mention.other || std::ranges::any_of(things, [&](const SpokenThing& one) {
        // `from this rail to the other one`
        return (mention.part == "to" ? one.roles.destination : one.roles.handled) && one.words.contains(mention.sense);
      }))
    return {};
  return "the other " + mention.sense;
}

bool names_itself(const Mention& mention, const std::string& argument) {
  return std::ranges::find(mention.things, argument) != mention.things.end();
}

// That, or what it is a part of.
bool names(const Mention& mention, const std::string& argument) {
  return names_itself(mention, argument) ||
         std::ranges::any_of(mention.things, [&](const std::string& name) { return is_part_of(argument, name); });
}

// A step that the verb may tell of has it as one of these arguments, or a part of it.
bool is_argument(const Sentence& sentence, const Mention& mention, const auto& arguments_of) {
  if (sentence.verb(mention) == nullptr) return false;
  const auto& skills = skills_of(sentence, sentence.verb(mention)->sense);
  for (const ToldStep& step : sentence.meaning.steps)
    if (skills.contains(step.skill))
      for (const std::size_t at : arguments_of(sentence.meaning.sense_of(step)))
        if (names(mention, step.arguments[at])) return true;
  return false;
}

bool is_object(const Sentence& sentence, const Mention& mention) {
  return is_argument(sentence, mention, [](const SkillSense& sense) { return std::set<std::size_t>{sense.handled}; });
}

bool is_subject(const Sentence& sentence, const Mention& mention) {
  const Segment& segment = sentence.segment(mention);
  for (std::size_t i = mention.head + 1; i < segment.end; ++i) {
    const Word& word = sentence.reading.words[i];
    if (word.is("belonging")) return mention.roles.moved;
    if (word.is("holding") && mention.roles.destination) return true;
    if (word.kind == WordKind::verb) break;
  }
  return mention.roles.handled;
}

// `the drawer of the chest`, `the chest's drawer`, `the button with the navy cap`, `the handle of the door`
bool is_whole(const Sentence& sentence, const Mention& mention) {
  const auto& mentions = sentence.reading.mentions;
  const std::size_t at = static_cast<std::size_t>(&mention - mentions.data());
  const bool possessive = sentence.reading.is_possessor(mention);
  if (possessive ? at + 1 >= mentions.size() : at == 0) return false;
  const Mention& other = mentions[possessive ? at + 1 : at - 1];
  if (sentence.head(other).is("grip") && sentence.swings()) return true;
  return std::ranges::any_of(mention.things, [&](const std::string& name) {
    return sentence.after(mention, "with")
               ? names(other, name)
               : std::ranges::any_of(other.things, [&](const auto& part) { return is_part_of(part, name); });
  });
}

// `let it dangle from the hook`: that is where it goes. Where a thing comes from that is none of the scene, the author
// says.
bool is_source(const Sentence& sentence, const Mention& mention) {
  const std::size_t begin = sentence.segment(mention).begin;
  for (const Mention& other : sentence.reading.mentions)
    if (other.segment == mention.segment && other.part == "object" && !other.by_head && !other.roles.moved)
      return false;
  for (std::size_t i = begin; i < mention.first; ++i)
    if (sentence.reading.words[i].is("hanging")) return mention.roles.destination;
  return mention.roles.source;
}

bool is_destination(const Sentence& sentence, const Mention& mention) {
  if (sentence.reading.at(sentence.segment(mention).verb, "going")) return mention.roles.handled;
  if (mention.aside) return mention.roles.source;
  const Word* verb = sentence.verb(mention);
  const bool any_place = verb == nullptr || verb->is("assembling") || (verb->is("putting_up") && sentence.lifts());
  if (any_place ? mention.roles.destination
                : is_argument(sentence, mention, [](const SkillSense& sense) { return sense.places; }))
    return true;
  // `take the cup on the table`: that is where it is.
  return mention.roles.source && sentence.after(mention, "located") && verb != nullptr && verb->is("taking");
}

// It is in the plan what it is in the sentence.
bool has_role(const Sentence& sentence, const Mention& mention) {
  const std::string& part = mention.part;
  if (part == "subject") return is_subject(sentence, mention);
  if (part == "object") return is_object(sentence, mention);
  if (part == "of") return is_whole(sentence, mention);
  if (part == "part") return mention.count && mention.roles.handled;
  if (part == "with") return mention.roles.tool;
  if (part == "from") return is_source(sentence, mention);
  if (part == "to") return is_destination(sentence, mention);
  return sentence.after(mention, "above") && sentence.head(mention).is("table");
}

// It is what it is in a sentence of the author.
bool has_authors_role(const Sentence& sentence, const Mention& mention) {
  const auto& roles = sentence.claims.roles;
  // `the television should be switched on`
  if (mention.part == "subject" && roles.contains({"object " + mention.verb, mention.sense})) return true;
  const std::string role = role_key(sentence.reading, mention);
  if (!mention.by_head) return roles.contains({role, mention.sense});
  return std::ranges::any_of(mention.things, [&](const std::string& name) { return roles.contains({role, name}); });
}

Fault other_role(const Sentence& sentence, const Mention& mention) {
  if (mention.things.empty() || mention.other) return {};
  const bool until = sentence.reading.at(sentence.segment(mention).intro, "until");
  if ((!until && has_role(sentence, mention)) || has_authors_role(sentence, mention)) return {};
  return "the " + mention.sense + " as " + quoted(mention.role());
}

// `put the bottle on the fridge` for in it
Fault other_way_in(const Sentence& sentence, const Mention& mention) {
  const auto way_of = [](const Reading& reading, const Mention& one) {
    return reading.at(one.after, "inside") ? "in" : reading.at(one.after, "upon") ? "on" : "";
  };
  const std::string way = way_of(sentence.reading, mention);
  if (way.empty() || mention.part != "to" || mention.things.empty()) return {};
  Texts ways;
  for (const Reading& own : sentence.claims.own)
    for (const Mention& one : own.mentions)
      if (one.sense == mention.sense) ways.insert(way_of(own, one));
  bool planned = false;
  for (const ToldStep& step : sentence.meaning.steps)
    for (const auto& [place, said] : sentence.meaning.sense_of(step).ways)
      if (names(mention, step.arguments[place])) {
        planned = true;
        if (said.contains("in") && !names_itself(mention, step.arguments[place]))
          ways.insert("in");  // `on top of the fridge` is not in it
        else
          ways.insert(said.begin(), said.end());
      }
  return planned && !ways.contains(way) ? Fault(quoted(way) + " the " + mention.sense) : std::nullopt;
}

// It handles one of the wanted things that the stretch names, or that names none; `part`: or a part of one.
bool concerns(const Sentence& sentence, const Segment& segment, const ToldStep& step, bool part) {
  bool named = false;
  for (const Mention& mention : sentence.reading.mentions_of(segment)) {
    if (!mention.roles.wanted) continue;
    named = true;
    for (const std::string& argument : step.arguments)
      if (part ? names(mention, argument) : names_itself(mention, argument)) return true;
  }
  return !named;
}

// The first and the last step of the plan that a stretch may tell of; -1: none.
std::pair<int, int> steps_of(const Sentence& sentence, const Segment& segment) {
  std::pair<int, int> found{-1, -1};
  const auto& skills = skills_of(sentence, sentence.reading.verb_of(segment));
  const auto& steps = sentence.meaning.steps;
  for (int i = 0; i < static_cast<int>(steps.size()); ++i) {
    const ToldStep& step = steps[static_cast<std::size_t>(i)];
    const bool first = found.first < 0;  // `open the dishwasher`: its door, whatever is opened after
    if (!skills.contains(step.skill) || !concerns(sentence, segment, step, first)) continue;
    if (first) found.first = i;
    found.second = i;
  }
  return found;
}

// Those that say what to do, in time.
std::vector<const Segment*> deeds_of(const Reading& reading) {
  std::vector<const Segment*> deeds;
  for (const std::size_t at : reading.in_time)
    if (reading.segments[at].verb) deeds.push_back(&reading.segments[at]);
  return deeds;
}

// Some sentence of the author has the one verb before the other.
bool said_before(const Sentence& sentence, const std::string& a, const std::string& b) {
  return std::ranges::any_of(sentence.claims.own, [&](const Reading& own) {
    const std::vector<const Segment*> deeds = deeds_of(own);
    const auto at = [&](const std::string& verb) {
      return std::ranges::find(deeds, verb, [&](const Segment* one) { return own.verb_of(*one); });
    };
    return at(b) != deeds.end() && at(a) < at(b);
  });
}

// What is said first comes later in the plan, or in all that the author says.
Fault other_order(const Sentence& sentence) {
  const std::vector<const Segment*> deeds = deeds_of(sentence.reading);
  for (std::size_t i = 0; i < deeds.size(); ++i)
    for (std::size_t k = i + 1; k < deeds.size(); ++k) {
      const std::string &one = sentence.reading.verb_of(*deeds[i]), &next = sentence.reading.verb_of(*deeds[k]);
      const int last = steps_of(sentence, *deeds[k]).second;
      const bool holds =
          sentence.reading.at(deeds[i]->verb, "holding") || sentence.reading.at(deeds[k]->verb, "holding");
      if ((last >= 0 && last < steps_of(sentence, *deeds[i]).first && !holds) ||
          (said_before(sentence, next, one) && !said_before(sentence, one, next)))
        return quoted(next) + " comes before " + quoted(one);
    }
  return {};
}

// `take the hanger off its rail`, and no more: some verb must tell of the last step, or all be there that one of the
// author's sentences does. A sentence that says how things should be has no such verb.
Fault ends_early(const Sentence& sentence) {
  const Texts ours = verbs_in(sentence.reading);
  const auto& words = sentence.reading.words;
  if (sentence.meaning.steps.empty() || ours.empty() ||
      std::ranges::any_of(words, [](const Word& word) { return word.is("stating"); }) ||
      std::ranges::any_of(ours, [&](const std::string& verb) {
        return skills_of(sentence, verb).contains(sentence.meaning.steps.back().skill);
      }))
    return {};
  for (const Reading& own : sentence.claims.own) {
    const Texts theirs = verbs_in(own);
    if (!theirs.empty() && std::ranges::includes(ours, theirs) && (sentence.names_as(own) || !sentence.unnamed()))
      return {};
  }
  return "it ends before the goal is reached";
}

// `flip the switch over, then flip it back again`
Fault undone(const Sentence& sentence) {
  Texts done;
  for (const std::size_t at : sentence.reading.in_time) {
    const Segment& segment = sentence.reading.segments[at];
    const std::string& verb = sentence.reading.verb_of(segment);
    if (!sentence.vouched(segment) && ((!done.empty() && sentence.reading.any(segment, "again")) ||
                                       (done.contains(verb) && sentence.reading.any(segment, "back"))))
      return "done, and again";
    if (segment.verb) done.insert(verb);
  }
  return {};
}

Fault too_few_steps(const Sentence& sentence) {
  if (sentence.grain == Grain::goal || sentence.meaning.slots) return {};
  const auto& segments = sentence.reading.segments;
  const auto verbs = std::ranges::count_if(segments, [](const Segment& one) { return one.verb.has_value(); });
  const auto wanted =
      sentence.grain == Grain::motions ? 3 : std::min<std::ptrdiff_t>(2, std::ssize(sentence.meaning.steps));
  return verbs < wanted ? Fault(std::to_string(verbs) + " of them") : std::nullopt;
}

}  // namespace

std::span<const Rule> deed_rules() {
  using enum Rejection;
  static const Rule kRules[] = {
      {not_a_sentence, "no verb", no_verb},
      {other_action, "other direction", other_direction},
      {unproved, "preface", preface},
      {swapped_roles, "named twice", named_twice},
      {other_thing, "other others", other_others, true},
      {swapped_roles, "other role", other_role},
      {wrong_side, "other way in", other_way_in},
      {swapped_order, "other order", other_order},
      {misses_steps, "ends early", ends_early},
      {other_action, "undone", undone},
      {misses_steps, "too few steps", too_few_steps},
  };
  return kRules;
}

}  // namespace stampede
