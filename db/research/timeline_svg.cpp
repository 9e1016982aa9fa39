#include "db/research/timeline_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/error.h"

namespace stampede::research {
namespace {

constexpr double kLeft = 80, kWidth = 1080, kRight = 20;  // pixels
constexpr double kGripperTop = 60, kSpeedTop = 170, kPanel = 90, kBandTop = 280, kBand = 34;
constexpr double kHeight = 420;
constexpr const char* kBandColours[] = {"#8dd3c7", "#fdb462", "#bebada", "#fb8072",
                                        "#80b1d3", "#b3de69", "#fccde5", "#ffffb3"};
constexpr const char* kLineColours[] = {"#1b9e77", "#d95f02", "#7570b3", "#e7298a", "#66a61e", "#a6761d", "#666666"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&')
      result += c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&amp;";
    else
      result += c;
  }
  return result;
}

class Timeline {
 public:
  Timeline(std::int64_t frames, double frame_hz)
      : frames_(static_cast<double>(std::max<std::int64_t>(frames, 1))), hz_(frame_hz) {
    svg_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n<!-- drawn "
        "by stampede -->\n",
        kLeft + kWidth + kRight, kHeight);
  }
  double x(double frame) const { return kLeft + kWidth * frame / frames_; }

  void text(double at_x, double at_y, const std::string& words, const char* anchor = "start") {
    svg_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", at_x, at_y, anchor,
                        escaped(words));
  }
  void panel(double top, const std::string& name, double greatest, const std::string& unit) {
    svg_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#999\"/>\n", kLeft,
                        top, kWidth, kPanel);
    text(kLeft, top - 6, name);
    text(kLeft - 6, top + 10, fmt::format("{:.2g} {}", greatest, unit), "end");
    text(kLeft - 6, top + kPanel, "0", "end");
  }
  void curve(double top, const std::vector<double>& values, double greatest, const char* colour) {
    svg_ += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.3\" points=\"", colour);
    for (std::size_t frame = 0; frame < values.size(); ++frame)
      svg_ += fmt::format("{:.1f},{:.1f} ", x(static_cast<double>(frame)),
                          top + kPanel * (1 - std::min(values[frame] / greatest, 1.0)));
    svg_ += "\"/>\n";
  }
  void band(double top, const LabelledSegment& segment, const char* colour) {
    const double first = x(static_cast<double>(segment.first)), end = x(static_cast<double>(segment.end));
    svg_ += fmt::format("<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\" fill=\"{}\" stroke=\"white\"/>\n",
                        first, top, end - first, kBand, colour);
    if (end - first > 8.0 * static_cast<double>(segment.label.size()))
      text((first + end) / 2, top + kBand / 2 + 5, segment.label, "middle");
  }
  // Through both panels and the bands.
  void mark(std::int64_t frame) {
    svg_ += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\" stroke=\"#d00\" stroke-dasharray=\"4 3\"/>\n",
        x(static_cast<double>(frame)), kGripperTop, kBandTop + kBand);
  }
  // A sample of a curve and its name, a column each, from the right end of a panel's title inwards.
  void legend(double top, const std::vector<std::pair<std::string, const char*>>& curves) {
    std::size_t longest = 0;
    for (const auto& [name, colour] : curves) longest = std::max(longest, name.size());
    const double column = 28 + 6.5 * static_cast<double>(longest);
    double left = kLeft + kWidth - column * static_cast<double>(curves.size());
    for (const auto& [name, colour] : curves) {
      svg_ += fmt::format(
          "<line x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\" stroke=\"{3}\" stroke-width=\"3\"/>\n",
          left, left + 14, top - 10, colour);
      text(left + 18, top - 6, name);
      left += column;
    }
  }
  void seconds() {
    const double whole = frames_ / hz_, step = whole > 40 ? 10 : whole > 16 ? 2 : 1;
    for (double second = 0; second <= whole; second += step)
      text(x(second * hz_), kHeight - 30, fmt::format("{}", second), "middle");
    text(kLeft + kWidth / 2, kHeight - 10, "time, s", "middle");
  }
  std::string finished() { return svg_ + "</svg>\n"; }

 private:
  double frames_, hz_;
  std::string svg_;
};

