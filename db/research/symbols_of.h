// What a data set's files say in symbols: facts over time, transitions, held-out problems.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "db/plain_file.h"
#include "engine/learning/experience.h"
#include "engine/learning/operator_score.h"
#include "engine/symbolic/task_planner.h"

namespace stampede::research {

// `(on block1 table)`. Throws Error{where} for a text that is no ground atom.
Fact fact_of(const std::string& text, const std::string& where);

// Facts and objects of these episodes. Tables: episodes, facts; objects where there is one.
std::map<std::int64_t, learning::History> histories_of(const PlainFile& file,
                                                       const std::vector<std::int64_t>& episodes);
std::vector<std::int64_t> episodes_to_learn_from(const PlainFile& given);  // those that do not test

// Each call of table skills: the facts of its first frame and of the frame after its last (or the episode's last).
learning::Experience labelled_experience(const PlainFile& given);

// The held-out planning problems.
struct HeldOutEpisode {
  std::int64_t number = 0;
  std::string task, variation;
  std::int64_t seed = 0;
  bool succeeded = false;  // when the data was made
  Problem problem;
};
struct HeldOutProblems {
  Domain truth;
  std::vector<HeldOutEpisode> episodes;   // those that have a problem
  std::set<std::string> actions;          // of the true domain, that the held-out skills are calls of
  std::vector<learning::Sample> samples;  // states before and after skills
};
// Tables: problems, skills, effects, sources. Throws Error where episodes have different domains, and for texts that
// are no PDDL.
HeldOutProblems held_out_problems(const PlainFile& hidden, const std::vector<std::int64_t>& episodes);

}  // namespace stampede::research
