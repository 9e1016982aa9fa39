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
  const bool any = std::any_of(words.begin(), words.end(), [](const Word& word) {
    return word.kind == WordKind::verb || word.kind == WordKind::own || word.is("wishing");
  });
  return any ? std::nullopt : Fault("there is no verb");
}

Fault other_verb(const Sentence& sentence) {
  const Meaning& meaning = sentence.meaning;
  for (const Segment& segment : sentence.reading.segments) {
    if (!segment.verb || sentence.spares(segment) || sentence.leads_on(segment)) continue;
    const Word& word = sentence.reading.words[*segment.verb];
    if (sentence.claims.verbs.contains(word.sense) || word.is("saying")) continue;
    if (meaning.slots && meaning.skills.empty() && sentence.claims.senses.contains(word.sense))
      continue;  // `is pressed`
    if (sentence.grain == Grain::motions && (word.is("motion") || moves_fingers(sentence.reading, *segment.verb)))
      continue;
    const auto& skills = skills_of(sentence, word.sense);
    if (std::none_of(skills.begin(), skills.end(), [&](const auto& one) { return meaning.skills.contains(one); }))
      return quoted(word.sense);
  }
  return {};
}

// `up` for `down`, `open` for `close`
Fault other_direction(const Sentence& sentence) {
  const Texts& own = sentence.claims.directions;
  for (const std::string& direction : sentence.directions()) {
    const auto opposite = sentence.english.opposites.find(direction);
    if (own.contains(direction) || opposite == sentence.english.opposites.end()) continue;
    const bool switches = sentence.english.has(direction, "switching");
    const bool planned = std::any_of(sentence.meaning.skills.begin(), sentence.meaning.skills.end(),
                                     [&](const auto& one) { return one.second.directions.contains(direction); });
    if (switches || (own.contains(opposite->second) && !planned)) return quoted(direction);
  }
  return {};
}

// `the lamp is dark: …` is the author's to say: no fact tells.
Fault preface(const Sentence& sentence) {
  const auto& words = sentence.reading.words;
  for (const Segment& segment : sentence.reading.segments) {
    if (segment.end >= words.size() || words[segment.end].before != ':' || sentence.vouched(segment)) continue;
    bool verb = false;
    for (std::size_t i = segment.begin; i < segment.end; ++i) verb |= words[i].kind == WordKind::verb;
    if (!verb) return "what comes before the colon";
  }
  return {};
}

// Of a thing that a short sentence names twice, one is another's place.
Fault named_twice(const Sentence& sentence) {
  const auto times = [](const Reading& reading, const std::string& sense) {
    return std::count_if(reading.mentions.begin(), reading.mentions.end(),
                         [&](const Mention& one) { return one.sense == sense; });
  };
  for (const Mention& mention : sentence.reading.mentions) {
    if (sentence.grain != Grain::goal || mention.things.empty() || mention.other || mention.partitive) continue;
    const auto ours = times(sentence.reading, mention.sense);
    const auto& own = sentence.claims.own;
    const bool said =
        std::any_of(own.begin(), own.end(), [&](const Reading& one) { return times(one, mention.sense) >= ours; });
    if (ours > 1 && !said) return "the " + mention.sense + " twice";
  }
  return {};
}

Fault other_others(const Sentence& sentence) {
  for (const Mention& mention : sentence.reading.mentions) {
    if (mention.things.empty() || !mention.other || sentence.vouched(mention)) continue;
    const auto& things = sentence.meaning.things;
    const bool alike = std::any_of(things.begin(), things.end(), [&](const SpokenThing& one) {
      // `from this rail to the other one`
      return (mention.part == "to" ? one.roles.destination : one.roles.handled) && one.words.contains(mention.sense);
    });
    if (!alike) return "the other " + mention.sense;
  }
  return {};
}

bool names(const Mention& mention, const std::string& argument) {
  return std::find(mention.things.begin(), mention.things.end(), argument) != mention.things.end();
}

bool names_whole(const Mention& mention, const std::string& argument) {
  return std::any_of(mention.things.begin(), mention.things.end(),
                     [&](const std::string& name) { return is_part_of(argument, name); });
}

bool names_part(const Mention& mention, const std::string& argument) {
  return std::any_of(mention.things.begin(), mention.things.end(),
                     [&](const std::string& name) { return is_part_of(name, argument); });
}

