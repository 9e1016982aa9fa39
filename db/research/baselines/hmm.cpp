// A supervised baseline: a hidden Markov model whose states are the phases of each label, learned by counting.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "db/research/baselines/functions.h"
#include "db/research/check_dataset.h"
#include "db/research/segmentation.h"
#include "db/research/signals.h"

namespace stampede::research {
namespace {

constexpr int kPhases = 4;  // of a segment, of equal length in training
constexpr double kLeast = -1e9;

// Labels in order; the first is for frames of no segment.
struct Model {
  std::vector<std::string> labels = {""};
  Eigen::MatrixXd mean, deviation;  // a row a state: kPhases of each label
  Eigen::MatrixXd stay;             // log probabilities of a state: to stay, to leave
  Eigen::MatrixXd follow;           // of labels: which comes after which
  Eigen::VectorXd begin;            // of labels
  Eigen::Index states() const { return static_cast<Eigen::Index>(labels.size()) * kPhases; }
};

int label_place(const Model& model, const std::string& label) {
  return static_cast<int>(std::find(model.labels.begin(), model.labels.end(), label) - model.labels.begin());
}

// Segments and the gaps between them.
std::vector<LabelledSegment> with_gaps(const Segmentation& one) {
  std::vector<LabelledSegment> all;
  std::int64_t at = 0;
  for (const LabelledSegment& segment : one.segments) {
    if (segment.first > at) all.push_back({at, segment.first, ""});
    all.push_back(segment);
    at = segment.end;
  }
  if (at < one.frames) all.push_back({at, one.frames, ""});
  return all;
}

int phase_of(const LabelledSegment& segment, std::int64_t frame) {
  return static_cast<int>((frame - segment.first) * kPhases / (segment.end - segment.first));
}

struct Sums {
  Eigen::MatrixXd values, squares;
  Eigen::VectorXd frames, visits;
  Eigen::MatrixXd follow;
  Eigen::VectorXd begin;
};

void count_episode(const Model& model, const Eigen::MatrixXd& features, const Segmentation& truth, Sums& sums) {
  int before = -1;
  for (const LabelledSegment& segment : with_gaps(truth)) {
    const int label = label_place(model, segment.label);
    ++(before < 0 ? sums.begin(label) : sums.follow(before, label));
    before = label;
    int last = -1;
    for (std::int64_t frame = segment.first; frame < segment.end; ++frame) {
      const int state = label * kPhases + phase_of(segment, frame);
      sums.values.row(state) += features.row(frame), sums.squares.row(state) += features.row(frame).cwiseAbs2();
      ++sums.frames(state);
      if (state != last) ++sums.visits(state);
      last = state;
    }
  }
}

Model learn(const PlainFile& given, const std::vector<Signals>& all, const Segmentations& truth, const Scale& scale) {
  Model model;
  for (const auto& [episode, one] : truth)
    for (const LabelledSegment& segment : one.segments)
      if (label_place(model, segment.label) == static_cast<int>(model.labels.size()))
        model.labels.push_back(segment.label);
  std::sort(model.labels.begin(), model.labels.end());
  const auto labels = static_cast<Eigen::Index>(model.labels.size());
  const Eigen::Index states = model.states(), width = scale.mean.cols();
  Sums sums{Eigen::MatrixXd::Zero(states, width),
            Eigen::MatrixXd::Zero(states, width),
            Eigen::VectorXd::Zero(states),
            Eigen::VectorXd::Zero(states),
            Eigen::MatrixXd::Constant(labels, labels, 0.01),
            Eigen::VectorXd::Constant(labels, 0.01)};
  for (const Signals& signals : all) {
    if (truth.at(signals.unit).frames > signals.hand.rows())
      refuse_unfit(given, "episode " + std::to_string(signals.unit) + " lacks joints of some frames");
    count_episode(model, scale.of(motion_features(signals)), truth.at(signals.unit), sums);
  }
  model.mean.setZero(states, width), model.deviation.setOnes(states, width), model.stay.setZero(states, 2);
  for (Eigen::Index state = 0; state < states; ++state) {
    const double frames = std::max(sums.frames(state), 1.0);
    model.mean.row(state) = sums.values.row(state) / frames;
    model.deviation.row(state) =
        (sums.squares.row(state) / frames - model.mean.row(state).cwiseAbs2()).cwiseMax(0.02).cwiseSqrt();
    const double leave = std::clamp(sums.visits(state) / frames, 0.001, 0.999);
    model.stay.row(state) << std::log(1 - leave), std::log(leave);
    if (sums.frames(state) == 0) model.stay.row(state).setConstant(kLeast);  // never seen: never used
  }
  model.follow = sums.follow.array().colwise() / sums.follow.rowwise().sum().array();
  model.follow = model.follow.array().log();
  model.begin = (sums.begin / sums.begin.sum()).array().log();
  return model;
}

// Log likelihoods of frames in states.
Eigen::MatrixXd emissions(const Model& model, const Eigen::MatrixXd& features) {
  Eigen::MatrixXd logs(features.rows(), model.states());
  for (Eigen::Index state = 0; state < model.states(); ++state) {
    const Eigen::ArrayXXd away =
        (features.rowwise() - model.mean.row(state)).array().rowwise() / model.deviation.row(state).array();
    logs.col(state) = -0.5 * away.square().rowwise().sum() - model.deviation.row(state).array().log().sum();
  }
  return logs;
}

// The most likely states (Viterbi 1967, doi:10.1109/TIT.1967.1054010): each phase is passed in order.
std::vector<int> most_likely(const Model& model, const Eigen::MatrixXd& logs) {
  const Eigen::Index frames = logs.rows(), states = model.states(), labels = states / kPhases;
  Eigen::VectorXd score = Eigen::VectorXd::Constant(states, kLeast);
  for (Eigen::Index label = 0; label < labels; ++label)
    score(label * kPhases) = model.begin(label) + logs(0, label * kPhases);
  Eigen::MatrixXi from(frames, states);
  for (Eigen::Index frame = 1; frame < frames; ++frame) {
    Eigen::VectorXd next(states);
    for (Eigen::Index state = 0; state < states; ++state) {
      double best = score(state) + model.stay(state, 0);
      from(frame, state) = static_cast<int>(state);
      const auto consider = [&](Eigen::Index other, double log) {
        if (score(other) + log > best) best = score(other) + log, from(frame, state) = static_cast<int>(other);
      };
      if (state % kPhases > 0) consider(state - 1, model.stay(state - 1, 1));
      for (Eigen::Index label = 0; state % kPhases == 0 && label < labels; ++label) {
        const Eigen::Index end = label * kPhases + kPhases - 1;
        if (end != state) consider(end, model.stay(end, 1) + model.follow(label, state / kPhases));
      }
      next(state) = best + logs(frame, state);
    }
    score = next;
  }
  std::vector<int> path(static_cast<std::size_t>(frames));
  Eigen::Index state = 0;
  score.maxCoeff(&state);
  for (Eigen::Index frame = frames; frame-- > 0;) {
    path[static_cast<std::size_t>(frame)] = static_cast<int>(state);
    if (frame > 0) state = from(frame, state);
  }
  return path;
}

}  // namespace

Answers hidden_markov(const ResearchProblem& problem, const PlainFile& given) {
  const std::vector<Signals> training = signals_of(given, {"train", "validation"});
  std::vector<std::int64_t> episodes;
  std::vector<Eigen::MatrixXd> features;
  for (const Signals& signals : training) {
    episodes.push_back(signals.unit);
    features.push_back(motion_features(signals));
  }
  const Scale scale(stacked(features));
  const Model model = learn(given, training, true_segments(given, episodes, problem.answer.back().name), scale);
  Answers answers;
  for (const Signals& signals : signals_of(given, {"test"})) {
    if (signals.frames.empty()) continue;
    const std::vector<int> path = most_likely(model, emissions(model, scale.of(motion_features(signals))));
    std::int64_t first = 0;
    for (std::int64_t frame = 1; frame <= static_cast<std::int64_t>(path.size()); ++frame) {
      const int state = path[static_cast<std::size_t>(frame) - 1];
      const bool ends = frame == static_cast<std::int64_t>(path.size()) ||
                        path[static_cast<std::size_t>(frame)] / kPhases != state / kPhases ||
                        path[static_cast<std::size_t>(frame)] < state;
      if (!ends) continue;
      const std::string& label = model.labels[static_cast<std::size_t>(state / kPhases)];
      if (!label.empty()) answers.rows.rows.push_back({signals.unit, first, frame, label});
      first = frame;
    }
  }
  return answers;
}

}  // namespace stampede::research
