#include "engine/language/meaning.h"

#include <algorithm>

#include "engine/base/text.h"
#include "engine/start/language.h"

namespace stampede {
namespace {

// `chest` of `chest.top_drawer`; empty: it is no part.
std::string owner_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot);
}

class ThingReader {
 public:
  ThingReader(const Domain& domain, const Scene& scene, Lexicon& lexicon)
      : domain_(domain), scene_(scene), lexicon_(lexicon) {}

  SpokenThing read(const Object& object) {
    SpokenThing thing;
    thing.name = object.name;
    thing.region = object.kind == ObjectKind::region;
    thing.phrase = phrase(scene_, object.name);
    const std::string owner = owner_of(object.name);
    add(object.name.substr(owner.empty() ? 0 : owner.size() + 1), thing);
    if (owner.empty()) add(object.class_name, thing);
    for (std::string type = object.type; is_telling(type); type = domain_.types.at(type)) add(type, thing);
    if (const auto colour = object.attributes.find("colour"); colour != object.attributes.end()) {
      lexicon_.learn_colour(colour->second);
      thing.colours.insert(colour->second);
    }
    if (const Object* whole = owner.empty() ? nullptr : scene_.object(owner)) {
      const SpokenThing theirs = read(*whole);
      thing.words.insert(theirs.words.begin(), theirs.words.end());
      thing.colours.insert(theirs.colours.begin(), theirs.colours.end());
    }
    return thing;
  }

 private:
  // Not `thing`, `fixture`, `region`: those at the root of the tree, of which nobody speaks.
  bool is_telling(const std::string& type) const {
    return domain_.types.contains(type) && !lexicon_.english().has(type, "general_type");
  }

  // The last word names the thing, those before it tell it from others.
  void add(const std::string& name, SpokenThing& thing) {
    lexicon_.learn_noun(name);
    const std::vector<std::string> words = name_words(name);
    for (const std::string& word : words) thing.words.insert(lexicon_.sense_of_noun(word));
    if (!words.empty()) thing.heads.insert(lexicon_.sense_of_noun(words.back()));
  }

  const Domain& domain_;
  const Scene& scene_;
  Lexicon& lexicon_;
};

// What a thing is called in every start: `cube`, where each start has another colour; `top drawer of the chest`.
std::string common_phrase(const Scene& scene, const SpokenThing& thing, const Meaning& meaning) {
  const Object* object = scene.object(thing.name);
  if (object == nullptr) return thing.phrase;
  if (const std::string owner = owner_of(thing.name); !owner.empty()) {
    const SpokenThing* whole = meaning.thing(owner);
    if (whole == nullptr) return thing.phrase;
    return spaced_name(thing.name.substr(owner.size() + 1)) + " of the " + common_phrase(scene, *whole, meaning);
  }
  const int body = scene.body_index(object->body);
  const bool stays = body >= 0 && !scene.bodies[static_cast<std::size_t>(body)].free;
  if (object->kind == ObjectKind::region || (stays && phrase(scene, thing.name) == thing.phrase)) return thing.phrase;
  const std::string name = spaced_name(object->class_name.empty() ? object->name : object->class_name);
  return thing.colours.empty() ? name : spaced_name(*thing.colours.begin()) + " " + name;
}

