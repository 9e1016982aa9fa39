// Named predicates against the facts, at every 20th frame; and learned symbols against predicates, before and after
// skills.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "db/research/frame_answers.h"
#include "db/research/matching.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kAskedEvery = 20;  // frames, as in db/datasets/asked_*.sql

using Moment = std::pair<std::int64_t, std::string>;  // of an episode (`frame 20`) or piece (`before`)
using Ground = std::map<Moment, std::set<std::string>>;

std::string frame_name(std::int64_t frame) { return "frame " + std::to_string(frame); }

// `(on block1 table)`: its words, or nothing where it is none.
std::vector<std::string> words_of(const std::string& atom) {
  if (atom.size() < 3 || atom.front() != '(' || atom.back() != ')') return {};
  const std::vector<std::string> words = split(std::string_view(atom).substr(1, atom.size() - 2), ' ');
  if (std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return word.empty() || word.find_first_of("()") != std::string::npos;
      }))
    return {};
  return words;
}

std::vector<std::string> words_or_refuse(const ScoringJob& job, const std::string& atom, std::size_t row) {
  const std::vector<std::string> words = words_of(atom);
  if (words.empty())
    throw Error(job.answers.where + ", answer " + std::to_string(row + 1),
                "'" + atom.substr(0, 60) + "' is no ground atom", "write it as (on block1 table)");
  return words;
}

struct Agreement {
  double both = 0, answered = 0, there = 0;  // atoms
  double f1() const { return answered + there > 0 ? 2 * both / (answered + there) : 1; }
  double precision() const { return answered > 0 ? both / answered : 0; }
  double recall() const { return there > 0 ? both / there : 0; }
  // Matthews 1975; `all`: atoms that could hold.
  double mcc(double all) const {
    const double wrong = answered - both, missed = there - both, neither = all - both - wrong - missed;
    const double scale = std::sqrt(answered * there * (neither + wrong) * (neither + missed));
    return scale > 0 ? (both * neither - wrong * missed) / scale : 0;
  }
};

void count(Agreement& agreement, const std::set<std::string>& truth, const std::set<std::string>& answer) {
  agreement.there += static_cast<double>(truth.size()), agreement.answered += static_cast<double>(answer.size());
  for (const std::string& atom : answer) agreement.both += truth.contains(atom) ? 1 : 0;
}

std::string predicate_of(const std::string& atom) { return words_of(atom).front(); }

std::set<std::string> of_predicate(const std::set<std::string>& atoms, const std::string& predicate) {
  std::set<std::string> some;
  for (const std::string& atom : atoms)
    if (predicate_of(atom) == predicate) some.insert(atom);
  return some;
}

Ground true_facts(const ScoringJob& job, std::map<std::string, std::size_t>& predicates) {
  Ground truth;
  const Rows names = job.hidden.query(
      "SELECT DISTINCT predicate, (arg1 IS NOT NULL) + (arg2 IS NOT NULL) + (arg3 IS NOT NULL) + (arg4 IS NOT NULL) AS "
      "n "
      "FROM facts WHERE predicate_kind IN ('basic', 'derived')");
  for (std::size_t i = 0; i < names.size(); ++i)
    predicates[names.text(i, "predicate")] = static_cast<std::size_t>(names.integer(i, "n"));
  for (const std::int64_t episode : job.test_units) {
    const std::int64_t frames =
        job.hidden.query("SELECT frames FROM episodes WHERE episode = ?1", {episode}).integer(0, "frames");
    for (std::int64_t frame = 0; frame < frames; frame += kAskedEvery) truth[{episode, frame_name(frame)}];
    const Rows rows = job.hidden.query(
        "SELECT fact, first_frame, end_frame FROM facts WHERE episode = ?1 AND predicate_kind IN ('basic', 'derived')",
        {episode});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::int64_t end = std::min(rows.integer(i, "end_frame"), frames);
      const std::int64_t first = (rows.integer(i, "first_frame") + kAskedEvery - 1) / kAskedEvery * kAskedEvery;
      for (std::int64_t frame = first; frame < end; frame += kAskedEvery)
        truth.at({episode, frame_name(frame)}).insert(rows.text(i, "fact"));
    }
  }
  return truth;
}

