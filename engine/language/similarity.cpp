#include "engine/language/similarity.h"

#include <algorithm>
#include <set>

#include "engine/language/lexicon.h"

namespace stampede {
namespace {

std::vector<std::string> words_of(const std::string& sentence, const English& english) {
  std::vector<std::string> words;
  for (PlainWord& word : plain_words(sentence, english))
    if (!english.has(word.text, "polite")) words.push_back(std::move(word.text));
  return words;
}

double edits(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t k = 0; k <= b.size(); ++k) row[k] = k;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t corner = row[0];
    row[0] = i + 1;
    for (std::size_t k = 0; k < b.size(); ++k) {
      const std::size_t kept = corner + (a[i] == b[k] ? 0 : 1);
      corner = row[k + 1];
      row[k + 1] = std::min({kept, row[k] + 1, row[k + 1] + 1});
    }
  }
  return static_cast<double>(row.back());
}

std::set<std::pair<std::string, std::string>> pairs_of(const std::vector<std::string>& words) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0; i <= words.size(); ++i)
    pairs.emplace(i == 0 ? "" : words[i - 1], i == words.size() ? "" : words[i]);
  return pairs;
}

}  // namespace

double similarity(const std::string& a, const std::string& b, const English& english) {
  const std::vector<std::string> first = words_of(a, english), second = words_of(b, english);
  const std::size_t longer = std::max(first.size(), second.size());
  if (longer == 0) return 1;
  const double kept = 1 - edits(first, second) / static_cast<double>(longer);
  const auto ours = pairs_of(first), theirs = pairs_of(second);
  std::size_t shared = 0;
  for (const auto& pair : ours) shared += theirs.count(pair);
  const double resemblance = static_cast<double>(shared) / static_cast<double>(ours.size() + theirs.size() - shared);
  return std::max(kept, resemblance);
}

const std::string* near_duplicate(const std::string& sentence, const std::vector<std::string>& others,
                                  const English& english) {
  for (const std::string& other : others)
    if (similarity(sentence, other, english) >= kNearDuplicate) return &other;
  return nullptr;
}

}  // namespace stampede
