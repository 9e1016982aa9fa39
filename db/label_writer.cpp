#include "db/label_writer.h"

#include <algorithm>

#include "db/catalogue_impl.h"
#include "db/insert.h"
#include "db/schema.h"
#include "engine/base/hash.h"

namespace stampede {
namespace {

std::optional<std::string> argument(const std::vector<std::string>& arguments, std::size_t index) {
  if (index < arguments.size()) return arguments[index];
  return std::nullopt;
}

// An ordinal, where -1 says none.
std::optional<std::int64_t> index(int ordinal) {
  std::optional<std::int64_t> result;
  if (ordinal >= 0) result = ordinal;
  return result;
}

// From 1: the tries of the same at its place that were undone go before it.
int try_number(const EpisodeRecord& episode, const SegmentRecord& segment) {
  return 1 + static_cast<int>(
                 std::count_if(episode.labels.attempts.begin(), episode.labels.attempts.end(), [&](const auto& a) {
                   return a.before_segment == segment.ordinal && a.segment.kind == segment.kind &&
                          a.segment.skill == segment.skill;
                 }));
}

}  // namespace

LabelWriter::LabelWriter(const sql::Database& database)
    : database_(database),
      segment_(insert(database, "segment",
                      "episode, undone, ordinal, was_ordinal, before_segment, try_number, kind, parent, robot, skill, "
                      "case_name, arg1, arg2, arg3, arg4, arguments, controller, start_step, end_step, first_frame, "
                      "end_frame, outcome, reason, detail, precondition_held, effect_held, missing_effects, forgotten, "
                      "searched_for, label, labelled_by")),
      parameter_(insert(database, "segment_parameter",
                        "episode, undone, segment, ordinal, component, name, value, text, unit, frame, chosen_by")),
      precondition_(insert(database, "segment_precondition",
                           "episode, undone, segment, ordinal, choice, negated, predicate, arg1, arg2, arg3, arg4, "
                           "fact, held")),
      effect_(insert(database, "segment_effect",
                     "episode, undone, segment, ordinal, negated, predicate, arg1, arg2, arg3, arg4, fact")),
      effects_held_(database, derived_sql("effects_held") + " AND d.episode = ?1", true),
      undeclared_(database,
                  "INSERT INTO undeclared_change (episode, segment, fact, negated) SELECT * FROM (" +
                      derived_sql("undeclared_change") + ") WHERE episode = ?1",
                  true),
      via_(insert(database, "via",
                  "episode, ordinal, segment, name, x, y, z, qx, qy, qz, qw, passed_x, passed_y, passed_z, "
                  "passed_qx, passed_qy, passed_qz, passed_qw, step, speed, tool_speed")),
      fact_(insert(database, "fact",
                   "episode, ordinal, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, first_frame, "
                   "end_frame, open_start, open_end, observed, margin, labelled_by")),
      observed_fact_(insert(database, "observed_fact",
                            "episode, ordinal, predicate, arg1, arg2, arg3, arg4, fact, start_step, end_step, "
                            "first_frame, end_frame, open_start, open_end")),
      contact_(insert(database, "contact",
                      "episode, ordinal, object_a, part_a, object_b, part_b, first_frame, end_frame, peak_force")),
      grasp_(insert(database, "grasp", "episode, ordinal, segment, object, x, y, z, qx, qy, qz, qw, width, held")),
      language_(insert(database, "language", "episode, ordinal, level, segment, text, source, grain, model")),
      text_store_(insert(database, "text_store", "hash, body", " ON CONFLICT DO NOTHING")),
      document_(insert(database, "document", "episode, ordinal, kind, text")),
      verdict_(insert(database, "verdict", "episode, dialect, theirs, ours, disagreements")),
      keyframe_(insert(database, "keyframe", "episode, method, frame")) {}

void LabelWriter::write(std::int64_t id, const EpisodeRecord& episode) {
  write_segments(id, episode);
  write_facts(id, episode);
  write_passages(id, episode);
  write_sentences(id, episode);
  write_documents(id, episode);
  write_keyframes(id, episode);
}

void LabelWriter::replace(std::int64_t id, const EpisodeRecord& episode) {
  sql::Statement found(database_, "SELECT source = 'real' FROM episode WHERE id = ?1");
  if (!found.start(id).step()) throw_no_episode(database_, id);
  bool real = false;
  found.read(real);
  sqlite3_reset(found.handle());
  if (!real)
    throw Error("episode " + std::to_string(id), "it is simulated: its labels are the simulator's",
                "label episodes whose source is real");
  for (const char* table : {"segment", "segment_parameter", "segment_precondition", "segment_effect",
                            "undeclared_change", "fact", "language", "keyframe"})
    sql::Statement(database_, std::string("DELETE FROM ") + table + " WHERE episode = ?1").run(id);
  write_segments(id, episode);
  write_facts(id, episode);
  write_sentences(id, episode);
  write_keyframes(id, episode);
}

void LabelWriter::write_segments(std::int64_t id, const EpisodeRecord& episode) {
  for (const SegmentRecord& segment : episode.labels.segments)
    write_segment({id, false, segment.ordinal, try_number(episode, segment)}, segment);
  int ordinal = 0;
  for (const AttemptRecord& attempt : episode.labels.attempts)
    write_segment({id, true, ordinal++, attempt.try_number, attempt.segment.ordinal, attempt.before_segment},
                  attempt.segment);
}

void LabelWriter::write_segment(const SegmentPlace& at, const SegmentRecord& s) {
  const std::string list = to_json_list(s.arguments), missing = to_json_list(s.missing_effects);
  const std::string forgotten = to_json_list(s.forgotten), searched = to_json_list(s.searched_for);
  const auto arg1 = argument(s.arguments, 0), arg2 = argument(s.arguments, 1), arg3 = argument(s.arguments, 2),
             arg4 = argument(s.arguments, 3);
  segment_.run(at.episode, at.undone, at.ordinal, at.was_ordinal, at.before_segment, at.try_number, to_string(s.kind),
               index(s.parent), s.robot, s.skill, s.case_name, arg1, arg2, arg3, arg4, list, s.controller,
               s.span.start_step, s.span.end_step, s.span.first_frame, s.span.end_frame,
               s.outcome == Outcome::success ? "success" : "failure", to_string(s.reason), s.detail,
               s.precondition_held, s.effect_held, missing, forgotten, searched, s.label, to_string(s.labelled_by));
  write_parameters(at, s);
  write_preconditions(at, s);
  write_effects(at, s);
}

void LabelWriter::write_parameters(const SegmentPlace& at, const SegmentRecord& segment) {
  int place = 0;
  for (const ParameterRecord& p : segment.parameters) {
    if (p.values.empty()) {
      parameter_.run(at.episode, at.undone, at.ordinal, place, 0, p.name, std::nullopt, p.text, p.unit, p.frame,
                     to_string(p.chosen_by));
    } else {
      for (std::size_t component = 0; component < p.values.size(); ++component)
        parameter_.run(at.episode, at.undone, at.ordinal, place, component, p.name, p.values[component],
                       p.text.empty() ? std::nullopt : std::optional<std::string>(p.text), p.unit, p.frame,
                       to_string(p.chosen_by));
    }
    ++place;
  }
}

void LabelWriter::write_preconditions(const SegmentPlace& at, const SegmentRecord& segment) {
  int place = 0;
  for (const PreconditionRecord& p : segment.preconditions) {
    const auto& arguments = p.fact.arguments;
    const auto arg1 = argument(arguments, 0), arg2 = argument(arguments, 1), arg3 = argument(arguments, 2),
               arg4 = argument(arguments, 3);
    precondition_.run(at.episode, at.undone, at.ordinal, place++, index(p.choice), p.negated, p.fact.predicate, arg1,
                      arg2, arg3, arg4, to_text(p.fact), p.held);
  }
}

void LabelWriter::write_effects(const SegmentPlace& at, const SegmentRecord& segment) {
  int place = 0;
  for (const EffectRecord& effect : segment.declared_effects) {
    const auto& arguments = effect.fact.arguments;
    const auto arg1 = argument(arguments, 0), arg2 = argument(arguments, 1), arg3 = argument(arguments, 2),
               arg4 = argument(arguments, 3);
    effect_.run(at.episode, at.undone, at.ordinal, place++, effect.negated, effect.fact.predicate, arg1, arg2, arg3,
                arg4, to_text(effect.fact));
  }
}

void LabelWriter::write_facts(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const FactRecord& f : episode.labels.facts) {
    const auto arg1 = argument(f.fact.arguments, 0), arg2 = argument(f.fact.arguments, 1),
               arg3 = argument(f.fact.arguments, 2), arg4 = argument(f.fact.arguments, 3);
    fact_.run(id, ordinal++, f.fact.predicate, arg1, arg2, arg3, arg4, to_text(f.fact), f.start_step, f.end_step,
              f.first_frame, f.end_frame, f.open_start, f.open_end, f.observed, f.margin, to_string(f.labelled_by));
  }
  ordinal = 0;
  for (const FactRecord& f : episode.labels.observed_facts) {
    const auto arg1 = argument(f.fact.arguments, 0), arg2 = argument(f.fact.arguments, 1),
               arg3 = argument(f.fact.arguments, 2), arg4 = argument(f.fact.arguments, 3);
    observed_fact_.run(id, ordinal++, f.fact.predicate, arg1, arg2, arg3, arg4, to_text(f.fact), f.start_step,
                       f.end_step, f.first_frame, f.end_frame, f.open_start, f.open_end);
  }
  effects_held_.run(id);
  undeclared_.run(id);
}