// A step that the verb may tell of is about it.
bool is_handled(const Sentence& sentence, const Mention& mention) {
  if (sentence.verb(mention) == nullptr) return false;
  const auto& skills = skills_of(sentence, sentence.verb(mention)->sense);
  return std::any_of(sentence.meaning.steps.begin(), sentence.meaning.steps.end(), [&](const ToldStep& step) {
    const SkillSense& sense = sentence.meaning.sense_of(step);
    if (!skills.contains(step.skill)) return false;
    const std::string& argument = step.arguments[static_cast<std::size_t>(sense.handled)];
    return names(mention, argument) || (sense.of_parts && names_whole(mention, argument));
  });
}

// Or it is where that goes, or with what it is done.
bool is_place(const Sentence& sentence, const Mention& mention) {
  if (sentence.verb(mention) == nullptr) return false;
  const auto& skills = skills_of(sentence, sentence.verb(mention)->sense);
  for (const ToldStep& step : sentence.meaning.steps) {
    const SkillSense& sense = sentence.meaning.sense_of(step);
    if (!skills.contains(step.skill)) continue;
    for (const int place : sense.places) {
      const std::string& argument = step.arguments[static_cast<std::size_t>(place)];
      if (names(mention, argument) || names_whole(mention, argument) || names_part(mention, argument)) return true;
    }
  }
  return false;
}

// `the drawer of the chest`, `the chest's drawer`, `the button with the navy cap`
bool is_whole(const Sentence& sentence, const Mention& mention) {
  const auto& mentions = sentence.reading.mentions;
  const std::size_t at = static_cast<std::size_t>(&mention - mentions.data());
  const auto& words = sentence.reading.words;
  const bool possessive = mention.head + 1 < words.size() && words[mention.head + 1].text == "'s";
  if (possessive ? at + 1 >= mentions.size() : at == 0) return false;
  const Mention& other = mentions[possessive ? at + 1 : at - 1];
  const bool with = sentence.after(mention, "with");
  for (const std::string& name : mention.things)
    if (with ? names_whole(other, name) || names(other, name) : names_part(other, name)) return true;
  return false;
}

// The thing that the stretch says is handled; null: none, or a pronoun.
const Mention* object_of(const Sentence& sentence, const Mention& mention) {
  for (const Mention& other : sentence.reading.mentions)
    if (other.segment == mention.segment && &other < &mention && !sentence.head(other).is("built") && other.acts())
      return &other;
  return nullptr;
}

bool said_by_author(const Sentence& sentence, const std::string& sense, std::initializer_list<const char*> parts) {
  const auto& roles = sentence.claims.roles;
  return std::any_of(roles.begin(), roles.end(), [&](const auto& one) {
    return one.second == sense &&
           std::any_of(parts.begin(), parts.end(), [&](const char* part) { return one.first.starts_with(part); });
  });
}

// What is carried there, or from there, may be so: it is known, or a word of the author's, as `the crumpled paper`.
bool is_carried(const Sentence& sentence, const Mention& place) {
  const Mention* object = object_of(sentence, place);
  if (object == nullptr || object->part == "subject" || object->sense.empty() || object->by_head || object->roles.moved)
    return true;
  if (!said_by_author(sentence, object->sense, {"object ", "subject"})) return false;
  return place.part == "to" || said_by_author(sentence, place.sense, {"from"}) ||
         std::any_of(place.things.begin(), place.things.end(),
                     [&](const std::string& name) { return said_by_author(sentence, name, {"from"}); });
}

bool is_object(const Sentence& sentence, const Mention& mention) {
  const bool leads_on = mention.verb_at && sentence.leads_on(sentence.segment(mention));
  return mention.roles.accessory || leads_on || is_handled(sentence, mention);
}

bool is_subject(const Sentence& sentence, const Mention& mention) {
  const Segment& segment = sentence.segment(mention);
  const auto& words = sentence.reading.words;
  const auto next = std::find_if(words.begin() + static_cast<std::ptrdiff_t>(mention.head + 1),
                                 words.begin() + static_cast<std::ptrdiff_t>(std::max(segment.end, mention.head + 1)),
                                 [](const Word& word) { return word.kind == WordKind::verb; });
  const Word* verb = next == words.begin() + static_cast<std::ptrdiff_t>(segment.end) ? nullptr : &*next;
  if (verb != nullptr && verb->is("belonging") && sentence.meaning.carries()) return mention.roles.moved;
  if (verb != nullptr && verb->is("holding") && mention.roles.destination) return true;
  return mention.roles.accessory || (mention.roles.handled && !(verb != nullptr && verb->is("showing")));
}

