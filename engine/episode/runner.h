// One run from reset to verdict.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "engine/start/options.h"
#include "engine/start/task.h"

namespace stampede {

class SkillLibrary;
class Symbols;

// Runs one episode to its end, good or bad. Repeatable: the same record, bit for bit, but for host times.
// `stop`: ends early with Reason::interrupted when true (checked between skills and every frame).
EpisodeRecord run_episode(const TaskDraw& task, Symbols& symbols, SkillLibrary& skills, const RunOptions& options,
                          const std::atomic<bool>* stop = nullptr);

// Re-simulates a stored episode from its scene and commands and compares every frame. Result: empty, or the first
// difference in words (frame, value, stored, now).
std::string replay_episode(const EpisodeRecord& episode);
// What that leaves out: channels of sensors that belong to the program which recorded the episode, and kMargins, which
// scripts measure.
std::vector<std::string> not_replayed(const EpisodeRecord& episode);

}  // namespace stampede
