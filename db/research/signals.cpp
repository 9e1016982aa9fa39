#include "db/research/signals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "db/research/check_dataset.h"
#include "db/research/known_columns.h"
#include "engine/base/error.h"
#include "engine/base/random.h"

namespace stampede::research {
namespace {

const std::vector<std::string> kHandColumns = {
    "x",        "y",        "z",         "qx",        "qy",        "qz",      "qw",      "linear_x",
    "linear_y", "linear_z", "angular_x", "angular_y", "angular_z", "opening", "touch_1", "touch_2"};

void read_joints(const PlainFile& given, const KnownColumns& known, const std::string& unit, Signals& signals) {
  const Rows rows = given.query("SELECT frame, joint, position, velocity FROM joints WHERE " + unit +
                                    " = ?1 AND arm_joint IS NOT NULL ORDER BY frame, arm_joint",
                                {signals.unit});
  std::vector<double> position, velocity;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::int64_t frame = rows.integer(i, "frame");
    if (signals.frames.empty() || signals.frames.back() != frame) signals.frames.push_back(frame);
    position.push_back(known.real(rows, i, "position")), velocity.push_back(known.real(rows, i, "velocity"));
  }
  const auto count = static_cast<Eigen::Index>(signals.frames.size());
  if (count > 0 && position.size() % signals.frames.size() != 0)
    refuse_unfit(given, "of " + unit + " " + std::to_string(signals.unit) + " some frames lack joints");
  const Eigen::Index joints = count > 0 ? static_cast<Eigen::Index>(position.size()) / count : 0;
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  signals.position = Eigen::Map<const RowMajor>(position.data(), count, joints);
  signals.velocity = Eigen::Map<const RowMajor>(velocity.data(), count, joints);
}

void read_hand(const PlainFile& given, const KnownColumns& known, const std::string& unit, Signals& signals) {
  const Rows rows = given.query("SELECT * FROM hands WHERE " + unit + " = ?1 ORDER BY hand, frame", {signals.unit});
  signals.hand.setZero(static_cast<Eigen::Index>(signals.frames.size()),
                       static_cast<Eigen::Index>(kHandColumns.size()));
  const auto count =
      std::min<Eigen::Index>(static_cast<Eigen::Index>(rows.size()), signals.hand.rows());  // the first hand
  for (std::size_t column = 0; column < kHandColumns.size(); ++column)
    for (Eigen::Index i = 0; i < count; ++i)
      signals.hand(i, static_cast<Eigen::Index>(column)) =
          known.real(rows, static_cast<std::size_t>(i), kHandColumns[column]);
  signals.touch = known.has("touch_1") && known.has("touch_2");
}

// Columns of what is learned from together, or of what is learned and what is asked.
void check_alike(Eigen::Index columns, Eigen::Index others) {
  if (columns == others) return;
  throw Error(
      "baseline",
      "episodes of the data set differ in what was measured: " + std::to_string(columns) + " numbers a frame, " +
          "and " + std::to_string(others),
      "their arms have different numbers of joints, or not all was recorded: make a data set of one robot, of which "
      "some episodes are for training, with `stampede dataset … --where \"world = 'NAME'\"`");
}

// The sum of squared distances to the centres, which it moves.
double assign(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& centres, std::vector<int>& of_row) {
  double sum = 0;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Eigen::Index nearest = 0;
    sum += (centres.rowwise() - rows.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    of_row[static_cast<std::size_t>(i)] = static_cast<int>(nearest);
  }
  return sum;
}

Eigen::MatrixXd first_centres(const Eigen::MatrixXd& rows, int clusters, Random& random) {
  Eigen::MatrixXd centres(clusters, rows.cols());
  centres.row(0) = rows.row(random.below(rows.rows()));
  for (int k = 1; k < clusters; ++k) {
    Eigen::VectorXd far(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      far(i) = (centres.topRows(k).rowwise() - rows.row(i)).rowwise().squaredNorm().minCoeff();
    double left = random.uniform() * far.sum();
    Eigen::Index chosen = 0;
    while (chosen + 1 < rows.rows() && (left -= far(chosen)) > 0) ++chosen;
    centres.row(k) = rows.row(chosen);
  }
  return centres;
}

}  // namespace

std::vector<Signals> signals_of(const PlainFile& given, const std::vector<std::string>& splits) {
  const std::string unit = given.has("pieces") ? "piece" : "episode";
  const Rows rows = given.query("SELECT " + unit + " AS number, split FROM " + unit + "s ORDER BY 1");
  const KnownColumns of_joints(given, "joints"), of_hands(given, "hands");
  std::vector<Signals> all;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::find(splits.begin(), splits.end(), rows.text(i, "split")) == splits.end()) continue;
    Signals& one = all.emplace_back();
    one.unit = rows.integer(i, "number"), one.split = rows.text(i, "split");
    read_joints(given, of_joints, unit, one);
    read_hand(given, of_hands, unit, one);
  }
  return all;
}

