#include "engine/language/sentence.h"

#include <algorithm>

namespace stampede {

Sentence::Sentence(std::string said, const Meaning& meant, const Claims& claimed, LanguageGrain of_grain)
    : text(std::move(said)),
      meaning(meant),
      claims(claimed),
      grain(of_grain),
      reading(read_sentence(text, meaning)),
      english(meaning.lexicon.english()) {
  for (const Segment& segment : reading.segments) {
    vouched_.push_back(claims.segments.contains(content_of(reading, segment)));
    spares_.push_back(spares_others(segment) || keeps_others(reading, segment) || leaves_idle(segment) ||
                      denies_start(segment));
  }
}

std::set<std::size_t> Sentence::beside() const {
  std::set<std::size_t> words = totals_in(reading);
  for (const Segment& segment : reading.segments)
    for (std::size_t i = segment.begin; i < segment.end && spares(segment); ++i) words.insert(i);
  return words;
}

bool Sentence::spares_others(const Segment& segment) const {
  return reading.any(segment, "other") && !claims.others &&
         std::none_of(reading.mentions.begin(), reading.mentions.end(),
                      [&](const Mention& mention) { return segment.holds(mention.head) && !mention.other; });
}

bool Sentence::spares_idle(const Segment& segment) const {
  bool any = false;
  for (const Mention& mention : reading.mentions) {
    if (!segment.holds(mention.head)) continue;
    if (mention.roles.wanted) return false;
    any |= !mention.things.empty();
  }
  return any && !segment.negated;
}

bool Sentence::leaves_idle(const Segment& segment) const {
  const auto first = std::find_if(reading.mentions.begin(), reading.mentions.end(),
                                  [&](const Mention& mention) { return segment.holds(mention.head); });
  if (segment.negated || first == reading.mentions.end() || first->after || first->things.empty() ||
      first->roles.wanted)
    return false;
  bool state = false;
  for (std::size_t i = first->head + 1; i < segment.end; ++i) state |= reading.words[i].is("shut");
  return reading.any(segment, "keeping") || (state && segment.verb.value_or(segment.end) > first->head);
}

// `it should no longer be on its stand`, `the door must not stay open`, `in the block instead of on the board`: what
// holds at the start and has to end
bool Sentence::denies_start(const Segment& segment) const {
  const bool instead = reading.any(segment, "instead");
  if (!segment.negated && !instead) return false;
  std::size_t from = segment.begin;
  for (std::size_t i = segment.begin; i < segment.end; ++i)
    if (reading.words[i].kind == WordKind::negation) from = i;
  bool state = false, place = false;
  for (std::size_t i = from + 1; i < segment.end; ++i) {
    const Word& word = reading.words[i];
    if (word.kind == WordKind::verb && !word.is("lasting")) return false;
    const auto opposite = word.is("openness") ? english.opposites.find(word.sense) : english.opposites.end();
    if (opposite == english.opposites.end()) continue;
    if (!claims.directions.contains(opposite->second)) return false;
    state = true;
  }
  for (const Mention& mention : reading.mentions) {
    if (!segment.holds(mention.head) || mention.head < from) continue;
    if (state && !mention.after && mention.roles.wanted) continue;
    if (mention.roles.destination || !mention.roles.source) return false;
    place = true;
  }
  return (state || place) && (instead || reading.any(segment, "stative"));
}

bool Sentence::leads(const Segment& segment) const {
  return std::any_of(reading.segments.begin(), reading.segments.end(),
                     [&](const Segment& one) { return one.verb && one.begin > segment.begin; });
}

bool Sentence::leads_on(const Segment& segment) const {
  if (!leads(segment) || !reading.at(segment.verb, "seizing")) return false;
  bool by_handle = false, own = false, handle = false;
  for (const Mention& mention : reading.mentions) {
    if (!segment.holds(mention.head)) continue;
    const bool is_handle = head(mention).is("grip") && (mention.things.empty() || mention.roles.wanted);
    const bool object = mention.part == "object" && mention.verb == reading.verb_of(segment);
    if (object && is_handle) return true;
    handle |= is_handle;
    by_handle |= is_handle && after(mention, "by");
    own |= object && mention.roles.handled;
  }
  return reading.at(segment.verb, "reaching") ? own || handle : own && by_handle && !meaning.carries();
}

bool Sentence::lifts() const {
  const ToldStep* last = meaning.steps.empty() ? nullptr : &meaning.steps.back();
  return last != nullptr && meaning.sense_of(*last).raises;
}

bool Sentence::swings() const {
  return std::any_of(meaning.skills.begin(), meaning.skills.end(), [](const auto& one) {
    return one.second.directions.contains("open") || one.second.directions.contains("close");
  });
}

std::set<std::string> Sentence::directions() const {
  return directions_in(reading, english, [this](const Segment& segment) { return denies_start(segment); });
}

bool Sentence::stands_on_table(const Mention& mention) const {
  const Word* doing = verb(mention);
  if (!head(mention).is("table") || !after(mention, "on") || meaning.carries() || &mention == reading.mentions.data())
    return false;
  const Mention& last = *(&mention - 1);
  return (doing == nullptr || !doing->is("putting")) && last.segment == mention.segment && !last.things.empty();
}

std::pair<int, int> Sentence::all_and_handled(const std::string& sense) const {
  int all = 0, handled = 0;
  for (const SpokenThing& one : meaning.things) {
    if (!one.heads.contains(sense) || one.region) continue;
    ++all;
    handled += (meaning.carries() ? one.roles.moved : one.roles.handled) ? 1 : 0;
  }
  return {all, handled};
}

bool Sentence::names_as(std::size_t own) const {
  const auto ours_any = [&](const auto& test) {
    return std::any_of(reading.mentions.begin(), reading.mentions.end(), test);
  };
  bool scene = false;
  for (const Mention& one : claims.own[own].mentions) {
    if (one.part == "to" && one.things.empty() && !ours_any([&](const Mention& ours) {  // `into the marked area`
          return ours.sense == one.sense || (ours.part == "to" && ours.roles.destination);
        }))
      return false;
    if (!one.roles.wanted) continue;
    scene = true;
    const bool named = ours_any([&](const Mention& ours) {
      return std::any_of(ours.things.begin(), ours.things.end(), [&](const std::string& name) {
        return std::find(one.things.begin(), one.things.end(), name) != one.things.end();
      });
    });
    if (!named) return false;
  }
  if (scene) return true;
  // It names nothing by the scene's words: `bin the paper`.
  const auto& theirs = claims.own[own].mentions;
  return !theirs.empty() && std::all_of(theirs.begin(), theirs.end(), [&](const Mention& one) {
    return ours_any([&](const Mention& ours) { return ours.sense == one.sense; });
  });
}

// The table goes without saying.
std::vector<std::string> Sentence::goal_things() const {
  std::vector<std::string> names;
  for (const SpokenThing& one : meaning.things) {
    const bool table = std::any_of(one.heads.begin(), one.heads.end(),
                                   [&](const std::string& head) { return english.has(head, "table"); });
    if (meaning.carries() ? one.roles.moved || (one.roles.destination && !table) : one.roles.handled)
      names.push_back(one.name);
  }
  return names;
}

bool Sentence::is_named(const std::string& name) const {
  return std::any_of(reading.mentions.begin(), reading.mentions.end(), [&](const Mention& mention) {
    return std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& one) {
      return one == name || is_part_of(one, name) || is_part_of(name, one);
    });
  });
}

// `hang up the picture`, `plug in the charger`: where there is one place for it
bool Sentence::is_implied(const std::string& name) const {
  const SpokenThing* place = meaning.thing(name);
  const bool alone = std::none_of(meaning.things.begin(), meaning.things.end(), [&](const SpokenThing& other) {
    return other.name != name && !is_part_of(other.name, name) && !is_part_of(name, other.name) &&
           std::any_of(other.heads.begin(), other.heads.end(),
                       [&](const std::string& head) { return place->heads.contains(head); });
  });
  for (const Segment& segment : reading.segments)
    for (const ToldStep& step : meaning.steps)
      if (alone && reading.at(segment.verb, "implying") && meaning.sense_of(step).verb == reading.verb_of(segment))
        for (std::size_t i = 1; i < step.arguments.size(); ++i)
          if (step.arguments[i] == name || is_part_of(step.arguments[i], name)) return true;
  return false;
}

bool Sentence::names_all() const {
  const std::vector<std::string> names = goal_things();
  return !names.empty() &&
         std::all_of(names.begin(), names.end(), [&](const auto& name) { return is_named(name) || is_implied(name); });
}

}  // namespace stampede
