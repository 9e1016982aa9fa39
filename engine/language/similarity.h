// How alike two sentences are.
#pragma once

#include <string>
#include <vector>

#include "engine/language/english.h"

namespace stampede {

// The greater of two measures, 0 … 1; 1: the same words but for articles and politeness.
//  - 1 minus the edit distance of the words, over the longer's length (Levenshtein, Soviet Physics Doklady 10, 1966)
//  - the resemblance of the sets of pairs of neighbouring words (Jaccard; Broder, SEQUENCES 1997,
//    doi:10.1109/SEQUEN.1997.666900)
double similarity(const std::string& a, const std::string& b, const English& english);

// From here on a sentence says what another one says, in the same words.
constexpr double kNearDuplicate = 0.8;

// The sentence of `others` that is a near-duplicate, or null.
const std::string* near_duplicate(const std::string& sentence, const std::vector<std::string>& others,
                                  const English& english);

}  // namespace stampede
