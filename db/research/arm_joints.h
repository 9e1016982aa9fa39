// Arms have as many joints as they have: what is named by them in data sets (`action_j1` …) and in answers (`j1` …),
// from the base on, is there as often as the arm of the data set has joints that has most. Rows of an arm that has
// fewer hold NULL in what is left, and answers may leave it out.
#pragma once

#include <string>

#include "db/plain_file.h"
#include "db/research/problem.h"

namespace stampede::research {

struct ArmJoints {
  int most = 1, fewest = 1;  // of all arms; of those that are asked about
};

// Of a part of a data set, by the columns of its table `actions` and what is in them; of one without that table, 1.
ArmJoints arm_joints_of(const PlainFile& file);

std::string column_of_joint(const std::string& prefix, int joint);  // `action_j3` of `action_j` and 3

// A SELECT of db/datasets with `action_j*` spelled out, of view `steps`.
std::string with_arm_joints(std::string select, int most);

// The problem with column `j*` of its answers spelled out; those that not every arm has may be left out.
ResearchProblem with_arm_joints(ResearchProblem problem, const ArmJoints& joints);

}  // namespace stampede::research
