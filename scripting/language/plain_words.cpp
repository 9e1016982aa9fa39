// From characters to words: typography, possessives, and phrases of several words that are one.
#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "scripting/language/lexicon.h"

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

using Phrases = std::map<std::string, std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>>>;

// By first word, the longest first.
const Phrases& phrases() {
  static const Phrases all = [] {
    Phrases made;
    std::istringstream lines(kPhraseText);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find('=');
      if (equals == std::string::npos) continue;
      const std::vector<std::string> from = words_in(line.substr(0, equals));
      made[from.front()].emplace_back(from, words_in(line.substr(equals + 1)));
    }
    for (auto& [word, list] : made)
      std::stable_sort(list.begin(), list.end(),
                       [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
    return made;
  }();
  return all;
}

std::vector<PlainWord> with_phrases(const std::vector<PlainWord>& words) {
  std::vector<PlainWord> result;
  for (std::size_t i = 0; i < words.size();) {
    std::size_t taken = 0;
    if (const auto found = phrases().find(words[i].text); found != phrases().end()) {
      for (const auto& [from, to] : found->second) {
        bool same = i + from.size() <= words.size();
        for (std::size_t k = 0; same && k < from.size(); ++k)
          same = words[i + k].text == from[k] && (k == 0 || words[i + k].before == ' ');
        if (!same) continue;
        for (std::size_t k = 0; k < to.size(); ++k) result.push_back({to[k], k == 0 ? words[i].before : ' '});
        taken = from.size();
        break;
      }
    }
    if (taken == 0) result.push_back(words[i]);
    i += std::max<std::size_t>(taken, 1);
  }
  return result;
}

// `give the button a push`: push the button
std::vector<PlainWord> without_giving(std::vector<PlainWord> words) {
  static const std::set<std::string> kDone = {"push", "shove", "pull", "twist", "press", "turn", "tap", "nudge", "tug"};
  for (std::size_t i = 0; i + 3 < words.size(); ++i) {
    if (words[i].text != "give" && words[i].text != "giving") continue;
    for (std::size_t k = i + 2; k + 1 < words.size() && words[k].before == ' '; ++k) {
      if (words[k].text != "a" || words[k + 1].before != ' ' || !kDone.contains(words[k + 1].text)) continue;
      words[i].text = words[k + 1].text;
      words.erase(words.begin() + static_cast<std::ptrdiff_t>(k), words.begin() + static_cast<std::ptrdiff_t>(k) + 2);
      break;
    }
  }
  return words;
}

}  // namespace

std::string spaced_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::vector<PlainWord> plain_words(std::string_view sentence) {
  std::vector<PlainWord> words;
  std::string text;
  char before = ' ';
  const auto end_word = [&] {
    while (text.ends_with('\'') || text.ends_with('-')) text.pop_back();
    while (text.starts_with('\'') || text.starts_with('-')) text.erase(0, 1);
    if (text.empty()) return;
    const bool possessive = text.size() > 2 && text.ends_with("'s") && text != "it's" && text != "that's" &&
                            text != "there's" && text != "let's";
    if (possessive) text.resize(text.size() - 2);
    words.push_back({text, before});
    if (possessive) words.push_back({"'s", ' '});
    text.clear();
    before = ' ';
  };
  for (const char c : plain_text(sentence)) {
    if (is_letter(c)) {
      text += c;
      continue;
    }
    end_word();
    if (c == ',' || c == ';' || c == ':' || c == '.' || c == '!' || c == '?' || c == '(' || c == ')')
      before = c == '!' || c == '?' ? '.' : c == '(' || c == ')' ? ',' : c;
  }
  end_word();
  return with_phrases(without_giving(std::move(words)));
}

}  // namespace stampede
