// An episode's timeline as a picture: gripper, joint speeds, true skills as bands, answered boundaries as marks.
#pragma once

#include "db/research/segmentation.h"

namespace stampede::research {

// Writes ScoreOptions::figure, an SVG file. Throws Error for an episode that is not of the test split, and where the
// hidden part holds no joints to draw.
void draw_timeline(const ScoringJob& job, const Segmentations& truth, const Segmentations& answers);

OutputKind figure_kind();

}  // namespace stampede::research
