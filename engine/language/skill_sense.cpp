#include <algorithm>

#include "engine/language/meaning.h"

namespace stampede {
namespace {

// Parameters of which an atom of these predicates stands in the formula, not denied.
void named_in(const Formula& formula, const std::set<std::string>& predicates, std::set<std::string>& names) {
  if (formula.kind == Formula::Kind::negation) return;
  if (formula.kind == Formula::Kind::atom && predicates.contains(formula.predicate))
    for (const Term& term : formula.terms) names.insert(term.name);
  for (const Formula& part : formula.parts) named_in(part, predicates, names);
}

// Of `put the {obj} on the {shelf}`: on, of shelf.
std::map<std::string, std::string> ways_in(const std::string& label, const Lexicon& lexicon) {
  std::map<std::string, std::string> ways;
  std::string way;
  for (const Word& word : lexicon.read(label)) {
    if (word.is("inside")) way = "in";
    if (word.is("upon")) way = "on";
    if (word.text.starts_with('{')) ways[word.text.substr(1, word.text.size() - 2)] = std::exchange(way, "");
  }
  std::erase_if(ways, [](const auto& one) { return one.second.empty(); });
  return ways;
}

class SenseReader {
 public:
  SenseReader(const SkillInfo& skill, const Domain& domain, const std::set<std::string>& held,
              std::shared_ptr<const English> english)
      : skill_(skill), domain_(domain), held_(held), lexicon_(std::move(english)) {}

  SkillSense read() {
    read_effects();
    find_parameters();
    sense_.takes = taken_.contains(name(sense_.handled));
    puts_ = put_.contains(name(sense_.handled));
    sense_.raises = !puts_ && (sense_.takes || before_.contains(name(sense_.handled)));
    find_places();
    find_ways();
    read_verbs();
    find_directions();
    return std::move(sense_);
  }

 private:
  const std::string& name(std::size_t parameter) const { return skill_.parameters[parameter].name; }
  bool is_moved(const std::string& parameter) const {
    return std::ranges::find(skill_.moves, parameter) != skill_.moves.end();
  }

  void read_effects() {
    const Action& action = *domain_.action(skill_.actions.front());
    named_in(action.precondition, held_, before_);
    for (const Effect& effect : action.effects) {
      if (!effect.forall.empty()) continue;
      if (held_.contains(effect.predicate)) {
        for (const Term& term : effect.terms) (effect.negated ? put_ : taken_).insert(term.name);
      } else if (!effect.negated) {
        made_.push_back(&effect);
      }
    }
  }

  void find_parameters() {
    bool found = false;
    for (std::size_t i = 0; i < skill_.parameters.size(); ++i) {
      if (skill_.parameters[i].type == "hand") continue;
      if (is_moved(name(i))) sense_.moved.insert(i);
      if (before_.contains(name(i)) && !put_.contains(name(i)) && !is_moved(name(i))) sense_.tool = i;
      const bool about = skill_.moves.empty() ? sense_.tool != i : is_moved(name(i));
      if (about && !std::exchange(found, true)) sense_.handled = i;
    }
  }

  // What is put down is put where the first thing that becomes true of it says; with more to it, it serves that.
  void find_places() {
    std::set<std::string> first;
    for (const Effect* effect : made_) {
      for (const Term& term : effect->terms) first.insert(term.name);
      if (first.contains(name(sense_.handled)) && first.size() > 1) break;
      first.clear();
    }
    int others = 0;
    for (std::size_t i = 0; i < skill_.parameters.size(); ++i) {
      if (i == sense_.handled || skill_.parameters[i].type == "hand") continue;
      ++others;
      if (sense_.takes || (puts_ && !first.contains(name(i)))) continue;
      sense_.places.insert(i);
      if (puts_) sense_.ways[i];  // none, where neither its label nor its effect says one: beside
    }
    if (puts_ && others > 1) sense_.tool = sense_.handled;
  }

  // As its label says, and those of what becomes true.
  void find_ways() {
    for (const auto& [parameter, way] : ways_in(skill_.label, lexicon_)) add_way(parameter, way);
    for (const Effect* effect : made_) {
      const Predicate* predicate = domain_.predicate(effect->predicate);
      if (predicate == nullptr) continue;
      const std::map<std::string, std::string> ways = ways_in(predicate->label, lexicon_);
      for (std::size_t i = 0; i < predicate->parameters.size(); ++i)
        if (const auto found = ways.find(predicate->parameters[i].name); found != ways.end())
          add_way(effect->terms[i].name, found->second);
    }
    for (const Word& word : lexicon_.read(skill_.label)) leaves_ |= word.is("away");
  }

  void add_way(const std::string& parameter, const std::string& way) {
    for (std::size_t i = 0; i < skill_.parameters.size(); ++i)
      if (name(i) == parameter) sense_.ways[i].insert(way);
  }

  void read_verbs() {
    for (const std::string& verb : skill_.verbs) {
      const std::vector<Word> words = lexicon_.read(verb);
      if (words.empty()) continue;
      if (sense_.verb.empty()) sense_.verb = words.front().sense;
      if (words.front().is("openness")) sense_.directions.insert(words.front().sense);
    }
  }

  void find_directions() {
    const bool in = std::ranges::any_of(sense_.ways, [](const auto& one) { return one.second.contains("in"); });
    if (sense_.raises) sense_.directions.insert("up");
    if (sense_.takes) sense_.directions.insert("out");
    if (sense_.takes && leaves_) sense_.directions.insert("remove");
    if (puts_ && in) sense_.directions.insert({"in", "insert"});
    if (puts_ && !in) sense_.directions.insert("down");
  }

  const SkillInfo& skill_;
  const Domain& domain_;
  const std::set<std::string>& held_;
  const Lexicon lexicon_;
  SkillSense sense_;
  bool puts_ = false;                           // what it is about is no longer in the hand then
  bool leaves_ = false;                         // it is taken out of something, or off it
  std::set<std::string> before_, taken_, put_;  // parameters that are held before, after, no longer
  std::vector<const Effect*> made_;             // what becomes true
};

}  // namespace

SkillSense skill_sense(const SkillInfo& skill, const Domain& domain, const std::set<std::string>& held,
                       std::shared_ptr<const English> english) {
  return SenseReader(skill, domain, held, std::move(english)).read();
}

}  // namespace stampede
