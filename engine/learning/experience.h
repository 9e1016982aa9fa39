// What was seen: the facts before and after something was done, or facts over time.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede::learning {

using Objects =
    std::shared_ptr<const std::vector<TypedObject>>;  // of one scene, sorted by name; shared by what is seen

struct Transition {
  std::string skill;                   // what was done; empty: nobody says
  std::vector<std::string> arguments;  // with what
  Facts before, after;                 // derived and static facts, traits included
  bool success = true;                 // of the skill, as whoever labelled it says
  Objects objects;
};

struct Experience {
  std::map<std::string, std::string> types;  // type -> parent, as in Domain
  std::vector<Transition> transitions;
};

// Facts over the frames of one episode.
struct Span {
  Fact fact;
  std::int64_t first = 0, end = 0;  // frames, half-open
};

struct History {
  std::vector<Span> spans;
  std::int64_t frames = 0;  // frames are 0 … frames - 1
  Objects objects;
};

// The facts of a frame.
Facts facts_at(const History& history, std::int64_t frame);

std::vector<std::int64_t> change_frames(const History& history);  // where facts begin or end to hold, ascending

// Transitions without labels: changes that follow each other within `gap` frames are one event, from the frame before
// its first to that of its last; what changes and changes back inside of it is none. Events without a net change are
// left out.
std::vector<Transition> events(const History& history, std::int64_t gap);

// The same with the frames of their first and last change.
struct TimedEvent {
  std::int64_t first = 0, last = 0;
  Transition transition;
};
std::vector<TimedEvent> timed_events(const History& history, std::int64_t gap);

// The gap that tells changes of one event from those of the next best: the threshold between all gaps that leaves the
// least variance on both sides (Otsu, IEEE Trans. SMC 9, 1979). 1 where all gaps are equal. (The gap with which all is
// told in the fewest bits, another way to choose, runs skills together that mostly follow each other.)
std::int64_t natural_gap(const std::vector<History>& histories);

}  // namespace stampede::learning
