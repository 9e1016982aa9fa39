// Learned operators against the true ones: by their literals, and by what they say of states.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/learning/counts.h"
#include "engine/learning/experience.h"
#include "engine/learning/matching.h"

namespace stampede::learning {

// A state of a held-out episode, with the facts of everything.
struct Sample {
  Objects objects;
  Facts facts;
};

// One learned action beside the true one that it stands for, literal by literal, over the true one's parameters.
//
// `preconditions`, `effects`: as written. Not counted: inequalities, types, what the true domain derives (in effects:
// it follows), conditional effects, and literals about further things, which the true action has no parameter for.
// `held`: as written, and by what holds in the samples: an extra literal that is true wherever the true action can be
// taken is no mistake, and a true one (quantified parts among them) that is true wherever the learned action can be
// taken is not missed.
struct LiteralScore {
  ActionMatch match;
  Counts preconditions, effects, held;
  std::vector<std::string> extra, missing;  // literals, `effect` before those of effects; implied ones in brackets
};

// All cases of a true action together, on every sample: which of its calls can be taken, and what these change. A call
// is an action with arguments; of a learned action without one of the true parameters, every value that the true action
// could be called with. Changes are compared where both can be taken: facts added and removed, basic ones and those
// derived ones that the learned domain has a word for (it may derive them too, or change them by itself).
struct CallScore {
  std::string action;
  int cases = 0;  // learned actions that stand for it
  Counts applicable, changes;
};

struct OperatorScore {
  std::vector<LiteralScore> literals;  // by learned action
  std::vector<CallScore> calls;        // by true action in question
  Counts preconditions, effects, held, applicable,
      changes;  // sums; a true action without a case: its literals are missed
  int samples = 0;
};

// `among`: the true actions in question, such as those that the data has. At most 200 samples, evenly chosen.
// Throws Error for a learned action whose formulas name a predicate that the domain does not declare.
OperatorScore score_operators(const Domain& learned, const Domain& truth, const std::vector<ActionMatch>& matches,
                              const std::set<std::string>& among, const std::vector<Sample>& samples);

}  // namespace stampede::learning
