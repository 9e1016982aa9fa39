// From characters to words: typography, possessives, and phrases of several words that are one.
#include <algorithm>
#include <array>

#include "engine/language/lexicon.h"

namespace stampede {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '\'' || c == '-' || c == '{' || c == '}' ||
         c == '_' || static_cast<unsigned char>(c) >= 0x80;
}

// Quotes and dashes of typography as plain characters.
std::string plain_text(std::string_view sentence) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSigns = {{{"\xE2\x80\x99", "'"},
                                                                                           {"\xE2\x80\x98", "'"},
                                                                                           {"\xE2\x80\x9C", " "},
                                                                                           {"\xE2\x80\x9D", " "},
                                                                                           {"\xE2\x80\x93", ", "},
                                                                                           {"\xE2\x80\x94", ", "}}};
  std::string text;
  for (std::size_t i = 0; i < sentence.size();) {
    const auto sign = std::find_if(kSigns.begin(), kSigns.end(),
                                   [&](const auto& one) { return sentence.substr(i).starts_with(one.first); });
    if (sign != kSigns.end()) {
      text += sign->second;
      i += sign->first.size();
      continue;
    }
    const char c = sentence[i++];
    text += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return text;
}

// With the punctuation before each, by what it does: `!` ends as `.` does, brackets part as commas do.
std::vector<PlainWord> split(const std::string& text, const English& english) {
  static const std::map<char, char> kPunctuation = {{',', ','}, {';', ';'}, {':', ':'}, {'.', '.'},
                                                    {'!', '.'}, {'?', '.'}, {'(', ','}, {')', ','}};
  std::vector<PlainWord> words;
  char before = ' ';
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_letter(text[end])) ++end;
    std::string word = text.substr(i, end - i);
    i = std::max(end, i + 1);
    while (word.ends_with('\'') || word.ends_with('-')) word.pop_back();
    while (word.starts_with('\'') || word.starts_with('-')) word.erase(0, 1);
    if (!word.empty()) {
      const bool possessive = word.size() > 2 && word.ends_with("'s") && !english.words.contains(word);
      if (possessive) word.resize(word.size() - 2);
      words.push_back({word, std::exchange(before, ' ')});
      if (possessive) words.push_back({"'s", ' '});
    }
    if (end >= text.size()) break;
    if (const auto sign = kPunctuation.find(text[end]); sign != kPunctuation.end()) before = sign->second;
    i = end + 1;
  }
  return words;
}

std::vector<PlainWord> with_phrases(const std::vector<PlainWord>& words, const English& english) {
  std::vector<PlainWord> result;
  for (std::size_t i = 0; i < words.size();) {
    std::size_t taken = 0;
    if (const auto found = english.phrases.find(words[i].text); found != english.phrases.end())
      for (const auto& [from, to] : found->second) {
        bool same = i + from.size() <= words.size();
        for (std::size_t k = 1; same && k < from.size(); ++k)
          same = words[i + k].text == from[k] && words[i + k].before == ' ';
        if (!same) continue;
        for (std::size_t k = 0; k < to.size(); ++k) result.push_back({to[k], k == 0 ? words[i].before : ' '});
        taken = from.size();
        break;
      }
    if (taken == 0) result.push_back(words[i]);
    i += std::max<std::size_t>(taken, 1);
  }
  return result;
}

// `give the button a push`: push the button
std::vector<PlainWord> without_giving(std::vector<PlainWord> words, const English& english) {
  for (std::size_t i = 0; i + 3 < words.size(); ++i) {
    if (!english.has(words[i].text, "giving")) continue;
    for (std::size_t k = i + 2; k + 1 < words.size() && words[k].before == ' '; ++k) {
      if (!english.has(words[k].text, "article") || words[k + 1].before != ' ' ||
          !english.has(words[k + 1].text, "given"))
        continue;
      words[i].text = words[k + 1].text;
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(k), words.begin() + static_cast<std::ptrdiff_t>(k) + 2);
      break;
    }
  }
  return words;
}

}  // namespace

std::vector<PlainWord> plain_words(std::string_view sentence, const English& english) {
  return with_phrases(without_giving(split(plain_text(sentence), english), english), english);
}

}  // namespace stampede
