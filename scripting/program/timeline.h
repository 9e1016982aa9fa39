// One episode as a picture in text: what happened when, and what it changed.
#pragma once

#include <string>

#include "engine/record/record.h"

namespace stampede::program {

struct TimelineStyle {
  int width = 100;
  bool constant_facts = false;  // also those that held from start to end
  std::string title;            // `episode 3 of demos.db`
};

// Header, skills and their motions as bars with undone tries and via-points, facts as bars, the end. Repeatable.
std::string timeline(const EpisodeRecord& episode, const TimelineStyle& style);

std::string timeline_json(const EpisodeRecord& episode);

}  // namespace stampede::program
