#include "scripting/sentences/meaning_of.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/start/language.h"
#include "engine/symbolic/pddl.h"
#include "scripting/session/episode_job.h"
#include "scripting/session/start_question.h"

namespace stampede {
namespace {

constexpr std::int64_t kStarts = 4;  // what differs among so many is not said of a variation

// What a skill does with its arguments, by the library.
SkillSense sense_of(const Library& library, const std::string& skill) {
  std::set<std::string> held;
  for (const auto& [name, traits] : library.predicate_traits())
    if (traits.requires_pairs == Pairs::held) held.insert(name);
  return skill_sense(*library.skill(skill), library.domain(), held, library.english());
}

void learn_sentences(Meaning& meaning) {
  for (const std::string& sentence : meaning.own) meaning.lexicon.learn_own(sentence);
  // Words of other variations are known, so that what they say is turned down for what it says.
  for (const OwnSentences& other : meaning.elsewhere)
    for (const std::string& sentence : other.sentences) meaning.lexicon.learn_own(sentence);
}

Scene drawn_scene(const std::shared_ptr<const Library>& library, const std::string& task, const std::string& variation,
                  std::int64_t seed) {
  return EpisodeScripts(library, task, variation, seed).task()(0).scene;
}

// A variation of a task, from one start on.
struct Asked {
  std::shared_ptr<const Library> library;
  std::string task, variation;
  std::int64_t seed = 0;
  std::string place() const { return task + (variation.empty() ? "" : " " + variation); }
};

// What is to be done at that start; `goal`: instead of the task's.
Meaning meaning_at_start(const Asked& asked, const std::optional<Formula>& goal) {
  Meaning meaning;
  meaning.task = asked.task;
  meaning.variation = asked.variation;
  meaning.lexicon = Lexicon(asked.library->english());
  RunOptions options;
  options.seed = asked.seed;
  options.goal = goal;
  PreparedEpisode prepared(asked.library, {asked.task, asked.variation, asked.seed}, options);
  const StartQuestion question = question_at_start(prepared.scripts(), prepared.options(), nullptr);
  if (question.start.reason != Reason::none)
    throw Error(asked.place(),
                "no start: " + std::string(to_string(question.start.reason)) + " " + question.start.detail,
                "try another --seed");
  const PlanOutcome found = question.said ? *question.said : solve(question.asked.domain, question.asked.problem);
  if (!found.solved) throw Error(asked.place(), "no plan: " + found.explanation, "try another --seed");
  const Domain& domain = prepared.scripts().symbols().domain();
  std::vector<Scene> others;
  for (std::int64_t i = 1; i < kStarts; ++i)
    others.push_back(drawn_scene(asked.library, asked.task, asked.variation, asked.seed + i));
  read_things(domain, *question.start.scene, others, meaning);
  for (const PlanStep& step : found.plan) {
    const Action* action = question.asked.domain.action(step.action);
    const std::string& skill = action == nullptr ? step.action : action->skill;
    meaning.steps.push_back({skill, step.arguments});
    if (!meaning.skills.contains(skill)) meaning.skills[skill] = sense_of(*asked.library, skill);
  }
  read_roles({question.state.facts, question.assumed, question.plain.goal}, meaning);
  meaning.goal = to_pddl(question.plain.goal);
  meaning.ordered = question.beside_goal.find("in the order") != std::string::npos;
  Facts seen = mentionable(question.state.facts, question.state.observed, domain, *question.start.scene);
  std::erase_if(seen, [&](const Fact& fact) {
    return std::any_of(fact.arguments.begin(), fact.arguments.end(), [&](const std::string& name) {
      const Object* object = question.start.scene->object(name);
      return object != nullptr && object->kind == ObjectKind::region;
    });
  });
  meaning.facts = describe_world(seen, domain, *question.start.scene);
  name_alike(others, meaning);
  return meaning;
}

// Of a part of the variation's goal, from the same start: its own sentence is what the author says of it.
Meaning meaning_of_subgoal(const Asked& asked, const std::string& name, const std::vector<OwnSentences>& all) {
  std::optional<Formula> goal;
  std::vector<std::string> own;
  std::vector<OwnSentences> elsewhere;
  for (const OwnSentences& one : all)
    for (const Subgoal& subgoal : one.subgoals) {
      if (one.variation == asked.variation && subgoal.name == name)
        goal = subgoal.formula, own = {subgoal.sentence};
      else
        elsewhere.push_back({subgoal_key(subgoal.name, one.variation), {subgoal.sentence}});
    }
  if (!goal) throw Error(asked.task, "there is no subgoal '" + name + "' with a sentence");
  Meaning meaning = meaning_at_start(asked, goal);
  meaning.own = std::move(own);
  std::erase_if(elsewhere, [&](const OwnSentences& one) { return one.sentences == meaning.own; });
  meaning.elsewhere = std::move(elsewhere);
  learn_sentences(meaning);
  return meaning;
}

}  // namespace

std::vector<OwnSentences> sentences_of(const std::shared_ptr<const Library>& library, const std::string& task) {
  std::vector<OwnSentences> all;
  for (const std::string& variation : task_info(*library, task).variation_texts) {
    Task drawn = EpisodeScripts(library, task, variation, 0).task()(0);
    std::erase_if(drawn.subgoals, [](const Subgoal& one) { return one.sentence.empty(); });
    all.push_back({variation, std::move(drawn.instructions), std::move(drawn.subgoals)});
  }
  return all;
}

Meaning meaning_of(const std::shared_ptr<const Library>& library, const std::string& task, const std::string& variation,
                   std::int64_t seed, const std::vector<OwnSentences>& all) {
  Meaning meaning = meaning_at_start({library, task, variation, seed}, {});
  for (const OwnSentences& one : all) {
    if (one.variation == variation)
      meaning.own = one.sentences;
    else
      meaning.elsewhere.push_back(one);
  }
  learn_sentences(meaning);
  return meaning;
}

Meaning meaning_of_label(const Library& library, const std::string& name, const std::string& label,
                         const std::string& skill) {
  Meaning meaning;
  meaning.task = name;
  meaning.slots = true;
  meaning.own = {label};
  meaning.lexicon = Lexicon(library.english());
  if (!skill.empty()) meaning.skills[skill] = sense_of(library, skill);
  for (std::size_t at = label.find('{'); at != std::string::npos; at = label.find('{', at + 1)) {
    const std::string slot = label.substr(at, label.find('}', at) - at + 1);
    SpokenThing thing;
    thing.name = thing.phrase = slot;
    thing.heads = thing.words = {slot};
    thing.roles.wanted = thing.roles.handled = thing.roles.source = thing.roles.destination = true;
    meaning.things.push_back(std::move(thing));
  }
  learn_sentences(meaning);
  return meaning;
}

std::map<std::string, std::string> labels_of(const Library& library, LanguageLevel level) {
  std::map<std::string, std::string> labels;
  if (level == LanguageLevel::motion)
    return {{"close_hand", "close the hand"},
            {"lift", "raise the hand"},
            {"move_line", "move the hand in a straight line"},
            {"move_through", "move the hand around what is in the way"},
            {"open_hand", "open the hand"},
            {"retreat", "draw the hand back"}};
  if (level == LanguageLevel::skill)
    for (const ScriptFile* file : library.files(DefinitionKind::skill))
      if (const SkillInfo* skill = library.skill(file->name)) labels[file->name] = skill->label;
  if (level == LanguageLevel::world)
    for (const Predicate& predicate : library.domain().predicates)
      if (predicate.kind == PredicateKind::basic || predicate.kind == PredicateKind::derived)
        labels[predicate.name] = predicate.label;
  std::erase_if(labels, [](const auto& one) { return one.second.empty(); });
  return labels;
}

std::optional<Meaning> meaning_for(const std::shared_ptr<const Library>& library, const MeaningKey& key,
                                   std::int64_t seed, const std::vector<OwnSentences>& all) {
  if (key.level == LanguageLevel::task) {
    const bool there =
        std::any_of(all.begin(), all.end(), [&](const OwnSentences& one) { return one.variation == key.of; });
    if (!there) return std::nullopt;
    return meaning_of(library, key.task, key.of, seed, all);
  }
  if (key.level == LanguageLevel::subgoal) {
    for (const OwnSentences& one : all)
      for (const Subgoal& subgoal : one.subgoals)
        if (subgoal_key(subgoal.name, one.variation) == key.of)
          return meaning_of_subgoal({library, key.task, one.variation, seed}, subgoal.name, all);
    return std::nullopt;
  }
  const std::map<std::string, std::string> labels = labels_of(*library, key.level);
  const auto label = labels.find(key.of);
  if (label == labels.end()) return std::nullopt;
  return meaning_of_label(*library, key.of, label->second, key.level == LanguageLevel::skill ? key.of : "");
}

}  // namespace stampede
