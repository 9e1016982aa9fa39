#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "scripting/research/problem.h"

namespace stampede::research {
namespace {

using Uses = std::vector<TableUse>;

Uses operator+(Uses left, const Uses& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

const Uses kProprioception = {{"joints"}, {"hands"}};
const Uses kObservations = kProprioception + Uses{{"object_joints"}, {"poses"}, {"objects"}, {"images"}};
// Of test episodes single moments, a second apart: the next one would say what was done.
const Uses kObservationsAsked = {{"joints", Part::train},
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
const Uses kFacts = {{"facts"}};
const Uses kConditions = {{"preconditions"}, {"effects"}};
const Uses kTrainedConditions = {{"preconditions", Part::train}, {"effects", Part::train}};
// What plans with learned operators are tried on.
const Uses kPlanning = {{"problems"}, {"plans"}, {"tasks"}};
const Uses kSources = {{"sources"}};
const std::vector<Need> kPlanned = {{"problems", "domain"}, {"skills"}};  // of problems with kPlanning

const AnswerColumn kEpisode = {"episode", AnswerType::integer, "number of the episode in given.db", "1"};
const AnswerColumn kPiece = {"piece", AnswerType::integer, "number of the piece in given.db", "1"};
const AnswerColumn kFrame = {"frame", AnswerType::integer, "number of the frame", "0"};
const AnswerColumn kFirst = {"first_frame", AnswerType::integer, "first frame of the segment", "0"};
const AnswerColumn kEnd = {"end_frame", AnswerType::integer, "frame after its last", "40"};
const AnswerColumn kDomain = {"domain", AnswerType::text, "a PDDL domain, as text", "(define (domain learned))"};

AnswerColumn number(const char* name, const char* about) { return {name, AnswerType::real, about, "0.0"}; }

std::vector<AnswerColumn> action_columns() {
  std::vector<AnswerColumn> columns = {kEpisode, kFrame};
  for (const char* joint : {"j1", "j2", "j3", "j4", "j5", "j6", "j7"})
    columns.push_back(number(joint, "commanded position, rad"));
  columns.push_back(number("gripper", "commanded opening, m"));
  return columns;
}

constexpr const char* kSegmentScore =
    "Boundaries between skills: precision, recall and F1 within 2, 5 and 10 frames, each true boundary matched once. "
    "Segments: share of frames with the right label (MoF), edit score and F1 at 10, 25 and 50 % overlap (Lea et al., "
    "CVPR "
    "2017), mean IoU over true segments, NMI of labels over frames. ";
constexpr const char* kAnyLabels =
    "Labels may be any: they are matched with the true ones one to one, such that most frames agree (Kuhn 1955), over "
    "all "
    "test episodes together.";
constexpr const char* kOperatorScore =
    "Actions go by name, else by likeness (Kuhn 1955). Preconditions and effects as lifted literals, as written and "
    "with "
    "what holds anyway; calls that can be taken in held-out states, and what they change; plans of held-out problems: "
    "sound, complete, how dear, and with --physics N run by the engine.";
constexpr const char* kActionScore =
    "Offline, at every 20th frame of the test episodes, which is all that is given of them: root mean square error of "
    "the "
    "commanded joints (rad) and share of frames where the gripper is told to open or close as it was. Success is "
    "measured "
    "with the policy in the loop: `stampede evaluate TASK --policy \"…\"`, with `--variation` for held-out values.";

std::vector<ResearchProblem> make_problems() {
  return {
      {.name = "abstractions",
       .serves = "state and action abstractions (SAT)",
       .title = "which of a planning problem's objects, predicates and actions matter",
       .given = Uses{{"problems"}, {"plans", Part::train}},
       .hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources,
       .needs = kPlanned,
       .answer_texts = {kDomain},
       .every_unit = false,
       .scoring = kOperatorScore,
       .scorer = "operators"},
      {.name = "inventions",
       .serves = "portable representations (symbols and operators)",
       .title = "predicates and operators of one's own, from observations and labelled skills",
       .demos_only = false,
       .given = kObservations + Uses{{"skills"}},
       .hidden = kFacts + Uses{{"skills"}} + kConditions + kPlanning + kSources,
       .needs = kPlanned,
       .answer = {kEpisode,
                  kFrame,
                  {"fact", AnswerType::text, "an atom of a predicate (or type) of the domain", "(grasped block1)"},
                  {"holds", AnswerType::integer, "1 or 0; left out: 1", "1", true}},
       .answer_texts = {kDomain},
       .every_unit = false,
       .scoring =
           std::string(
               "Learned predicates are mapped to true ones by agreement (MCC) at the frames answered, "
               "arguments in any order, denied or not, one to one (Kuhn 1955), two at once where one "
               "does not do; types by their objects. Of each test episode the frames before and after skills must "
               "be answered, and others may be: what is said of one of them must be said of all. Then, in "
               "true words: ") +
           kOperatorScore,
       .scorer = "abstractions"},
      {.name = "symbols",
       .serves = "portable representations (symbols and operators)",
       .title = "symbols learned from transitions of known skills",
       .unit = Unit::piece,
       .demos_only = false,
       .given = Uses{{"piece_skill", Part::all, "skills"},
                     {"piece_poses", Part::all, "poses"},
                     {"piece_joints_around", Part::all, "joints"},
                     {"piece_hands_around", Part::all, "hands"},
                     {"objects"}},
       .hidden = Uses{{"piece_facts", Part::all, "facts"}} + kSources,
       .needs = {{"facts"}},
       .answer = {kPiece,
                  {"moment", AnswerType::text, "before or after", "before"},
                  {"symbol", AnswerType::text, "one that holds, with its objects; left out: none does", "(s1 block1)",
                   true}},
       .every_unit = false,
       .scoring =
           "Each true predicate is matched with one of the learned symbols of as many arguments, such that the mean "
           "F1 over predicates is greatest (Kuhn 1955); F1 counts ground symbols of all test moments. Each of them "
           "must "
           "be answered; a symbol that is not said does not hold.",
       .scorer = "symbols"},
      {.name = "concepts",
       .serves = "concepts (with pre-trained models)",
       .title = "named predicates, from observations and language",
       .given = kObservations + Uses{{"descriptions"}, {"vocabulary"}},
       .hidden = kFacts + Uses{{"objects"}} + kSources,
       .needs = {{"vocabulary"}, {"facts", "predicate_kind"}},
       .answer = {kEpisode,
                  kFrame,
                  {"fact", AnswerType::text, "one that holds there; left out: none does", "(on block1 table)", true}},
       .every_unit = false,
       .scoring =
           "Agreement with the facts at every 20th frame: precision, recall, F1 and MCC (over all ground atoms of the "
           "vocabulary), and the mean F1 over predicates. Each of these frames must be answered; a fact that is not "
           "said "
           "does not hold.",
       .scorer = "facts"},
      {.name = "segments_supervised",
       .serves = "skill segments, supervised",
       .title = "which skill runs when, learned from labelled episodes",
       .given = kProprioception + Uses{{"skills", Part::train}},
       .hidden = Uses{{"skills"}, {"joints"}, {"hands"}} + kSources,
       .needs = {{"joints"}, {"skills"}},
       .answer = {kEpisode, kFirst, kEnd, {"skill", AnswerType::text, "its name, as in table skills", "pick"}},
       .scoring = kSegmentScore,
       .scorer = "segments"},
      {.name = "segments",
       .serves = "skill segments, unsupervised",
       .title = "where skills begin and end, without labels",
       .given = kProprioception,
       .hidden = Uses{{"skills"}, {"joints"}, {"hands"}} + kSources,
       .needs = {{"joints"}, {"skills"}},
       .answer =
           {kEpisode, kFirst, kEnd, {"skill", AnswerType::text, "any name: the same for the same skill", "a", true}},
       .scoring = std::string(kSegmentScore) + kAnyLabels,
       .scorer = "segments"},
      {.name = "conditions_supervised",
       .serves = "skill preconditions and effects, supervised",
       .title = "operators of labelled skills, with examples of conditions",
       .demos_only = false,
       .given = kObservations + kFacts + Uses{{"skills"}} + kTrainedConditions,
       .hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources,
       .needs = kPlanned,
       .answer_texts = {kDomain},
       .every_unit = false,
       .scoring = kOperatorScore,
       .scorer = "operators"},
      {.name = "conditions",
       .serves = "skill preconditions and effects, unsupervised",
       .title = "operators of labelled skills, from what happens",
       .demos_only = false,
       .given = kObservations + kFacts + Uses{{"skills"}},
       .hidden = Uses{{"skills"}} + kConditions + kPlanning + kSources,
       .needs = kPlanned,
       .answer_texts = {kDomain},
       .every_unit = false,
       .scoring = kOperatorScore,
       .scorer = "operators"},
      {.name = "segments_and_conditions",
       .serves = "segments and conditions together, unsupervised",
       .title = "skills and their operators, from observations alone",
       .given = kObservations + kFacts,
       .hidden = Uses{{"skills"}, {"joints"}, {"hands"}} + kConditions + kPlanning + kSources,
       .needs = kPlanned,
       .answer = {kEpisode, kFirst, kEnd, {"skill", AnswerType::text, "name of an action of the domain", "a1", true}},
       .answer_texts = {kDomain},
       .scoring = std::string(kSegmentScore) + kAnyLabels + " " + kOperatorScore,
       .scorer = "segments_and_operators"},
      {.name = "motions",
       .serves = "motions from demos (VAE, GAN)",
       .title = "which skill made a piece of motion",
       .unit = Unit::piece,
       .given = Uses{{"piece_joints", Part::all, "joints"}, {"piece_hands", Part::all, "hands"}},
       .hidden = Uses{{"piece_skill", Part::all, "skills"}} + kSources,
       .needs = {{"joints"}, {"skills"}},
       .answer = {kPiece, {"cluster", AnswerType::text, "any name: the same for the same skill", "a"}},
       .scoring = "Clusters against skills: purity, NMI, adjusted Rand index, and accuracy after matching one to one.",
       .scorer = "clusters"},
      {.name = "behaviour",
       .serves = "behaviour (imitation)",
       .title = "what to do next, from demonstrations and parts of logical programs",
       .given = kObservationsAsked + Uses{{"actions", Part::train},
                                          {"facts", Part::train},
                                          {"skills", Part::train},
                                          {"problems"},
                                          {"plans", Part::train},
                                          {"instructions"}},
       .hidden = Uses{{"asked_actions", Part::test, "actions"}, {"tasks"}} + kSources,
       .needs = {{"actions", "action_j1"}},
       .answer = action_columns(),
       .scoring = kActionScore,
       .scorer = "actions"},
      {.name = "controllers",
       .serves = "composition of controllers by priority",
       .title = "which controller acts when, and policies that choose",
       .given = kObservations + Uses{{"instructions"}, {"controls", Part::train}},
       .hidden = Uses{{"controls"}, {"tasks"}} + kSources,
       .needs = {{"controls"}},
       .answer = {kEpisode,
                  kFirst,
                  kEnd,
                  {"motion", AnswerType::text, "what moves the arm, as in table controls", "approach"}},
       .scoring = std::string(kSegmentScore) +
                  "Success is measured with the policy in the loop: `stampede evaluate TASK --policy \"…\"`, whose "
                  "actions may call skills with controllers of its choice.",
       .scorer = "segments"},
      {.name = "transfer",
       .serves = "task transfer; efficient exploration (RL)",
       .title = "a policy for what was held out, from what was seen, with rewards",
       .demos_only = false,
       .given = kObservationsAsked + Uses{{"actions", Part::train}, {"rewards", Part::train}, {"tasks"}},
       .hidden = Uses{{"asked_actions", Part::test, "actions"}} + kSources,
       .needs = {{"actions", "action_j1"}},
       .answer = action_columns(),
       .scoring = kActionScore,
       .scorer = "actions"},
      {.name = "rewards",
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
           "Rank correlation at every 10th frame: with the plan's progress within each success (Spearman, mean) "
           "and over all of them together, with the share of the goal that holds over all test frames (Spearman, "
           "Kendall's tau-b); and how often the last frame of a success is above that of a failure (AUC). Answer "
           "at least every 10th frame of each test episode. EPIC distance (Gleave et al., ICLR 2021) to the "
           "reward that is the share of the goal where one arrives: over all pairs of every 40th frame of each "
           "test episode, drawn uniformly and independently, discount 0.99. A value counts as the reward of "
           "arriving there, unless there are rows with next_frame: then such rows are asked for all these pairs, "
           "and shaping (0.99 P(next_frame) - P(frame)) makes no difference.",
       .scorer = "rewards"},
      {.name = "transition_models",
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
           "fact. "
           "Positions (always asked for): mean distance in m of hands, and of things that moved; and the same divided "
           "by "
           "that of saying that nothing moves. Joints, where any row is about one: the same of all of the arm's hinges "
           "(rad), and of joints of things that moved. Facts (basic and derived ones), where any row is about one: "
           "precision, recall and F1 of those that changed since the context, begun and ended ones; a frame is taken "
           "to "
           "have just the facts that rows say.",
       .scorer = "predictions"},
  };
}

}  // namespace

const std::vector<ResearchProblem>& all_problems() {
  static const std::vector<ResearchProblem> problems = make_problems();
  return problems;
}

const ResearchProblem& find_problem(std::string_view name) {
  std::vector<std::string> names;
  for (const ResearchProblem& problem : all_problems()) {
    if (problem.name == name) return problem;
    names.push_back(problem.name);
  }
  const std::string meant = did_you_mean(name, names);
  throw Error("problem", "there is no research problem '" + std::string(name) + "'",
              (meant.empty() ? "" : meant + " ") + "`stampede dataset --list` names all");
}

}  // namespace stampede::research
