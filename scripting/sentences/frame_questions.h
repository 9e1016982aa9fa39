// Questions and answers about a frame, for vision-language training: truth from the catalogue, the same every time.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "engine/symbolic/symbols.h"

namespace stampede {

struct FrameQuestion {
  std::int64_t frame = 0;
  std::string type;                          // holds colour count where next_skill changed side
  std::string pattern;                       // with slots {a} {b}: `is the {a} left of the {b}?`
  std::map<std::string, std::string> slots;  // what fills them: `red cube`
  std::string answer;
  std::string answer_type;       // yes_no colour number thing skill facts
  std::string proof;             // the fact, attribute or segment that says so: `(on block1 table)`
  std::set<std::string> things;  // that it asks about, by name
  std::string camera;            // `side`: as this camera sees it
  std::string text(const std::string& with_pattern) const;  // with the slots filled
};

// All that can be asked of a frame; of questions with yes or no as many of each. Facts are those that are known to
// hold at that frame; names are those of the start (language.h).
std::vector<FrameQuestion> questions_about(const EpisodeRecord& episode, const Domain& domain, const Scene& scene,
                                           std::int64_t frame);

// `most` of them, of all types in turn; a pure function of the episode's task, variation and seed, and the frame.
std::vector<FrameQuestion> chosen_questions(std::vector<FrameQuestion> all, const EpisodeRecord& episode,
                                            std::int64_t frame, int most);

}  // namespace stampede
