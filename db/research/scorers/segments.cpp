// Segments and their labels against the true ones. Figures: frames between segments count as nothing; boundaries are
// where segments begin or end inside an episode.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "db/research/matching.h"
#include "db/research/scorers/functions.h"
#include "db/research/segmentation.h"
#include "db/research/timeline_svg.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"

namespace stampede::research {
namespace {

struct Both {
  const Segmentation& truth;
  const Segmentation& answer;
};

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }
double f1_of(double hits, double answered, double there) { return share(2 * hits, answered + there); }

// Each true boundary with one answered at most: in order, the first that is near enough.
double matched_boundaries(const Both& both, std::int64_t tolerance) {
  const std::vector<std::int64_t> truth = boundaries_of(both.truth), answer = boundaries_of(both.answer);
  double hits = 0;
  for (std::size_t i = 0, j = 0; i < truth.size() && j < answer.size();) {
    if (std::abs(truth[i] - answer[j]) <= tolerance)
      ++hits, ++i, ++j;
    else if (answer[j] < truth[i])
      ++j;
    else
      ++i;
  }
  return hits;
}

void add_boundary_figures(const std::vector<Both>& all, std::vector<Figure>& figures) {
  double there = 0, answered = 0;
  for (const Both& both : all) {
    there += static_cast<double>(boundaries_of(both.truth).size());
    answered += static_cast<double>(boundaries_of(both.answer).size());
  }
  for (const int tolerance : {2, 5, 10}) {
    double hits = 0;
    for (const Both& both : all) hits += matched_boundaries(both, tolerance);
    const std::string within = "_within_" + std::to_string(tolerance),
                      words = " within " + std::to_string(tolerance) + " frames";
    figures.push_back({"precision" + within, share(hits, answered), "boundaries answered that are true," + words});
    figures.push_back({"recall" + within, share(hits, there), "true boundaries found," + words});
    figures.push_back({"f1" + within, f1_of(hits, answered, there), "F1 of boundaries," + words});
  }
}

double overlap(const LabelledSegment& a, const LabelledSegment& b) {
  const auto common = static_cast<double>(std::min(a.end, b.end) - std::max(a.first, b.first));
  return common <= 0 ? 0 : common / static_cast<double>(std::max(a.end, b.end) - std::min(a.first, b.first));
}

double mean_iou(const std::vector<Both>& all) {
  double sum = 0, count = 0;
  for (const Both& both : all)
    for (const LabelledSegment& segment : both.truth.segments) {
      double best = 0;
      for (const LabelledSegment& other : both.answer.segments) best = std::max(best, overlap(segment, other));
      sum += best, ++count;
    }
  return share(sum, count);
}

// As Lea et al. count: each answered segment takes the true one of its label that it overlaps most, each of which is
// taken once.
double segment_f1(const std::vector<Both>& all, double least) {
  double hits = 0, there = 0, answered = 0;
  for (const Both& both : all) {
    std::vector<bool> taken(both.truth.segments.size(), false);
    for (const LabelledSegment& segment : both.answer.segments) {
      double best = 0;
      std::size_t which = 0;
      for (std::size_t i = 0; i < taken.size(); ++i) {
        const LabelledSegment& other = both.truth.segments[i];
        const double shared = other.label == segment.label ? overlap(segment, other) : 0;
        if (shared > best) best = shared, which = i;
      }
      if (best >= least && !taken[which]) taken[which] = true, ++hits;
    }
    there += static_cast<double>(both.truth.segments.size());
    answered += static_cast<double>(both.answer.segments.size());
  }
  return f1_of(hits, answered, there);
}

std::vector<std::string> labels_in_order(const Segmentation& one) {
  std::vector<std::string> labels;
  for (const LabelledSegment& segment : one.segments) labels.push_back(segment.label);
  return labels;
}

// 1 - edit distance by the longer sequence, mean over episodes.
double edit_score(const std::vector<Both>& all) {
  double sum = 0;
  for (const Both& both : all) {
    const std::vector<std::string> a = labels_in_order(both.truth), b = labels_in_order(both.answer);
    std::vector<double> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<double>(j);
    for (std::size_t i = 1; i <= a.size(); ++i) {
      double diagonal = std::exchange(row[0], static_cast<double>(i));
      for (std::size_t j = 1; j <= b.size(); ++j) {
        const double above = row[j];
        row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
        diagonal = above;
      }
    }
    const auto longest = static_cast<double>(std::max(a.size(), b.size()));
    sum += longest > 0 ? 1 - row[b.size()] / longest : 1;
  }
  return share(sum, static_cast<double>(all.size()));
}

// Frames by answered and true label; frames in no true segment are left out, those in no answered one have the label
// "".
struct LabelCounts {
  std::vector<std::string> answered, there;
  Eigen::MatrixXd counts;
};

LabelCounts label_counts(const std::vector<Both>& all) {
  std::set<std::string> answered = {""}, there;
  for (const Both& both : all) {
    for (const LabelledSegment& segment : both.answer.segments) answered.insert(segment.label);
    for (const LabelledSegment& segment : both.truth.segments) there.insert(segment.label);
  }
  LabelCounts result{{answered.begin(), answered.end()}, {there.begin(), there.end()}, {}};
  result.counts.setZero(static_cast<Eigen::Index>(answered.size()), static_cast<Eigen::Index>(there.size()));
  const auto place = [](const std::vector<std::string>& names, const std::string& name) {
    return static_cast<Eigen::Index>(std::lower_bound(names.begin(), names.end(), name) - names.begin());
  };
  for (const Both& both : all) {
    const std::vector<int> truth = segment_of_frames(both.truth), answer = segment_of_frames(both.answer);
    for (std::size_t frame = 0; frame < truth.size(); ++frame) {
      if (truth[frame] < 0) continue;
      const std::string label =
          answer[frame] < 0 ? "" : both.answer.segments[static_cast<std::size_t>(answer[frame])].label;
      ++result.counts(place(result.answered, label),
                      place(result.there, both.truth.segments[static_cast<std::size_t>(truth[frame])].label));
    }
  }
  return result;
}

// The learner's names become ours where they are matched; a name of its own that is ours by chance must not count.
void rename(Segmentations& answers, const std::vector<Both>& all) {
  const LabelCounts counts = label_counts(all);
  const std::vector<int> match = best_matching(counts.counts);
  std::map<std::string, std::string> names;
  for (std::size_t i = 0; i < match.size(); ++i)
    names[counts.answered[i]] = match[i] < 0 || counts.answered[i].empty()
                                    ? "?" + counts.answered[i]
                                    : counts.there[static_cast<std::size_t>(match[i])];
  for (auto& [episode, one] : answers)
    for (LabelledSegment& segment : one.segments) segment.label = names.at(segment.label);
}

double frames_right(const LabelCounts& counts) {
  double right = 0;
  for (std::size_t i = 0; i < counts.answered.size(); ++i)
    for (std::size_t j = 0; j < counts.there.size(); ++j)
      if (counts.answered[i] == counts.there[j])
        right += counts.counts(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  return share(right, counts.counts.sum());
}

void check_labels(const ScoringJob& job, const std::string& column, const Segmentations& answers) {
  const std::string table = column == "motion" ? "controls" : "skills";
  const Rows rows = job.hidden.query("SELECT DISTINCT " + column + " AS label FROM " + table + " ORDER BY 1");
  std::vector<std::string> known;
  for (std::size_t i = 0; i < rows.size(); ++i) known.push_back(rows.text(i, "label"));
  for (const auto& [episode, one] : answers)
    for (const LabelledSegment& segment : one.segments)
      if (std::find(known.begin(), known.end(), segment.label) == known.end())
        throw Error(
            job.answers.where,
            "the label '" + segment.label + "' of episode " + std::to_string(episode) + " is none of this data set's",
            did_you_mean(segment.label, known));
}

}  // namespace

std::vector<Figure> score_segments(const ScoringJob& job) {
  const AnswerColumn& label = job.problem.answer.back();
  const Segmentations truth = true_segments(job.hidden, job.test_units, label.name);
  Segmentations answers = answered_segments(job, label.name);
  if (!job.options.figure.empty()) draw_timeline(job, truth, answers);
  std::vector<Both> all;
  for (const auto& [episode, one] : truth) all.push_back({one, answers.at(episode)});
  std::vector<Figure> figures;
  add_boundary_figures(all, figures);
  figures.push_back({"mean_iou", mean_iou(all), "of each true segment the best overlap with any answered one"});
  bool labelled = false;
  for (const auto& [episode, one] : answers)
    for (const LabelledSegment& segment : one.segments) labelled = labelled || !segment.label.empty();
  if (!labelled) return figures;  // boundaries alone
  figures.push_back(
      {"nmi", normalised_mutual_information(label_counts(all).counts), "mutual information of labels over frames"});
  if (label.optional)
    rename(answers, all);
  else
    check_labels(job, label.name, answers);
  figures.push_back({"frames_right", frames_right(label_counts(all)), "share of frames with the right label (MoF)"});
  figures.push_back({"edit", edit_score(all), "1 - edit distance of the sequences of labels by the longer one"});
  for (const int percent : {10, 25, 50})
    figures.push_back({"f1_at_" + std::to_string(percent), segment_f1(all, percent / 100.0),
                       "F1 of labelled segments that overlap by " + std::to_string(percent) + " % at least"});
  return figures;
}

}  // namespace stampede::research
