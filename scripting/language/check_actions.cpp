// What is done, and in which order.
#include "scripting/language/one_sentence.h"

namespace stampede {

// `take the handle`, `go to the button`, `take the seat by its grip`: on the way to what is done
bool OneSentence::takes_part(const Segment& segment) const {
  if (!segment.verb) return false;
  const std::string& verb = reading_.words[*segment.verb].sense;
  const bool more = std::any_of(reading_.segments.begin(), reading_.segments.end(),
                                [&](const Segment& one) { return one.verb && one.begin > segment.begin; });
  if (!more || (verb != "take" && verb != "hold" && verb != "reach")) return false;
  const auto is_handle = [&](const Mention& mention) {
    return mention.sense == "handle" && (mention.things.empty() || may_be(mention, meaning_, &SpokenThing::wanted));
  };
  bool by_handle = false, own = false, handle = false;
  for (const Mention& mention : reading_.mentions) {
    if (!within(mention, segment)) continue;
    handle |= is_handle(mention);
    by_handle |= is_handle(mention) && mention.preposition == "by";
    own |= mention.role == "object " + verb && may_be(mention, meaning_, &SpokenThing::handled);
    if (mention.role == "object " + verb && is_handle(mention)) return true;
  }
  return verb == "reach" ? own || handle : own && by_handle && !carries();
}

Maybe OneSentence::actions() const {
  static const std::set<std::string> kSays = {"is", "are", "be", "want", "need"};
  static const std::set<std::string> kStates = {"find", "switch", "belong", "complete", "lie",      "contain",
                                                "mark", "show",   "locate", "colour",   "take-care"};
  static const std::set<std::string> kMotions = {"reach", "take", "hold", "lift", "lower", "drop", "put", "pull"};
  bool any = false;
  for (const Word& word : reading_.words)
    any |= word.kind == WordKind::verb || word.kind == WordKind::own || kSays.contains(word.text);
  if (!any) return no(Rejection::not_a_sentence, "there is no verb");
  for (const Segment& segment : reading_.segments) {
    if (!segment.verb || spares(segment) || takes_part(segment)) continue;
    const std::string& verb = reading_.words[*segment.verb].sense;
    if (claims_.verbs.contains(verb) || kStates.contains(verb)) continue;
    if (meaning_.slots && meaning_.skills.empty() && claims_.senses.contains(verb)) continue;  // `is pressed`
    if (grain_ == Grain::motions && (kMotions.contains(verb) || moves_fingers(reading_, *segment.verb))) continue;
    const std::set<std::string>& skills = meaning_.lexicon.skills_of(verb);
    if (std::none_of(skills.begin(), skills.end(), [&](const auto& one) { return meaning_.skills.contains(one); }))
      return no(Rejection::other_action, quoted(verb));
  }
  for (const std::string& direction :
       directions_in(reading_, [this](const Segment& segment) { return denies_start(segment); })) {
    const std::string opposite = opposite_of(direction);
    if (direction.starts_with("switch_") && !claims_.directions.contains(direction))
      return no(Rejection::other_action, quoted(direction));
    if (!claims_.directions.contains(direction) && !opposite.empty() && claims_.directions.contains(opposite) &&
        !planned(direction))
      return no(Rejection::other_action, quoted(direction) + " for " + quoted(opposite));
  }
  return {};
}

bool OneSentence::planned(const std::string& direction) const {
  static const std::map<std::string, std::set<std::string>> kOf = {
      {"open", {"open", "unscrew"}},
      {"close", {"close"}},
      {"in", {"put_in", "insert", "put_on_shelf", "drop"}},
      {"insert", {"insert", "put_in"}},
      {"remove", {"extract", "take_out", "take_from_shelf", "unhang"}},
      {"out", {"extract", "take_out", "take_from_shelf", "unhang", "pick"}},
      {"up", {"pick", "lift"}},
      {"down", {"place", "set_down", "lay", "stack"}}};
  const auto found = kOf.find(direction);
  if (found == kOf.end()) return false;
  return std::any_of(found->second.begin(), found->second.end(),
                     [&](const auto& one) { return meaning_.skills.contains(one); });
}

// Kinds of skills in the order of the plan: each kind of what is said, where the plan has it first after the last.
Maybe OneSentence::order() const {
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
      const Concern concern = concerns(segment, meaning_.steps[static_cast<std::size_t>(i)]);
      if (concern == Concern::none) continue;
      if (any < 0) any = i;
      // `open the dishwasher` is its door, whatever else of it is opened after
      if (i >= reached && next < 0 && (concern == Concern::itself || any == i || any >= reached)) next = i;
    }
    if (next >= 0)
      reached = next;
    else if (any >= 0)
      return no(Rejection::swapped_order, quoted(reading_.words[*segment.verb].text) + " comes earlier");
  }
  return {};
}

// Verbs that the author's sentences have in one order only.
Maybe OneSentence::relative_order() const {
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

// Of what the stretch names; `none` where the step handles none of the wanted things that are named.
OneSentence::Concern OneSentence::concerns(const Segment& segment, const PlanStep& step) const {
  bool named = false, part = false;
  for (const Mention& mention : reading_.mentions) {
    if (!within(mention, segment) || !may_be(mention, meaning_, &SpokenThing::wanted)) continue;
    named = true;
    for (const std::string& name : mention.things)
      for (const std::string& argument : step.arguments) {
        if (argument == name) return Concern::itself;
        part |= argument.starts_with(name + ".");
      }
  }
  return named && !part ? Concern::none : part ? Concern::part : Concern::itself;
}

Maybe OneSentence::steps() const {
  if (grain_ == Grain::goal || meaning_.slots) return {};
  int verbs = 0;
  for (const Segment& segment : reading_.segments) verbs += segment.verb ? 1 : 0;
  const int wanted = grain_ == Grain::motions ? 3 : std::min<int>(2, static_cast<int>(meaning_.steps.size()));
  if (verbs < wanted) return no(Rejection::misses_steps, std::to_string(verbs) + " of them");
  return {};
}

}  // namespace stampede
