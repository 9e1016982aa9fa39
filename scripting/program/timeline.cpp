#include "scripting/program/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/text.h"
#include "engine/rollout/goal_watch.h"
#include "scripting/program/console.h"

namespace stampede::program {
namespace {

std::string fact_text(const Fact& fact) {
  return fact.arguments.empty() ? fact.predicate : fact.predicate + "(" + joined(fact.arguments) + ")";
}

std::string call_text(const SegmentRecord& segment) {
  std::string text = segment.skill;
  if (!segment.case_name.empty()) text += ":" + segment.case_name;
  for (const std::string& argument : segment.arguments) text += " " + argument;
  return text;
}

// Maps steps to columns of the right-hand side.
class Painter {
 public:
  Painter(const EpisodeRecord& episode, const TimelineStyle& style)
      : episode_(episode),
        label_(std::clamp(style.width * 2 / 5, 24, 44)),
        columns_(std::max(20, style.width - label_ - 16)),
        steps_(std::max<std::int64_t>(1, episode.steps)) {}

  double seconds(std::int64_t step) const { return static_cast<double>(step) / episode_.physics_hz; }
  int label() const { return label_; }

  std::string line(const std::string& label, std::int64_t start, std::int64_t end, const char* ink,
                   const std::vector<std::int64_t>& marks = {}) const {
    std::vector<std::string> cells(static_cast<std::size_t>(columns_), " ");
    const int first = column(start), last = std::max(first + 1, column(end));
    for (int c = first; c < std::min(last, columns_); ++c) cells[static_cast<std::size_t>(c)] = ink;
    for (const std::int64_t mark : marks) cells[static_cast<std::size_t>(std::min(column(mark), columns_ - 1))] = "◆";
    std::string text =
        padded(clipped(label, label_), label_) + fmt::format(" {:6.2f} {:6.2f} ", seconds(start), seconds(end));
    for (const std::string& cell : cells) text += cell;
    while (text.back() == ' ') text.pop_back();
    return text + "\n";
  }

  std::string ruler() const {
    const double total = seconds(steps_);
    double tick = 1;
    for (const double candidate : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0}) {
      tick = candidate;
      if (total / candidate * 8 <= columns_) break;
    }
    std::string numbers(static_cast<std::size_t>(columns_ + 8), ' ');
    std::vector<std::string> marks(static_cast<std::size_t>(columns_), "─");
    for (double t = 0; t <= total; t += tick) {
      const int at = std::min(column(static_cast<std::int64_t>(std::lround(t * episode_.physics_hz))), columns_ - 1);
      const std::string number = fmt::format("{:g}", t);
      numbers.replace(static_cast<std::size_t>(at), number.size(), number);
      marks[static_cast<std::size_t>(at)] = "┬";
    }
    while (numbers.back() == ' ') numbers.pop_back();
    return padded("", label_) + "   from     to " + numbers + "\n" + padded("", label_ + 15) + joined(marks, "") + "\n";
  }

 private:
  int column(std::int64_t step) const {
    const double share = static_cast<double>(step) / static_cast<double>(steps_);
    return static_cast<int>(share * columns_ + 1e-9);
  }
  const EpisodeRecord& episode_;
  int label_, columns_;
  std::int64_t steps_;
};

std::string header(const EpisodeRecord& episode, const TimelineStyle& style) {
  std::string text = style.title.empty() ? "" : style.title + "\n";
  text += episode.task + (episode.variation.empty() ? "" : " (" + episode.variation + ")");
  text += episode.real
              ? fmt::format(", recorded, world {}\n", episode.world)
              : fmt::format(", seed {}, {}, world {}\n", episode.seed, to_string(episode.made.split), episode.world);
  for (const LanguageRecord& language : episode.labels.language) {
    if (language.level != LanguageLevel::task) continue;
    text += "“" + language.text + "”\n";
    break;
  }
  const double seconds = episode.duration_s();
  if (episode.outcome == Outcome::success) {
    text += fmt::format("✓ success after {:.2f} s", seconds);
  } else {
    text +=
        fmt::format("✗ failure after {:.2f} s: {}, {}", seconds, to_string(episode.reason), describe(episode.reason));
    if (!episode.detail.empty()) text += " (" + episode.detail + ")";
  }
  text += fmt::format("; {} frames, {} undone tries\n", episode.frames.size(), episode.labels.attempts.size());
  return text;
}

// Facts that began or ended inside the span, as `+ on(a, b)` and `− holding(hand, a)`.
std::string changes(const EpisodeRecord& episode, const Span& span) {
  std::vector<std::string> texts;
  for (const FactRecord& fact : episode.labels.facts) {
    if (!fact.open_end && fact.end_step > span.start_step && fact.end_step <= span.end_step) {
      texts.push_back("− " + fact_text(fact.fact));
    }
  }
  for (const FactRecord& fact : episode.labels.facts) {
    if (!fact.open_start && fact.start_step > span.start_step && fact.start_step <= span.end_step) {
      texts.push_back("+ " + fact_text(fact.fact));
    }
  }
  return joined(texts, "  ");
}

std::string parameters_text(const SegmentRecord& segment) {
  std::vector<std::string> texts;
  for (const ParameterRecord& parameter : segment.parameters) {
    if (parameter.values.size() > 1) continue;  // poses say nothing to a reader
    std::string text = parameter.name + " = ";
    text += parameter.values.empty() ? parameter.text : fmt::format("{:.4g}", parameter.values[0]);
    if (!parameter.unit.empty()) text += " " + parameter.unit;
    if (parameter.chosen_by != ChosenBy::default_value)
      text += " (" + std::string(to_string(parameter.chosen_by)) + ")";
    texts.push_back(text);
  }
  return joined(texts);
}

std::string verdict(const SegmentRecord& segment) {
  if (segment.outcome == Outcome::success) return "✓";
  return "✗";
}

std::string failure_text(const SegmentRecord& segment) {
  std::string text(to_string(segment.reason));
  if (!segment.detail.empty()) text += ": " + segment.detail;
  if (!segment.missing_effects.empty()) text += "; did not come true: " + joined(segment.missing_effects);
  return text;
}

// Of a call that was made all the same: what it asked for and was not so.
std::string unmet_text(const SegmentRecord& segment) {
  std::vector<std::string> texts;
  for (const PreconditionRecord& literal : segment.preconditions)
    if (!literal.held && literal.choice < 0) texts.push_back((literal.negated ? "not " : "") + fact_text(literal.fact));
  return texts.empty() ? "" : "before it was false: " + joined(texts);
}

// Writes an episode line by line, below its header.
class TimelineWriter {
 public:
  TimelineWriter(const EpisodeRecord& episode, const TimelineStyle& style)
      : episode_(episode), style_(style), painter_(episode, style) {}

