#include <algorithm>

#include "db/catalogue_impl.h"
#include "db/episode_writer.h"

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

// Columns of a segment after those that say whether it was undone.
void run_segment(sql::Statement& statement, std::int64_t episode, bool undone, int ordinal,
                 const std::optional<std::int64_t>& was_ordinal, const std::optional<std::int64_t>& before_segment,
                 int try_number, const SegmentRecord& s) {
  const std::string list = to_json_list(s.arguments), missing = to_json_list(s.missing_effects);
  const std::string forgotten = to_json_list(s.forgotten), searched = to_json_list(s.searched_for);
  const auto arg1 = argument(s.arguments, 0), arg2 = argument(s.arguments, 1), arg3 = argument(s.arguments, 2),
             arg4 = argument(s.arguments, 3);
  statement.run(episode, undone, ordinal, was_ordinal, before_segment, try_number, to_string(s.kind), index(s.parent),
                s.robot, s.skill, s.case_name, arg1, arg2, arg3, arg4, list, s.controller, s.span.start_step,
                s.span.end_step, s.span.first_frame, s.span.end_frame,
                s.outcome == Outcome::success ? "success" : "failure", to_string(s.reason), s.detail,
                s.precondition_held, s.effect_held, missing, forgotten, searched, s.label, to_string(s.labelled_by));
}

// From 1: the tries of the same at its place that were undone go before it.
int try_number(const EpisodeRecord& episode, const SegmentRecord& segment) {
  return 1 + static_cast<int>(std::count_if(episode.attempts.begin(), episode.attempts.end(), [&](const auto& a) {
           return a.before_segment == segment.ordinal && a.segment.kind == segment.kind &&
                  a.segment.skill == segment.skill;
         }));
}

}  // namespace

void EpisodeWriter::write_labels(const EpisodeRecord& episode) {
  write_segments(episode);
  write_facts(episode);
  effects_held_.run(id_);
  undeclared_.run(id_);
  write_passages(episode);
  write_language(episode);
  for (const auto& [method, frames] : episode.keyframes)
    for (const std::int64_t frame : frames) keyframe_.run(id_, method, frame);
}

void EpisodeWriter::set_labels(std::int64_t id, const EpisodeRecord& episode) {
  id_ = id;
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
  write_segments(episode);
  write_facts(episode);
  effects_held_.run(id_);
  undeclared_.run(id_);
  write_sentences(episode);
  for (const auto& [method, frames] : episode.keyframes)
    for (const std::int64_t frame : frames) keyframe_.run(id_, method, frame);
  set_running(episode);
}

void EpisodeWriter::write_segments(const EpisodeRecord& episode) {
  for (const SegmentRecord& segment : episode.segments) {
    run_segment(segment_, id_, false, segment.ordinal, std::nullopt, std::nullopt, try_number(episode, segment),
                segment);
    write_parameters(segment, false, segment.ordinal);
    write_preconditions(segment, false, segment.ordinal);
    write_effects(segment, false, segment.ordinal);
  }
  int ordinal = 0;
  for (const AttemptRecord& attempt : episode.attempts) {
    run_segment(segment_, id_, true, ordinal, attempt.segment.ordinal, attempt.before_segment, attempt.try_number,
                attempt.segment);
    write_parameters(attempt.segment, true, ordinal);
    write_preconditions(attempt.segment, true, ordinal);
    write_effects(attempt.segment, true, ordinal);
    ++ordinal;
  }
}

void EpisodeWriter::write_parameters(const SegmentRecord& segment, bool undone, std::int64_t ordinal) {
  int place = 0;
  for (const ParameterRecord& p : segment.parameters) {
    if (p.values.empty()) {
      parameter_.run(id_, undone, ordinal, place, 0, p.name, std::nullopt, p.text, p.unit, p.frame,
                     to_string(p.chosen_by));
    } else {
      for (std::size_t component = 0; component < p.values.size(); ++component)
        parameter_.run(id_, undone, ordinal, place, component, p.name, p.values[component],
                       p.text.empty() ? std::nullopt : std::optional<std::string>(p.text), p.unit, p.frame,
                       to_string(p.chosen_by));
    }
    ++place;
  }
}