bool is_owner(const Sentence& sentence, const Mention& mention) {
  const bool of_handle = &mention != sentence.reading.mentions.data() && sentence.head(*(&mention - 1)).is("grip");
  return mention.roles.accessory || is_whole(sentence, mention) ||
         (of_handle && sentence.swings() && mention.roles.handled);
}

// `let it dangle from the hook`: that is where it goes.
bool is_source(const Sentence& sentence, const Mention& mention) {
  bool hangs = false;
  for (std::size_t i = sentence.segment(mention).begin; i < mention.first; ++i)
    hangs |= sentence.reading.words[i].is("hanging");
  return is_carried(sentence, mention) && (hangs ? mention.roles.destination : mention.roles.source);
}

bool is_destination(const Sentence& sentence, const Mention& mention) {
  const Segment& segment = sentence.segment(mention);
  if (sentence.reading.at(segment.verb, "going") && sentence.leads(segment)) return mention.roles.handled;
  if (!is_carried(sentence, mention)) return false;
  const bool in = sentence.after(mention, "inside"), on = sentence.after(mention, "on");
  if (in && sentence.head(mention).is("table")) return false;
  if (mention.aside) return mention.roles.source;
  const Word* verb = sentence.verb(mention);
  const bool any_place = verb == nullptr || verb->is("assembling") || (verb->is("fetching") && !in && !on) ||
                         (verb->is("putting_up") && sentence.lifts() && !on && !mention.roles.source);
  if (any_place ? mention.roles.destination : is_place(sentence, mention)) return true;
  // `take the cup on the table`: that is where it is.
  return mention.roles.source && sentence.after(mention, "located") && verb != nullptr && segment.verb &&
         *segment.verb < mention.first && verb->is("taking");
}

bool is_above(const Sentence& sentence, const Mention& mention) {
  if (!sentence.after(mention, "above")) return false;
  return (sentence.head(mention).is("table") && sentence.lifts()) ||
         (sentence.grain != Grain::goal && (mention.roles.destination || mention.roles.handled));
}

// It is in the plan what it is in the sentence.
bool has_role(const Sentence& sentence, const Mention& mention) {
  const std::string& part = mention.part;
  if (is_above(sentence, mention)) return true;
  if (part == "subject") return is_subject(sentence, mention);
  if (part == "object") return is_object(sentence, mention);
  if (part == "of") return is_owner(sentence, mention);
  if (part == "part")
    return mention.count && (sentence.meaning.carries() ? mention.roles.moved : mention.roles.handled);
  if (part == "with") return mention.roles.accessory || mention.roles.tool || is_place(sentence, mention);
  if (part == "from") return is_source(sentence, mention);
  return part == "to" && is_destination(sentence, mention);
}

// It is what it is in a sentence of the author.
bool has_authors_role(const Sentence& sentence, const Mention& mention) {
  const auto& roles = sentence.claims.roles;
  const std::string role = role_key(sentence.reading, mention);
  // Of a label: the same part with another verb, which is looked at by itself.
  if (sentence.meaning.slots && !sentence.meaning.skills.empty() &&
      said_by_author(sentence, mention.sense, {mention.part.c_str()}))
    return true;
  // `the television should be switched on`
  if (mention.part == "subject" && !mention.verb.empty() && roles.contains({"object " + mention.verb, mention.sense}))
    return true;
  if (!mention.by_head) return roles.contains({role, mention.sense});
  return std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& name) {
    return roles.contains({role, name});
  });
}

Fault other_role(const Sentence& sentence) {
  for (const Mention& mention : sentence.reading.mentions) {
    const Segment& segment = sentence.segment(mention);
    if (mention.things.empty() || mention.other || sentence.vouched(segment) || sentence.spares(segment)) continue;
    const bool until = sentence.reading.at(segment.intro, "until");
    if (!until && (has_role(sentence, mention) || sentence.stands_on_table(mention))) continue;
    if (!has_authors_role(sentence, mention)) return "the " + mention.sense + " as " + quoted(mention.role());
  }
  return {};
}

