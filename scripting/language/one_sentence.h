// One sentence being checked: what the parts of the check share. Of this room alone.
#pragma once

#include <algorithm>

#include "scripting/language/sentence_check.h"

namespace stampede {

using Maybe = std::optional<Verdict>;

inline Verdict no(Rejection reason, std::string detail) { return {reason, std::move(detail)}; }
inline bool says_above(const Mention& mention) {
  return mention.preposition == "above" || mention.preposition == "over";
}
inline std::string quoted(const std::string& word) { return "'" + word + "'"; }

class OneSentence {
 public:
  OneSentence(const std::string& sentence, const Meaning& meaning, const Claims& claims, Grain grain)
      : sentence_(sentence),
        meaning_(meaning),
        claims_(claims),
        grain_(grain),
        reading_(read_sentence(sentence, meaning)) {}
  Verdict check() const;

 private:
  Maybe form() const;
  Maybe words() const;
  bool vouched(const Segment& segment) const;
  // `and no others`, `leave the other blocks alone`
  bool spares_others(const Segment& segment) const;
  // What is said of it holds anyway: it has no part in this.
  bool spares(const Segment& segment) const;
  // `leave the chicken where it is`, `the steak still on the grill`, `the left one shut`
  bool leaves_idle(const Segment& segment) const;
  // `leave the block on the table`: it has to go somewhere else.
  Maybe left() const;
  // Words of what tells nothing of this variation.
  std::set<std::size_t> beside() const;
  bool within(const Mention& mention, const Segment& segment) const;
  Maybe denials() const;
  bool denies_start(const Segment& segment) const;
  // `spare the tomatoes`: things that have no part in it
  bool spares_idle(const Segment& segment) const;
  Maybe slots() const;
  Rejection kind_of_mark(const std::string& sense) const;
  // What tells this variation from the others must be said, and nothing that tells another one.
  Maybe marks() const;
  const SpokenThing* thing(const std::string& name) const;
  Maybe mentions() const;
  // Lifting ends in the air, above the table.
  bool lifts() const;
  bool rises() const;
  bool moves_above() const;
  bool is_above(const Mention& mention) const;
  bool swings() const;
  // How many there are of what a noun names, and how many of these are handled.
  std::pair<int, int> all_and_handled(const std::string& sense) const;
  // Those that count nothing that is named. Of what is left alone: how many there are.
  Maybe numbers() const;
  // Those that are said of no noun too; and at least those of one of the author's sentences.
  Maybe colours() const;
  Maybe known(const Mention& mention) const;
  Maybe coloured(const Mention& mention) const;
  int count_of(const Mention& mention, bool SpokenThing::*role) const;
  Maybe counted(const Mention& mention) const;
  Maybe placed(const Mention& mention) const;
  Maybe has_part(const Mention& mention) const;
  bool names_as(std::size_t own) const;
  // At least what one of the author's own sentences names.
  Maybe coverage() const;
  // All nouns of a sentence that names nothing by the scene's words: `bin the paper`.
  bool says_all_of(const Reading& own) const;
  bool carries() const;
  // What is carried, and to where; else what is handled. The table goes without saying.
  std::vector<std::string> goal_things() const;
  bool is_named(const std::string& name) const;
  bool is_implied(const std::string& name) const;
  bool names_all() const;
  // `take the handle`, `go to the button`: on the way to what is done
  bool takes_part(const Segment& segment) const;
  Maybe actions() const;
  Maybe ends() const;
  std::set<std::string> skills_told(const std::set<std::string>& verbs) const;
  Maybe undone() const;
  bool planned(const std::string& direction) const;
  // What each thing is in the sentence (what is handled, where to, where from) must be what it is in the plan, or in a
  // sentence of the author.
  Maybe roles() const;
  bool same_part(const std::string& role, const std::string& sense) const;
  // `the lamp is dark: …` is the author's to say: no fact tells.
  Maybe prefaces() const;
  // `put the cup on the cup`; of a thing that a short sentence names twice, one is another's place.
  Maybe twice() const;
  // `…: put it on the table`: what was spoken of last is what is moved.
  Maybe pronouns() const;
  // `the button on the table`: that it stands there goes without saying.
  bool stands_on_table(const Mention& mention) const;
  // The thing that the stretch says is handled; null: none, or a pronoun.
  const Mention* object_of(const Mention& mention) const;
  bool has_role(const Mention& mention) const;
  bool left_by_author(const Mention& mention) const;  // `from the fridge`
  bool is_handled_by_author(const std::string& sense) const;
  // `put the bottle on the fridge` for in it
  Maybe contained() const;
  // `go to the button and …`
  bool arrives(const Mention& mention) const;
  bool shows(const Mention& mention) const;
  static bool fetches(const std::string& verb);
  const Word* verb_of(const Mention& mention) const;
  // A step that the verb may tell of has it as what is handled, or as where that goes.
  bool steps_have(const Mention& mention, bool as_place) const;
  // `the drawer of the chest`, `the chest's drawer`
  bool is_whole(const Mention& mention) const;
  // `let it dangle from the hook`: that is where it goes.
  bool hangs(const Mention& mention) const;
  // `take the cup on the table`: that is where it is.
  bool takes(const Mention& mention) const;
  // Kinds of skills in the order of the plan: each kind of what is said, where the plan has it first after the last.
  Maybe order() const;
  // Verbs that the author's sentences have in one order only.
  Maybe relative_order() const;
  enum class Concern { none, part, itself };
  Concern concerns(const Segment& segment, const PlanStep& step) const;
  Maybe steps() const;
  const std::string& sentence_;
  const Meaning& meaning_;
  const Claims& claims_;
  Grain grain_;
  Reading reading_;
};

}  // namespace stampede
