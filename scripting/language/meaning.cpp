#include "scripting/language/meaning.h"

#include <algorithm>
#include <sstream>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/start/language.h"
#include "engine/symbolic/pddl.h"
#include "scripting/session/episode_job.h"
#include "scripting/session/start_question.h"

namespace stampede {

const std::set<std::string> kTakes = {"pick", "take_out", "extract", "unhang", "take_from_shelf"};
const std::set<std::string> kPuts = {"place", "put_in", "put_on_shelf", "set_down", "lay",
                                     "drop",  "stack",  "insert",       "hang"};

namespace {

constexpr std::int64_t kStarts = 4;  // what differs among so many is not said of a variation

const std::set<std::string> kWithTool = {"press_with", "drag", "point"};  // their first argument
const std::set<std::string> kMoves = {"lift", "drag", "push", "unscrew"};

std::vector<std::string> name_words(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '_' || c == '.' || (c >= '0' && c <= '9'); }, ' ');
  std::istringstream in(name);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    if (word.size() > 1) words.push_back(word);
  return words;
}

bool is_general(const std::string& type) {
  static const std::set<std::string> kGeneral = {"thing", "fixture", "region", "furniture", "level", "object", ""};
  return kGeneral.contains(type);
}

class ThingReader {
 public:
  ThingReader(const Domain& domain, Lexicon& lexicon) : domain_(domain), lexicon_(lexicon) {}

  SpokenThing read(const Scene& scene, const Object& object) {
    SpokenThing thing;
    thing.name = object.name;
    thing.region = object.kind == ObjectKind::region;
    thing.phrase = phrase(scene, object.name);
    const std::size_t dot = object.name.rfind('.');
    add(object.name.substr(dot == std::string::npos ? 0 : dot + 1), thing, true);
    if (dot == std::string::npos) add(object.class_name, thing, true);
    for (std::string type = object.type; !is_general(type); type = parent(type)) add(type, thing, true);
    if (const auto colour = object.attributes.find("colour"); colour != object.attributes.end()) {
      lexicon_.learn_colour(colour->second);
      thing.colours.insert(colour->second);
    }
    if (dot == std::string::npos) return thing;
    const Object* whole = scene.object(object.name.substr(0, dot));
    if (whole == nullptr) return thing;
    const SpokenThing owner = read(scene, *whole);
    thing.words.insert(owner.words.begin(), owner.words.end());
    thing.colours.insert(owner.colours.begin(), owner.colours.end());
    return thing;
  }

 private:
  std::string parent(const std::string& type) const {
    const auto found = domain_.types.find(type);
    return found == domain_.types.end() ? "" : found->second;
  }

  // The last word names the thing, those before it tell it from others.
  void add(const std::string& name, SpokenThing& thing, bool names) {
    lexicon_.learn_noun(name);
    const std::vector<std::string> words = name_words(name);
    for (const std::string& word : words) thing.words.insert(lexicon_.sense_of_noun(word));
    if (names && !words.empty()) thing.heads.insert(lexicon_.sense_of_noun(words.back()));
  }

  const Domain& domain_;
  Lexicon& lexicon_;
};

void read_things(const Domain& domain, const Scene& scene, Meaning& meaning) {
  ThingReader reader(domain, meaning.lexicon);
  for (const Object& object : scene.objects)
    if (object.kind != ObjectKind::hand) meaning.things.push_back(reader.read(scene, object));
}

// What a thing is called in every start: `cube`, where each start has another colour; `top drawer of the chest`.
std::string common_phrase(const Scene& scene, const SpokenThing& thing, const std::vector<SpokenThing>& things) {
  const Object* object = scene.object(thing.name);
  const std::size_t dot = thing.name.rfind('.');
  if (object == nullptr) return thing.phrase;
  if (dot != std::string::npos) {
    for (const SpokenThing& whole : things)
      if (whole.name == thing.name.substr(0, dot))
        return spaced_name(thing.name.substr(dot + 1)) + " of the " + common_phrase(scene, whole, things);
    return thing.phrase;
  }
  const int body = scene.body_index(object->body);
  const bool stays = body >= 0 && !scene.bodies[static_cast<std::size_t>(body)].free;
  if (object->kind == ObjectKind::region || (stays && phrase(scene, thing.name) == thing.phrase)) return thing.phrase;
  const std::string name = spaced_name(object->class_name.empty() ? object->name : object->class_name);
  return thing.colours.empty() ? name : spaced_name(*thing.colours.begin()) + " " + name;
}