// `put the bottle on the fridge` for in it
Fault other_way_in(const Sentence& sentence) {
  const auto way_of = [](const Reading& reading, const Mention& mention) {
    return reading.at(mention.after, "inside") ? "in" : reading.at(mention.after, "upon") ? "on" : "";
  };
  for (const Mention& mention : sentence.reading.mentions) {
    const std::string way = way_of(sentence.reading, mention);
    if (way.empty() || mention.part != "to" || mention.aside || mention.things.empty() || !mention.roles.destination ||
        sentence.vouched(mention))
      continue;
    Texts ways;
    for (const Reading& own : sentence.claims.own)
      for (const Mention& one : own.mentions)
        if (one.sense == mention.sense && one.part == "to") ways.insert(way_of(own, one));
    bool planned = false;
    for (const ToldStep& step : sentence.meaning.steps) {
      const SkillSense& sense = sentence.meaning.sense_of(step);
      for (const int place : sense.places) {
        const std::string& argument = step.arguments[static_cast<std::size_t>(place)];
        const bool whole = names_whole(mention, argument);
        if (!sense.puts || (!whole && !names(mention, argument))) continue;
        planned = true;
        const auto said = sense.ways.find(place);
        if (said == sense.ways.end()) continue;
        if (whole && said->second.contains("in"))
          ways.insert("in");
        else
          ways.insert(said->second.begin(), said->second.end());
      }
    }
    if (planned && !ways.contains(way)) return quoted(way) + " the " + mention.sense;
  }
  return {};
}

enum class Concern { none, part, itself };

// Of what the stretch names; `none` where the step handles none of the wanted things that are named.
Concern concerns(const Sentence& sentence, const Segment& segment, const ToldStep& step) {
  bool named = false, part = false;
  for (const Mention& mention : sentence.reading.mentions) {
    if (!segment.holds(mention.head) || !mention.roles.wanted) continue;
    named = true;
    for (const std::string& argument : step.arguments) {
      if (names(mention, argument)) return Concern::itself;
      part |= names_whole(mention, argument);
    }
  }
  return named && !part ? Concern::none : part ? Concern::part : Concern::itself;
}

// Kinds of skills in the order of the plan: each kind of what is said, where the plan has it first after the last.
Fault other_order(const Sentence& sentence) {
  if (sentence.reading.segments.size() < 2) return {};
  int reached = -1;
  for (const std::size_t at : sentence.reading.in_time) {
    const Segment& segment = sentence.reading.segments[at];
    if (sentence.reading.words[segment.begin].before == ':') reached = -1;
    if (!segment.verb || segment.negated || segment.excluding || sentence.reading.at(segment.verb, "holding")) continue;
    int next = -1, any = -1;
    for (int i = 0; i < static_cast<int>(sentence.meaning.steps.size()); ++i) {
      const ToldStep& step = sentence.meaning.steps[static_cast<std::size_t>(i)];
      if (!skills_of(sentence, sentence.reading.verb_of(segment)).contains(step.skill)) continue;
      const Concern concern = concerns(sentence, segment, step);
      if (concern == Concern::none) continue;
      if (any < 0) any = i;
      // `open the dishwasher` is its door, whatever else of it is opened after
      if (i >= reached && next < 0 && (concern == Concern::itself || any == i || any >= reached)) next = i;
    }
    if (next < 0 && any >= 0) return quoted(sentence.reading.words[*segment.verb].text) + " comes earlier";
    reached = std::max(next, next < 0 ? reached : next);
  }
  return {};
}

std::vector<std::string> verbs_in_time(const Reading& reading) {
  std::vector<std::string> verbs;
  for (const std::size_t at : reading.in_time)
    if (reading.segments[at].verb) verbs.push_back(reading.verb_of(reading.segments[at]));
  return verbs;
}

// Verbs that the author's sentences have in one order only.
Fault other_order_of_verbs(const Sentence& sentence) {
  const auto before = [](const std::vector<std::string>& list, const std::string& a, const std::string& b) {
    const auto first = std::find(list.begin(), list.end(), a), second = std::find(list.begin(), list.end(), b);
    return first != list.end() && second != list.end() && first < second;
  };
  const auto in_any = [&](const std::string& a, const std::string& b) {
    return std::any_of(sentence.claims.own.begin(), sentence.claims.own.end(),
                       [&](const Reading& own) { return before(verbs_in_time(own), a, b); });
  };
  const std::vector<std::string> ours = verbs_in_time(sentence.reading);
  for (std::size_t i = 0; i < ours.size() && sentence.reading.segments.size() > 1; ++i)
    for (std::size_t k = i + 1; k < ours.size(); ++k)
      if (ours[i] != ours[k] && in_any(ours[k], ours[i]) && !in_any(ours[i], ours[k]))
        return quoted(ours[k]) + " comes before " + quoted(ours[i]);
  return {};
}

