#include "db/recording/label_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "db/recording/label_rows.h"
#include "engine/base/nearest.h"

namespace stampede {
namespace {

constexpr std::size_t kMostArguments = 4;

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> all = {"subgoal", "skill", "motion", "fact", "language"};
  return all;
}

void check_word(const std::string& word, const std::string& place) {
  if (word.empty() || word.find_first_of(" ()\t\n\"") != std::string::npos)
    throw Error(place, "'" + word + "' cannot be a name", "names hold no spaces, quotes or brackets");
}

class LabelReader {
 public:
  LabelReader(const EpisodeRecord& episode, std::vector<LabelRow> rows, const LabelClock& clock)
      : episode_(episode),
        rows_(std::move(rows)),
        ticks_(episode.physics_hz / episode.frame_hz),
        frames_(static_cast<std::int64_t>(episode.frames.size())),
        own_hz_(clock.recording == nullptr ? episode.frame_hz : clock.frames.hz),
        own_frames_(clock.recording == nullptr ? frames_ : static_cast<std::int64_t>(clock.frames.count)) {}
  Labels read() {
    for (const LabelRow& row : rows_) {
      if (std::find(kinds().begin(), kinds().end(), row.kind) == kinds().end())
        throw Error(row.place, "there is no kind of label '" + row.kind + "'", did_you_mean(row.kind, kinds()));
      labeller(row);
      if (segment_kind_from(row.kind)) add_segment(row);
      if (row.kind == "fact") add_fact(row);
    }
    order_segments();
    for (const LabelRow& row : rows_)
      if (row.kind == "language") add_sentence(row);
    return std::move(labels_);
  }

 private:
  static Labeller labeller(const LabelRow& row) {
    const auto found = labeller_from(row.labelled_by);
    if (found && *found != Labeller::simulator) return *found;
    throw Error(row.place, "'" + row.labelled_by + "' cannot have labelled it", "write person or model");
  }

  std::int64_t step_of(double time, const LabelRow& row) const {
    const double last = static_cast<double>(episode_.steps) / episode_.physics_hz;
    if (!(time >= 0)) throw Error(row.place, "it begins before the first frame", "seconds count from frame 0");
    if (time > last + 1.0 / episode_.frame_hz)
      throw Error(row.place, "it ends after the episode, whose last frame is at " + std::to_string(last) + " s",
                  "seconds count from frame 0, not from the beginning of the recording");
    return std::min<std::int64_t>(std::llround(time * episode_.physics_hz), episode_.steps);
  }
  void check_frame(std::int64_t frame, const LabelRow& row) const {
    if (frame < 0 || frame > own_frames_)
      throw Error(row.place,
                  "there is no frame " + std::to_string(frame) + ": at " + std::to_string(own_hz_) +
                      " frames a second there are " + std::to_string(own_frames_),
                  "frames count from 0, and end_frame is " + std::to_string(own_frames_) +
                      " at most; or give start_s and end_s");
  }
  std::int64_t step_of_frame(std::int64_t frame) const {
    const double step = static_cast<double>(frame) * episode_.physics_hz / own_hz_;
    return std::min<std::int64_t>(std::llround(step), episode_.steps);
  }
  std::int64_t frame_from(std::int64_t step) const { return (step + ticks_ - 1) / ticks_; }

  // Of a row without a span: the whole episode, where that is allowed.
  Span span_of(const LabelRow& row, bool may_be_missing) const {
    const LabelSpan& given = row.span;
    if (!given.given()) {
      if (may_be_missing) return {0, episode_.steps, 0, frames_};
      throw Error(row.place, "it has no span", "give start_s and end_s, or first_frame and end_frame");
    }
    Span span;
    if (given.start_s && given.end_s && !given.first_frame && !given.end_frame) {
      span.start_step = step_of(*given.start_s, row), span.end_step = step_of(*given.end_s, row);
      span.first_frame = frame_from(span.start_step);
      span.end_frame = span.end_step == episode_.steps ? frames_ : frame_from(span.end_step);
    } else if (given.first_frame && given.end_frame && !given.start_s && !given.end_s) {
      check_frame(*given.first_frame, row), check_frame(*given.end_frame, row);
      span.start_step = step_of_frame(*given.first_frame), span.end_step = step_of_frame(*given.end_frame);
      span.first_frame = *given.first_frame == own_frames_ ? frames_ : frame_from(span.start_step);
      span.end_frame = *given.end_frame == own_frames_ ? frames_ : frame_from(span.end_step);
      if (span.start_step == episode_.steps && *given.first_frame < *given.end_frame)
        throw Error(
            row.place, "it begins at the last frame, where the episode ends",
            "begin it a frame earlier" + std::string(own_hz_ == episode_.frame_hz ? "" : ", or leave --frame-hz out"));
    } else {
      throw Error(row.place, "its span is given in part, or twice",
                  "give start_s and end_s, or first_frame and end_frame");
    }
    if (span.start_step >= span.end_step)
      throw Error(row.place, "it ends before it has begun", "end_s lies after start_s");
    return span;
  }

