#include "db/research/arm_joints.h"

#include <algorithm>

namespace stampede::research {
namespace {

constexpr std::string_view kEachAction = "action_j*", kEachAnswer = "j*";
constexpr int kInSteps = 7;  // joints that view `steps` has columns for

}  // namespace

std::string column_of_joint(const std::string& prefix, int joint) { return prefix + std::to_string(joint); }

ArmJoints arm_joints_of(const PlainFile& file) {
  ArmJoints joints;
  if (!file.has("actions")) return joints;
  const std::vector<std::string> columns = file.query("SELECT * FROM actions LIMIT 0").columns;
  const auto has = [&](int joint) {
    return std::find(columns.begin(), columns.end(), column_of_joint("action_j", joint)) != columns.end();
  };
  while (has(joints.most + 1)) ++joints.most;
  const auto lacked = [&](int joint) {
    return file.query("SELECT 1 FROM actions WHERE action_j1 IS NOT NULL AND " + column_of_joint("action_j", joint) +
                      " IS NULL LIMIT 1")
               .size() > 0;
  };
  joints.fewest = joints.most;
  while (joints.fewest > 1 && lacked(joints.fewest)) --joints.fewest;
  return joints;
}

std::string with_arm_joints(std::string select, int most) {
  const std::size_t place = select.find(kEachAction, select.find('\n'));  // after the line that describes it
  if (place == std::string::npos) return select;
  std::string columns;
  for (int joint = 1; joint <= most; ++joint) {
    const std::string name = column_of_joint("action_j", joint);
    columns += (columns.empty() ? "" : ", ");
    columns += joint <= kInSteps ? name
                                 : "(SELECT q.value FROM actions q WHERE q.episode = steps.episode AND q.frame = "
                                   "steps.frame AND q.space = 'joint_position' AND q.component = " +
                                       std::to_string(joint - 1) + ") AS " + name;
  }
  return select.replace(place, kEachAction.size(), columns);
}

ResearchProblem with_arm_joints(ResearchProblem problem, const ArmJoints& joints) {
  std::vector<AnswerColumn> columns;
  for (const AnswerColumn& column : problem.answer) {
    if (column.name != kEachAnswer) {
      columns.push_back(column);
      continue;
    }
    for (int joint = 1; joint <= joints.most; ++joint) {
      AnswerColumn& one = columns.emplace_back(column);
      one.name = column_of_joint("j", joint), one.optional = joint > joints.fewest;
      one.about += joint == 1 ? " of the arm's joint next to the base, rad" : ", of the next, rad";
    }
  }
  problem.answer = std::move(columns);
  return problem;
}

}  // namespace stampede::research
