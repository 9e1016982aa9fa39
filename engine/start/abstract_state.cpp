#include "engine/start/abstract_state.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/error.h"
#include "engine/start/language.h"

namespace stampede {
namespace {

bool at(const FactRecord& record, std::int64_t frame) {
  return record.first_frame <= frame && frame < record.end_frame;
}

std::string line(const char* format, const std::string& name, double a, double b, double c) {
  char text[160];
  std::snprintf(text, sizeof text, format, name.c_str(), a, b, c);
  return text;
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
      text += line("%s is %.0f %% open (%.3f)\n", name, 100 * fraction, state.joints.at(name), 0);
  for (const auto& [name, opening] : state.openings) text += line("%s is open %.3f m\n", name, opening, 0, 0);
  for (const auto& [name, pose] : state.poses)
    text += line("%s is at %.3f %.3f %.3f\n", name, pose.position[0], pose.position[1], pose.position[2]);
  return text;
}

}  // namespace stampede