// Each moment that is asked about is answered, be it by a row without an atom: nothing holds there. So half a file is
// no answer, and what is not said is taken not to hold.
void refuse_silence(const ScoringJob& job, const std::set<Moment>& asked, const std::set<Moment>& answered,
                    const std::string& unit, const std::string& column) {
  std::vector<std::string> missing;
  for (const Moment& moment : asked)
    if (!answered.contains(moment))
      missing.push_back(moment.second + " of " + unit + " " + std::to_string(moment.first));
  refuse_missing(job, missing, asked.size(), "moments that are asked about",
                 "answer each; where nothing holds, with a row without '" + column + "'");
}

[[noreturn]] void refuse_twice(const std::string& where, const std::string& said, const Moment& moment,
                               const std::string& unit) {
  throw Error(where, said + " is answered twice: " + moment.second + " of " + unit + " " + std::to_string(moment.first),
              "say each once");
}

void check_predicate(const std::vector<std::string>& words, const std::map<std::string, std::size_t>& predicates,
                     const std::string& where) {
  std::vector<std::string> names;
  for (const auto& [name, arguments] : predicates) names.push_back(name);
  const auto predicate = predicates.find(words.front());
  if (predicate == predicates.end())
    throw Error(where, "there is no predicate '" + words.front() + "'", did_you_mean(words.front(), names));
  if (predicate->second + 1 != words.size())
    throw Error(where, words.front() + " takes " + std::to_string(predicate->second) + " arguments, not " +
                           std::to_string(words.size() - 1));
}

Ground answered_facts(const ScoringJob& job, const Ground& truth,
                      const std::map<std::string, std::size_t>& predicates) {
  const std::set<std::int64_t> tests(job.test_units.begin(), job.test_units.end());
  Ground answers;
  for (std::size_t i = 0; i < job.answers.rows.size(); ++i) {
    const std::int64_t episode = job.answers.rows.integer(i, "episode"), frame = job.answers.rows.integer(i, "frame");
    const std::string where = job.answers.where + ", answer " + std::to_string(i + 1);
    const bool none = job.answers.rows.is_null(i, "fact");
    const std::string atom = none ? "" : job.answers.rows.text(i, "fact");
    if (!none) check_predicate(words_or_refuse(job, atom, i), predicates, where);
    if (!tests.contains(episode)) continue;
    const Moment moment = {episode, frame_name(frame)};
    if (!truth.contains(moment))
      throw Error(where, moment.second + " of episode " + std::to_string(episode) + " is not asked about",
                  "asked about is every 20th frame that the episode has: 0, 20, 40 …");
    std::set<std::string>& there = answers[moment];
    if (!none && !there.insert(atom).second) refuse_twice(where, atom, moment, "episode");
  }
  std::set<Moment> asked, answered;
  for (const auto& [moment, atoms] : truth) asked.insert(moment);
  for (const auto& [moment, atoms] : answers) answered.insert(moment);
  refuse_silence(job, asked, answered, "episode", "fact");
  return answers;
}

// Atoms of the vocabulary about the things that there are, all moments together.
double possible_atoms(const ScoringJob& job, const Ground& truth,
                      const std::map<std::string, std::size_t>& predicates) {
  std::map<std::int64_t, double> of_episode;
  for (const std::int64_t episode : job.test_units) {
    const auto objects = static_cast<double>(
        job.hidden.query("SELECT count(*) AS n FROM objects WHERE episode = ?1", {episode}).integer(0, "n"));
    for (const auto& [name, arguments] : predicates) of_episode[episode] += std::pow(objects, arguments);
  }
  double sum = 0;
  for (const auto& [moment, atoms] : truth) sum += of_episode.at(moment.first);
  return sum;
}

}  // namespace