// What another start of the variation has otherwise is said of none.
void keep_common(const Scene& scene, Meaning& meaning) {
  std::erase_if(meaning.things, [&](const SpokenThing& thing) { return scene.object(thing.name) == nullptr; });
  for (SpokenThing& thing : meaning.things) {
    std::set<std::string> colours;
    for (std::string name = thing.name; !name.empty(); name = owner_of(name)) {
      const Object* object = scene.object(name);
      if (object != nullptr && object->attributes.contains("colour")) colours.insert(object->attributes.at("colour"));
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

class RoleReader {
 public:
  RoleReader(const Deed& deed, Meaning& meaning) : deed_(deed), meaning_(meaning) {}

  void read() {
    read_goal();
    for (const Fact& fact : deed_.assumed)
      for (std::size_t i = 1; i < fact.arguments.size(); ++i) guessed_.insert(fact.arguments[i]);
    for (const ToldStep& step : meaning_.steps) read_step(step);
    for (SpokenThing& thing : meaning_.things)
      if (!is_sibling(thing)) spread(thing);
  }

 private:
  void read_goal() {
    std::vector<Fact> atoms;
    atoms_of(deed_.goal, atoms);
    for (const Fact& atom : atoms)
      for (std::size_t i = 0; i < atom.arguments.size() && !deed_.facts.contains(atom); ++i) {
        ThingRoles& roles = named_[atom.arguments[i]];
        roles.wanted = true;
        (i == 0 ? roles.handled : roles.destination) = true;
      }
  }

  void read_step(const ToldStep& step) {
    const SkillSense& sense = meaning_.sense_of(step);
    for (std::size_t i = 0; i < step.arguments.size(); ++i) {
      ThingRoles& roles = named_[step.arguments[i]];
      const bool about = i == sense.handled || i == sense.tool, guessed = guessed_.contains(step.arguments[i]);
      roles.wanted |= !guessed;
      roles.handled |= about;
      roles.tool |= i == sense.tool;
      roles.moved |= sense.moved.contains(i);
      (sense.takes ? roles.source : roles.destination) |= !about && !guessed;
    }
  }

  // Of the remote that is picked up, one button is pressed: the others have no part in it.
  bool is_sibling(const SpokenThing& thing) const {
    const std::string owner = owner_of(thing.name);
    return !owner.empty() && !named_.contains(thing.name) &&
           std::ranges::any_of(meaning_.things, [&](const SpokenThing& other) {
             return named_.contains(other.name) && owner_of(other.name) == owner && share_a_noun(thing, other);
           });
  }

  // A whole has the roles of its parts; a part those of its whole, but for being handled.
  void spread(SpokenThing& thing) const {
    for (auto [name, roles] : named_) {
      if (is_part_of(thing.name, name)) roles.moved = roles.handled = false;
      if (name == thing.name || is_part_of(name, thing.name) || is_part_of(thing.name, name)) thing.roles |= roles;
    }
    for (const std::string& guessed : guessed_)  // it is somewhere in there
      if (is_part_of(guessed, thing.name)) thing.roles.wanted = thing.roles.source = true;
    // A lid is a part of the jar that it is taken off, and not where it is taken from.
    const auto own = named_.find(thing.name);
    if (own == named_.end() || !own->second.moved) return;
    thing.roles.source = own->second.source;
    thing.roles.destination = own->second.destination;
  }

  const Deed& deed_;
  Meaning& meaning_;
  std::map<std::string, ThingRoles> named_;  // by the goal or the plan
  std::set<std::string> guessed_;
};

}  // namespace

void read_things(const Domain& domain, const Scene& scene, const std::vector<Scene>& others, Meaning& meaning) {
  ThingReader reader(domain, scene, meaning.lexicon);
  for (const Object& object : scene.objects)
    if (object.kind != ObjectKind::hand) meaning.things.push_back(reader.read(object));
  for (const Scene& other : others) keep_common(other, meaning);
}

void name_alike(const std::vector<Scene>& others, Meaning& meaning) {
  std::map<std::string, std::string> phrases;
  for (const SpokenThing& thing : meaning.things)
    for (const Scene& scene : others)
      if (const std::string common = common_phrase(scene, thing, meaning); common != thing.phrase)
        phrases[thing.phrase] = common;
  for (SpokenThing& thing : meaning.things)
    if (const auto found = phrases.find(thing.phrase); found != phrases.end()) thing.phrase = found->second;
  std::vector<std::pair<std::string, std::string>> longest(phrases.begin(), phrases.end());
  std::ranges::stable_sort(longest, [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  std::vector<std::string> facts;
  for (std::string fact : meaning.facts) {
    for (const auto& [from, to] : longest)
      for (std::size_t at = fact.find(from); at != std::string::npos; at = fact.find(from, at + to.size()))
        fact.replace(at, from.size(), to);
    if (std::ranges::find(facts, fact) == facts.end()) facts.push_back(std::move(fact));
  }
  meaning.facts = std::move(facts);
}

void read_roles(const Deed& deed, Meaning& meaning) { RoleReader(deed, meaning).read(); }

ThingRoles& ThingRoles::operator|=(const ThingRoles& other) {
  for (const ThingRole role : {&ThingRoles::wanted, &ThingRoles::handled, &ThingRoles::moved, &ThingRoles::tool,
                               &ThingRoles::source, &ThingRoles::destination})
    this->*role |= other.*role;
  return *this;
}

const SpokenThing* Meaning::thing(const std::string& name) const {
  const auto found = std::ranges::find_if(things, [&](const SpokenThing& one) { return one.name == name; });
  return found == things.end() ? nullptr : &*found;
}

bool Meaning::carries() const {
  return std::ranges::any_of(things, [](const SpokenThing& one) { return one.roles.moved; });
}

bool share_a_noun(const SpokenThing& a, const SpokenThing& b) {
  return std::ranges::any_of(a.heads, [&](const std::string& head) { return b.heads.contains(head); });
}

bool is_part_of(const std::string& name, const std::string& whole) {
  return name.size() > whole.size() && name[whole.size()] == '.' && name.starts_with(whole);
}

}  // namespace stampede