Eigen::MatrixXd motion_features(const Signals& signals) {
  const Eigen::Index frames = signals.hand.rows(), joints = signals.velocity.cols();
  const Eigen::Index forces = signals.touch ? 2 : 0;
  Eigen::MatrixXd features(frames, joints + 6 + forces);
  features.leftCols(joints) = signals.velocity;
  const Eigen::VectorXd opening = signals.opening();
  for (Eigen::Index i = 0; i < frames; ++i) {
    const Eigen::Index before = std::max<Eigen::Index>(i - 1, 0), after = std::min<Eigen::Index>(i + 1, frames - 1);
    features.row(i).segment(joints, 6) << signals.hand.row(i).segment(7, 3).norm(), signals.hand(i, 2),
        signals.hand(i, 9), signals.hand.row(i).segment(10, 3).norm(), opening(i), opening(after) - opening(before);
    features.row(i).tail(forces) = signals.hand.row(i).tail(forces);
  }
  return features;
}

Scale::Scale(const Eigen::MatrixXd& rows) : mean(rows.colwise().mean()) {
  deviation =
      (rows.rowwise() - mean).colwise().squaredNorm() / static_cast<double>(std::max<Eigen::Index>(rows.rows(), 1));
  deviation = deviation.cwiseSqrt();
  for (double& one : deviation)
    if (one < 1e-9) one = 1;
}

Eigen::MatrixXd Scale::of(const Eigen::MatrixXd& rows) const {
  check_alike(rows.cols(), mean.cols());
  return (rows.rowwise() - mean).array().rowwise() / deviation.array();
}

Eigen::MatrixXd ridge(const Eigen::MatrixXd& features, const Eigen::MatrixXd& targets, double penalty) {
  Eigen::MatrixXd all(features.rows(), features.cols() + 1);
  all << features, Eigen::VectorXd::Ones(features.rows());
  Eigen::MatrixXd normal = all.transpose() * all;
  for (Eigen::Index i = 0; i < features.cols(); ++i) normal(i, i) += penalty;  // the offset is free
  return normal.ldlt().solve(all.transpose() * targets);
}

Eigen::MatrixXd apply_ridge(const Eigen::MatrixXd& features, const Eigen::MatrixXd& weights) {
  check_alike(features.cols() + 1, weights.rows());
  return (features * weights.topRows(features.cols())).rowwise() + weights.row(features.cols());
}

Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& parts) {
  Eigen::Index rows = 0;
  for (const Eigen::MatrixXd& part : parts) {
    rows += part.rows();
    check_alike(part.cols(), parts.front().cols());
  }
  Eigen::MatrixXd all(rows, parts.empty() ? 0 : parts.front().cols());
  rows = 0;
  for (const Eigen::MatrixXd& part : parts) all.middleRows(rows, part.rows()) = part, rows += part.rows();
  return all;
}

std::vector<int> k_means(const Eigen::MatrixXd& rows, int clusters) {
  clusters = std::max(1, std::min(clusters, static_cast<int>(rows.rows())));
  std::vector<int> best(static_cast<std::size_t>(rows.rows()), 0), of_row = best;
  double least = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 8 && rows.rows() > 0; ++start) {
    Random random(RandomKey("k_means").with(static_cast<std::int64_t>(start)));
    Eigen::MatrixXd centres = first_centres(rows, clusters, random);
    double sum = assign(rows, centres, of_row);
    for (int round = 0; round < 100; ++round) {
      Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(clusters, rows.cols());
      Eigen::VectorXd counts = Eigen::VectorXd::Zero(clusters);
      for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const int k = of_row[static_cast<std::size_t>(i)];
        sums.row(k) += rows.row(i), ++counts(k);
      }
      for (int k = 0; k < clusters; ++k)
        if (counts(k) > 0) centres.row(k) = sums.row(k) / counts(k);
      const double now = assign(rows, centres, of_row);
      if (now >= sum) break;
      sum = now;
    }
    if (sum < least) least = sum, best = of_row;
  }
  return best;
}

}  // namespace stampede::research