void LabelWriter::write_passages(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const ViaRecord& v : episode.labels.vias)
    via_.run(id, ordinal++, v.segment, v.name, v.pose, v.passed, v.step, v.speed, v.tool_speed);
  ordinal = 0;
  for (const ContactRecord& c : episode.labels.contacts)
    contact_.run(id, ordinal++, c.object_a, c.part_a, c.object_b, c.part_b, c.first_frame, c.end_frame, c.peak_force);
  ordinal = 0;
  for (const GraspRecord& g : episode.labels.grasps)
    grasp_.run(id, ordinal++, g.segment, g.object, g.object_from_tip, g.width, g.held);
}

void LabelWriter::write_sentences(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const LanguageRecord& l : episode.labels.language) {
    const std::optional<std::int64_t> segment = index(l.segment);
    const auto grain = l.grain ? std::optional(to_string(*l.grain)) : std::nullopt;
    const auto model = l.model.empty() ? std::nullopt : std::optional(l.model);
    language_.run(id, ordinal++, to_string(l.level), segment, l.text, to_string(l.source), grain, model);
  }
}

void LabelWriter::write_documents(std::int64_t id, const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const DocumentRecord& d : episode.labels.documents) {
    const std::string hash = content_hash(d.text);
    text_store_.run(hash, d.text);
    document_.run(id, ordinal++, to_string(d.kind), hash);
  }
  for (const VerdictRecord& v : episode.labels.verdicts)
    verdict_.run(id, v.dialect, v.theirs, v.ours, to_json_list(v.disagreements));
}

void LabelWriter::write_keyframes(std::int64_t id, const EpisodeRecord& episode) {
  for (const auto& [method, frames] : episode.labels.keyframes)
    for (const std::int64_t frame : frames) keyframe_.run(id, method, frame);
}

}  // namespace stampede