void EpisodeWriter::write_preconditions(const SegmentRecord& segment, bool undone, std::int64_t ordinal) {
  int place = 0;
  for (const PreconditionRecord& p : segment.preconditions) {
    const auto& arguments = p.fact.arguments;
    const auto arg1 = argument(arguments, 0), arg2 = argument(arguments, 1), arg3 = argument(arguments, 2),
               arg4 = argument(arguments, 3);
    precondition_.run(id_, undone, ordinal, place++, index(p.choice), p.negated, p.fact.predicate, arg1, arg2, arg3,
                      arg4, to_text(p.fact), p.held);
  }
}

void EpisodeWriter::write_effects(const SegmentRecord& segment, bool undone, std::int64_t ordinal) {
  int place = 0;
  for (const EffectRecord& effect : segment.declared_effects) {
    const auto& arguments = effect.fact.arguments;
    const auto arg1 = argument(arguments, 0), arg2 = argument(arguments, 1), arg3 = argument(arguments, 2),
               arg4 = argument(arguments, 3);
    effect_.run(id_, undone, ordinal, place++, effect.negated, effect.fact.predicate, arg1, arg2, arg3, arg4,
                to_text(effect.fact));
  }
}

void EpisodeWriter::write_facts(const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const FactRecord& f : episode.facts) {
    const auto arg1 = argument(f.fact.arguments, 0), arg2 = argument(f.fact.arguments, 1),
               arg3 = argument(f.fact.arguments, 2), arg4 = argument(f.fact.arguments, 3);
    fact_.run(id_, ordinal++, f.fact.predicate, arg1, arg2, arg3, arg4, to_text(f.fact), f.start_step, f.end_step,
              f.first_frame, f.end_frame, f.open_start, f.open_end, f.observed, f.margin, to_string(f.labelled_by));
  }
  ordinal = 0;
  for (const FactRecord& f : episode.observed_facts) {
    const auto arg1 = argument(f.fact.arguments, 0), arg2 = argument(f.fact.arguments, 1),
               arg3 = argument(f.fact.arguments, 2), arg4 = argument(f.fact.arguments, 3);
    observed_fact_.run(id_, ordinal++, f.fact.predicate, arg1, arg2, arg3, arg4, to_text(f.fact), f.start_step,
                       f.end_step, f.first_frame, f.end_frame, f.open_start, f.open_end);
  }
}

void EpisodeWriter::write_passages(const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const ViaRecord& v : episode.vias)
    via_.run(id_, ordinal++, v.segment, v.name, v.pose, v.passed, v.step, v.speed, v.tool_speed);
  ordinal = 0;
  for (const ContactRecord& c : episode.contacts)
    contact_.run(id_, ordinal++, c.object_a, c.part_a, c.object_b, c.part_b, c.first_frame, c.end_frame, c.peak_force);
  ordinal = 0;
  for (const GraspRecord& g : episode.grasps)
    grasp_.run(id_, ordinal++, g.segment, g.object, g.object_from_tip, g.width, g.held);
}

void EpisodeWriter::write_sentences(const EpisodeRecord& episode) {
  int ordinal = 0;
  for (const LanguageRecord& l : episode.language) {
    const std::optional<std::int64_t> segment = index(l.segment);
    const auto grain = l.grain ? std::optional(to_string(*l.grain)) : std::nullopt;
    const auto model = l.model.empty() ? std::nullopt : std::optional(l.model);
    language_.run(id_, ordinal++, to_string(l.level), segment, l.text, to_string(l.source), grain, model);
  }
}

void EpisodeWriter::write_language(const EpisodeRecord& episode) {
  write_sentences(episode);
  int ordinal = 0;
  for (const DocumentRecord& d : episode.documents)
    document_.run(id_, ordinal++, to_string(d.kind), write_text(d.text));
  for (const VerdictRecord& v : episode.verdicts)
    verdict_.run(id_, v.dialect, v.theirs, v.ours, to_json_list(v.disagreements));
}

}  // namespace stampede
