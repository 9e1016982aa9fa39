// What several problems share: tables, columns of answers, sentences. And each problem, for the list in problems.cpp.
#pragma once

#include <string>
#include <vector>

#include "db/research/problem.h"

namespace stampede::research {

using Uses = std::vector<TableUse>;

inline Uses operator+(Uses left, const Uses& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

inline const Uses kProprioception = {{"joints"}, {"hands"}};
inline const Uses kObservations = kProprioception + Uses{{"object_joints"}, {"poses"}, {"objects"}, {"images"}};
// Of test episodes single moments, a second apart: the next one would say what was done.
inline const Uses kObservationsAsked = {{"joints", Part::train},
                                        {"asked_joints", Part::test, "joints"},
                                        {"hands", Part::train},
                                        {"asked_hands", Part::test, "hands"},
                                        {"object_joints", Part::train},
                                        {"asked_object_joints", Part::test, "object_joints"},
                                        {"poses", Part::train},
                                        {"asked_poses", Part::test, "poses"},
                                        {"objects"},
                                        {"images", Part::train},
                                        {"asked_images", Part::test, "images"}};
inline const Uses kFacts = {{"facts"}};
inline const Uses kConditions = {{"preconditions"}, {"effects"}};
inline const Uses kTrainedConditions = {{"preconditions", Part::train}, {"effects", Part::train}};
// What plans with learned operators are tried on.
inline const Uses kPlanning = {{"problems"}, {"plans"}, {"tasks"}};
inline const Uses kSources = {{"sources"}};
inline const std::vector<Need> kPlanned = {{"problems", "domain"}, {"skills"}};  // of problems with kPlanning

inline const AnswerColumn kEpisode = {"episode", AnswerType::integer, "number of the episode in given.db", "1"};
inline const AnswerColumn kPiece = {"piece", AnswerType::integer, "number of the piece in given.db", "1"};
inline const AnswerColumn kFrame = {"frame", AnswerType::integer, "number of the frame", "0"};
inline const AnswerColumn kFirst = {"first_frame", AnswerType::integer, "first frame of the segment", "0"};
inline const AnswerColumn kEnd = {"end_frame", AnswerType::integer, "frame after its last", "40"};
inline const AnswerColumn kDomain = {"domain", AnswerType::text, "a PDDL domain, as text", "(define (domain learned))"};

inline AnswerColumn number(const char* name, const char* about) { return {name, AnswerType::real, about, "0.0"}; }

// `j*`: a column for each joint of the data set's arm, see arm_joints.h.
inline std::vector<AnswerColumn> action_columns() {
  return {kEpisode, kFrame, number("j*", "commanded position"), number("gripper", "commanded opening, m")};
}

inline const std::string kSegmentScore =
    "Boundaries between skills: precision, recall and F1 within 2, 5 and 10 frames, each true boundary matched once. "
    "Segments: share of frames with the right label (MoF), edit score and F1 at 10, 25 and 50 % overlap (Lea et al., "
    "CVPR 2017), mean IoU over true segments, NMI of labels over frames. ";
inline const std::string kAnyLabels =
    "Labels may be any: they are matched with the true ones one to one, such that most frames agree (Kuhn 1955), over "
    "all test episodes together.";
inline const std::string kOperatorScore =
    "Actions go by name, else by likeness (Kuhn 1955). Preconditions and effects as lifted literals, as written and "
    "with what holds anyway; calls that can be taken in held-out states, and what they change; plans of held-out "
    "problems: sound, complete, how dear, and with --physics N run by the engine.";
inline const std::string kActionScore =
    "Offline, at every 20th frame of the test episodes, which is all that is given of them: root mean square error of "
    "the commanded joints (rad; each arm's own, however many) and share of frames where the gripper is told to open or "
    "close as it was. Success is "
    "measured with the policy in the loop: `stampede evaluate TASK --policy \"…\"`, with `--variation` for held-out "
    "values.";

// What is answered by a PDDL domain of the facts' names.
inline ResearchProblem by_a_domain(ResearchProblem problem) {
  problem.hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources;
  problem.needs = kPlanned;
  problem.answer_texts = {kDomain};
  problem.every_unit = false;
  problem.scoring = kOperatorScore;
  problem.scorer = "operators";
  return problem;
}

ResearchProblem abstractions_problem();
ResearchProblem inventions_problem();
ResearchProblem symbols_problem();
ResearchProblem concepts_problem();
ResearchProblem segments_supervised_problem();
ResearchProblem segments_problem();
ResearchProblem conditions_supervised_problem();
ResearchProblem conditions_problem();
ResearchProblem segments_and_conditions_problem();
ResearchProblem motions_problem();
ResearchProblem behaviour_problem();
ResearchProblem controllers_problem();
ResearchProblem transfer_problem();
ResearchProblem rewards_problem();
ResearchProblem transition_models_problem();

}  // namespace stampede::research
