#include "db/research/symbols_of.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/read_json.h"
#include "engine/base/text.h"
#include "engine/symbolic/pddl.h"

namespace stampede::research {
namespace {

learning::Objects typed_objects(const PlainFile& file, std::int64_t episode) {
  std::vector<TypedObject> objects;
  if (file.has("objects")) {
    const Rows rows = file.query("SELECT object, type FROM objects WHERE episode = ?1 ORDER BY object", {episode});
    for (std::size_t i = 0; i < rows.size(); ++i) objects.push_back({rows.text(i, "object"), rows.text(i, "type")});
  }
  return std::make_shared<const std::vector<TypedObject>>(std::move(objects));
}

Facts facts_in(const std::string& json, const std::string& where) {
  Facts facts;
  for (const std::string& one : texts_from_json(json, where)) facts.insert(fact_of(one, where));
  return facts;
}

std::string episode_place(const PlainFile& file, std::int64_t episode) {
  return file.path().string() + ", episode " + std::to_string(episode);
}

// Domains and problems as read, each domain's text once.
class ProblemReader {
 public:
  explicit ProblemReader(const PlainFile& hidden) : hidden_(hidden) {}
  // False: the episode has none.
  bool read(std::int64_t episode, HeldOutProblems& into, Problem& problem) {
    const Rows rows = hidden_.query("SELECT domain, problem FROM problems WHERE episode = ?1", {episode});
    if (rows.size() == 0 || rows.is_null(0, "domain") || rows.is_null(0, "problem")) return false;
    const std::string where = episode_place(hidden_, episode);
    if (text_.empty()) {
      text_ = rows.text(0, "domain");
      into.truth = domain_from_pddl(text_, where);
    } else if (text_ != rows.text(0, "domain")) {
      throw Error(where, "its domain is another than that of the first held-out episode",
                  "make the data set of episodes that were run with the same scripts");
    }
    problem = problem_from_pddl(rows.text(0, "problem"), where, into.truth);
    return true;
  }

 private:
  const PlainFile& hidden_;
  std::string text_;
};

void add_held_actions(const PlainFile& hidden, std::int64_t episode, HeldOutProblems& held) {
  const Rows rows = hidden.query("SELECT DISTINCT skill, case_name FROM skills WHERE episode = ?1", {episode});
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const Action& action : held.truth.actions)
      if (action.skill == rows.text(i, "skill") && action.case_name == rows.text(i, "case_name"))
        held.actions.insert(action.name);
}

void add_held_samples(const PlainFile& hidden, const HeldOutEpisode& episode, HeldOutProblems& held) {
  const auto objects = std::make_shared<const std::vector<TypedObject>>(episode.problem.objects);
  const Rows rows = hidden.query("SELECT before, after FROM effects WHERE episode = ?1", {episode.number});
  const std::string where = episode_place(hidden, episode.number);
  std::set<Facts> seen;
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const char* moment : {"before", "after"})
      if (Facts facts = facts_in(rows.text(i, moment), where); seen.insert(facts).second)
        held.samples.push_back({objects, std::move(facts)});
}

}  // namespace

Fact fact_of(const std::string& text, const std::string& where) {
  std::vector<std::string> words;
  if (text.size() > 2 && text.front() == '(' && text.back() == ')')
    words = split(std::string_view(text).substr(1, text.size() - 2), ' ');
  const bool good = !words.empty() && std::none_of(words.begin(), words.end(), [](const std::string& word) {
    return word.empty() || word.find_first_of("()?") != std::string::npos;
  });
  if (!good) throw Error(where, "'" + text.substr(0, 60) + "' is no ground atom", "write it as (on block1 table)");
  return {words[0], {words.begin() + 1, words.end()}};
}

std::map<std::int64_t, learning::History> histories_of(const PlainFile& file,
                                                       const std::vector<std::int64_t>& episodes) {
  std::map<std::int64_t, learning::History> histories;
  for (const std::int64_t episode : episodes) {
    learning::History& history = histories[episode];
    history.objects = typed_objects(file, episode);
    history.frames = file.query("SELECT frames FROM episodes WHERE episode = ?1", {episode}).integer(0, "frames");
    const Rows rows =
        file.query("SELECT fact, first_frame, end_frame, open_end FROM facts WHERE episode = ?1", {episode});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const bool to_the_end = rows.integer(i, "open_end") != 0;
      history.spans.push_back({fact_of(rows.text(i, "fact"), episode_place(file, episode)),
                               rows.integer(i, "first_frame"),
                               to_the_end ? history.frames : rows.integer(i, "end_frame")});
    }
  }
  return histories;
}

std::vector<std::int64_t> episodes_to_learn_from(const PlainFile& given) {
  const Rows rows = given.query("SELECT episode FROM episodes WHERE split != 'test' ORDER BY episode");
  std::vector<std::int64_t> episodes;
  for (std::size_t i = 0; i < rows.size(); ++i) episodes.push_back(rows.integer(i, "episode"));
  return episodes;
}

learning::Experience labelled_experience(const PlainFile& given) {
  learning::Experience experience;
  for (const auto& [episode, history] : histories_of(given, episodes_to_learn_from(given))) {
    for (const TypedObject& one : *history.objects) experience.types[one.type] = "object";
    const Rows rows = given.query(
        "SELECT first_frame, end_frame, skill, case_name, arguments, outcome FROM skills WHERE episode = ?1 ORDER BY "
        "ordinal",
        {episode});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      learning::Transition one;
      one.skill = rows.text(i, "skill");
      if (const std::string& name = rows.text(i, "case_name"); !name.empty()) one.skill += "_" + name;
      one.arguments = texts_from_json(rows.text(i, "arguments"), episode_place(given, episode));
      one.before = learning::facts_at(history, rows.integer(i, "first_frame"));
      one.after = learning::facts_at(history, std::min(rows.integer(i, "end_frame"), history.frames - 1));
      one.success = rows.text(i, "outcome") == "success";
      one.objects = history.objects;
      experience.transitions.push_back(std::move(one));
    }
  }
  return experience;
}

HeldOutProblems held_out_problems(const PlainFile& hidden, const std::vector<std::int64_t>& episodes) {
  HeldOutProblems held;
  ProblemReader reader(hidden);
  for (const std::int64_t number : episodes) {
    HeldOutEpisode one;
    if (!reader.read(number, held, one.problem)) continue;
    one.number = number;
    const Rows source = hidden.query("SELECT task, variation, seed, outcome FROM sources WHERE episode = ?1", {number});
    one.task = source.text(0, "task");
    one.variation = source.text(0, "variation");
    one.seed = source.integer(0, "seed");
    one.succeeded = source.text(0, "outcome") == "success";
    add_held_actions(hidden, number, held);
    add_held_samples(hidden, one, held);
    held.episodes.push_back(std::move(one));
  }
  if (held.episodes.empty())
    throw Error(hidden.path().string(), "no test episode has a planning problem",
                "make the data set of a catalogue that `stampede run` has made");
  return held;
}

}  // namespace stampede::research
