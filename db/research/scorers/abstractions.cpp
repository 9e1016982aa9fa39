// Someone's own predicates and operators: the mapping to the true ones is found, then the operators are scored in true
// words.
#include <algorithm>

#include "db/research/frame_answers.h"
#include "db/research/operator_figures.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"
#include "engine/learning/abstraction.h"
#include "engine/symbolic/pddl.h"

namespace stampede::research {
namespace {

using FramesJudged = std::map<std::pair<std::int64_t, std::int64_t>, learning::JudgedFrame>;  // by episode and frame

void check_atom(const Fact& fact, const Domain& learned, const std::string& where) {
  if (learned.types.contains(fact.predicate) && fact.arguments.size() == 1) return;
  const Predicate* predicate = learned.predicate(fact.predicate);
  const bool trait = std::find(learned.traits.begin(), learned.traits.end(), fact.predicate) != learned.traits.end();
  if (trait && fact.arguments.size() == 1) return;
  if (predicate == nullptr)
    throw Error(where, "the domain declares no predicate or type `" + fact.predicate + "`",
                "declare it in (:predicates …) of \"domain\"");
  if (predicate->parameters.size() != fact.arguments.size())
    throw Error(where, "`" + fact.predicate + "` takes " + std::to_string(predicate->parameters.size()) +
                           " arguments, not " + std::to_string(fact.arguments.size()));
}

// Where skills begin and end each test episode must be judged, and an atom of it at all of these frames or at none;
// otherwise whoever leaves out what he is unsure of would agree the more. Predicates of which no row says 0 are
// complete as they are.
void check_complete(const ScoringJob& job, const FramesJudged& frames) {
  std::set<std::string> denied;
  for (const auto& [at, frame] : frames)
    for (const Fact& fact : frame.no) denied.insert(fact.predicate);
  std::vector<std::string> unseen, unsaid;
  std::size_t asked = 0, atoms = 0;
  for (const std::int64_t episode : job.test_units) {
    const Rows rows = job.hidden.query(
        "SELECT first_frame AS frame FROM skills WHERE episode = ?1 UNION SELECT min(s.end_frame, e.frames - 1) FROM "
        "skills s JOIN episodes e USING (episode) WHERE episode = ?1 ORDER BY 1",
        {episode});
    std::map<Fact, std::set<std::int64_t>> said;  // where
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto found = frames.find({episode, rows.integer(i, "frame")});
      ++asked;
      if (found == frames.end()) {
        unseen.push_back(name_of(episode, rows.integer(i, "frame")));
        continue;
      }
      for (const auto* facts : {&found->second.yes, &found->second.no})
        for (const Fact& fact : *facts)
          if (denied.contains(fact.predicate)) said[fact].insert(rows.integer(i, "frame"));
    }
    for (const auto& [fact, where] : said)
      for (std::size_t i = 0; i < rows.size(); ++i, ++atoms)
        if (!where.contains(rows.integer(i, "frame")))
          unsaid.push_back(name_of(episode, rows.integer(i, "frame"), to_text(fact)));
  }
  refuse_missing(job, unseen, asked, "frames that are asked about",
                 "answer each frame where a skill of the test split begins, and the one after its last");
  refuse_missing(job, unsaid, atoms, "atoms at these frames",
                 "an atom that is judged where a skill begins or ends is judged at all such frames of its episode");
}

// Every row names a frame of the data set and things that are there.
FramesJudged judged_frames(const ScoringJob& job, const Domain& learned, const HeldOutProblems& held) {
  std::map<std::int64_t, learning::History> histories = histories_of(job.hidden, job.test_units);
  for (const HeldOutEpisode& one : held.episodes)
    histories.at(one.number).objects = std::make_shared<const std::vector<TypedObject>>(one.problem.objects);
  FramesJudged frames;
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto history = histories.find(rows.integer(i, "episode"));
    if (history == histories.end()) continue;  // not of the test split
    const std::string where = job.answers.where + ", answer " + std::to_string(i + 1);
    const std::int64_t frame = rows.integer(i, "frame"),
                       holds = rows.is_null(i, "holds") ? 1 : rows.integer(i, "holds");
    if (frame < 0 || frame >= history->second.frames)
      throw Error(where, "episode " + std::to_string(history->first) + " has no frame " + std::to_string(frame),
                  "its frames are 0 to " + std::to_string(history->second.frames - 1));
    if (holds != 0 && holds != 1) throw Error(where, "'holds' is 0 or 1, not " + std::to_string(holds));
    Fact fact = fact_of(rows.text(i, "fact"), where);
    check_atom(fact, learned, where);
    const auto [at, fresh] = frames.insert({{history->first, frame}, {}});
    if (fresh) at->second = {{}, {}, learning::facts_at(history->second, frame), history->second.objects};
    if ((holds == 1 ? at->second.no : at->second.yes).contains(fact))
      throw Error(where, to_text(fact) + " is said to hold and not to hold");
    if (const auto [said, first] = (holds == 1 ? at->second.yes : at->second.no).insert(std::move(fact)); !first)
      throw Error(where, to_text(*said) + " is answered twice", "say each once");
  }
  if (frames.empty())
    throw Error(job.answers.where, "it says of no test episode what holds",
                "give the answers of the classifiers at the frames where skills begin and end");
  check_complete(job, frames);
  return frames;
}

