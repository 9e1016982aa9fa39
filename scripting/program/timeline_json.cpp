#include "scripting/program/json_text.h"
#include "scripting/program/timeline.h"

namespace stampede::program {
namespace {

void strings(JsonText& json, const char* name, const std::vector<std::string>& values) {
  json.key(name).array();
  for (const std::string& value : values) json.value(value);
  json.end();
}

void segment_fields(JsonText& json, const SegmentRecord& segment, double hz) {
  json.field("kind", std::string(to_string(segment.kind)))
      .field("skill", segment.skill)
      .field("case", segment.case_name);
  strings(json, "arguments", segment.arguments);
  json.field("start", static_cast<double>(segment.span.start_step) / hz);
  json.field("end", static_cast<double>(segment.span.end_step) / hz);
  json.field("outcome", to_string(segment.outcome)).field("reason", to_string(segment.reason));
  json.field("detail", segment.detail).field("controller", segment.controller).field("label", segment.label);
  strings(json, "missing", segment.missing_effects);
}

}  // namespace

std::string timeline_json(const EpisodeRecord& episode) {
  const double hz = episode.physics_hz;
  JsonText json;
  json.object().field("key", episode.made.key).field("task", episode.task).field("variation", episode.variation);
  json.field("seed", episode.seed).field("split", to_string(episode.made.split)).field("world", episode.world);
  json.field("outcome", to_string(episode.outcome)).field("reason", to_string(episode.reason));
  json.field("detail", episode.detail).field("duration", episode.duration_s());
  json.field("frames", static_cast<std::int64_t>(episode.frames.size()));
  json.key("segments").array();
  for (const SegmentRecord& segment : episode.labels.segments) {
    json.object().field("ordinal", segment.ordinal).field("parent", segment.parent);
    segment_fields(json, segment, hz);
    json.end();
  }
  json.end().key("attempts").array();
  for (const AttemptRecord& attempt : episode.labels.attempts) {
    json.object().field("before_segment", attempt.before_segment).field("try", attempt.try_number);
    segment_fields(json, attempt.segment, hz);
    json.end();
  }
  json.end().key("vias").array();
  for (const ViaRecord& via : episode.labels.vias) {
    json.object().field("segment", via.segment).field("name", via.name);
    json.field("time", static_cast<double>(via.step) / hz).field("joint_speed", via.speed).end();
  }
  json.end().key("facts").array();
  for (const FactRecord& fact : episode.labels.facts) {
    json.object().field("predicate", fact.fact.predicate);
    strings(json, "arguments", fact.fact.arguments);
    json.field("start", static_cast<double>(fact.start_step) / hz)
        .field("end", static_cast<double>(fact.end_step) / hz);
    json.field("open_start", fact.open_start).field("open_end", fact.open_end).end();
  }
  return json.end().end().text();
}

}  // namespace stampede::program
