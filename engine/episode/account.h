// What a record says of an episode beside its frames: written at its beginning and at its end, whoever drives it.
#pragma once

#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"
#include "engine/start/options.h"

namespace stampede {

class Symbols;
struct Task;

// The key of all draws of one purpose.
RandomKey draw_key(const char* purpose, const EpisodeRecord& record);

// Task, seed, options, sentences; after the scene (engine/record/scene_record.h) the world as it begins, in words and
// as PDDL.
EpisodeRecord described(const Task& task, const Symbols& symbols, const RunOptions& options);
void describe_beginning(const Rollout& rollout, EpisodeRecord& record);

// All that the rollout holds goes into the record. `plan`: the text of its document of that kind, where it has one.
void close_record(Rollout& rollout, const SkillResult& verdict, const std::string& plan, EpisodeRecord& record);

}  // namespace stampede