  std::string write() {
    text_ = header(episode_, style_) + "\n" + painter_.ruler();
    for (const SegmentRecord& segment : episode_.labels.segments)
      if (segment.parent < 0) add_segment(segment, 0);
    add_undone(static_cast<int>(episode_.labels.segments.size()), 2);
    text_ += "\nfacts\n";
    add_facts();
    return std::move(text_);
  }

 private:
  void add_note(const std::string& text, int indent) {
    if (text.empty()) return;
    text_ += std::string(static_cast<std::size_t>(indent), ' ') + wrapped(text, style_.width, indent) + "\n";
  }

  void add_undone(int before_segment, int indent) {
    for (const AttemptRecord& attempt : episode_.labels.attempts) {
      if (attempt.before_segment != before_segment) continue;
      const Span& span = attempt.segment.span;
      const double seconds = static_cast<double>(span.end_step - span.start_step) / episode_.physics_hz;
      add_note(fmt::format("↶ undone after {:.2f} s: {} ({})", seconds, call_text(attempt.segment),
                           failure_text(attempt.segment)),
               indent);
    }
  }

  void add_segment(const SegmentRecord& segment, int depth) {
    const int indent = 2 * depth;
    const bool skill = segment.kind != SegmentKind::motion || segment.skill == kHold;  // what can fail by itself
    add_undone(segment.ordinal, indent + 2);
    std::vector<std::int64_t> marks;
    std::string passed;
    for (const ViaRecord& via : episode_.labels.vias) {
      if (via.segment != segment.ordinal) continue;
      marks.push_back(via.step);
      passed += (passed.empty() ? "◆ " : ", ") +
                fmt::format("{} passed at {:.2f} s, {:.2f} rad/s", via.name, painter_.seconds(via.step), via.speed);
    }
    const std::string label = std::string(static_cast<std::size_t>(indent), ' ') +
                              (skill ? verdict(segment) + " " : "· ") + call_text(segment);
    text_ += painter_.line(label, segment.span.start_step, segment.span.end_step, skill ? "█" : "▂", marks);
    add_note(passed, indent + 4);
    if (skill && segment.outcome != Outcome::success) add_note(failure_text(segment), indent + 4);
    if (segment.kind == SegmentKind::skill) {
      add_note(unmet_text(segment), indent + 4);
      add_note(changes(episode_, segment.span), indent + 4);
      add_note(parameters_text(segment), indent + 4);
    }
    for (const SegmentRecord& child : episode_.labels.segments)
      if (child.parent == segment.ordinal) add_segment(child, depth + 1);
  }

  void add_facts() {
    std::size_t constant = 0;
    for (const FactRecord& fact : episode_.labels.facts) {
      if (fact.open_start && fact.open_end && !style_.constant_facts) {
        ++constant;
        continue;
      }
      text_ += painter_.line(fact_text(fact.fact), fact.start_step, fact.end_step, fact.observed ? "▒" : "░");
    }
    if (constant > 0) text_ += fmt::format("and {} facts that held throughout (--all shows them)\n", constant);
  }

  const EpisodeRecord& episode_;
  const TimelineStyle& style_;
  Painter painter_;
  std::string text_;
};

}  // namespace

std::string timeline(const EpisodeRecord& episode, const TimelineStyle& style) {
  return TimelineWriter(episode, style).write();
}

}  // namespace stampede::program
