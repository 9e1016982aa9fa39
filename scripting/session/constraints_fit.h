// Which variations of a task can meet what a run adds to it, told before anything runs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scripting/session/episode_job.h"

namespace stampede {

// A formula as it is given on a command line or by a program. `place` starts messages: `--where`.
// Throws Error with line, column and cure.
Formula formula_option(const std::string& text, const std::string& place);

// Why no start of this variation can meet `options.where`: the part that most often contradicts what never changes
// (traits, attributes, types). Empty: some start may. Throws Error for a `where` or `goal` that speaks of what is not
// there.
std::string misfit(const std::shared_ptr<const Library>& library, const EpisodeJob& job, const RunOptions& options);

// Those of `variations` that fit; all of them when the options constrain nothing. Throws Error when none does, with
// the part that fails.
std::vector<std::string> fitting_variations(const std::shared_ptr<const Library>& library, const std::string& task,
                                            const std::vector<std::string>& variations, std::int64_t seed,
                                            const RunOptions& options);

}  // namespace stampede
