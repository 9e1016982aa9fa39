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
  std::set<std::size_t> words;
  for (const Segment& segment : reading.segments)
    for (std::size_t i = segment.begin; i < segment.end && spares(segment); ++i) words.insert(i);
  return words;
}

bool Sentence::spares_others(const Segment& segment) const {
  return reading.any(segment, "other") && !claims.others &&
         std::ranges::all_of(reading.mentions_of(segment), &Mention::other);
}

bool Sentence::leaves_idle(const Segment& segment) const {
  const std::span<const Mention> named = reading.mentions_of(segment);
  if (segment.negated || named.empty() || named[0].after || named[0].things.empty() || named[0].roles.wanted)
    return false;
  return reading.any(segment, "keeping") ||
         (reading.any(segment, "shut") && segment.verb.value_or(segment.end) > named[0].head);
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
  for (const Mention& mention : reading.mentions_of(segment)) {
    if (mention.head < from) continue;
    if (state && !mention.after && mention.roles.wanted) continue;
    if (mention.roles.destination || !mention.roles.source) return false;
    place = true;
  }
  return (state || place) && (instead || reading.any(segment, "stative"));
}

bool Sentence::lifts() const {
  const ToldStep* last = meaning.steps.empty() ? nullptr : &meaning.steps.back();
  return last != nullptr && meaning.sense_of(*last).raises;
}

bool Sentence::swings() const {
  return std::ranges::any_of(meaning.skills, [](const auto& one) {
    return one.second.directions.contains("open") || one.second.directions.contains("close");
  });
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

bool Sentence::names_as(const Reading& own) const {
  const auto ours_any = [&](const auto& test) { return std::ranges::any_of(reading.mentions, test); };
  bool scene = false;
  for (const Mention& one : own.mentions) {
    if (one.part == "to" && one.things.empty() && !ours_any([&](const Mention& ours) {  // `into the marked area`
          return ours.sense == one.sense || (ours.part == "to" && ours.roles.destination);
        }))
      return false;
    if (!one.roles.wanted) continue;
    scene = true;
    const bool named = ours_any([&](const Mention& ours) {
      return std::ranges::any_of(ours.things, [&](const std::string& name) {
        return std::ranges::find(one.things, name) != one.things.end();
      });
    });
    if (!named) return false;
  }
  if (scene) return true;
  // It names nothing by the scene's words: `bin the paper`.
  const auto& theirs = own.mentions;
  return !theirs.empty() && std::ranges::all_of(theirs, [&](const Mention& one) {
    return ours_any([&](const Mention& ours) { return ours.sense == one.sense; });
  });
}

bool Sentence::is_named(const std::string& name) const {
  return std::ranges::any_of(reading.mentions, [&](const Mention& mention) {
    return std::ranges::any_of(mention.things, [&](const std::string& one) {
      return one == name || is_part_of(one, name) || is_part_of(name, one);
    });
  });
}

// `hang up the picture`, `plug in the charger`: where there is one place for it
bool Sentence::is_implied(const SpokenThing& place) const {
  const bool alone = std::ranges::none_of(meaning.things, [&](const SpokenThing& other) {
    return other.name != place.name && !is_part_of(other.name, place.name) && !is_part_of(place.name, other.name) &&
           share_a_noun(other, place);
  });
  for (const Segment& segment : reading.segments)
    for (const ToldStep& step : meaning.steps)
      if (alone && reading.at(segment.verb, "implying") && meaning.sense_of(step).verb == reading.verb_of(segment))
        for (std::size_t i = 1; i < step.arguments.size(); ++i)
          if (step.arguments[i] == place.name || is_part_of(step.arguments[i], place.name)) return true;
  return false;
}

std::optional<std::string> Sentence::unnamed() const {
  for (const SpokenThing& one : meaning.things) {
    const bool table = std::ranges::any_of(one.heads, [&](const auto& head) { return english.has(head, "table"); });
    const bool wanted = meaning.carries() ? one.roles.moved || (one.roles.destination && !table) : one.roles.handled;
    if (wanted && !is_named(one.name) && !is_implied(one)) return one.name;
  }
  return {};
}

}  // namespace stampede