Texts skills_told(const Sentence& sentence, const Texts& verbs) {
  Texts told;
  for (const std::string& verb : verbs)
    for (const std::string& skill : skills_of(sentence, verb))
      if (sentence.meaning.skills.contains(skill)) told.insert(skill);
  return told;
}

// `take the hanger off its rail`, and no more: some verb must tell of the last step, or all be there that one of the
// author's sentences does. A sentence that says how things should be has no such verb.
Fault ends_early(const Sentence& sentence) {
  const Meaning& meaning = sentence.meaning;
  const auto& words = sentence.reading.words;
  if (meaning.slots || meaning.steps.empty() || std::any_of(words.begin(), words.end(), [](const Word& word) {
        return word.is("stating") || word.kind == WordKind::own;
      }))
    return {};
  const Texts ours =
      verbs_in(sentence.reading, [&](const Segment& segment) { return sentence.spares(segment) || segment.excluding; });
  const std::string& last = meaning.steps.back().skill;
  const Texts directions = directions_in(sentence.reading, sentence.english);
  const bool away = directions.contains("out") || directions.contains("up") || directions.contains("down");
  const SkillSense& end = meaning.sense_of(meaning.steps.back());
  for (const std::string& verb : ours)
    if (skills_of(sentence, verb).contains(last) &&
        (away || !(end.takes && end.leaves) || !sentence.english.has(verb, "grasping")))
      return {};
  const Texts reached = skills_told(sentence, ours);
  for (std::size_t i = 0; i < sentence.claims.done.size(); ++i) {
    const Texts &own = sentence.claims.done[i], theirs = skills_told(sentence, own);
    if (own.empty() || !(sentence.names_as(i) || sentence.names_all())) continue;
    if (std::includes(ours.begin(), ours.end(), own.begin(), own.end()) ||
        (!theirs.empty() && std::includes(reached.begin(), reached.end(), theirs.begin(), theirs.end())))
      return {};
  }
  return ours.empty() ? std::nullopt : Fault("it ends before the goal is reached");
}

// `flip the switch over, then flip it back again`
Fault undone(const Sentence& sentence) {
  Texts done;
  for (const std::size_t at : sentence.reading.in_time) {
    const Segment& segment = sentence.reading.segments[at];
    if (!done.empty() && sentence.reading.any(segment, "again") && !sentence.vouched(segment)) return "done, and again";
    if (!segment.verb) continue;
    const std::string& verb = sentence.reading.verb_of(segment);
    if (done.contains(verb) && sentence.reading.any(segment, "back") && !sentence.vouched(segment))
      return quoted(verb) + " and back";
    done.insert(verb);
  }
  return {};
}

Fault too_few_steps(const Sentence& sentence) {
  if (sentence.grain == Grain::goal || sentence.meaning.slots) return {};
  const auto& segments = sentence.reading.segments;
  const auto verbs =
      std::count_if(segments.begin(), segments.end(), [](const Segment& one) { return one.verb.has_value(); });
  const auto wanted =
      sentence.grain == Grain::motions ? 3 : std::min<std::ptrdiff_t>(2, std::ssize(sentence.meaning.steps));
  return verbs < wanted ? Fault(std::to_string(verbs) + " of them") : std::nullopt;
}

}  // namespace

std::span<const Rule> deed_rules() {
  using enum Rejection;
  static const Rule kRules[] = {
      {not_a_sentence, "no verb", no_verb},
      {other_action, "other verb", other_verb},
      {other_action, "other direction", other_direction},
      {unproved, "preface", preface},
      {swapped_roles, "named twice", named_twice},
      {other_thing, "other others", other_others},
      {swapped_roles, "other role", other_role},
      {wrong_side, "other way in", other_way_in},
      {swapped_order, "other order of verbs", other_order_of_verbs},
      {swapped_order, "other order", other_order},
      {misses_steps, "ends early", ends_early},
      {other_action, "undone", undone},
      {misses_steps, "too few steps", too_few_steps},
  };
  return kRules;
}

}  // namespace stampede