  void add_segment(const LabelRow& row) {
    SegmentRecord segment;
    segment.kind = *segment_kind_from(row.kind);
    check_word(row.name, row.place);
    for (const std::string& word : row.arguments) check_word(word, row.place);
    segment.skill = row.name;
    segment.arguments = row.arguments;
    segment.robot =
        episode_.scene.hands.empty() ? "" : episode_.scene.hands[0].substr(0, episode_.scene.hands[0].find('.'));
    segment.span = span_of(row, false);
    if (row.outcome != "success" && row.outcome != "failure")
      throw Error(row.place, "there is no outcome '" + row.outcome + "'", "write success or failure");
    if (row.outcome == "failure") {
      segment.outcome = Outcome::failure;
      segment.reason = reason_from(row.reason.empty() ? "failed_by_task" : row.reason).value_or(Reason::none);
      if (segment.reason == Reason::none)
        throw Error(row.place, "there is no reason '" + row.reason + "'", did_you_mean(row.reason, failure_reasons()));
    }
    segment.label = row.text;
    segment.labelled_by = labeller(row);
    segment.ordinal = static_cast<int>(labels_.segments.size());  // in the file
    labels_.segments.push_back(std::move(segment));
    segment_rows_.push_back(&row);
  }

  const LabelRow& row_of(const SegmentRecord& segment) const {
    return *segment_rows_[static_cast<std::size_t>(segment.ordinal)];
  }

  // Before what lies across another is complained of: parts of a segment lie across what it overlaps. In the order of
  // starts, only the one before of the same kind can be met.
  void refuse_overlaps() const {
    std::map<SegmentKind, const SegmentRecord*> before;
    for (const SegmentRecord& segment : labels_.segments) {
      const auto [found, first] = before.try_emplace(segment.kind, &segment);
      if (!first && found->second->span.end_step > segment.span.start_step)
        throw Error(row_of(segment).place,
                    "it overlaps the " + std::string(to_string(segment.kind)) + " " + found->second->skill,
                    "one of a kind runs at a time");
      found->second = &segment;
    }
  }

  // Of those of one kind, which do not overlap and are in the order of starts: the one that holds `segment`, -1 where
  // none meets it.
  int holder(const SegmentRecord& segment, const std::vector<int>& of_kind) const {
    const std::vector<SegmentRecord>& list = labels_.segments;
    const auto span = [&](int at) -> const Span& { return list[static_cast<std::size_t>(at)].span; };
    auto next = std::upper_bound(of_kind.begin(), of_kind.end(), segment.span.start_step,
                                 [&](std::int64_t step, int at) { return step < span(at).end_step; });
    if (next == of_kind.end() || span(*next).start_step >= segment.span.end_step) return -1;
    if (segment.span.start_step < span(*next).start_step || segment.span.end_step > span(*next).end_step) {
      const SegmentRecord& other = list[static_cast<std::size_t>(*next)];
      throw Error(row_of(segment).place,
                  "it lies partly within the " + std::string(to_string(other.kind)) + " " + other.skill,
                  "let it begin and end within it, or outside");
    }
    return *next;
  }

  // By start, then depth; each part of the innermost that holds it.
  void order_segments() {
    std::vector<SegmentRecord>& list = labels_.segments;
    std::stable_sort(list.begin(), list.end(), [](const SegmentRecord& a, const SegmentRecord& b) {
      return std::tie(a.span.start_step, a.kind) < std::tie(b.span.start_step, b.kind);
    });
    refuse_overlaps();
    std::map<SegmentKind, std::vector<int>> of_kind;
    for (std::size_t i = 0; i < list.size(); ++i) of_kind[list[i].kind].push_back(static_cast<int>(i));
    ordinal_of_.resize(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      ordinal_of_[static_cast<std::size_t>(list[i].ordinal)] = static_cast<int>(i);
      for (const auto& [kind, places] : of_kind)  // the outermost first
        if (kind < list[i].kind)
          if (const int whole = holder(list[i], places); whole >= 0) list[i].parent = whole;
      places_.try_emplace({list[i].kind, list[i].span.start_step, list[i].span.end_step}, static_cast<int>(i));
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
      const LabelRow& row = *segment_rows_[static_cast<std::size_t>(list[i].ordinal)];
      list[i].ordinal = static_cast<int>(i);
      if (!list[i].label.empty()) say(row, *language_level_from(row.kind), static_cast<int>(i), list[i].label);
    }
  }

