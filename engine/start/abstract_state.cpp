#include "engine/start/abstract_state.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "engine/base/error.h"
#include "engine/start/language.h"

namespace stampede {
namespace {

bool at(const FactRecord& record, std::int64_t frame) {
  return record.first_frame <= frame && frame < record.end_frame;
}

// What is rounded to nothing has no sign: 0.000, not -0.000.
std::string rounded(double value, int digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return std::strspn(text, "-0.") == std::strlen(text) && text[0] == '-' ? text + 1 : text;
}

}  // namespace

AbstractState abstract_state(const EpisodeRecord& episode, std::int64_t frame) {
  if (frame < 0 || frame >= static_cast<std::int64_t>(episode.frames.size()))
    throw Error("frame " + std::to_string(frame),
                "the episode has " + std::to_string(episode.frames.size()) + " frames",
                episode.frames.empty() ? "" : "choose 0 to " + std::to_string(episode.frames.size() - 1));
  AbstractState state;
  state.frame = frame;
  std::set<std::string> hiding;
  for (const FactRecord& record : episode.labels.facts)
    if (!record.observed) hiding.insert(record.fact.predicate);
  for (const FactRecord& record : episode.labels.observed_facts) hiding.insert(record.fact.predicate);
  for (const FactRecord& record : episode.labels.facts) {
    if (!at(record, frame)) continue;
    state.facts.insert(record.fact);
    if (!hiding.contains(record.fact.predicate)) state.observed.insert(record.fact);
  }
  for (const FactRecord& record : episode.labels.observed_facts)
    if (at(record, frame)) state.observed.insert(record.fact);
  const FrameRecord& recorded = episode.frames[static_cast<std::size_t>(frame)];
  for (std::size_t i = 0; i < episode.scene.joints.size(); ++i) {
    const JointName& joint = episode.scene.joints[i];
    const double position = recorded.joint_position.at(i);
    state.joints[joint.name] = position;
    if (std::isfinite(joint.lower) && std::isfinite(joint.upper) && joint.lower < joint.upper)
      state.joint_fractions[joint.name] = (position - joint.lower) / (joint.upper - joint.lower);
  }
  for (std::size_t i = 0; i < episode.scene.posed.size(); ++i)
    state.poses[episode.scene.posed[i]] = recorded.object_pose.at(i);
  for (std::size_t i = 0; i < episode.scene.hands.size(); ++i)
    state.openings[episode.scene.hands[i]] = recorded.hands.at(i).opening;
  return state;
}

std::string describe(const AbstractState& state, const Domain& domain, const Scene& scene) {
  std::string text;
  Facts all = state.facts;
  all.insert(state.observed.begin(), state.observed.end());
  for (const Fact& fact : all) {
    const Predicate* predicate = domain.predicate(fact.predicate);
    const std::vector<std::string> sentence = describe_world({fact}, domain, scene);
    if (predicate == nullptr || sentence.empty()) continue;
    const bool holds = state.facts.contains(fact), known = state.observed.contains(fact);
    text += sentence.front() + (holds && known ? "" : known ? " (believed, not so)" : " (not known)") + "\n";
  }
  for (const auto& [name, fraction] : state.joint_fractions)
    if (!name.starts_with(scene.robot.name + "."))
      text += name + " is " + rounded(100 * fraction, 0) + " % open (" + rounded(state.joints.at(name), 3) + ")\n";
  for (const auto& [name, opening] : state.openings) text += name + " is open " + rounded(opening, 3) + " m\n";
  const std::set<std::string> unseen = unseen_things(state);
  for (const auto& [name, pose] : state.poses) {
    text += name + " is at";
    for (const double value : pose.position) text += " " + rounded(value, 3);
    text += unseen.contains(name) ? " (not known)\n" : "\n";
  }
  return text;
}

std::set<std::string> unseen_things(const AbstractState& state) {
  std::set<std::string> things;
  for (const Fact& fact : state.facts)
    if ((fact.predicate == "inside" || fact.predicate == "on") && !state.observed.contains(fact))
      things.insert(fact.arguments.front());
  return things;
}

}  // namespace stampede
