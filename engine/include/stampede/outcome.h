// How an episode ended, what is done about a failed skill, and who decides on the next one.
#pragma once

namespace stampede {

enum class Outcome { success, failure };

// undo: back to the last skill boundary and the next draws; stop: the failure is the episode; recover: plan again.
enum class OnFailure { undo, stop, recover };

// What decides on the next skill: a plan for the goal, or seeded draws: of any skill and arguments of the right types
// and traits, or of those whose precondition holds. Draws include continuous parameters; failures stay in the episode.
enum class Behaviour { plan, random_skills, random_applicable };

}  // namespace stampede