  void add_fact(const LabelRow& row) {
    FactRecord fact;
    check_word(row.name, row.place);
    for (const std::string& word : row.arguments) check_word(word, row.place);
    if (row.arguments.size() > kMostArguments)
      throw Error(row.place, "a fact has 4 arguments at most, and this has " + std::to_string(row.arguments.size()));
    fact.fact = {row.name, row.arguments};
    const Span span = span_of(row, true);
    fact.start_step = span.start_step, fact.end_step = span.end_step;
    fact.first_frame = span.first_frame, fact.end_frame = span.end_frame;
    fact.open_start = span.start_step == 0;
    fact.open_end = span.end_step == episode_.steps;
    fact.labelled_by = labeller(row);
    std::map<std::int64_t, std::int64_t>& spans = spans_[fact.fact];  // by their starts, none meets another
    const auto next = spans.lower_bound(fact.start_step);
    if ((next != spans.end() && next->first < fact.end_step) ||
        (next != spans.begin() && std::prev(next)->second > fact.start_step))
      throw Error(row.place, "this fact holds twice at once", "join the two spans");
    spans.emplace(fact.start_step, fact.end_step);
    labels_.facts.push_back(std::move(fact));
  }

  void say(const LabelRow& row, LanguageLevel level, int segment, const std::string& text) {
    LanguageRecord sentence;
    sentence.level = level;
    sentence.text = text;
    sentence.segment = segment;
    sentence.source = labeller(row) == Labeller::model ? LanguageSource::model : LanguageSource::person;
    sentence.model = row.model;
    if (!row.grain.empty()) {
      sentence.grain = language_grain_from(row.grain);
      if (!sentence.grain)
        throw Error(row.place, "there is no grain '" + row.grain + "'", "write goal, steps or motions");
    }
    labels_.language.push_back(std::move(sentence));
  }

  void add_sentence(const LabelRow& row) {
    const auto level = language_level_from(row.name);
    if (!level)
      throw Error(row.place, "there is no level '" + row.name + "'", "levels: task, world, subgoal, skill, motion");
    if (row.text.empty()) throw Error(row.place, "the sentence is empty", "write its text");
    const bool of_all = *level == LanguageLevel::task || *level == LanguageLevel::world;
    say(row, *level, of_all ? -1 : segment_of(row), row.text);
  }

  int segment_of(const LabelRow& row) const {
    if (row.segment) {
      const auto which = static_cast<std::size_t>(*row.segment);
      if (*row.segment >= 0 && which < ordinal_of_.size()) {
        const int ordinal = ordinal_of_[which];
        if (to_string(labels_.segments[static_cast<std::size_t>(ordinal)].kind) == row.name) return ordinal;
      }
      throw Error(row.place, "the file's segment " + std::to_string(*row.segment) + " is no " + row.name,
                  "segments count from 0, in the file's order");
    }
    if (row.span.given()) {
      const Span span = span_of(row, false);
      if (const auto kind = segment_kind_from(row.name))
        if (const auto found = places_.find({*kind, span.start_step, span.end_step}); found != places_.end())
          return found->second;
    }
    throw Error(row.place, "it does not say which " + row.name + " it is of",
                "give `segment`, or in a CSV the span of a segment of that kind");
  }

  const EpisodeRecord& episode_;
  std::vector<LabelRow> rows_;
  std::int64_t ticks_, frames_;
  int own_hz_;  // frames in the labels count at this rate
  std::int64_t own_frames_;
  Labels labels_;
  std::vector<const LabelRow*> segment_rows_;  // by place in the file
  std::vector<int> ordinal_of_;                // likewise
  std::map<std::tuple<SegmentKind, std::int64_t, std::int64_t>, int>
      places_;  // of the ordered segments, by their spans
  std::map<Fact, std::map<std::int64_t, std::int64_t>> spans_;
};

}  // namespace

Labels read_labels(const std::filesystem::path& file, const std::string& shown, const EpisodeRecord& episode,
                   const LabelClock& clock) {
  Labels labels = LabelReader(episode, label_rows(file, shown, clock), clock).read();
  if (labels.segments.empty() && labels.facts.empty() && labels.language.empty())
    throw Error(shown, "it holds no labels", "it takes segments, facts or language, or leave it out");
  return labels;
}

void put_labels(Labels labels, EpisodeRecord& episode) {
  if (!labels.segments.empty()) {
    // Sentences of segments that are gone would name others.
    std::erase_if(episode.labels.language, [](const LanguageRecord& sentence) { return sentence.segment >= 0; });
    episode.labels.segments = std::move(labels.segments);
  }
  if (!labels.facts.empty()) episode.labels.facts = std::move(labels.facts);
  std::set<LanguageLevel> levels;
  for (const LanguageRecord& sentence : labels.language) levels.insert(sentence.level);
  const auto replaced = [&](const LanguageRecord& sentence) { return levels.contains(sentence.level); };
  std::erase_if(episode.labels.language, replaced);
  episode.labels.language.insert(episode.labels.language.end(), labels.language.begin(), labels.language.end());
}

}  // namespace stampede
