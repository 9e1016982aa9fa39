#include "db/research/leaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <set>
#include <tuple>

namespace stampede::research {
namespace {

using Ids = std::set<std::int64_t>;

bool tests(const Split& split, std::int64_t episode) { return split.of.at(episode) == "test"; }

// What is looked for: a value, or both of a pair. Of pairs of skills nothing: they are seen in segments alone.
std::vector<std::vector<std::string>> sought(const Split& split, const SplitRule& rule) {
  std::vector<std::vector<std::string>> all;
  for (const HeldOut& one : split.held_out) {
    if (rule.kind == SplitRule::Kind::skill_pairs) continue;
    all.push_back({one.first});
    if (!one.second.empty()) all.back().push_back(one.second);
  }
  return all;
}

// `red_block` as a sentence says it, as a whole word: an extended regular expression, for lower case.
std::string pattern_of(const std::string& value) {
  std::string pattern = "(^|[^[:alnum:]_])";
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '_')
      pattern += "[ _-]";
    else if (std::isalnum(byte) != 0 || byte >= 0x80)
      pattern += static_cast<char>(std::tolower(byte));
    else
      pattern += std::string("\\") + c;
  }
  return pattern + "s?($|[^[:alnum:]_])";
}

// Of the episodes that a question names, one a row, those for training.
std::vector<std::int64_t> training(const Catalogue& catalogue, const Split& split, const std::string& question,
                                   const std::vector<SqlValue>& parameters) {
  std::vector<std::int64_t> found;
  const Rows rows = catalogue.query(question, {.parameters = parameters});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::int64_t episode = rows.integer(i, "episode");
    if (split.of.contains(episode) && !tests(split, episode)) found.push_back(episode);
  }
  return found;
}

Ids both(const Ids& one, const Ids& other) {
  Ids ids;
  std::set_intersection(one.begin(), one.end(), other.begin(), other.end(), std::inserter(ids, ids.end()));
  return ids;
}

// Where one value shows.
struct Shown {
  Ids axes, things;
};

Shown where_shown(const Catalogue& catalogue, const Split& split, const std::string& value) {
  const auto ids = [&](const std::string& question, const std::string& parameter) {
    const std::vector<std::int64_t> found = training(catalogue, split, question, {parameter});
    return Ids(found.begin(), found.end());
  };
  Shown shown;
  shown.axes = ids("SELECT episode FROM axes WHERE value = ?1", value);
  shown.things = ids(
      "SELECT episode FROM objects o WHERE ?1 IN (class, type) OR EXISTS (SELECT 1 FROM json_each(o.attributes) WHERE "
      "CAST(value AS TEXT) = ?1)",
      value);
  return shown;
}

Ids either(Ids one, const Ids& other) {
  one.insert(other.begin(), other.end());
  return one;
}

// Of a pair: where both show, in words where one sentence says both.
Leak leak_of(const Catalogue& catalogue, const Split& split, const std::vector<std::string>& values) {
  Shown shown = where_shown(catalogue, split, values.front());
  Leak leak{.value = values.front()};
  std::string question = "SELECT episode FROM instructions WHERE lower(text) REGEXP ?1";
  std::vector<SqlValue> patterns = {pattern_of(values.front())};
  if (values.size() > 1) {
    const Shown other = where_shown(catalogue, split, values[1]);
    shown = {both(shown.axes, other.axes), both(either(shown.axes, shown.things), either(other.axes, other.things))};
    leak.value += " and " + values[1];
    question += " AND lower(text) REGEXP ?2";
    patterns.emplace_back(pattern_of(values[1]));
  }
  const std::vector<std::int64_t> told = training(catalogue, split, question, patterns);
  const Ids words(told.begin(), told.end());
  const auto count = [](const auto& ids) { return static_cast<std::int64_t>(ids.size()); };
  leak.by_axis = count(shown.axes), leak.by_things = count(shown.things), leak.by_words = count(words);
  leak.sentences = count(told), leak.episodes = count(either(either(shown.axes, shown.things), words));
  return leak;
}

