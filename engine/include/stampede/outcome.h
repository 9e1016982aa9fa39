// How an episode ended, and what is done about a failed skill.
#pragma once

namespace stampede {

enum class Outcome { success, failure };

// undo: back to the last skill boundary and the next draws; stop: the failure is the episode; recover: plan again.
enum class OnFailure { undo, stop, recover };

}  // namespace stampede
