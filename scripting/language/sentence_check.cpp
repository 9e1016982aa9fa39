#include "scripting/language/sentence_check.h"

#include <algorithm>
#include <array>

namespace stampede {
namespace {

constexpr std::array<std::string_view, 21> kRejections = {
    "too_short",      "too_long",     "not_a_sentence", "refused",       "other_language", "unknown_word",
    "unknown_thing",  "other_thing",  "missing_thing",  "wrong_colour",  "wrong_count",    "wrong_side",
    "unproved",       "other_action", "swapped_roles",  "swapped_order", "negated",        "misses_steps",
    "near_duplicate", "asked_back",   "no_answer"};

Verdict no(Rejection reason, std::string detail) { return {reason, std::move(detail)}; }

// What is there only once it is done.
const std::set<std::string> kBuilt = {"tower", "stack", "pile", "pyramid"};

std::string quoted(const std::string& word) { return "'" + word + "'"; }

using Maybe = std::optional<Verdict>;

// One sentence being checked.
class Checker {
 public:
  Checker(const std::string& sentence, const Meaning& meaning, const Claims& claims, Grain grain)
      : sentence_(sentence),
        meaning_(meaning),
        claims_(claims),
        grain_(grain),
        reading_(read_sentence(sentence, meaning)) {}

  Verdict check() const {
    for (const auto part :
         {&Checker::form, &Checker::words, &Checker::denials, &Checker::slots, &Checker::marks, &Checker::mentions,
          &Checker::coverage, &Checker::actions, &Checker::roles, &Checker::order, &Checker::steps})
      if (Maybe bad = (this->*part)()) return *bad;
    return {};
  }

 private:
  Maybe form() const {
    const auto count = static_cast<int>(reading_.words.size());
    if (count < 2) return no(Rejection::too_short, std::to_string(count) + " words");
    if (count > most_words(grain_)) return no(Rejection::too_long, std::to_string(count) + " words");
    for (const char c : sentence_)
      if (c == '\n' || c == '\t' || c == '<' || c == '>' || c == '[' || c == ']' || c == '|' || c == '*' || c == '#' ||
          c == '`' || c == '=' || (!meaning_.slots && (c == '{' || c == '}')) || c == '\\' || c == '_')
        if (!(meaning_.slots && c == '_')) return no(Rejection::not_a_sentence, std::string("it has a `") + c + "`");
    return {};
  }

