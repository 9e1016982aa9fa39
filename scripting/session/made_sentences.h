// Sentences of a model become rows of an episode's language.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/episode/runner.h"
#include "scripting/library/library.h"

namespace stampede {

// Those of the variation and of its subgoals, and those with slots.
std::shared_ptr<const std::vector<MadeSentence>> sentences_for(const std::vector<MadeSentence>& all,
                                                               const std::string& variation);

// Slots are filled with what things are called at the start. Of a subgoal, skill or motion: one row a segment; of a
// predicate: one row a fact that holds at the start.
void add_sentences(const std::vector<MadeSentence>& sentences, const Library& library, EpisodeRecord& record);

}  // namespace stampede
