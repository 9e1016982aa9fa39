// Why something did not succeed: one list for C++, Lua and SQL.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace stampede {

// The texts are stored in catalogues: add at the end, never rename.
#define STAMPEDE_REASONS(X)                                                   \
  X(none, "it succeeded")                                                     \
  X(no_plan, "the task planner found no plan")                                \
  X(no_path, "no collision-free path was found")                              \
  X(no_grasp, "no grasp is reachable and free of collision")                  \
  X(no_placement, "no placement is reachable and free of collision")          \
  X(unreachable, "no joint configuration reaches the pose")                   \
  X(dropped, "a held object was lost")                                        \
  X(grasp_missed, "the hand closed on nothing")                               \
  X(timeout, "the motion or the episode ran out of steps")                    \
  X(effect_mismatch, "a declared effect did not come true")                   \
  X(precondition_false, "a precondition did not hold")                        \
  X(out_of_order, "a later part of the goal came true before its turn")       \
  X(goal_false, "the goal does not hold at the end")                          \
  X(goal_unstable, "the goal did not stay true while the scene settled")      \
  X(init_impossible, "no start was found in which init holds")                \
  X(failed_by_task, "the task's own test ended the episode")                  \
  X(tracking_error, "the arm could not follow its reference")                 \
  X(start_in_collision, "the arm touches something at the start of the path") \
  X(stuck, "the mechanism did not move as far as asked")                      \
  X(script_error, "a script raised an error")                                 \
  X(budget, "the tries allowed were used up")                                 \
  X(interrupted, "the run was interrupted")                                   \
  X(policy_error, "a policy failed, or asked for what cannot be done")        \
  X(sensor_error, "a sensor of the program failed")                           \
  X(failed_by_skill, "the skill gave up")

enum class Reason {
#define X(name, text) name,
  STAMPEDE_REASONS(X)
#undef X
};

std::string_view to_string(Reason reason);  // the stored name, such as "no_path"
std::string_view describe(Reason reason);   // a sentence without a full stop
std::optional<Reason> reason_from(std::string_view name);
const std::vector<Reason>& all_reasons();

}  // namespace stampede
