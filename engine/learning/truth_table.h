// What classifiers say of frames, beside what was so.
#pragma once

#include <vector>

#include "engine/learning/experience.h"

namespace stampede::learning {

// One frame. What is in neither set was not said.
struct JudgedFrame {
  Facts yes, no;
  Facts truth;  // all facts there
  Objects objects;
};

// A predicate of which nothing is ever said to be false is taken to be false of all other objects of the frame that
// are, place by place, of types that it is said of somewhere, no object twice: what is not said does not hold.
void complete(std::vector<JudgedFrame>& frames);

}  // namespace stampede::learning
