// What a sentence has to mean: the things of the scene, what is to be done with them, and how its author says it.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/language/lexicon.h"
#include "engine/model/scene.h"
#include "engine/start/declared.h"
#include "engine/start/task.h"

namespace stampede {

// What a thing is in the goal and the plan.
struct ThingRoles {
  bool wanted = false;                       // they handle it, or a part of it
  bool handled = false;                      // a step is about it: pressed, opened, carried …
  bool moved = false;                        // it is carried somewhere
  bool tool = false;                         // with which something else is handled
  bool source = false, destination = false;  // of what is moved
  ThingRoles& operator|=(const ThingRoles& other);
};
using ThingRole = bool ThingRoles::*;

// A thing as it can be spoken of: senses of words, in the sense of Lexicon.
struct SpokenThing {
  std::string name;               // `chest.top_drawer`
  std::string phrase;             // `top drawer of the chest`, without what other starts have otherwise
  std::set<std::string> heads;    // nouns that name it: `drawer`
  std::set<std::string> words;    // all words of its names, its whole's too: top drawer chest
  std::set<std::string> colours;  // that it has in every start of the variation
  bool region = false;            // a place without a body: a mark, the inside of a box
  ThingRoles roles;
};

// The sentences of one of the task's variations, or of one of its subgoals.
struct OwnSentences {
  std::string variation;
  std::vector<std::string> sentences;
  std::vector<Subgoal> subgoals = {};  // of the variation, those that have a sentence
};

// A step of the plan, by its skill.
struct ToldStep {
  std::string skill;
  std::vector<std::string> arguments;
};

// What a skill does with its arguments, as sentences tell it: read once from its effects, its label and `moves`.
struct SkillSense {
  bool takes = false;               // what it is about is in the hand then
  bool raises = false;              // it ends in the air
  std::size_t handled = 0;          // the parameter that it is about
  std::optional<std::size_t> tool;  // that it handles it with: held before and after, or put down to serve
  std::set<std::size_t> moved, places;
  std::string verb;                                   // the sense of its first
  std::map<std::size_t, std::set<std::string>> ways;  // how sentences say that it is at a parameter's place: in, on
  std::set<std::string> directions;                   // in which something moves: up, out, open …
};
// Of the skill's first action. `held`: predicates of what the pads grasp.
SkillSense skill_sense(const SkillInfo& skill, const Domain& domain, const std::set<std::string>& held,
                       std::shared_ptr<const English> english);

struct Meaning {
  std::string task, variation;          // of a skill's or predicate's label: its name, and nothing
  std::vector<std::string> own;         // the author's sentences
  std::vector<OwnSentences> elsewhere;  // of the other variations; of a subgoal: of the other ones
  std::vector<SpokenThing> things;
  std::vector<ToldStep> steps;               // what does it; empty where nothing has to be done
  std::map<std::string, SkillSense> skills;  // of the steps
  bool ordered = false;                      // the goal's parts must come true in their order
  bool slots = false;                        // the sentences speak of {slots} in place of things
  std::string goal;                          // as PDDL, for prompts
  std::vector<std::string> facts;            // of the start, as sentences, for prompts
  Lexicon lexicon;                           // with the words of all these

  const SpokenThing* thing(const std::string& name) const;  // null: there is none
  bool carries() const;                                     // something is moved
  const SkillSense& sense_of(const ToldStep& step) const { return skills.at(step.skill); }
};

bool share_a_noun(const SpokenThing& a, const SpokenThing& b);
// `whole` is the thing or what it is a part of.
bool is_part_of(const std::string& name, const std::string& whole);

// The things of a start; their words go into the meaning's lexicon. What `others`, further starts of the variation,
// have otherwise is said of none.
void read_things(const Domain& domain, const Scene& scene, const std::vector<Scene>& others, Meaning& meaning);

// What other starts call otherwise is called alike, in `facts` too.
void name_alike(const std::vector<Scene>& others, Meaning& meaning);

// What is to be done, from a state with these facts; what a plan does because of `assumed`, which nobody can see, is
// not said.
struct Deed {
  const Facts& facts;
  const Facts& assumed;
  const Formula& goal;
};
// Of the goal and of meaning.steps, whose skills must be there.
void read_roles(const Deed& deed, Meaning& meaning);

}  // namespace stampede
