#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem transition_models_problem() {
  return {.name = "transition_models",
          .serves = "transition models",
          .title = "what the world will be after some actions",
          .demos_only = false,
          .given = Uses{{"joints", Part::train},
                        {"context_joints", Part::test, "joints"},
                        {"hands", Part::train},
                        {"context_hands", Part::test, "hands"},
                        {"poses", Part::train},
                        {"context_poses", Part::test, "poses"},
                        {"object_joints", Part::train},
                        {"context_object_joints", Part::test, "object_joints"},
                        {"facts", Part::train},
                        {"context_facts", Part::test, "facts"},
                        {"objects"},
                        {"images", Part::train},
                        {"context_images", Part::test, "images"},
                        {"actions", Part::train},
                        {"context_actions", Part::test, "actions"}},
          .hidden = Uses{{"future_hands", Part::test, "hands"},
                         {"future_poses", Part::test, "poses"},
                         {"future_joints", Part::test, "joints"},
                         {"future_facts", Part::test, "facts"}} +
                    kSources,
          .needs = {{"hands"}, {"actions", "action_j1"}},
          .answer = {kEpisode,
                     kFrame,
                     {"object", AnswerType::text, "a thing, or the hand", "block1", true},
                     {"x", AnswerType::real, "its position, m, world", "0.0", true},
                     {"y", AnswerType::real, "its position, m, world", "0.0", true},
                     {"z", AnswerType::real, "its position, m, world", "0.0", true},
                     {"joint", AnswerType::text, "in place of an object: a joint", "", true},
                     {"position", AnswerType::real, "its position, rad or m", "", true},
                     {"fact", AnswerType::text, "in place of both: a fact that holds there", "", true}},
          .scoring =
              "1, 5 and 20 frames after each context (every 40th frame). A row is about a thing or hand, a joint, or a "
              "fact. Positions (always asked for): mean distance in m of hands, and of things that moved; and the same "
              "divided by that of saying that nothing moves. Joints, where any row is about one: the same of all of "
              "the arm's hinges (rad), and of joints of things that moved. Facts (basic and derived ones), where any "
              "row is about one: precision, recall and F1 of those that changed since the context, begun and ended "
              "ones; a frame is taken to have just the facts that rows say.",
          .scorer = "predictions"};
}

}  // namespace stampede::research
