#include "engine/language/english.h"

#include <algorithm>
#include <sstream>

namespace stampede {

std::vector<English::Stem> English::stems(const std::string& word) const {
  std::vector<Stem> all = {{word, false}};
  if (const auto form = irregular.find(word); form != irregular.end()) all.push_back(form->second);
  for (const Ending& ending : endings) {
    if (word.size() <= ending.from.size() + 1 || !word.ends_with(ending.from) ||
        (!ending.unless.empty() && word.ends_with(ending.unless)))
      continue;
    const std::string stem = word.substr(0, word.size() - ending.from.size());
    all.push_back({stem + ending.to, ending.plural});
    const bool doubled = stem.size() > 2 && stem[stem.size() - 1] == stem[stem.size() - 2];
    if (!ending.plural && ending.to.empty() && doubled) all.push_back({stem.substr(0, stem.size() - 1), false});
  }
  return all;
}

bool English::is_done(const std::string& word) const {
  return std::ranges::any_of(endings, [&](const Ending& ending) { return ending.done && word.ends_with(ending.from); });
}

void English::add(const std::string& word, const std::string& sense, WordKind kind) {
  words[word].push_back({sense, kind});
}

bool English::has(const std::string& word, WordClass of) const {
  const auto found = classes.find(word);
  return found != classes.end() && found->second.test(of.index());
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

}  // namespace stampede
