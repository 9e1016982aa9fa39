#include "engine/language/lexicon.h"

#include <algorithm>
#include <sstream>

namespace stampede {
namespace {

bool is_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool has_kind(const std::vector<English::Entry>& entries, WordKind kind) {
  return std::any_of(entries.begin(), entries.end(), [&](const English::Entry& one) { return one.kind == kind; });
}

}  // namespace

const Lexicon::Entries* Lexicon::exactly(const std::string& word) const {
  if (const auto found = learned_.find(word); found != learned_.end()) return &found->second;
  const auto found = english_->words.find(word);
  return found == english_->words.end() ? nullptr : &found->second;
}

// Of the word, or of what it is a form of: first what has the wanted kind.
const Lexicon::Entries* Lexicon::entries(const std::string& word, bool& plural, WordKind wanted) const {
  const Entries* any = nullptr;
  for (const English::Stem& stem : english_->stems(word)) {
    const Entries* found = exactly(stem.text);
    const bool is_form = stem.text != word;
    if (found == nullptr || (is_form && found->front().kind == WordKind::negation)) continue;  // `notes` is no `not`
    const bool fits = has_kind(*found, wanted);
    if (any == nullptr || fits) plural = stem.plural;
    if (fits) return found;
    if (any == nullptr) any = found;
    if (!is_form && wanted != WordKind::noun && wanted != WordKind::verb) break;
  }
  return any;
}

void Lexicon::learn(const std::string& word, const std::string& sense, WordKind kind) {
  if (!learned_.contains(word) && exactly(word) != nullptr) learned_[word] = *exactly(word);
  learned_[word].push_back({sense, kind});
}

std::string spaced_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
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
  for (const std::string& word : name_words(std::string(name))) {
    bool plural = false;
    const Entries* known = entries(word, plural, WordKind::noun);
    const bool says_more =
        known != nullptr && std::any_of(known->begin(), known->end(), [](const English::Entry& one) {
          return one.kind != WordKind::own && one.kind != WordKind::verb && one.kind != WordKind::harmless;
        });
    if (!says_more) learn(word, word, WordKind::noun);
  }
}

void Lexicon::learn_colour(const std::string& name) {
  const Entries* known = exactly(name);
  if (known == nullptr || !has_kind(*known, WordKind::colour)) learn(name, name, WordKind::colour);
}

void Lexicon::learn_own(std::string_view sentence) {
  for (const PlainWord& word : plain_words(sentence, *english_)) {
    bool plural = false;
    if (is_digits(word.text) || word.text == "'s" || entries(word.text, plural, WordKind::own) != nullptr) continue;
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
  bool plural = false;
  for (const WordKind kind : due(text, before, punctuation, next)) {
    const Entries* known = entries(text, plural, kind);
    if (known == nullptr) continue;
    for (const English::Entry& one : *known)
      if (one.kind == kind) {
        word.plural = kind == WordKind::noun && plural;
        return become(kind, one.sense);
      }
  }
  const Entries* known = entries(text, plural, WordKind::grammar);
  if (known == nullptr) return become(WordKind::unknown, text);
  word.plural = known->front().kind == WordKind::noun && plural;
  return become(known->front().kind, known->front().sense);
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
  bool plural = false;
  if (const Entries* known = entries(word, plural, WordKind::noun))
    for (const English::Entry& one : *known)
      if (one.kind == WordKind::noun) return one.sense;
  return word;
}

const std::set<std::string>& Lexicon::skills_of(const std::string& verb) const {
  static const std::set<std::string> kNone;
  const auto found = english_->skills.find(verb);
  return found == english_->skills.end() ? kNone : found->second;
}

}  // namespace stampede
