// What a sentence has to mean: the things of the scene, what is to be done with them, and how its author says it.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "engine/start/interfaces.h"
#include "engine/symbolic/task_planner.h"
#include "scripting/language/lexicon.h"

namespace stampede {

class Library;

// A thing as it can be spoken of: senses of words, in the sense of Lexicon.
struct SpokenThing {
  std::string name;                          // `chest.top_drawer`
  std::string phrase;                        // `top drawer of the chest`, without what other starts have otherwise
  std::set<std::string> heads;               // nouns that name it: `drawer`
  std::set<std::string> words;               // all words of its names, its whole's too: top drawer chest
  std::set<std::string> colours;             // that it has in every start of the variation
  bool region = false;                       // a place without a body: a mark, the inside of a box
  bool wanted = false;                       // the goal or the plan handles it, or a part of it
  bool handled = false;                      // a step is about it: pressed, opened, carried …
  bool moved = false;                        // the plan carries it somewhere
  bool accessory = false;                    // a part that helps: the handle of what is opened
  bool tool = false;                         // with which something else is handled
  bool source = false, destination = false;  // of what is moved
};

// The sentences of one of the task's variations, or of one of its subgoals.
struct OwnSentences {
  std::string variation;
  std::vector<std::string> sentences;
  std::vector<Subgoal> subgoals = {};  // of the variation, those that have a sentence
};

struct Meaning {
  std::string task, variation;          // of a skill's or predicate's label: its name, and nothing
  std::vector<std::string> own;         // the author's sentences
  std::vector<OwnSentences> elsewhere;  // of the other variations; of a subgoal: of the other ones
  std::vector<SpokenThing> things;
  Plan steps;                      // what does it; empty where nothing has to be done
  std::set<std::string> skills;    // of the steps
  bool ordered = false;            // the goal's parts must come true in their order
  bool slots = false;              // the sentences speak of {slots} in place of things
  std::string goal;                // as PDDL, for prompts
  std::vector<std::string> facts;  // of the start, as sentences, for prompts
  Lexicon lexicon;                 // with the words of all these
};

// Skills that end a thing's being somewhere, and those that begin it: of the thing, and of the place.
extern const std::set<std::string> kTakes, kPuts;

// The author's sentences of every variation of a task.
std::vector<OwnSentences> sentences_of(const std::shared_ptr<const Library>& library, const std::string& task);

// Of a variation: what is said of its things holds in several starts (seeds `seed` to `seed` + 3). Makes one start in
// physics, as `stampede plan` does. `all`: of sentences_of. Throws Error where no start or no plan is found.
Meaning meaning_of(const std::shared_ptr<const Library>& library, const std::string& task, const std::string& variation,
                   std::int64_t seed, const std::vector<OwnSentences>& all);

// Of a part of the variation's goal, from the same start: its own sentence is what the author says of it.
Meaning meaning_of_subgoal(const std::shared_ptr<const Library>& library, const std::string& task,
                           const std::string& variation, const std::string& name, std::int64_t seed,
                           const std::vector<OwnSentences>& all);

// Of a label with slots, such as a skill's `pick up the {obj}`; `skill`: whose it is, or empty.
Meaning meaning_of_label(const std::string& name, const std::string& label, const std::string& skill);

// Labels with slots that sentences of a level can be asked for, by name: of skills, of predicates (level world), of
// kinds of motions.
std::map<std::string, std::string> labels_of(const Library& library, LanguageLevel level);

// Of any: `of` is a variation at level task, a subgoal_key at level subgoal, else a name of labels_of. Nothing where
// there is none of that name.
std::optional<Meaning> meaning_for(const std::shared_ptr<const Library>& library, const std::string& task,
                                   LanguageLevel level, const std::string& of, std::int64_t seed,
                                   const std::vector<OwnSentences>& all);

}  // namespace stampede