  Maybe words() const {
    static const std::set<std::string> kExcuses = {"sorry",     "ai",     "assistant", "language", "apologize",
                                                   "apologise", "unable", "assist",    "sure"};
    int unknown = 0, foreign = 0, excuses = 0;
    const Word* first = nullptr;
    for (const Word& word : reading_.words) {
      if (std::any_of(word.text.begin(), word.text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
        ++foreign;
      excuses += kExcuses.contains(word.text) ? 1 : 0;
      if (word.kind != WordKind::unknown) continue;
      ++unknown;
      if (first == nullptr) first = &word;
    }
    const auto count = static_cast<int>(reading_.words.size());
    if (excuses > 1 || (excuses > 0 && unknown > 0)) return no(Rejection::refused, sentence_.substr(0, 60));
    if (foreign > 0 || 2 * unknown > count)
      return no(Rejection::other_language, std::to_string(unknown) + " of " + std::to_string(count) + " words unknown");
    if (first != nullptr) return no(Rejection::unknown_word, quoted(first->text));
    return {};
  }

  bool vouched(const Segment& segment) const {
    return claims_.segments.contains(content_of(reading_, segment.begin, segment.end));
  }

  // `and no others`, `leave the other blocks alone`
  bool spares_others(const Segment& segment) const {
    bool others = false;
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      others |= (reading_.words[i].kind == WordKind::exclusion && reading_.words[i].sense == "other") ||
                reading_.words[i].text == "else";
    return others && !claims_.others &&
           std::none_of(reading_.mentions.begin(), reading_.mentions.end(),
                        [&](const Mention& mention) { return within(mention, segment) && !mention.other; });
  }

  // What is said of it holds anyway: it has no part in this.
  bool spares(const Segment& segment) const {
    return spares_others(segment) || keeps_others(reading_, segment) || leaves_idle(segment);
  }

  // `leave the chicken where it is`, `the steak still on the grill`, `the left one shut`
  bool leaves_idle(const Segment& segment) const {
    static const std::set<std::string> kKeeps = {"leave", "leaving", "leaves", "keep", "keeping",
                                                 "keeps", "stay",    "stays",  "still"};
    if (segment.negated) return false;
    const Mention* first = nullptr;
    for (const Mention& mention : reading_.mentions)
      if (first == nullptr && within(mention, segment)) first = &mention;
    if (first == nullptr || !first->preposition.empty() || first->things.empty() || may_be(*first, meaning_, &SpokenThing::wanted)) return false;
    bool keeps = false, state = false;
    for (std::size_t i = segment.begin; i < segment.end; ++i) {
      keeps |= kKeeps.contains(reading_.words[i].text);
      state |= i > first->head && (reading_.words[i].text == "shut" || reading_.words[i].text == "closed");
    }
    return keeps || (state && segment.verb.value_or(segment.end) > first->head);
  }

  // `leave the block on the table`: it has to go somewhere else.
  Maybe left() const {
    for (const Segment& segment : reading_.segments) {
      if (!segment.verb || !reading_.words[*segment.verb].text.starts_with("lea") || vouched(segment)) continue;
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

  // Words of what tells nothing of this variation.
  std::set<std::size_t> beside() const {
    std::set<std::size_t> words = totals_in(reading_);
    for (const Segment& segment : reading_.segments)
      if (spares(segment))
        for (std::size_t i = segment.begin; i < segment.end; ++i) words.insert(i);
    return words;
  }

  bool within(const Mention& mention, const Segment& segment) const {
    return mention.head >= segment.begin && mention.head < segment.end;
  }

  Maybe denials() const {
    for (const Segment& segment : reading_.segments)
      if ((segment.negated || segment.excluding) && !vouched(segment) && !spares_others(segment) &&
          !spares_idle(segment) && !leaves_idle(segment))
        for (std::size_t i = segment.begin; i < segment.end; ++i)
          if (reading_.words[i].kind == WordKind::negation || reading_.words[i].kind == WordKind::exclusion)
            return no(Rejection::negated, quoted(reading_.words[i].text));
    return left();
  }

  // `spare the tomatoes`: things that have no part in it
  bool spares_idle(const Segment& segment) const {
    if (segment.negated) return false;
    bool any = false;
    for (const Mention& mention : reading_.mentions) {
      if (!within(mention, segment)) continue;
      if (may_be(mention, meaning_, &SpokenThing::wanted)) return false;
      any |= !mention.things.empty();
    }
    return any;
  }

  Maybe slots() const {
    if (!meaning_.slots) return {};
    const auto slots_of = [](const Reading& reading) {
      std::vector<std::string> found;
      for (const Word& word : reading.words)
        if (word.text.starts_with('{')) found.push_back(word.text);
      return found;
    };
    const std::vector<std::string> ours = slots_of(reading_), wanted = slots_of(claims_.own.front());
    if (ours == wanted) return {};
    for (const std::string& slot : wanted)
      if (std::find(ours.begin(), ours.end(), slot) == ours.end()) return no(Rejection::missing_thing, slot);
    for (const std::string& slot : ours)
      if (std::find(wanted.begin(), wanted.end(), slot) == wanted.end()) return no(Rejection::unknown_thing, slot);
    return no(ours.size() == wanted.size() ? Rejection::swapped_roles : Rejection::wrong_count, "of the slots");
  }

  Rejection kind_of_mark(const std::string& sense) const {
    for (const Word& word : reading_.words)
      if (word.sense == sense) {
        if (word.kind == WordKind::colour) return Rejection::wrong_colour;
        if (word.kind == WordKind::number) return Rejection::wrong_count;
        if (word.kind == WordKind::place) return Rejection::wrong_side;
        if (word.kind == WordKind::verb || word.kind == WordKind::function) return Rejection::other_action;
      }
    return Rejection::other_thing;
  }

  // What tells this variation from the others must be said, and nothing that tells another one.
  Maybe marks() const {
    const Marks& marks = claims_.marks;
    if (marks.telling.empty()) return {};
    const std::vector<std::string> said = marks_in(reading_, marks.telling, beside());
    for (const std::string& sense : said)
      if (!marks.ours.contains(sense)) return no(kind_of_mark(sense), quoted(sense) + " is another variation's");
    for (const std::vector<std::string>& own : marks.own)
      if (own == said || (!meaning_.ordered && std::set<std::string>(own.begin(), own.end()) ==
                                                   std::set<std::string>(said.begin(), said.end())))
        return {};
    const std::set<std::string> set(said.begin(), said.end());
    if (meaning_.ordered) {
      for (const std::vector<std::string>& own : marks.own)
        if (std::set<std::string>(own.begin(), own.end()) == set)
          return no(Rejection::swapped_order, "what has to be done first is not said first");
      return no(Rejection::missing_thing, "not all of the parts are named");
    }
    std::size_t least = said.size() + 1;
    for (const std::vector<std::string>& own : marks.own)
      if (!own.empty()) least = std::min(least, own.size());
    const bool alone = std::none_of(marks.theirs.begin(), marks.theirs.end(), [&](const auto& theirs) {
      return std::includes(theirs.begin(), theirs.end(), set.begin(), set.end());
    });
    if (alone && said.size() >= least) return {};
    for (const std::string& sense : marks.ours)
      if (!set.contains(sense)) return no(Rejection::missing_thing, "no word says " + quoted(sense));
    return no(Rejection::missing_thing, "which variation is meant");
  }

  const SpokenThing* thing(const std::string& name) const {
    for (const SpokenThing& one : meaning_.things)
      if (one.name == name) return &one;
    return nullptr;
  }

  Maybe mentions() const {
    for (const Mention& mention : reading_.mentions) {
      const Segment& segment = reading_.segments[mention.segment];
      if (vouched(segment) && segment.negated) continue;
      if (spares(segment)) {
        if (Maybe bad = known(mention)) return bad;
        continue;
      }
      for (const auto part :
           {&Checker::known, &Checker::coloured, &Checker::counted, &Checker::placed, &Checker::has_part})
        if (Maybe bad = (this->*part)(mention)) return bad;
    }
    if (Maybe bad = numbers()) return bad;
    if (Maybe bad = colours()) return bad;
    for (const auto& [before, place] : free_places(reading_))
      if (!claims_.places.contains({before, place})) return no(Rejection::wrong_side, quoted(before + " " + place));
    for (const std::string& relation : relations_in(reading_))
      if (!claims_.relations.contains(relation) && !(relation == "over" && rises())) return no(Rejection::wrong_side, quoted(relation));
    return {};
  }

  // Lifting ends in the air, above the table.
  bool lifts() const {
    return meaning_.skills.contains("lift") || (meaning_.skills.size() == 1 && meaning_.skills.contains("pick"));
  }

  bool rises() const {
    return lifts() && std::all_of(reading_.mentions.begin(), reading_.mentions.end(), [](const Mention& mention) {
             return (mention.preposition != "over" && mention.preposition != "above") || mention.sense == "table";
           });
  }

  // How many there are of what a noun names, and how many of these are handled.
  std::pair<int, int> all_and_handled(const std::string& sense) const {
    int all = 0, handled = 0;
    for (const SpokenThing& one : meaning_.things) {
      if (!one.heads.contains(sense) || one.region) continue;
      ++all;
      handled += (carries() ? one.moved : one.handled) ? 1 : 0;
    }
    return {all, handled};
  }

  // Those that count nothing that is named. Of what is left alone: how many there are.
  Maybe numbers() const {
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
    const bool said = ours.empty() || std::any_of(claims_.numbers.begin(), claims_.numbers.end(),
                                                  [&](const auto& own) { return own == ours || bare(own) == bare(ours); });
    if (!said) return no(Rejection::wrong_count, ours.front());
    return {};
  }

  // Those that are said of no noun too; and at least those of one of the author's sentences.
  Maybe colours() const {
    const std::set<std::string> ours = colours_in(reading_);
    for (const std::string& colour : ours) {
      const bool borne = std::any_of(meaning_.things.begin(), meaning_.things.end(), [&](const SpokenThing& one) {
        return one.wanted && one.colours.contains(colour);
      });
      if (!borne && !claims_.senses.contains(colour)) return no(Rejection::wrong_colour, quoted(colour));
    }
    const bool enough = std::any_of(claims_.colours.begin(), claims_.colours.end(), [&](const auto& own) {
      return std::includes(ours.begin(), ours.end(), own.begin(), own.end());
    });
    if (!enough && !claims_.colours.empty()) return no(Rejection::missing_thing, "a colour is left out");
    return {};
  }

  Maybe known(const Mention& mention) const {
    static const std::set<std::string> kGeneral = {"side", "order",  "colour", "space", "thing",
                                                   "end",  "number", "hand",   "shape", "item"};
    const auto there = [&](const std::string& sense) {
      return sense.empty() || (sense == "air" && lifts()) || kGeneral.contains(sense) || claims_.senses.contains(sense) ||
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

  Maybe coloured(const Mention& mention) const {
    const std::set<std::string> different(mention.colours.begin(), mention.colours.end());
    if (different.size() < mention.colours.size()) return no(Rejection::wrong_count, "a colour twice");
    for (const std::string& colour : mention.colours) {
      if (claims_.attributes.contains({colour, mention.sense})) continue;
      const bool borne = std::any_of(mention.things.begin(), mention.things.end(),
                                     [&](const std::string& name) { return thing(name)->colours.contains(colour); });
      const bool built = mention.things.empty() && kBuilt.contains(mention.sense) && claims_.marks.ours.contains(colour);
      if (!borne && !built) return no(Rejection::wrong_colour, "the " + mention.sense + " is not " + colour + " in every start");
    }
    return {};
  }

  int count_of(const Mention& mention, bool SpokenThing::*role) const {
    int count = 0;
    for (const std::string& name : mention.things) {
      const std::string whole = name.substr(0, name.find('.'));
      const bool again = whole != name && std::find(mention.things.begin(), mention.things.end(), whole) != mention.things.end();
      count += thing(name)->*role && !again ? 1 : 0;  // a button's cap is no other button
    }
    return count;
  }

  Maybe counted(const Mention& mention) const {
    const auto own = claims_.counts.find(mention.sense);
    if (mention.count) {
      if (*mention.count == 1 && mention.plural && !mention.partitive)
        return no(Rejection::wrong_count, "one of several " + mention.sense);
      if (mention.total && *mention.total != all_and_handled(mention.sense).first)
        return no(Rejection::wrong_count, "of " + std::to_string(*mention.total) + " " + mention.sense);
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

  Maybe placed(const Mention& mention) const {
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

  Maybe has_part(const Mention& mention) const {
    const Segment& segment = reading_.segments[mention.segment];
    if (mention.things.empty() || mention.other || may_be(mention, meaning_, &SpokenThing::wanted)) return {};
    if (vouched(segment) || segment.excluding || spares_others(segment)) return {};
    if (mention.partitive && (mention.plural || mention.count)) return {};  // `of all the groceries`
    if (stands_on_table(mention)) return {};
    return no(Rejection::other_thing, "the " + mention.things.front() + " has no part in this");
  }

  // At least what one of the author's own sentences names.
  Maybe coverage() const {
    bool names = false;
    for (std::size_t i = 0; i < claims_.wanted.size(); ++i) {
      const std::vector<Mention>& own = claims_.wanted[i];
      if (own.empty() && says_all_of(claims_.own[i])) return {};
      if (own.empty()) continue;
      names = true;
      const bool all = std::all_of(own.begin(), own.end(), [&](const Mention& one) {
        return std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& ours) {
          return std::any_of(ours.things.begin(), ours.things.end(), [&](const std::string& name) {
            return std::find(one.things.begin(), one.things.end(), name) != one.things.end();
          });
        });
      });
      if (all) return {};
    }
    if (!names || names_all()) return {};
    for (const std::string& name : goal_things())
      if (!is_named(name)) return no(Rejection::missing_thing, "nothing names the " + name);
    return no(Rejection::missing_thing, "less is named than in any sentence of the author");
  }

  // All nouns of a sentence that names nothing by the scene's words: `bin the paper`.
  bool says_all_of(const Reading& own) const {
    return !own.mentions.empty() && std::all_of(own.mentions.begin(), own.mentions.end(), [&](const Mention& one) {
      return std::any_of(reading_.mentions.begin(), reading_.mentions.end(),
                         [&](const Mention& ours) { return ours.sense == one.sense; });
    });
  }

  bool carries() const {
    return std::any_of(meaning_.things.begin(), meaning_.things.end(), [](const auto& one) { return one.moved; });
  }

  // What is carried, and to where; else what is handled. The table goes without saying.
  std::vector<std::string> goal_things() const {
    std::vector<std::string> names;
    for (const SpokenThing& one : meaning_.things)
      if (carries() ? one.moved || (one.destination && !one.heads.contains("table")) : one.handled)
        names.push_back(one.name);
    return names;
  }

  bool is_named(const std::string& name) const {
    return std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& mention) {
      return std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& one) {
        return one == name || one.starts_with(name + ".") || name.starts_with(one + ".");
      });
    });
  }

  bool names_all() const {
    const std::vector<std::string> names = goal_things();
    return !names.empty() && std::all_of(names.begin(), names.end(), [&](const auto& name) { return is_named(name); });
  }

  // `take the handle`, `go to the button`: on the way to what is done
  bool takes_part(const Segment& segment) const {
    const std::string& verb = reading_.words[*segment.verb].sense;
    const bool more = std::any_of(reading_.segments.begin(), reading_.segments.end(),
                                  [&](const Segment& one) { return one.verb && one.begin > segment.begin; });
    if (!more || (verb != "take" && verb != "hold" && verb != "reach")) return false;
    return std::any_of(reading_.mentions.begin(), reading_.mentions.end(), [&](const Mention& mention) {
      return within(mention, segment) && mention.role == "object " + verb &&
             (verb == "reach" ? may_be(mention, meaning_, &SpokenThing::handled)
                              : mention.sense == "handle" && may_be(mention, meaning_, &SpokenThing::wanted));
    });
  }

  Maybe actions() const {
    static const std::set<std::string> kSays = {"is", "are", "be", "want", "need"};
    static const std::set<std::string> kStates = {"find", "switch", "belong", "complete", "lie",      "contain",
                                                  "mark", "show",   "locate", "colour",   "take-care"};
    bool any = false;
    for (const Word& word : reading_.words)
      any |= word.kind == WordKind::verb || word.kind == WordKind::own || kSays.contains(word.text);
    if (!any) return no(Rejection::not_a_sentence, "there is no verb");
    for (const Segment& segment : reading_.segments) {
      if (!segment.verb || spares(segment) || takes_part(segment)) continue;
      const std::string& verb = reading_.words[*segment.verb].sense;
      if (claims_.verbs.contains(verb) || kStates.contains(verb)) continue;
      const std::set<std::string>& skills = meaning_.lexicon.skills_of(verb);
      if (std::none_of(skills.begin(), skills.end(), [&](const auto& one) { return meaning_.skills.contains(one); }))
        return no(Rejection::other_action, quoted(verb));
    }
    for (const std::string& direction : directions_in(reading_)) {
      const std::string opposite = opposite_of(direction);
      if (!claims_.directions.contains(direction) && !opposite.empty() && claims_.directions.contains(opposite) &&
          !planned(direction))
        return no(Rejection::other_action, quoted(direction) + " for " + quoted(opposite));
    }
    return {};
  }

  bool planned(const std::string& direction) const {
    static const std::map<std::string, std::set<std::string>> kOf = {
        {"open", {"open", "unscrew"}},
        {"close", {"close"}},
        {"in", {"put_in", "insert", "put_on_shelf", "drop"}},
        {"insert", {"insert", "put_in"}},
        {"remove", {"extract", "take_out", "take_from_shelf", "unhang"}},
        {"out", {"extract", "take_out", "take_from_shelf", "unhang", "pick"}},
        {"up", {"pick", "lift"}}};
    const auto found = kOf.find(direction);
    if (found == kOf.end()) return false;
    return std::any_of(found->second.begin(), found->second.end(),
                       [&](const auto& one) { return meaning_.skills.contains(one); });
  }

  // What each thing is in the sentence (what is handled, where to, where from) must be what it is in the plan, or in a
  // sentence of the author.
  Maybe roles() const {
    if (Maybe bad = prefaces()) return bad;
    if (Maybe bad = twice()) return bad;
    if (Maybe bad = pronouns()) return bad;
    for (const Mention& mention : reading_.mentions) {
      if (mention.things.empty() || vouched(reading_.segments[mention.segment])) continue;
      if (mention.other) {
        const bool alike = std::any_of(meaning_.things.begin(), meaning_.things.end(), [&](const SpokenThing& one) {
          return one.handled && one.words.contains(mention.sense);
        });
        if (!alike) return no(Rejection::other_thing, "the other " + mention.sense);
        continue;
      }
      if (spares(reading_.segments[mention.segment])) continue;
      const bool until = reading_.segments[mention.segment].intro == "until";
      if (!until && (has_role(mention) || stands_on_table(mention))) continue;
      const std::string role = role_key(reading_, mention);
      const bool vouched_for =
          (!mention.by_head && claims_.roles.contains({role, mention.sense})) ||
          (mention.by_head && std::any_of(mention.things.begin(), mention.things.end(), [&](const std::string& name) {
             return claims_.roles.contains({role, name});
           }));
      if (!vouched_for) return no(Rejection::swapped_roles, "the " + mention.sense + " as " + quoted(mention.role));
    }
    return {};
  }

  // `the lamp is dark: …` is the author's to say: no fact tells.
  Maybe prefaces() const {
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
  Maybe twice() const {
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
  Maybe pronouns() const {
    static const std::set<std::string> kCarrying = {"put", "insert", "stack", "hang", "drop", "take"};
    for (const Segment& segment : reading_.segments) {
      if (!segment.verb || *segment.verb + 1 >= segment.end || !kCarrying.contains(reading_.words[*segment.verb].sense))
        continue;
      const std::string& text = reading_.words[*segment.verb + 1].text;
      if (text != "it" && text != "them") continue;
      const Mention* last = nullptr;
      bool itself = false;
      for (const Mention& mention : reading_.mentions)
        if (mention.head < segment.begin &&
            (mention.role.starts_with("subject") || mention.role.starts_with("object ")))
          last = &mention;
      for (const Mention& mention : reading_.mentions)
        itself |= last != nullptr && within(mention, segment) && mention.sense == last->sense &&
                  mention.role.starts_with("to");
      if (itself) return no(Rejection::swapped_roles, "the " + last->sense + " and itself");
      if (last != nullptr && vouched(segment) && vouched(reading_.segments[last->segment])) continue;
      if (last != nullptr && !last->things.empty() && !may_be(*last, meaning_, &SpokenThing::moved))
        return no(Rejection::swapped_roles, "the " + last->sense + " is not carried");
    }
    return {};
  }

  // `the button on the table`: that it stands there goes without saying.
  bool stands_on_table(const Mention& mention) const {
    static const std::set<std::string> kPutting = {"put",   "insert", "drop",  "stack", "hang",
                                                   "stand", "lower",  "point", "lift"};
    const Word* verb = verb_of(mention);
    return mention.sense == "table" && mention.preposition == "on" && !carries() &&
           (verb == nullptr || !kPutting.contains(verb->sense)) && &mention != reading_.mentions.data() &&
           (&mention - 1)->segment == mention.segment && !(&mention - 1)->things.empty();
  }

  // The thing that the stretch says is handled; null: none, or a pronoun.
  const Mention* object_of(const Mention& mention) const {
    for (const Mention& other : reading_.mentions)
      if (other.segment == mention.segment && &other < &mention && !kBuilt.contains(other.sense) &&
          (other.role.starts_with("subject") || other.role.starts_with("object ")))
        return &other;
    return nullptr;
  }

  bool has_role(const Mention& mention) const {
    const std::string role = mention.role.substr(0, mention.role.find(' '));
    const bool accessory = may_be(mention, meaning_, &SpokenThing::accessory);
    if (mention.role == "subject belong" && carries()) return may_be(mention, meaning_, &SpokenThing::moved);
    const bool above = mention.preposition == "above" || mention.preposition == "over";
    if (above && mention.sense == "table" && lifts()) return true;
    if (role == "to" && arrives(mention)) return may_be(mention, meaning_, &SpokenThing::handled);
    if (mention.role == "subject hold" && may_be(mention, meaning_, &SpokenThing::destination)) return true;
    if (role == "subject") return accessory || (may_be(mention, meaning_, &SpokenThing::handled) && !shows(mention));
    if (role == "object" && verb_of(mention) != nullptr && takes_part(reading_.segments[mention.segment])) return true;
    if (role == "object") return accessory || steps_have(mention, false);
    if (role == "of") return accessory || is_whole(mention);
    if (role == "part")
      return (mention.count && mention.count &&
              may_be(mention, meaning_, carries() ? &SpokenThing::moved : &SpokenThing::handled));
    if (role == "with") return accessory || steps_have(mention, true);
    const Mention* object = object_of(mention);
    if (object != nullptr && !object->by_head && object->role.starts_with("object") && !object->sense.empty())
      return false;  // of that nothing is known
    if ((role == "to" || role == "in") && mention.sense == "table" && mention.preposition.starts_with("in"))
      return false;
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

  // `go to the button and …`
  bool arrives(const Mention& mention) const {
    const Segment& segment = reading_.segments[mention.segment];
    return segment.verb && reading_.words[*segment.verb].text == "go" &&
           std::any_of(reading_.segments.begin(), reading_.segments.end(),
                       [&](const Segment& one) { return one.verb && one.begin > segment.begin; });
  }

  bool shows(const Mention& mention) const {
    static const std::set<std::string> kSays = {"show", "contain", "mark", "complete"};
    const Segment& segment = reading_.segments[mention.segment];
    for (std::size_t i = mention.head + 1; i < segment.end; ++i)
      if (reading_.words[i].kind == WordKind::verb) return kSays.contains(reading_.words[i].sense);
    return false;
  }

  static bool fetches(const std::string& verb) { return verb == "take" || verb == "remove" || verb == "lift"; }

  const Word* verb_of(const Mention& mention) const {
    const Segment& segment = reading_.segments[mention.segment];
    if (segment.verb) return &reading_.words[*segment.verb];
    if (!mention.role.starts_with("object ")) return nullptr;
    for (std::size_t k = mention.first; k > segment.begin; --k)
      if (reading_.words[k - 1].kind == WordKind::verb && mention.role.substr(7) == reading_.words[k - 1].sense)
        return &reading_.words[k - 1];
    return nullptr;
  }

  // A step that the verb may tell of has it as what is handled, or as where that goes.
  bool steps_have(const Mention& mention, bool as_place) const {
    static const std::set<std::string> kWhole = {"open", "close", "press", "turn", "press_with", "push", "unscrew"};
    const Word* verb = verb_of(mention);
    if (verb == nullptr) return false;
    const std::set<std::string>& skills = meaning_.lexicon.skills_of(verb->sense);
    for (const PlanStep& step : meaning_.steps) {
      if (!skills.contains(step.action) || (as_place && kTakes.contains(step.action))) continue;
      // Of what is pressed with a thing, the thing comes first.
      const std::size_t handled = step.action == "press_with" ? 1 : 0;
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
  bool is_whole(const Mention& mention) const {
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
  bool hangs(const Mention& mention) const {
    const Segment& segment = reading_.segments[mention.segment];
    return std::any_of(reading_.words.begin() + static_cast<std::ptrdiff_t>(segment.begin),
                       reading_.words.begin() + static_cast<std::ptrdiff_t>(mention.first),
                       [](const Word& word) { return word.sense == "hang"; });
  }

  // `take the cup on the table`: that is where it is.
  bool takes(const Mention& mention) const {
    static const std::set<std::string> kTaking = {"take", "remove", "lift", "find", "hold", "pull", "clear"};
    const Segment& segment = reading_.segments[mention.segment];
    const bool at = mention.preposition == "on" || mention.preposition == "in" || mention.preposition == "inside";
    return at && segment.verb && *segment.verb < mention.first && kTaking.contains(reading_.words[*segment.verb].sense);
  }

  // Kinds of skills in the order of the plan: each kind of what is said, where the plan has it first after the last.
  Maybe order() const {
    if (reading_.segments.size() < 2) return {};
    if (const Maybe bad = relative_order()) return bad;
    int reached = -1;
    for (const std::size_t at : reading_.in_time) {
      const Segment& segment = reading_.segments[at];
      if (reading_.words[segment.begin].before == ':') reached = -1;
      if (!segment.verb || segment.negated || segment.excluding) continue;
      if (reading_.words[*segment.verb].sense == "hold") continue;  // it lasts
      const std::set<std::string>& skills = meaning_.lexicon.skills_of(reading_.words[*segment.verb].sense);
      int next = -1, any = -1;
      for (int i = 0; i < static_cast<int>(meaning_.steps.size()); ++i) {
        if (!skills.contains(meaning_.steps[static_cast<std::size_t>(i)].action)) continue;
        if (!concerns(segment, meaning_.steps[static_cast<std::size_t>(i)])) continue;
        if (any < 0) any = i;
        if (i >= reached && next < 0) next = i;
      }
      if (next >= 0)
        reached = next;
      else if (any >= 0)
        return no(Rejection::swapped_order, quoted(reading_.words[*segment.verb].text) + " comes earlier");
    }
    return {};
  }

  // Verbs that the author's sentences have in one order only.
  Maybe relative_order() const {
    const auto verbs_of = [&](const Reading& reading) {
      std::vector<std::string> verbs;
      for (const std::size_t at : reading.in_time)
        if (const auto verb = reading.segments[at].verb) verbs.push_back(reading.words[*verb].sense);
      return verbs;
    };
    const std::vector<std::string> ours = verbs_of(reading_);
    const auto before = [](const std::vector<std::string>& list, const std::string& a, const std::string& b) {
      const auto first = std::find(list.begin(), list.end(), a), second = std::find(list.begin(), list.end(), b);
      return first != list.end() && second != list.end() && first < second;
    };
    for (const Reading& own : claims_.own) {
      const std::vector<std::string> theirs = verbs_of(own);
      for (std::size_t i = 0; i < ours.size(); ++i)
        for (std::size_t k = i + 1; k < ours.size(); ++k)
          if (ours[i] != ours[k] && before(theirs, ours[k], ours[i]) && !before(theirs, ours[i], ours[k]) &&
              std::none_of(claims_.own.begin(), claims_.own.end(),
                           [&](const Reading& other) { return before(verbs_of(other), ours[i], ours[k]); }))
            return no(Rejection::swapped_order, quoted(ours[k]) + " comes before " + quoted(ours[i]));
    }
    return {};
  }

  // False where the stretch names wanted things and the step handles none of them.
  bool concerns(const Segment& segment, const PlanStep& step) const {
    bool named = false;
    for (const Mention& mention : reading_.mentions) {
      if (!within(mention, segment) || !may_be(mention, meaning_, &SpokenThing::wanted)) continue;
      named = true;
      for (const std::string& name : mention.things)
        for (const std::string& argument : step.arguments)
          if (argument == name || argument.starts_with(name + ".")) return true;
    }
    return !named;
  }

  Maybe steps() const {
    if (grain_ == Grain::goal || meaning_.slots) return {};
    int verbs = 0;
    for (const Segment& segment : reading_.segments) verbs += segment.verb ? 1 : 0;
    const int wanted = grain_ == Grain::motions ? 3 : std::min<int>(2, static_cast<int>(meaning_.steps.size()));
    if (verbs < wanted) return no(Rejection::misses_steps, std::to_string(verbs) + " of them");
    return {};
  }

  const std::string& sentence_;
  const Meaning& meaning_;
  const Claims& claims_;
  Grain grain_;
  Reading reading_;
};

}  // namespace

std::string_view to_string(Rejection reason) { return kRejections.at(static_cast<std::size_t>(reason)); }

std::optional<Rejection> rejection_from(std::string_view name) {
  for (std::size_t i = 0; i < kRejections.size(); ++i)
    if (kRejections[i] == name) return static_cast<Rejection>(i);
  return std::nullopt;
}

int most_words(Grain grain) { return grain == Grain::goal ? 40 : grain == Grain::steps ? 80 : 120; }

SentenceChecker::SentenceChecker(Meaning meaning) : meaning_(std::move(meaning)), claims_(claims_of(meaning_)) {}

Verdict SentenceChecker::check(const std::string& sentence, Grain grain) const {
  return Checker(sentence, meaning_, claims_, grain).check();
}

}  // namespace stampede
