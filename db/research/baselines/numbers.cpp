// Baselines that answer with names of pieces and with actions.
#include <algorithm>
#include <cmath>

#include "db/research/arm_joints.h"
#include "db/research/baselines/functions.h"
#include "db/research/check_dataset.h"
#include "db/research/signals.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kActionEvery = 20;  // frames that are asked about

// A piece as one row: ten points along it of how far the tip has come, its height, its speed and the opening; its
// length.
Eigen::RowVectorXd piece_row(const Signals& signals) {
  constexpr Eigen::Index kPoints = 10;
  const Eigen::Index frames = signals.hand.rows();
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(kPoints * 4 + 1);
  if (frames == 0) return row;
  for (Eigen::Index i = 0; i < kPoints; ++i) {
    const Eigen::Index at = i * (frames - 1) / (kPoints - 1);
    row.segment(i * 4, 4) << (signals.hand.row(at).head(3) - signals.hand.row(0).head(3)).norm(),
        signals.hand(at, 2) - signals.hand(0, 2), signals.hand.row(at).segment(7, 3).norm(), signals.hand(at, 13);
  }
  row(kPoints * 4) = std::log(static_cast<double>(frames));
  return row;
}

// What an action is learned from, and its target: joints beside their present positions, and the opening.
struct Steps {
  Eigen::MatrixXd features, targets;
};

Eigen::MatrixXd state_features(const Signals& signals) {
  Eigen::MatrixXd features(signals.hand.rows(),
                           signals.position.cols() + signals.velocity.cols() + signals.hand.cols());
  features << signals.position, signals.velocity, signals.hand;
  return features;
}

Steps steps_of(const PlainFile& given, const std::vector<Signals>& all) {
  std::vector<Eigen::MatrixXd> features, targets;
  for (const Signals& signals : all) {
    const Rows rows = given.query(
        "SELECT * FROM actions WHERE episode = ?1 AND action_j1 IS NOT NULL AND action_gripper IS "
        "NOT NULL ORDER BY frame",
        {signals.unit});
    const Eigen::MatrixXd state = state_features(signals);
    Eigen::MatrixXd some(static_cast<Eigen::Index>(rows.size()), state.cols());
    const Eigen::Index joints = signals.position.cols();
    Eigen::MatrixXd wanted(static_cast<Eigen::Index>(rows.size()), joints + 1);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const std::int64_t frame = rows.integer(i, "frame");  // training episodes have every frame
      if (frame >= state.rows())
        refuse_unfit(given,
                     "episode " + std::to_string(signals.unit) + " lacks joints of frame " + std::to_string(frame));
      some.row(row) = state.row(frame);
      for (Eigen::Index j = 0; j < joints; ++j) {
        const std::string name = column_of_joint("action_j", static_cast<int>(j) + 1);
        wanted(row, j) = rows.is_null(i, name) ? 0 : rows.real(i, name) - signals.position(frame, j);
      }
      wanted(row, joints) = rows.real(i, "action_gripper");
    }
    features.push_back(some), targets.push_back(wanted);
  }
  return {stacked(features), stacked(targets)};
}

template <typename Guess>  // of a row of features: joints beside the present ones, opening
Answers actions_by(const PlainFile& given, Guess guess) {
  Answers answers;
  const Eigen::Index most = arm_joints_of(given).most;
  for (const Signals& signals : signals_of(given, {"test"})) {
    const Eigen::Index joints = signals.position.cols();
    if (joints > most)
      refuse_unfit(given, "the arm of episode " + std::to_string(signals.unit) + " has more joints than table actions");
    const Eigen::MatrixXd state = state_features(signals);
    for (std::size_t i = 0; i < signals.frames.size(); ++i) {
      if (signals.frames[i] % kActionEvery != 0) continue;
      const auto row = static_cast<Eigen::Index>(i);
      const Eigen::RowVectorXd wanted = guess(signals, row, state.row(row));
      std::vector<SqlValue> answer = {signals.unit, signals.frames[i]};
      for (Eigen::Index j = 0; j < joints; ++j) answer.emplace_back(wanted(j) + signals.position(row, j));
      answer.resize(static_cast<std::size_t>(2 + most));  // NULL of joints that this arm has not
      answer.emplace_back(wanted(joints));
      answers.rows.rows.push_back(answer);
    }
  }
  return answers;
}

}  // namespace

Answers motion_clusters(const ResearchProblem&, const PlainFile& given) {
  constexpr int kClusters = 8;
  const std::vector<Signals> all = signals_of(given, {"train", "validation", "test"});
  std::vector<Eigen::MatrixXd> rows;
  for (const Signals& signals : all) rows.emplace_back(piece_row(signals));
  const Eigen::MatrixXd table = stacked(rows);
  const std::vector<int> names = k_means(Scale(table).of(table), kClusters);
  Answers answers;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].split == "test") answers.rows.rows.push_back({all[i].unit, "c" + std::to_string(names[i])});
  return answers;
}

Answers one_cluster(const ResearchProblem&, const PlainFile& given) {
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"}))
    answers.rows.rows.push_back({signals.unit, std::string("a")});
  return answers;
}

Answers stay_there(const ResearchProblem&, const PlainFile& given) {
  return actions_by(given, [](const Signals& signals, Eigen::Index row, const auto&) -> Eigen::RowVectorXd {
    Eigen::RowVectorXd wanted = Eigen::RowVectorXd::Zero(signals.position.cols() + 1);
    wanted.tail(1)(0) = signals.opening()(row);
    return wanted;
  });
}

Answers nearest_action(const ResearchProblem&, const PlainFile& given) {
  const Steps steps = steps_of(given, signals_of(given, {"train", "validation"}));
  const Scale scale(steps.features);
  const Eigen::MatrixXd known = scale.of(steps.features);
  if (known.rows() == 0) refuse_unfit(given, "no training episode has actions");
  return actions_by(given, [&](const Signals&, Eigen::Index, const auto& state) -> Eigen::RowVectorXd {
    Eigen::Index nearest = 0;
    (known.rowwise() - scale.of(state).row(0)).rowwise().squaredNorm().minCoeff(&nearest);
    return steps.targets.row(nearest);
  });
}

Answers linear_action(const ResearchProblem&, const PlainFile& given) {
  const Steps steps = steps_of(given, signals_of(given, {"train", "validation"}));
  const Scale scale(steps.features);
  const Eigen::MatrixXd weights = ridge(scale.of(steps.features), steps.targets, 1.0);
  return actions_by(given, [&](const Signals&, Eigen::Index, const auto& state) -> Eigen::RowVectorXd {
    return apply_ridge(scale.of(state), weights).row(0);
  });
}

}  // namespace stampede::research