double greatest_of(const std::vector<double>& values, double least) {
  return values.empty() ? least : std::max(least, *std::max_element(values.begin(), values.end()));
}

std::vector<double> opening_of(const PlainFile& hidden, std::int64_t episode) {
  std::vector<double> values;
  const Rows rows = hidden.query("SELECT frame, opening FROM hands WHERE episode = ?1 ORDER BY hand, frame", {episode});
  for (std::size_t i = 0; i < rows.size() && (i == 0 || rows.integer(i, "frame") > 0); ++i)
    values.push_back(rows.real(i, "opening"));
  return values;
}

// Of the arm, from the base on.
std::vector<std::pair<std::string, std::vector<double>>> speeds_of(const PlainFile& hidden, std::int64_t episode) {
  std::vector<std::pair<std::string, std::vector<double>>> speeds;
  const Rows rows = hidden.query(
      "SELECT joint, velocity FROM joints WHERE episode = ?1 AND arm_joint IS NOT NULL ORDER BY arm_joint, frame",
      {episode});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (speeds.empty() || speeds.back().first != rows.text(i, "joint")) speeds.push_back({rows.text(i, "joint"), {}});
    speeds.back().second.push_back(std::abs(rows.real(i, "velocity")));
  }
  return speeds;
}

void draw_signals(Timeline& timeline, const PlainFile& hidden, std::int64_t episode) {
  const std::vector<double> opening = opening_of(hidden, episode);
  const double widest = greatest_of(opening, 0.01);
  timeline.panel(kGripperTop, "gripper opening", widest, "m");
  timeline.curve(kGripperTop, opening, widest, "#333");
  const auto speeds = speeds_of(hidden, episode);
  double fastest = 0.1;
  for (const auto& [joint, values] : speeds) fastest = greatest_of(values, fastest);
  timeline.panel(kSpeedTop, "speeds of the arm's joints", fastest, "rad/s");
  std::vector<std::pair<std::string, const char*>> curves;
  for (const auto& [joint, values] : speeds) {
    curves.emplace_back(joint.substr(joint.find('.') + 1), kLineColours[curves.size() % std::size(kLineColours)]);
    timeline.curve(kSpeedTop, values, fastest, curves.back().second);
  }
  timeline.legend(kSpeedTop, curves);
}

}  // namespace

OutputKind figure_kind() { return marked_kind("a timeline", "<svg", "<!-- drawn by stampede -->"); }

void draw_timeline(const ScoringJob& job, const Segmentations& truth, const Segmentations& answers) {
  const std::int64_t episode = job.options.figure_episode > 0 ? job.options.figure_episode : truth.begin()->first;
  if (!truth.contains(episode))
    throw Error("--episode", "episode " + std::to_string(episode) + " is not of the test split",
                "leave it out for the first");
  if (!job.hidden.has("joints") || !job.hidden.has("hands"))
    throw Error("--figure", "the hidden part of " + job.problem.name + " holds no joints to draw",
                "it is for segments and segments_supervised");
  const Rows rate = job.hidden.query("SELECT frame_hz FROM episodes WHERE episode = ?1", {episode});
  Timeline timeline(truth.at(episode).frames, rate.real(0, "frame_hz"));
  draw_signals(timeline, job.hidden, episode);
  std::map<std::string, std::size_t> colours;
  const auto bands = [&](double top, const Segmentation& one, const std::string& name) {
    timeline.text(kLeft - 6, top + kBand / 2 + 5, name, "end");
    for (const LabelledSegment& segment : one.segments)
      timeline.band(
          top, segment,
          kBandColours[colours.emplace(segment.label, colours.size()).first->second % std::size(kBandColours)]);
  };
  bands(kBandTop, truth.at(episode), "skills");
  bands(kBandTop + kBand + 8, answers.at(episode), "answered");
  for (const std::int64_t frame : boundaries_of(answers.at(episode))) timeline.mark(frame);
  timeline.text(kLeft, 24,
                fmt::format("{}, episode {}: true skills, and answered boundaries ({}, dashed)", job.problem.name,
                            episode, boundaries_of(answers.at(episode)).size()));
  timeline.seconds();
  OutputFile file(job.options.figure, figure_kind(), job.options.rules);
  file.write(timeline.finished());
  file.finish();
}

}  // namespace stampede::research
