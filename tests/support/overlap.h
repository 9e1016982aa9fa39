// How deep the solid things of an episode lie in each other, measured anew from its recorded frames with geometry that
// is not the engine's (libccd): what must never be seen in a picture is found here, whoever moved the arm.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/record/record.h"

namespace stampede::test {

enum class OverlapKind { itself, furniture, thing, things, start };  // arm and itself, arm and what stands … see below
constexpr std::array<const char*, 5> kOverlapKinds{"arm-arm", "arm-fixed", "arm-free", "body-body", "start"};

// The worst of one pair of parts over an episode.
struct Overlap {
  OverlapKind kind = OverlapKind::itself;
  std::string one, other;  // `panda.link6`, `chest.top_drawer`
  double depth = 0;        // m: the least way that would part them
  std::int64_t frame = 0;  // where it is deepest
  bool pressed = false;    // they were in contact in physics then: a grasp, a push, a landing
};

struct OverlapLimits {
  double let_alone = 0.001;  // m
  double pressed = 0.002;    // m, of what is grasped or pressed
  std::int64_t stride = 1;   // every so many frames are measured
};

// Pairs deeper than the limits, deepest first; parts of one body, links beside each other, and a thing and what it is
// still joined to are no pairs. Kind `start`: two bodies, or an arm and a body, in the first frame.
std::vector<Overlap> overlaps_of(const EpisodeRecord& episode, const OverlapLimits& limits = {});
std::string to_text(const Overlap& overlap);

// How deep two shapes of parts lie in each other: the least way that parts them, m; 0: they do not touch.
double depth_of(const Shape& one, const Transform& world_from_part, const Shape& other,
                const Transform& world_from_other_part);

}  // namespace stampede::test
