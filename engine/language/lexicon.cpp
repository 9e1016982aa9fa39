#include "engine/language/lexicon.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace stampede {
namespace {

bool is_digits(const std::string& text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

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
    const auto sign =
        std::ranges::find_if(kSigns, [&](const auto& one) { return sentence.substr(i).starts_with(one.first); });
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

const Lexicon::Entries* Lexicon::exactly(const std::string& word) const {
  if (const auto found = learned_.find(word); found != learned_.end()) return &found->second;
  const auto found = english_->words.find(word);
  return found == english_->words.end() ? nullptr : &found->second;
}

// A form of a word that is known itself is only ever another noun or verb.
std::vector<Lexicon::Known> Lexicon::known(const std::string& word) const {
  std::vector<Known> all;
  for (const English::Stem& stem : english_->stems(word)) {
    const Entries* entries = exactly(stem.text);
    const bool is_form = stem.text != word;
    if (entries == nullptr || (is_form && entries->front().kind == WordKind::negation))
      continue;  // `notes` is no `not`
    for (const auto& [sense, kind] : *entries)
      if (!is_form || kind == WordKind::noun || kind == WordKind::verb || exactly(word) == nullptr)
        all.push_back({sense, kind, stem.plural});
  }
  return all;
}

void Lexicon::learn(const std::string& word, const std::string& sense, WordKind kind) {
  if (!learned_.contains(word) && exactly(word) != nullptr) learned_[word] = *exactly(word);
  learned_[word].push_back({sense, kind});
}

std::string spaced_name(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

std::vector<std::string> name_words(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '_' || c == '.' || (c >= '0' && c <= '9'); }, ' ');
  std::vector<std::string> words = words_in(name);
  std::erase_if(words, [](const std::string& word) { return word.size() < 2; });  // a square of a board, one of several
  return words;
}

void Lexicon::learn_noun(std::string_view name) {
  for (const std::string& word : name_words(std::string(name)))
    if (std::ranges::all_of(known(word), [](const Known& one) {
          return one.kind == WordKind::own || one.kind == WordKind::verb || one.kind == WordKind::harmless;
        }))
      learn(word, word, WordKind::noun);
}

void Lexicon::learn_colour(const std::string& name) {
  if (std::ranges::count(known(name), WordKind::colour, &Known::kind) == 0) learn(name, name, WordKind::colour);
}

void Lexicon::learn_own(std::string_view sentence) {
  for (const PlainWord& word : plain_words(sentence, *english_)) {
    if (is_digits(word.text) || word.text == "'s" || !known(word.text).empty()) continue;
    std::string stem = word.text;
    for (const English::Stem& one : english_->stems(word.text))
      if (one.plural && one.text.size() > 2) stem = one.text;
    learn(stem, stem, WordKind::own);
    if (stem != word.text) learn(word.text, stem, WordKind::own);
  }
}

// Which kinds are looked for, one after the other: what the words before lead to.
std::vector<WordKind> Lexicon::due(const std::string& text, const std::vector<Word>& before, char punctuation,
                                   const std::string& next) const {
  using enum WordKind;
  const Word* last = before.empty() || punctuation != ' ' ? nullptr : &before.back();  // null: a stretch begins
  const bool after_noun = !before.empty() && before.back().kind == noun && before.back().text != "'s";
  // `the box stands open`, `let it stand open`: no stand
  const bool says = after_noun && (english_->has(text, "standing") || english_->has(next, "state"));
  const bool noun_due = last != nullptr && !says &&
                        (english_->has(last->text, "noun_follows") || last->kind == adjective || last->kind == colour ||
                         last->kind == number || last->kind == place || last->kind == noun);
  const bool verb_due = last == nullptr || says || last->kind == order || last->kind == harmless ||
                        english_->has(last->text, "verb_follows");
  std::vector<WordKind> kinds = {grammar, noun, place, verb};
  if (noun_due)
    kinds = {noun, colour, place, adjective, exclusion, verb};
  else if (verb_due)
    kinds = {order, verb, noun};
  if (after_noun && english_->is_done(text)) kinds.insert(kinds.begin(), verb);  // `the drawer pushed shut`
  if (english_->has(text, "modal") && (!noun_due || after_noun)) kinds.insert(kinds.begin(), grammar);
  return kinds;
}

void Lexicon::set_kind(Word& word, WordKind kind, const std::string& sense) const {
  word.kind = kind;
  word.sense = sense;
  word.classes.reset();
  for (const std::string* one : {&word.text, &word.sense})
    if (const auto found = english_->classes.find(*one); found != english_->classes.end())
      word.classes |= found->second;
}

Word Lexicon::choose(const std::string& text, const std::vector<Word>& before, char punctuation,
                     const std::string& next) const {
  Word word{text, text, WordKind::unknown, false, english_->is_done(text), punctuation};
  const auto become = [&](WordKind kind, const std::string& sense) { return set_kind(word, kind, sense), word; };
  if (text == "'s") return become(WordKind::grammar, text);
  if (text.starts_with('{')) return become(WordKind::noun, text);
  if (is_digits(text)) return become(WordKind::number, text);
  const std::vector<Known> all = known(text);
  if (all.empty()) return become(WordKind::unknown, text);
  const Known* chosen = &all.front();
  for (const WordKind kind : due(text, before, punctuation, next))
    if (const auto found = std::ranges::find(all, kind, &Known::kind); found != all.end()) {
      chosen = &*found;
      break;
    }
  word.plural = chosen->kind == WordKind::noun && chosen->plural;
  return become(chosen->kind, chosen->sense);
}

std::vector<Word> Lexicon::read(std::string_view sentence) const {
  std::vector<Word> words;
  const std::vector<PlainWord> all = plain_words(sentence, *english_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const PlainWord& plain = all[i];
    Word word = choose(plain.text, words, plain.before, i + 1 < all.size() ? all[i + 1].text : "");
    if (word.kind != WordKind::unknown || plain.text.find('-') == std::string::npos) {
      words.push_back(std::move(word));
      continue;
    }
    char before = plain.before;  // `red-coloured`
    std::istringstream parts(plain.text);
    for (std::string part; std::getline(parts, part, '-'); before = ' ')
      if (!part.empty() && !english_->has(part, "painted")) words.push_back(choose(part, words, before, ""));
  }
  return words;
}

std::string Lexicon::sense_of_noun(const std::string& word) const {
  const std::vector<Known> all = known(word);
  const auto noun = std::ranges::find(all, WordKind::noun, &Known::kind);
  return noun == all.end() ? word : noun->sense;
}

const std::set<std::string>& Lexicon::skills_of(const std::string& verb) const {
  static const std::set<std::string> kNone;
  const auto found = english_->skills.find(verb);
  return found == english_->skills.end() ? kNone : found->second;
}

}  // namespace stampede
