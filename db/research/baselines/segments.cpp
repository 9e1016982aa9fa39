// Baselines that cut episodes into segments.
#include <algorithm>
#include <cmath>
#include <set>

#include "db/research/baselines/functions.h"
#include "db/research/signals.h"
#include "engine/base/random.h"

namespace stampede::research {
namespace {

// Segments between frames, in order; a name for each, or none.
void add_segments(Answers& answers, std::int64_t episode, std::int64_t frames, const std::vector<std::int64_t>& cuts,
                  const std::vector<std::string>& names = {}) {
  std::int64_t first = 0;
  std::size_t which = 0;
  const auto add = [&](std::int64_t end) {
    if (end <= first) return;
    answers.rows.rows.push_back({episode, first, end, which < names.size() ? SqlValue(names[which]) : SqlValue()});
    first = end, ++which;
  };
  for (const std::int64_t cut : cuts) add(std::min(cut, frames));
  add(frames);
}

std::int64_t frames_of(const Signals& signals) { return static_cast<std::int64_t>(signals.frames.size()); }

// As stopped_keyframes() of engine/episode finds them, from what is given: the gripper's open state changes, the arm
// stands still, the end.
std::vector<std::int64_t> stops_of(const Signals& signals) {
  constexpr double kStill = 0.1, kOpenShare = 0.9;
  constexpr int kBuffer = 4;
  const std::int64_t count = frames_of(signals);
  const Eigen::VectorXd opening = signals.opening();
  const double widest = count > 0 ? opening.maxCoeff() : 0;
  const auto open = [&](std::int64_t i) { return opening((i + count) % count) > kOpenShare * widest; };
  std::vector<std::int64_t> stops;
  int buffer = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const bool steady = i < count - 2 && open(i) == open(i + 1) && open(i) == open(i - 1) && open(i - 1) == open(i - 2);
    const bool still = signals.velocity.row(i).cwiseAbs().maxCoeff() <= kStill;
    const bool stop = buffer <= 0 && i != count - 2 && steady && still;
    buffer = stop ? kBuffer : buffer - 1;
    if (i != 0 && (open(i) != open(i - 1) || i == count - 1 || stop)) stops.push_back(i);
  }
  if (stops.size() > 1 && stops.back() - 1 == stops[stops.size() - 2]) stops.erase(stops.end() - 2);
  return stops;
}

// Cost of a segment in normal models of mean and variance, each column its own; sums are prepared.
class SegmentCost {
 public:
  explicit SegmentCost(const Eigen::MatrixXd& rows)
      : sums_(Eigen::MatrixXd::Zero(rows.rows() + 1, rows.cols())), squares_(sums_) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      sums_.row(i + 1) = sums_.row(i) + rows.row(i);
      squares_.row(i + 1) = squares_.row(i) + rows.row(i).cwiseAbs2();
    }
  }
  double of(std::int64_t first, std::int64_t end) const {
    constexpr double kLeastVariance =
        0.01;  // of features of deviation 1: what stands still must not be worth everything
    const auto n = static_cast<double>(end - first);
    double cost = 0;
    for (Eigen::Index column = 0; column < sums_.cols(); ++column) {
      const double mean = (sums_(end, column) - sums_(first, column)) / n;
      const double variance = (squares_(end, column) - squares_(first, column)) / n - mean * mean;
      cost += n * std::log(std::max(variance, kLeastVariance));
    }
    return cost;
  }

 private:
  Eigen::MatrixXd sums_, squares_;
};

