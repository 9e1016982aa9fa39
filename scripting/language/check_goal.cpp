// Whether what is said to be done brings about the goal, and leaves it so.
#include "scripting/language/one_sentence.h"

namespace stampede {
namespace {

// Verbs of relative clauses tell where something is: `the picture that hangs on the hook`.
bool is_told(const Reading& reading, std::size_t verb) {
  static const std::set<std::string> kRelative = {"that", "which", "who", "is", "are", "was", "were"};
  return verb > 0 && kRelative.contains(reading.words[verb - 1].text);
}

}  // namespace

// The verbs of what is to be done, those of any stretch that `skip` is true of left out.
std::set<std::string> verbs_in(const Reading& reading, const std::function<bool(const Segment&)>& skip) {
  std::set<std::string> verbs;
  for (const Segment& segment : reading.segments) {
    if (segment.negated || (skip && skip(segment))) continue;
    for (std::size_t i = segment.begin; i < segment.end; ++i)
      if (reading.words[i].kind == WordKind::verb && (segment.verb == i || !is_told(reading, i)))
        verbs.insert(reading.words[i].sense);
  }
  return verbs;
}

// `take the hanger off its rail`, and no more: some verb must tell of the last step, or all be there that one of the
// author's sentences does. A sentence that says how things should be has no such verb.
Maybe OneSentence::ends() const {
  static const std::set<std::string> kIs = {"is", "are", "be", "belong", "should", "want"};
  if (meaning_.slots || meaning_.steps.empty()) return {};
  for (const Word& word : reading_.words)
    if (kIs.contains(word.text) || word.sense == "belong" || word.kind == WordKind::own) return {};
  std::set<std::string> ours =
      verbs_in(reading_, [this](const Segment& segment) { return spares(segment) || segment.excluding; });
  if (ours.empty()) return {};
  const std::set<std::string> directions = directions_in(reading_);
  const std::string& last = meaning_.steps.back().action;
  const bool away = directions.contains("out") || directions.contains("up") || directions.contains("down");
  for (const std::string& verb : ours)
    if (meaning_.lexicon.skills_of(verb).contains(last) &&
        (verb != "take" || away || !kTakes.contains(last) || last == "pick"))
      return {};
  const std::set<std::string> reached = skills_told(ours);
  for (std::size_t i = 0; i < claims_.done.size(); ++i) {
    const std::set<std::string>&own = claims_.done[i], theirs = skills_told(own);
    if (own.empty() || !(names_as(i) || names_all())) continue;
    if (std::includes(ours.begin(), ours.end(), own.begin(), own.end())) return {};
    if (!theirs.empty() && std::includes(reached.begin(), reached.end(), theirs.begin(), theirs.end())) return {};
  }
  return no(Rejection::misses_steps, "it ends before the goal is reached");
}

// Of the plan's.
std::set<std::string> OneSentence::skills_told(const std::set<std::string>& verbs) const {
  std::set<std::string> told;
  for (const std::string& verb : verbs)
    for (const std::string& skill : meaning_.lexicon.skills_of(verb))
      if (meaning_.skills.contains(skill)) told.insert(skill);
  return told;
}

// `flip the switch over, then flip it back again`
Maybe OneSentence::undone() const {
  std::set<std::string> done;
  for (const std::size_t at : reading_.in_time) {
    const Segment& segment = reading_.segments[at];
    for (std::size_t i = segment.begin; i < segment.end && !done.empty() && !vouched(segment); ++i)
      if (reading_.words[i].text == "again") return no(Rejection::other_action, "done, and again");
    if (!segment.verb) continue;
    const std::string& verb = reading_.words[*segment.verb].sense;
    bool back = false;
    for (std::size_t i = *segment.verb; i < segment.end; ++i) back |= reading_.words[i].text == "back";
    if (back && done.contains(verb) && !vouched(segment))
      return no(Rejection::other_action, quoted(verb) + " and back");
    done.insert(verb);
  }
  return {};
}

}  // namespace stampede