// True predicates that the skills need and of which the held-out states have facts; `changing`: those of them that
// change there.
struct Needed {
  std::set<std::string> all, changing;
};

Needed needed_predicates(const HeldOutProblems& held) {
  std::map<std::string, std::map<learning::Objects, std::set<Facts>>> seen;
  for (const learning::Sample& sample : held.samples) {
    std::map<std::string, Facts> here;
    for (const Fact& fact : sample.facts) here[fact.predicate].insert(fact);
    for (auto& [predicate, facts] : here) seen[predicate][sample.objects].insert(std::move(facts));
  }
  Needed needed;
  for (const std::string& name : learning::predicates_of_actions(held.truth, held.actions)) {
    if (!seen.contains(name)) continue;
    needed.all.insert(name);
    for (const auto& [objects, states] : seen.at(name))
      if (states.size() > 1) needed.changing.insert(name);
  }
  return needed;
}

std::vector<Figure> mapping_figures(const learning::Mapping& mapping, const Needed& needed, std::size_t frames) {
  std::vector<Figure> figures = {
      {"coverage", mapping.coverage,
       "mean agreement (MCC) over the true predicates that the skills need; without a counterpart 0"},
      {"coverage_changing", learning::coverage_of(mapping, needed.changing), "the same over those that change"}};
  double sum = 0;
  std::size_t extra = 0;
  for (const learning::PredicateLink& one : mapping.links) {
    sum += one.agreement;
    extra += one.parts.empty();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, mapping.links.size()));
  figures.push_back({"agreement", sum / count, "mean agreement (MCC) over the learned predicates with what they mean"});
  figures.push_back({"meaningless", static_cast<double>(extra) / count, "learned predicates that mean nothing", false});
  figures.push_back({"missing", static_cast<double>(mapping.missing.size()),
                     "true predicates that the skills need and none means", false});
  figures.push_back({"frames", static_cast<double>(frames), "frames that were judged"});
  for (const learning::PredicateLink& one : mapping.links)
    figures.push_back({"predicate_" + one.learned, one.agreement, to_text(one)});
  for (const std::string& one : mapping.missing) figures.push_back({"missing_" + one, 0, "no predicate means it"});
  for (const learning::TypeLink& one : mapping.types)
    figures.push_back({"type_" + one.learned, one.overlap,
                       one.truth.empty() ? "means no type" : "its objects are those of " + one.truth});
  return figures;
}

}  // namespace

std::vector<Figure> score_abstractions(const ScoringJob& job) {
  const Domain learned = answered_domain(job);
  const HeldOutProblems held = held_out_problems(job.hidden, job.test_units);
  std::vector<learning::JudgedFrame> frames;
  for (auto& [at, frame] : judged_frames(job, learned, held)) frames.push_back(std::move(frame));
  learning::complete(frames);
  const Needed needed = needed_predicates(held);
  const learning::Mapping mapping = learning::find_mapping(learned, held.truth, frames, needed.all);
  std::vector<Figure> figures = mapping_figures(mapping, needed, frames.size());
  const learning::Translation translated = learning::in_true_words(learned, mapping, held.truth);
  figures.push_back({"left_out", static_cast<double>(translated.notes.size()),
                     translated.notes.empty() ? "literals of the operators that cannot be said in true words"
                                              : "not said in true words, the first: " + translated.notes.front(),
                     false});
  for (Figure& one : operator_figures(translated.domain, held, job)) figures.push_back(std::move(one));
  return figures;
}

}  // namespace stampede::research