// Test episodes that have one of the things that `of` tells, which a training episode has too.
template <typename Thing>
std::int64_t shared(const std::vector<std::pair<std::int64_t, Thing>>& of, const Split& split) {
  std::set<Thing> trained;
  for (const auto& [episode, thing] : of)
    if (!tests(split, episode)) trained.insert(thing);
  Ids ids;
  for (const auto& [episode, thing] : of)
    if (tests(split, episode) && trained.contains(thing)) ids.insert(episode);
  return static_cast<std::int64_t>(ids.size());
}

std::string shown(const Leak& leak) {
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", leak.value, leak.by_axis, leak.by_things, leak.by_words,
                     leak.sentences, leak.episodes);
}

}  // namespace

Leaks leaks_of(const Catalogue& catalogue, const std::vector<SplitEpisode>& episodes, const Split& split,
               const SplitRule& rule) {
  Leaks leaks;
  for (const SplitEpisode& one : episodes) leaks.training += tests(split, one.id) ? 0 : 1;
  for (const auto& values : sought(split, rule)) leaks.values.push_back(leak_of(catalogue, split, values));
  std::vector<std::pair<std::int64_t, std::tuple<std::string, std::string, std::int64_t>>> starts;
  const Rows simulated = catalogue.query("SELECT episode, task, variation, seed FROM episodes WHERE source = 'sim'");
  for (std::size_t i = 0; i < simulated.size(); ++i)
    if (split.of.contains(simulated.integer(i, "episode")))
      starts.push_back({simulated.integer(i, "episode"),
                        {simulated.text(i, "task"), simulated.text(i, "variation"), simulated.integer(i, "seed")}});
  leaks.shared_starts = shared(starts, split);
  std::vector<std::pair<std::int64_t, std::string>> phrases;
  const Rows sentences = catalogue.query("SELECT episode, text FROM instructions WHERE level = 'task'");
  for (std::size_t i = 0; i < sentences.size(); ++i)
    if (split.of.contains(sentences.integer(i, "episode")))
      phrases.push_back({sentences.integer(i, "episode"), sentences.text(i, "text")});
  leaks.shared_phrases = shared(phrases, split);
  return leaks;
}

std::string leaks_text(const Leaks& leaks, const SplitRule& rule) {
  std::string text;
  if (!leaks.values.empty()) {
    text += fmt::format(
        "A split by `{}` holds out episodes by that alone. What else of it training and validation show, in so many of "
        "their {} episodes:\n\n| held out | as a value of an axis | as a thing, or of one | in words | sentences | in "
        "all |\n|---|---|---|---|---|---|\n",
        rule.text(), leaks.training);
    for (const Leak& leak : leaks.values) text += shown(leak);
    text += "\nThings are all that stand about, those without a part in the task too.\n\n";
  }
  text += fmt::format(
      "Test episodes whose start (task, variation, seed) is that of a training episode: {}; of whose sentences for the "
      "task one is that of a training episode, word for word: {}.\n",
      leaks.shared_starts, leaks.shared_phrases);
  return text;
}

std::string leaks_line(const Leaks& leaks) {
  std::string text;
  constexpr std::size_t kMost = 3;
  std::size_t told = 0;
  for (const Leak& leak : leaks.values) {
    if (leak.episodes == 0 || ++told > kMost) continue;
    text += fmt::format(
        "{}{}: {} of {} episodes that are not for test show it ({} as an axis, {} in things, {} in {} sentences)",
        text.empty() ? "" : "; ", leak.value, leak.episodes, leaks.training, leak.by_axis, leak.by_things,
        leak.by_words, leak.sentences);
  }
  if (told > kMost) text += fmt::format("; and {} more", told - kMost);
  if (leaks.shared_starts > 0)
    text += fmt::format("{}{} test episodes start as a training episode does", text.empty() ? "" : "; ",
                        leaks.shared_starts);
  return text;
}

}  // namespace stampede::research
