#include "db/research/problems/parts.h"

namespace stampede::research {

ResearchProblem rewards_problem() {
  return {.name = "rewards",
          .serves = "reward functions",
          .title = "how far an episode has come, from observations, sparse rewards and language",
          .demos_only = false,
          .given = kObservations + Uses{{"rewards", Part::train}, {"instructions"}},
          .hidden = Uses{{"progress"}, {"goal_share"}, {"tasks"}} + kSources,
          .needs = {{"goal_share"}},
          .answer = {kEpisode,
                     kFrame,
                     number("value",
                            "reward or value there, the more, the further; with next_frame: of going from frame there"),
                     {"next_frame", AnswerType::integer,
                      "a frame of the same episode; left out: the value of the frame itself", "", true}},
          .scoring =
              "Rank correlation at every 10th frame: with the plan's progress within each success (Spearman, mean) and "
              "over all of them together, with the share of the goal that holds over all test frames (Spearman, "
              "Kendall's tau-b); and how often the last frame of a success is above that of a failure (AUC). Answer at "
              "least every 10th frame of each test episode. EPIC distance (Gleave et al., ICLR 2021) to the reward "
              "that is the share of the goal where one arrives: over all pairs of every 40th frame of each test "
              "episode, drawn uniformly and independently, discount 0.99. A value counts as the reward of arriving "
              "there, unless there are rows with next_frame: then such rows are asked for all these pairs, and shaping "
              "(0.99 P(next_frame) - P(frame)) makes no difference.",
          .scorer = "rewards"};
}

}  // namespace stampede::research
