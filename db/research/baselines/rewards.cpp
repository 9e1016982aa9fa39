// Baselines that say how far an episode has come.
#include <algorithm>
#include <cmath>
#include <map>

#include "db/research/baselines/functions.h"
#include "db/research/relations.h"
#include "db/research/signals.h"
#include "engine/base/random.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kValueEvery = 10;  // frames that are asked about

// How many things have moved since the start, and how far the farthest: by frame.
Eigen::MatrixXd moved_things(const PlainFile& given, const Signals& signals) {
  constexpr double kMoved = 0.02;  // m
  Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(signals.hand.rows(), 2);
  std::map<std::string, Eigen::Vector3d> start;
  const Rows rows =
      given.query("SELECT frame, object, x, y, z FROM poses WHERE episode = ?1 ORDER BY frame", {signals.unit});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Vector3d at(rows.real(i, "x"), rows.real(i, "y"), rows.real(i, "z"));
    const double distance = (at - start.emplace(rows.text(i, "object"), at).first->second).norm();
    const auto frame = rows.integer(i, "frame");
    if (frame >= moved.rows()) continue;
    moved(frame, 0) += distance > kMoved ? 1 : 0;
    moved(frame, 1) = std::max(moved(frame, 1), distance);
  }
  return moved;
}

Eigen::MatrixXd value_features(const PlainFile& given, const Signals& signals) {
  Eigen::MatrixXd features(signals.hand.rows(), signals.hand.cols() + 2);
  features << signals.hand, moved_things(given, signals);
  return features;
}

void add_values(Answers& answers, const Signals& signals, const Eigen::VectorXd& values) {
  for (Eigen::Index frame = 0; frame < values.size(); ++frame)
    if (frame % kValueEvery == 0)
      answers.rows.rows.push_back({signals.unit, std::int64_t{frame}, values(frame), std::monostate{}});
}

// The discounted return from each frame, of a reward that comes once: of a failure 0.
Eigen::VectorXd returns(const PlainFile& given, const Signals& signals) {
  constexpr double kDiscount = 0.99;  // a frame
  Eigen::VectorXd values = Eigen::VectorXd::Zero(signals.hand.rows());
  const Rows rows =
      given.query("SELECT min(frame) AS first FROM rewards WHERE episode = ?1 AND reward > 0", {signals.unit});
  if (rows.is_null(0, "first")) return values;
  const auto first = static_cast<double>(rows.integer(0, "first"));
  for (Eigen::Index frame = 0; frame < values.size(); ++frame)
    values(frame) = std::pow(kDiscount, std::max(0.0, first - static_cast<double>(frame)));
  return values;
}

}  // namespace

Answers random_values(const ResearchProblem&, const PlainFile& given) {
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"})) {
    Random random(RandomKey("random_values").with(signals.unit));
    Eigen::VectorXd values(signals.hand.rows());
    for (double& value : values) value = random.uniform();
    add_values(answers, signals, values);
  }
  return answers;
}

Answers elapsed_time(const ResearchProblem&, const PlainFile& given) {
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"}))
    add_values(answers, signals,
               Eigen::VectorXd::LinSpaced(signals.hand.rows(), 0, static_cast<double>(signals.hand.rows() - 1)));
  return answers;
}

// Regression of the share of a success that has passed; of a failure nothing has.
Answers learned_value(const ResearchProblem&, const PlainFile& given) {
  std::vector<Eigen::MatrixXd> features, targets;
  for (const Signals& signals : signals_of(given, {"train", "validation"})) {
    const Rows rows = given.query("SELECT max(reward) AS most FROM rewards WHERE episode = ?1", {signals.unit});
    const bool success = rows.size() > 0 && !rows.is_null(0, "most") && rows.real(0, "most") > 0;
    const double end = success ? 1 : 0.3;  // a failure ends somewhere on the way
    features.push_back(value_features(given, signals));
    targets.emplace_back(Eigen::VectorXd::LinSpaced(signals.hand.rows(), 0, end));
  }
  const Scale scale(stacked(features));
  const Eigen::MatrixXd weights = ridge(scale.of(stacked(features)), stacked(targets), 1.0);
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"}))
    add_values(answers, signals, apply_ridge(scale.of(value_features(given, signals)), weights).col(0));
  return answers;
}

// Evaluation of what was seen, by the returns themselves: a regression for each kind of scene, and one for all where a
// test scene is of no kind that was trained.
Answers goal_relations(const ResearchProblem&, const PlainFile& given) {
  struct Seen {
    std::vector<Eigen::MatrixXd> features, targets;
  };
  constexpr double kPenalty = 10;
  std::map<std::string, Seen> seen;  // by kind; "": all
  for (const Signals& signals : signals_of(given, {"train", "validation"})) {
    const Eigen::MatrixXd features = relations(given, signals), targets = returns(given, signals);
    for (const std::string& kind : {std::string(), kind_of_scene(given, signals.unit)})
      seen[kind].features.push_back(features), seen[kind].targets.push_back(targets);
  }
  const Scale scale(stacked(seen[""].features));
  std::map<std::string, Eigen::MatrixXd> weights;
  for (const auto& [kind, of] : seen)
    weights[kind] = ridge(scale.of(stacked(of.features)), stacked(of.targets), kPenalty);
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"})) {
    const std::string kind = kind_of_scene(given, signals.unit);
    add_values(answers, signals,
               apply_ridge(scale.of(relations(given, signals)), weights.at(weights.contains(kind) ? kind : "")).col(0));
  }
  return answers;
}

}  // namespace stampede::research
