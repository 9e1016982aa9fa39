#include <algorithm>

#include "db/research/arm_joints.h"
#include "db/research/baseline.h"
#include "db/research/baselines/functions.h"
#include "db/research/check_dataset.h"
#include "db/research/dataset.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"

namespace stampede::research {

const std::vector<Baseline>& all_baselines() {
  static const std::vector<Baseline> baselines = {
      {"one_segment", {"segments"}, "the whole episode is one segment", one_segment},
      {"equal_parts", {"segments"}, "a boundary every 45 frames", equal_parts},
      {"keyframes",
       {"segments"},
       "where the gripper opens or closes or the arm stands still (James, Davison, RA-L 2022)",
       keyframe_segments},
      {"change_points",
       {"segments"},
       "PELT on speeds, opening and forces (Killick et al., JASA 2012), named by k-means",
       change_points},
      {"hmm",
       {"segments_supervised", "controllers"},
       "hidden Markov model of four phases a label, Viterbi",
       hidden_markov},
      {"one_cluster", {"motions"}, "all are the same", one_cluster},
      {"k_means", {"motions"}, "k-means on ten points of each piece", motion_clusters},
      {"stay", {"behaviour", "transfer"}, "the command is where the arm is", stay_there},
      {"nearest", {"behaviour", "transfer"}, "what was commanded in the nearest state of training", nearest_action},
      {"linear", {"behaviour", "transfer"}, "ridge regression of the command", linear_action},
      {"random", {"rewards"}, "a number by chance", random_values},
      {"time", {"rewards"}, "frames since the start", elapsed_time},
      {"learned_value", {"rewards"}, "ridge regression of how much of a success has passed", learned_value},
      {"goal_relations",
       {"rewards"},
       "ridge regression, for each kind of scene, of the discounted reward to come on relations of what is asked for",
       goal_relations},
      {"still", {"transition_models"}, "nothing changes", nothing_moves},
      {"constant_velocity", {"transition_models"}, "all goes on as it does; facts stay", constant_velocity},
      {"linear_tip",
       {"transition_models"},
       "ridge regression of tip and joints on speed and command, with what the hand carries; facts change as after the "
       "nearest context",
       linear_tip},
      {"geometry", {"concepts"}, "bounding boxes and fingers", geometry_facts},
      {"geometry_symbols", {"symbols"}, "bounding boxes and fingers, under names of its own", geometry_symbols},
      {"operators",
       {"conditions", "conditions_supervised"},
       "calls with equal effects are cases, what held before all is the precondition (Silver et al., IROS 2021)",
       operators_with_labels},
      {"used_actions", {"abstractions"}, "the actions that plans of training take, and nothing else", actions_of_plans},
      {"thresholds",
       {"inventions"},
       "thresholds of distances that skills change are predicates (2-means), and operators learned with them",
       invented_predicates},
      {"operators_unlabelled",
       {"segments_and_conditions"},
       "changes of facts close in time are events, events with equal effects are actions (after Silver et al., 2021)",
       operators_without_labels},
  };
  return baselines;
}

const Baseline& find_baseline(std::string_view name) {
  std::vector<std::string> names;
  for (const Baseline& baseline : all_baselines()) {
    if (baseline.name == name) return baseline;
    names.push_back(baseline.name);
  }
  const std::string meant = did_you_mean(name, names);
  throw Error("baseline", "there is no baseline '" + std::string(name) + "'",
              (meant.empty() ? "" : meant + " ") + "`stampede baseline --list` names all");
}

Answers answer_by(const Baseline& baseline, const std::filesystem::path& given_folder) {
  const PlainFile given = open_dataset(given_folder / kGivenFile);
  const std::string name = dataset_problem(given);
  if (std::find(baseline.problems.begin(), baseline.problems.end(), name) == baseline.problems.end()) {
    std::string served;
    for (const std::string& problem : baseline.problems) served += (served.empty() ? "" : ", ") + problem;
    throw Error("baseline", baseline.name + " does not answer " + name, "it answers " + served);
  }
  const ResearchProblem problem = with_arm_joints(find_problem(name), arm_joints_of(given));
  Answers answers = fitting(given, [&] { return baseline.answer(problem, given); });
  answers.dataset = dataset_id(given);
  answers.problem = name;
  if (answers.rows.columns.empty())
    for (const AnswerColumn& column : problem.answer) answers.rows.columns.push_back(column.name);
  return answers;
}

}  // namespace stampede::research
