#include <algorithm>

#include "db/episode_reader.h"

namespace stampede {
namespace {

Fact fact_from(const std::string& text) {  // (on block1 table)
  std::vector<std::string> words;
  for (std::size_t begin = 1; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size() - 1);
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  Fact fact;
  if (words.empty()) return fact;
  fact.predicate = words.front();
  fact.arguments.assign(words.begin() + 1, words.end());
  return fact;
}

constexpr const char* kSegmentColumns =
    "undone, coalesce(was_ordinal, ordinal), coalesce(before_segment, 0), try_number, kind, coalesce(parent, -1), "
    "robot, skill, case_name, arguments, controller, start_step, end_step, first_frame, end_frame, outcome, reason, "
    "detail, precondition_held, effect_held, missing_effects, forgotten, searched_for, label, labelled_by";

void read_segment(const sql::Database& database, sql::Statement& row, AttemptRecord& a, bool& undone) {
  SegmentRecord& s = a.segment;
  std::string kind, arguments, outcome, reason, missing, forgotten, searched, labelled_by;
  row.read(undone, s.ordinal, a.before_segment, a.try_number, kind, s.parent, s.robot, s.skill, s.case_name, arguments,
           s.controller, s.span.start_step, s.span.end_step, s.span.first_frame, s.span.end_frame, outcome, reason,
           s.detail, s.precondition_held, s.effect_held, missing, forgotten, searched, s.label, labelled_by);
  s.labelled_by = known_word(database, "labelled_by", labelled_by, labeller_from(labelled_by));
  s.kind = known_word(database, "kind", kind, segment_kind_from(kind));
  s.arguments = from_json_list(database, arguments);
  s.outcome = known_word(database, "outcome", outcome, outcome_from(outcome));
  s.reason = known_word(database, "reason", reason, reason_from(reason));
  s.missing_effects = from_json_list(database, missing);
  s.forgotten = from_json_list(database, forgotten);
  s.searched_for = from_json_list(database, searched);
}

}  // namespace

void EpisodeReader::read_segments() {
  each(kSegmentColumns, "segment", "undone, segment.ordinal", [&](sql::Statement& row) {
    bool undone = false;
    AttemptRecord tried;
    read_segment(database_, row, tried, undone);
    if (undone) {
      record_.labels.attempts.push_back(std::move(tried));
    } else {
      segment_at_[tried.segment.ordinal] = record_.labels.segments.size();
      record_.labels.segments.push_back(std::move(tried.segment));
    }
  });
  read_segment_details();
}

SegmentRecord& EpisodeReader::owner(bool undone, std::int64_t ordinal) {
  if (undone) return at(record_.labels.attempts, ordinal, "segment").segment;
  const auto found = segment_at_.find(ordinal);
  return at(record_.labels.segments, found == segment_at_.end() ? -1 : static_cast<std::int64_t>(found->second),
            "segment");
}

void EpisodeReader::read_segment_details() {
  each("undone, segment, component, name, value, coalesce(text, ''), unit, frame, chosen_by", "segment_parameter",
       "undone, segment, ordinal, component", [&](sql::Statement& row) {
         bool undone = false;
         std::int64_t segment = 0, component = 0;
         std::optional<double> value;
         ParameterRecord p;
         std::string chosen_by;
         row.read(undone, segment, component, p.name, value, p.text, p.unit, p.frame, chosen_by);
         p.chosen_by = known_word(database_, "chosen_by", chosen_by, chosen_by_from(chosen_by));
         auto& parameters = owner(undone, segment).parameters;
         if (component == 0) parameters.push_back(p);
         if (parameters.empty()) damaged("segment_parameter");
         if (value) parameters.back().values.push_back(*value);
       });
  each("undone, segment, coalesce(choice, -1), negated, fact, held", "segment_precondition", "undone, segment, ordinal",
       [&](sql::Statement& row) {
         bool undone = false;
         std::int64_t segment = 0;
         PreconditionRecord precondition;
         std::string fact;
         row.read(undone, segment, precondition.choice, precondition.negated, fact, precondition.held);
         precondition.fact = fact_from(fact);
         owner(undone, segment).preconditions.push_back(std::move(precondition));
       });
  each("undone, segment, negated, fact", "segment_effect", "undone, segment, ordinal", [&](sql::Statement& row) {
    bool undone = false;
    std::int64_t segment = 0;
    EffectRecord effect;
    std::string fact;
    row.read(undone, segment, effect.negated, fact);
    effect.fact = fact_from(fact);
    owner(undone, segment).declared_effects.push_back(effect);
  });
}

void EpisodeReader::read_facts() {
  each("fact, start_step, end_step, first_frame, end_frame, open_start, open_end, observed, margin, labelled_by",
       "fact", "ordinal", [&](sql::Statement& row) {
         FactRecord& f = record_.labels.facts.emplace_back();
         std::string fact, labelled_by;
         row.read(fact, f.start_step, f.end_step, f.first_frame, f.end_frame, f.open_start, f.open_end, f.observed,
                  f.margin, labelled_by);
         f.labelled_by = known_word(database_, "labelled_by", labelled_by, labeller_from(labelled_by));
         f.fact = fact_from(fact);
       });
  each("fact, start_step, end_step, first_frame, end_frame, open_start, open_end", "observed_fact", "ordinal",
       [&](sql::Statement& row) {
         FactRecord& f = record_.labels.observed_facts.emplace_back();
         std::string fact;
         row.read(fact, f.start_step, f.end_step, f.first_frame, f.end_frame, f.open_start, f.open_end);
         f.fact = fact_from(fact);
       });
}

void EpisodeReader::read_passages() {
  const std::string pose = kPoseColumns;
  each("segment, name, " + pose +
           ", passed_x, passed_y, passed_z, passed_qx, passed_qy, passed_qz, passed_qw, step, "
           "speed, tool_speed",
       "via", "ordinal", [&](sql::Statement& row) {
         ViaRecord& v = record_.labels.vias.emplace_back();
         row.read(v.segment, v.name, v.pose, v.passed, v.step, v.speed, v.tool_speed);
       });
  each("object_a, part_a, object_b, part_b, first_frame, end_frame, peak_force", "contact", "ordinal",
       [&](sql::Statement& row) {
         ContactRecord& c = record_.labels.contacts.emplace_back();
         row.read(c.object_a, c.part_a, c.object_b, c.part_b, c.first_frame, c.end_frame, c.peak_force);
       });
  each("segment, object, " + pose + ", width, held", "grasp", "ordinal", [&](sql::Statement& row) {
    GraspRecord& g = record_.labels.grasps.emplace_back();
    row.read(g.segment, g.object, g.object_from_tip, g.width, g.held);
  });
}

void EpisodeReader::read_documents() {
  each("kind, (SELECT body FROM text_store t WHERE t.hash = document.text)", "document", "ordinal",
       [&](sql::Statement& row) {
         DocumentRecord& d = record_.labels.documents.emplace_back();
         std::string kind;
         row.read(kind, d.text);
         d.kind = known_word(database_, "kind", kind, document_kind_from(kind));
       });
}

void EpisodeReader::read_language() {
  each("level, text, coalesce(segment, -1), source, coalesce(grain, ''), coalesce(model, '')", "language", "ordinal",
       [&](sql::Statement& row) {
         LanguageRecord& l = record_.labels.language.emplace_back();
         std::string level, source, grain;
         row.read(level, l.text, l.segment, source, grain, l.model);
         l.level = known_word(database_, "level", level, language_level_from(level));
         l.source = known_word(database_, "source", source, language_source_from(source));
         if (!grain.empty()) l.grain = known_word(database_, "grain", grain, language_grain_from(grain));
       });
  read_documents();
  each("dialect, theirs, ours, disagreements", "verdict", "dialect", [&](sql::Statement& row) {
    VerdictRecord& v = record_.labels.verdicts.emplace_back();
    std::string disagreements;
    row.read(v.dialect, v.theirs, v.ours, disagreements);
    v.disagreements = from_json_list(database_, disagreements);
  });
  each("method, frame", "keyframe", "method, frame", [&](sql::Statement& row) {
    std::string method;
    std::int64_t frame = 0;
    row.read(method, frame);
    record_.labels.keyframes[method].push_back(frame);
  });
}

void EpisodeReader::read_streams() {
  each(
      "kind, name, file, clock, offset_s, drift_ppm, reference_s, origin_s, rate_hz, readings, longest_gap_s, missing, "
      "rule",
      "stream", "ordinal", [&](sql::Statement& row) {
        StreamRecord& s = record_.streams.emplace_back();
        row.read(s.kind, s.name, s.file, s.clock, s.offset_s, s.drift_ppm, s.reference_s, s.origin_s, s.rate_hz,
                 s.readings, s.longest_gap_s, s.missing, s.rule);
      });
  each("frame, camera, kind, time_s", "image_time", "frame, camera, kind", [&](sql::Statement& row) {
    ImageTimeRecord& i = record_.image_times.emplace_back();
    row.read(i.frame, i.camera, i.kind, i.time_s);
  });
}

}  // namespace stampede