// As in every start, in what is told of this one too.
void name_alike(const std::vector<Scene>& others, Meaning& meaning) {
  std::map<std::string, std::string> phrases;
  for (const SpokenThing& thing : meaning.things)
    for (const Scene& scene : others)
      if (const std::string common = common_phrase(scene, thing, meaning.things); common != thing.phrase)
        phrases[thing.phrase] = common;
  for (SpokenThing& thing : meaning.things)
    if (const auto found = phrases.find(thing.phrase); found != phrases.end()) thing.phrase = found->second;
  std::vector<std::pair<std::string, std::string>> longest(phrases.begin(), phrases.end());
  std::stable_sort(longest.begin(), longest.end(),
                   [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  std::vector<std::string> facts;
  for (std::string fact : meaning.facts) {
    for (const auto& [from, to] : longest)
      for (std::size_t at = fact.find(from); at != std::string::npos; at = fact.find(from, at + to.size()))
        fact.replace(at, from.size(), to);
    if (std::find(facts.begin(), facts.end(), fact) == facts.end()) facts.push_back(std::move(fact));
  }
  meaning.facts = std::move(facts);
}

// What another start of the variation has otherwise is said of none.
void keep_common(const Scene& scene, Meaning& meaning) {
  std::erase_if(meaning.things, [&](const SpokenThing& thing) { return scene.object(thing.name) == nullptr; });
  for (SpokenThing& thing : meaning.things) {
    std::set<std::string> colours;
    for (std::string name = thing.name; !name.empty();) {
      const Object* object = scene.object(name);
      if (object != nullptr && object->attributes.contains("colour")) colours.insert(object->attributes.at("colour"));
      const std::size_t dot = name.rfind('.');
      name = dot == std::string::npos ? "" : name.substr(0, dot);
    }
    std::erase_if(thing.colours, [&](const std::string& colour) { return !colours.contains(colour); });
  }
}

void atoms_of(const Formula& formula, std::vector<Fact>& atoms) {
  if (formula.kind == Formula::Kind::negation || formula.kind == Formula::Kind::exists ||
      formula.kind == Formula::Kind::forall)
    return;
  if (formula.kind == Formula::Kind::atom) {
    Fact fact{formula.predicate, {}};
    for (const Term& term : formula.terms) fact.arguments.push_back(term.name);
    atoms.push_back(fact);
  }
  for (const Formula& part : formula.parts) atoms_of(part, atoms);
}

class RoleMarker {
 public:
  explicit RoleMarker(Meaning& meaning) : meaning_(meaning) {}

  void mark(const std::string& name, bool SpokenThing::*role) {
    for (SpokenThing& thing : meaning_.things) {
      const bool is_whole = name.starts_with(thing.name + ".");
      const bool is_part =
          thing.name.starts_with(name + ".") && role != &SpokenThing::moved && role != &SpokenThing::handled;
      if (thing.name == name || is_whole || is_part) thing.*role = true;
    }
  }

 private:
  Meaning& meaning_;
};

std::string skill_of(const Domain& domain, const std::string& action) {
  const Action* found = domain.action(action);
  return found == nullptr ? action : found->skill;
}

// Of the remote that is picked up, one button is pressed: the others have no part in it.
void leave_out_siblings(const std::set<std::string>& direct, Meaning& meaning) {
  const auto whole_of = [](const std::string& name) { return name.substr(0, name.rfind('.')); };
  for (SpokenThing& thing : meaning.things) {
    if (direct.contains(thing.name) || thing.name.find('.') == std::string::npos) continue;
    const bool beside = std::any_of(meaning.things.begin(), meaning.things.end(), [&](const SpokenThing& other) {
      return direct.contains(other.name) && whole_of(other.name) == whole_of(thing.name) &&
             std::any_of(thing.heads.begin(), thing.heads.end(),
                         [&](const std::string& head) { return other.heads.contains(head); });
    });
    if (beside) thing.wanted = thing.handled = thing.source = thing.destination = false;
  }
}

// `assumed`: of what nobody can see; what a plan does because of it is not said.
void read_roles(const Domain& domain, const Facts& facts, const Facts& assumed, const Formula& goal, Meaning& meaning) {
  RoleMarker roles(meaning);
  std::set<std::string> direct;  // named by the goal or the plan, not as parts
  std::vector<Fact> atoms;
  atoms_of(goal, atoms);
  for (const Fact& atom : atoms)
    if (!facts.contains(atom))
      for (std::size_t i = 0; i < atom.arguments.size(); ++i) {
        roles.mark(atom.arguments[i], &SpokenThing::wanted);
        roles.mark(atom.arguments[i], i == 0 ? &SpokenThing::handled : &SpokenThing::destination);
        direct.insert(atom.arguments[i]);
      }
  std::set<std::string> guessed, carried, sources, destinations;
  for (const PlanStep& step : meaning.steps) direct.insert(step.arguments.begin(), step.arguments.end());
  for (const Fact& fact : assumed)
    for (std::size_t i = 1; i < fact.arguments.size(); ++i) {
      guessed.insert(fact.arguments[i]);
      const std::string whole = fact.arguments[i].substr(0, fact.arguments[i].find('.'));
      for (const auto role : {&SpokenThing::wanted, &SpokenThing::source})
        for (SpokenThing& thing : meaning.things)
          if (thing.name == whole) thing.*role = true;
    }
  for (PlanStep& step : meaning.steps) {
    step.action = skill_of(domain, step.action);
    meaning.skills.insert(step.action);
    for (const std::string& name : step.arguments)
      if (!guessed.contains(name)) roles.mark(name, &SpokenThing::wanted);
    if (step.arguments.empty()) continue;
    roles.mark(step.arguments.front(), &SpokenThing::handled);
    if (kWithTool.contains(step.action)) roles.mark(step.arguments.front(), &SpokenThing::tool);
    if (step.action == "drag" && step.arguments.size() > 1)
      roles.mark(step.arguments[1], &SpokenThing::moved), carried.insert(step.arguments[1]);
    const bool takes = kTakes.contains(step.action);
    if (takes || kPuts.contains(step.action) || kMoves.contains(step.action))
      roles.mark(step.arguments.front(), &SpokenThing::moved), carried.insert(step.arguments.front());
    for (std::size_t i = 1; i < step.arguments.size(); ++i)
      if (!guessed.contains(step.arguments[i])) {
        roles.mark(step.arguments[i], takes ? &SpokenThing::source : &SpokenThing::destination);
        (takes ? sources : destinations).insert(step.arguments[i]);
      }
  }
  leave_out_siblings(direct, meaning);
  // A door's handle: a part beside what is handled, of another kind.
  for (SpokenThing& thing : meaning.things) {
    const std::size_t dot = thing.name.rfind('.');
    if (dot == std::string::npos || thing.wanted || thing.region) continue;
    bool beside = false, alike = false;
    for (const SpokenThing& other : meaning.things) {
      if (!other.wanted || other.name.rfind('.') == std::string::npos) continue;
      beside |= other.name.substr(0, other.name.rfind('.')) == thing.name.substr(0, dot);
      alike |= std::any_of(thing.heads.begin(), thing.heads.end(),
                           [&](const auto& head) { return other.heads.contains(head); });
    }
    thing.accessory = beside && !alike && (thing.heads.contains("handle") || thing.heads.contains("hook"));
  }
  for (SpokenThing& thing : meaning.things) thing.wanted |= thing.accessory;
  // A lid is a part of the jar that it is taken off, and not where it is taken from.
  for (SpokenThing& thing : meaning.things) {
    if (!carried.contains(thing.name)) continue;
    thing.source = thing.source && sources.contains(thing.name);
    thing.destination = thing.destination && destinations.contains(thing.name);
  }
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

// What is to be done at a start of the variation; `goal`: instead of the task's.
Meaning meaning_at_start(const std::shared_ptr<const Library>& library, const std::string& task,
                         const std::string& variation, std::int64_t seed, const std::optional<Formula>& goal) {
  Meaning meaning;
  meaning.task = task;
  meaning.variation = variation;
  RunOptions options;
  options.seed = seed;
  options.goal = goal;
  PreparedEpisode prepared(library, {task, variation, seed}, options);
  const StartQuestion question = question_at_start(prepared.scripts(), prepared.options(), nullptr);
  const std::string place = task + (variation.empty() ? "" : " " + variation);
  if (question.start.reason != Reason::none)
    throw Error(place, "no start: " + std::string(to_string(question.start.reason)) + " " + question.start.detail,
                "try another --seed");
  const PlanOutcome found = question.said ? *question.said : solve(question.asked.domain, question.asked.problem);
  if (!found.solved) throw Error(place, "no plan: " + found.explanation, "try another --seed");
  const Domain& domain = prepared.scripts().symbols().domain();
  read_things(domain, *question.start.scene, meaning);
  std::vector<Scene> others;
  for (std::int64_t i = 1; i < kStarts; ++i) others.push_back(drawn_scene(library, task, variation, seed + i));
  for (const Scene& scene : others) keep_common(scene, meaning);
  meaning.steps = found.plan;
  read_roles(question.asked.domain, question.state.facts, question.assumed, question.plain.goal, meaning);
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
  Meaning meaning = meaning_at_start(library, task, variation, seed, {});
  for (const OwnSentences& one : all) {
    if (one.variation == variation)
      meaning.own = one.sentences;
    else
      meaning.elsewhere.push_back(one);
  }
  learn_sentences(meaning);
  return meaning;
}

Meaning meaning_of_subgoal(const std::shared_ptr<const Library>& library, const std::string& task,
                           const std::string& variation, const std::string& name, std::int64_t seed,
                           const std::vector<OwnSentences>& all) {
  std::optional<Formula> goal;
  std::vector<std::string> own;
  std::vector<OwnSentences> elsewhere;
  for (const OwnSentences& one : all)
    for (const Subgoal& subgoal : one.subgoals) {
      if (one.variation == variation && subgoal.name == name)
        goal = subgoal.formula, own = {subgoal.sentence};
      else
        elsewhere.push_back({subgoal_key(subgoal.name, one.variation), {subgoal.sentence}});
    }
  if (!goal) throw Error(task, "there is no subgoal '" + name + "' with a sentence");
  Meaning meaning = meaning_at_start(library, task, variation, seed, goal);
  meaning.own = std::move(own);
  std::erase_if(elsewhere, [&](const OwnSentences& one) { return one.sentences == meaning.own; });
  meaning.elsewhere = std::move(elsewhere);
  learn_sentences(meaning);
  return meaning;
}

Meaning meaning_of_label(const std::string& name, const std::string& label, const std::string& skill) {
  Meaning meaning;
  meaning.task = name;
  meaning.slots = true;
  meaning.own = {label};
  if (!skill.empty()) meaning.skills.insert(skill);
  for (std::size_t at = label.find('{'); at != std::string::npos; at = label.find('{', at + 1)) {
    const std::string slot = label.substr(at, label.find('}', at) - at + 1);
    SpokenThing thing;
    thing.name = thing.phrase = slot;
    thing.heads = thing.words = {slot};
    thing.wanted = thing.handled = thing.source = thing.destination = true;
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

std::optional<Meaning> meaning_for(const std::shared_ptr<const Library>& library, const std::string& task,
                                   LanguageLevel level, const std::string& of, std::int64_t seed,
                                   const std::vector<OwnSentences>& all) {
  if (level == LanguageLevel::task) {
    const bool there =
        std::any_of(all.begin(), all.end(), [&](const OwnSentences& one) { return one.variation == of; });
    if (!there) return std::nullopt;
    return meaning_of(library, task, of, seed, all);
  }
  if (level == LanguageLevel::subgoal) {
    for (const OwnSentences& one : all)
      for (const Subgoal& subgoal : one.subgoals)
        if (subgoal_key(subgoal.name, one.variation) == of)
          return meaning_of_subgoal(library, task, one.variation, subgoal.name, seed, all);
    return std::nullopt;
  }
  const std::map<std::string, std::string> labels = labels_of(*library, level);
  const auto label = labels.find(of);
  if (label == labels.end()) return std::nullopt;
  return meaning_of_label(of, label->second, level == LanguageLevel::skill ? of : "");
}

}  // namespace stampede