// PELT: the cuts of least cost + penalty a cut (Killick, Fearnhead, Eckley, JASA 2012,
// doi:10.1080/01621459.2012.737745).
std::vector<std::int64_t> pelt(const Eigen::MatrixXd& rows, double penalty, std::int64_t shortest) {
  const SegmentCost cost(rows);
  const auto count = static_cast<std::int64_t>(rows.rows());
  std::vector<double> best(static_cast<std::size_t>(count) + 1, 0);
  std::vector<std::int64_t> last(static_cast<std::size_t>(count) + 1, 0), candidates = {0};
  best[0] = -penalty;
  for (std::int64_t end = shortest; end <= count; ++end) {
    double least = INFINITY;
    std::vector<double> with;
    for (const std::int64_t from : candidates) {
      with.push_back(best[static_cast<std::size_t>(from)] + cost.of(from, end));
      if (with.back() + penalty < least) least = with.back() + penalty, last[static_cast<std::size_t>(end)] = from;
    }
    best[static_cast<std::size_t>(end)] = least;
    std::vector<std::int64_t> kept;
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (with[i] <= least) kept.push_back(candidates[i]);
    if (const std::int64_t next = end - shortest + 1; next >= shortest) kept.push_back(next);
    candidates = std::move(kept);
  }
  std::vector<std::int64_t> cuts;
  for (std::int64_t at = count; at > 0 && last[static_cast<std::size_t>(at)] > 0;)
    cuts.push_back(at = last[static_cast<std::size_t>(at)]);
  std::reverse(cuts.begin(), cuts.end());
  return cuts;
}

// Where joint speeds, the tip and the hand behave differently. The penalty is the BIC's: two numbers a column and cut.
std::vector<std::int64_t> changes_of(const Signals& signals, const Scale& scale) {
  constexpr std::int64_t kShortest = 12;  // frames
  const Eigen::MatrixXd features = scale.of(motion_features(signals));
  const double frames = std::max<double>(2, static_cast<double>(features.rows()));
  return pelt(features, 2 * static_cast<double>(features.cols()) * std::log(frames), kShortest);
}

Scale scale_of(const std::vector<Signals>& all) {
  std::vector<Eigen::MatrixXd> parts;
  for (const Signals& signals : all) parts.push_back(motion_features(signals));
  return Scale(stacked(parts));
}

}  // namespace

Answers one_segment(const ResearchProblem&, const PlainFile& given) {
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"}))
    add_segments(answers, signals.unit, frames_of(signals), {}, {"all"});
  return answers;
}

Answers equal_parts(const ResearchProblem&, const PlainFile& given) {
  constexpr std::int64_t kLength = 45;  // frames: about a skill
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"})) {
    std::vector<std::int64_t> cuts;
    for (std::int64_t cut = kLength; cut < frames_of(signals); cut += kLength) cuts.push_back(cut);
    add_segments(answers, signals.unit, frames_of(signals), cuts);
  }
  return answers;
}

Answers keyframe_segments(const ResearchProblem&, const PlainFile& given) {
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"}))
    add_segments(answers, signals.unit, frames_of(signals), stops_of(signals));
  return answers;
}

Answers change_points(const ResearchProblem&, const PlainFile& given) {
  constexpr int kNames = 8;  // clusters of segments
  const std::vector<Signals> all = signals_of(given, {"train", "validation", "test"});
  const Scale scale = scale_of(all);
  struct Cut {
    std::size_t episode;
    std::int64_t first, end;
  };
  std::vector<Cut> cuts;
  std::vector<Eigen::MatrixXd> means;
  for (std::size_t i = 0; i < all.size(); ++i) {
    std::vector<std::int64_t> ends = changes_of(all[i], scale);
    ends.push_back(frames_of(all[i]));
    const Eigen::MatrixXd features = scale.of(motion_features(all[i]));
    std::int64_t first = 0;
    for (const std::int64_t end : ends) {
      cuts.push_back({i, first, end});
      means.emplace_back(features.middleRows(first, end - first).colwise().mean());
      first = end;
    }
  }
  const std::vector<int> names = k_means(stacked(means), kNames);
  Answers answers;
  for (std::size_t i = 0; i < cuts.size(); ++i)
    if (all[cuts[i].episode].split == "test")
      answers.rows.rows.push_back(
          {all[cuts[i].episode].unit, cuts[i].first, cuts[i].end, "c" + std::to_string(names[i])});
  return answers;
}

}  // namespace stampede::research
