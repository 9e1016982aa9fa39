// Episodes cut into labelled segments: the learner's and the true ones.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "db/research/scorer.h"

namespace stampede::research {

struct LabelledSegment {
  std::int64_t first = 0, end = 0;  // frames, half-open
  std::string label;
};

struct Segmentation {
  std::int64_t frames = 0;
  std::vector<LabelledSegment> segments;  // in order, without overlap; frames between are in none
};
using Segmentations = std::map<std::int64_t, Segmentation>;  // by episode

// The innermost segments: what a skill calls cuts it into pieces.
Segmentations true_segments(const PlainFile& hidden, const std::vector<std::int64_t>& episodes,
                            const std::string& label_column);
// Throws Error for segments beyond an episode's frames, empty ones, and such as overlap.
Segmentations answered_segments(const ScoringJob& job, const std::string& label_column);

std::vector<std::int64_t> boundaries_of(
    const Segmentation& one);  // where segments begin or end, but for first and last frame
std::vector<int> segment_of_frames(const Segmentation& one);  // -1: none

}  // namespace stampede::research