std::vector<Figure> score_facts(const ScoringJob& job) {
  std::map<std::string, std::size_t> predicates;
  const Ground truth = true_facts(job, predicates);
  const Ground answers = answered_facts(job, truth, predicates);
  Agreement whole;
  std::map<std::string, Agreement> of_predicates;
  for (const auto& [moment, atoms] : truth) {
    const auto found = answers.find(moment);
    const std::set<std::string> answer = found == answers.end() ? std::set<std::string>{} : found->second;
    count(whole, atoms, answer);
    for (const auto& [name, arguments] : predicates)
      count(of_predicates[name], of_predicate(atoms, name), of_predicate(answer, name));
  }
  double sum = 0;
  for (const auto& [name, agreement] : of_predicates) sum += agreement.f1();
  std::vector<Figure> figures = {
      {"precision", whole.precision(), "atoms answered that are facts"},
      {"recall", whole.recall(), "facts that are answered"},
      {"f1", whole.f1(), "F1 over atoms of all moments"},
      {"mcc", whole.mcc(possible_atoms(job, truth, predicates)), "Matthews' correlation over all possible atoms"},
      {"mean_f1", of_predicates.empty() ? 0 : sum / static_cast<double>(of_predicates.size()),
       "mean F1 of predicates"}};
  for (const auto& [name, agreement] : of_predicates)
    figures.push_back({"f1_of_" + name, agreement.f1(), "F1 of " + name});
  return figures;
}

namespace {

using Lifted = std::pair<std::string, std::size_t>;      // name, arguments
using Extent = std::map<Lifted, std::set<std::string>>;  // where each holds: piece, moment and arguments

// F1 of each predicate (row) with each symbol (column) of as many arguments; 0 with others.
Eigen::MatrixXd agreements(const Extent& truth, const Extent& answers) {
  Eigen::MatrixXd f1 =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(truth.size()), static_cast<Eigen::Index>(answers.size()));
  Eigen::Index row = 0;
  for (const auto& [predicate, there] : truth) {
    Eigen::Index column = 0;
    for (const auto& [symbol, said] : answers) {
      Agreement agreement;
      if (symbol.second == predicate.second) count(agreement, there, said);
      if (symbol.second == predicate.second) f1(row, column) = agreement.f1();
      ++column;
    }
    ++row;
  }
  return f1;
}

}  // namespace

std::vector<Figure> score_symbols(const ScoringJob& job) {
  const std::set<std::int64_t> tests(job.test_units.begin(), job.test_units.end());
  const auto add = [](Extent& extent, std::int64_t piece, const std::string& moment,
                      const std::vector<std::string>& words) {
    std::string place = std::to_string(piece) + " " + moment;
    for (std::size_t i = 1; i < words.size(); ++i) place += " " + words[i];
    return extent[{words.front(), words.size() - 1}].insert(place).second;
  };
  Extent truth, answers;
  const Rows facts = job.hidden.query("SELECT piece, moment, fact FROM facts ORDER BY piece");
  for (std::size_t i = 0; i < facts.size(); ++i)
    if (tests.contains(facts.integer(i, "piece")))
      add(truth, facts.integer(i, "piece"), facts.text(i, "moment"), words_of(facts.text(i, "fact")));
  std::set<Moment> asked, answered;
  for (const std::int64_t piece : tests) asked.insert({{piece, "before"}, {piece, "after"}});
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& moment = rows.text(i, "moment");
    if (moment != "before" && moment != "after")
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1), "'" + moment + "' is no moment",
                  "it is before or after");
    const Moment at = {rows.integer(i, "piece"), moment};
    const std::string where = job.answers.where + ", answer " + std::to_string(i + 1);
    if (rows.is_null(i, "symbol")) {
      answered.insert(at);
      continue;
    }
    const std::vector<std::string> words = words_or_refuse(job, rows.text(i, "symbol"), i);
    if (!tests.contains(at.first)) continue;
    answered.insert(at);
    if (!add(answers, at.first, moment, words)) refuse_twice(where, rows.text(i, "symbol"), at, "piece");
  }
  refuse_silence(job, asked, answered, "piece", "symbol");
  const Eigen::MatrixXd f1 = agreements(truth, answers);
  const std::vector<int> match = best_matching(f1);
  std::vector<Figure> figures;
  double sum = 0;
  std::size_t i = 0;
  for (const auto& [predicate, there] : truth) {
    const double value = match[i] < 0 ? 0 : f1(static_cast<Eigen::Index>(i), match[i]);
    figures.push_back({"f1_of_" + predicate.first, value, "F1 of the symbol matched with " + predicate.first});
    sum += value, ++i;
  }
  figures.insert(figures.begin(), {"mean_f1", truth.empty() ? 0 : sum / static_cast<double>(truth.size()),
                                   "mean F1 of predicates and the symbols matched with them"});
  figures.insert(figures.begin() + 1,
                 {"symbols", static_cast<double>(answers.size()), "symbols that the answers use", false});
  return figures;
}

}  // namespace stampede::research
