// One sentence being checked: its reading beside what it has to mean and what its author says, for the rules.
#pragma once

#include "engine/language/claims.h"
#include "engine/record/record.h"

namespace stampede {

class Sentence {
 public:
  Sentence(std::string text, const Meaning& meaning, const Claims& claims, LanguageGrain grain);

  const std::string text;
  const Meaning& meaning;
  const Claims& claims;
  const LanguageGrain grain;
  const Reading reading;
  const English& english;

  const Segment& segment(const Mention& mention) const { return reading.segments[mention.segment]; }
  // Words of what tells nothing of this variation.
  std::set<std::size_t> beside() const;

  // The author says so.
  bool vouched(const Segment& segment) const { return vouched_[number(segment)]; }
  // What is said there holds anyway: it has no part in this.
  bool spares(const Segment& segment) const { return spares_[number(segment)]; }

  bool lifts() const;   // the plan ends in the air, above the table
  bool swings() const;  // what is opened or closed has something to take hold of
  const Word* verb(const Mention& mention) const {
    return mention.verb_at ? &reading.words[*mention.verb_at] : nullptr;
  }
  bool after(const Mention& mention, WordClass of) const { return reading.at(mention.after, of); }
  const Word& head(const Mention& mention) const { return reading.words[mention.head]; }
  bool stands_on_table(const Mention& mention) const;  // `the button on the table`: that goes without saying

  // How many there are of what a noun names, and how many of these are handled.
  std::pair<int, int> all_and_handled(const std::string& sense) const;
  bool names_as(const Reading& own) const;  // all that a sentence of the author names of what is wanted
  // Of what is carried, and to where, or else handled, the first that is not named; the table goes without saying.
  std::optional<std::string> unnamed() const;

 private:
  std::size_t number(const Segment& segment) const {
    return static_cast<std::size_t>(&segment - reading.segments.data());
  }
  bool is_named(const std::string& name) const;
  bool is_implied(const SpokenThing& place) const;
  bool spares_others(const Segment& segment) const;  // `and no others`, `leave the other blocks alone`
  bool leaves_idle(const Segment& segment) const;    // `leave the chicken where it is`, `the left one shut`
  bool denies_start(const Segment& segment) const;   // `it should no longer be on its stand`

  std::vector<bool> vouched_, spares_;  // by segment: every rule asks
};

}  // namespace stampede
