#include "scripting/language/lexicon.h"

#include <algorithm>
#include <optional>
#include <sstream>

namespace stampede {
namespace {

const std::map<std::string, WordKind>& kinds() {
  static const std::map<std::string, WordKind> all = {
      {"function", WordKind::function}, {"harmless", WordKind::harmless}, {"adjective", WordKind::adjective},
      {"colour", WordKind::colour},     {"number", WordKind::number},     {"place", WordKind::place},
      {"order", WordKind::order},       {"negation", WordKind::negation}, {"exclusion", WordKind::exclusion},
      {"noun", WordKind::noun},         {"verb", WordKind::verb}};
  return all;
}

const std::map<std::string, std::string>& irregular() {
  static const std::map<std::string, std::string> forms = {
      {"took", "take"},   {"taken", "take"},   {"laid", "lay"},   {"lying", "lie"},     {"held", "hold"},
      {"found", "find"},  {"stood", "stand"},  {"got", "get"},    {"brought", "bring"}, {"hung", "hang"},
      {"built", "build"}, {"putting", "put"},  {"kept", "keep"},  {"broke", "break"},   {"slid", "slide"},
      {"swung", "swing"}, {"drawn", "draw"},   {"shown", "show"}, {"thrown", "throw"},  {"people", "person"},
      {"men", "man"},     {"knives", "knife"}, {"dies", "die"},   {"tying", "tie"},     {"men's", "man"}};
  return forms;
}

struct Stem {
  std::string text;
  bool plural = false;  // if it is a noun
};

// What a word may be a form of, the word itself first.
std::vector<Stem> stems(const std::string& word) {
  std::vector<Stem> all = {{word, false}};
  const auto ends = [&](std::string_view tail) { return word.size() > tail.size() + 1 && word.ends_with(tail); };
  const auto without = [&](std::size_t n) { return word.substr(0, word.size() - n); };
  if (const auto form = irregular().find(word); form != irregular().end()) all.push_back({form->second, ends("ves")});
  if (ends("ied")) all.push_back({without(3) + "y", false});
  if (ends("ies")) all.push_back({without(3) + "y", true});
  if (ends("ves")) all.push_back({without(3) + "f", true});
  if (ends("ses") || ends("xes") || ends("zes") || ends("ches") || ends("shes") || ends("oes"))
    all.push_back({without(2), true});
  if (ends("s") && !ends("ss")) all.push_back({without(1), true});
  for (const std::string tail : {"ing", "ed"}) {
    if (!ends(tail)) continue;
    const std::string stem = without(tail.size());
    all.push_back({stem, false});
    all.push_back({stem + "e", false});
    if (stem.size() > 2 && stem[stem.size() - 1] == stem[stem.size() - 2])
      all.push_back({stem.substr(0, stem.size() - 1), false});
  }
  return all;
}

// `notes` is no form of `not`.
bool has_forms(WordKind kind) { return kind != WordKind::negation; }

bool is_digits(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

const std::set<std::string> kBeforeNouns = {"a",     "an",   "the",  "its",   "their", "this", "that",  "these",
                                            "those", "your", "each", "every", "all",   "both", "other", "another",
                                            "'s",    "no",   "same", "own",   "which", "any",  "of"};
const std::set<std::string> kBeforeVerbs = {"to",  "and",   "then", "please", "or",   "not",   "don't", "you",
                                            "it",  "never", "must", "should", "can",  "will",  "would", "could",
                                            "may", "might", "them", "that",   "let",  "first", "by",    "kindly",
                                            "now", "which", "is",   "be",     "been", "being"};

bool leads_to_noun(const Word& before) {
  return kBeforeNouns.contains(before.text) || before.kind == WordKind::adjective || before.kind == WordKind::colour ||
         before.kind == WordKind::number || before.kind == WordKind::place || before.kind == WordKind::noun;
}

}  // namespace

Lexicon::Lexicon() {
  std::istringstream lines(kLexiconText);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    std::string head = line.substr(0, colon);
    std::string skills;
    if (const std::size_t bracket = head.find('['); bracket != std::string::npos) {
      skills = head.substr(bracket + 1, head.find(']') - bracket - 1);
      head.resize(bracket);
    }
    const std::vector<std::string> parts = words_in(head);
    const WordKind kind = kinds().at(parts.at(0));
    for (const std::string& skill : words_in(skills)) skills_[parts.at(1)].insert(skill);
    for (const std::string& word : words_in(line.substr(colon + 1))) {
      const std::string sense = parts.at(1) == "-" ? word : parts.at(1);
      words_[word].push_back({sense, kind});
      if (kind == WordKind::noun) noun_senses_.insert(sense);
    }
  }
  words_["first"].push_back({"first", WordKind::place});
  words_["last"].push_back({"last", WordKind::place});
}

void Lexicon::learn_noun(std::string_view name) {
  std::string spaced(name);
  std::replace_if(
      spaced.begin(), spaced.end(), [](char c) { return c == '_' || c == '.' || (c >= '0' && c <= '9'); }, ' ');
  for (const std::string& word : words_in(spaced)) {
    if (word.size() < 2) continue;  // a square of a board, one of several
    bool plural = false;
    const std::vector<Entry>* known = entries(word, plural, WordKind::noun);
    if (known != nullptr && std::any_of(known->begin(), known->end(), [](const Entry& one) {
          return one.kind != WordKind::own && one.kind != WordKind::verb && one.kind != WordKind::harmless;
        }))
      continue;
    words_[word].push_back({word, WordKind::noun});
    noun_senses_.insert(word);
  }
}

void Lexicon::learn_colour(std::string_view name) {
  std::vector<Entry>& known = words_[std::string(name)];
  if (std::none_of(known.begin(), known.end(), [](const Entry& one) { return one.kind == WordKind::colour; }))
    known.push_back({std::string(name), WordKind::colour});
  if (name == "grey") learn_colour("gray"), words_["gray"] = {{"grey", WordKind::colour}};
}

void Lexicon::learn_own(std::string_view sentence) {
  for (const PlainWord& word : plain_words(sentence)) {
    bool plural = false;
    if (is_digits(word.text) || word.text == "'s" || entries(word.text, plural, WordKind::own) != nullptr) continue;
    std::string stem = word.text;
    if (stem.size() > 3 && stem.ends_with('s') && !stem.ends_with("ss")) stem.pop_back();
    words_[stem].push_back({stem, WordKind::own});
    if (stem != word.text) words_[word.text].push_back({stem, WordKind::own});
  }
}

// Of the word, or of what it is a form of: first what has the wanted kind.
const std::vector<Lexicon::Entry>* Lexicon::entries(const std::string& word, bool& plural, WordKind wanted) const {
  const std::vector<Entry>* any = nullptr;
  for (const Stem& stem : stems(word)) {
    const auto found = words_.find(stem.text);
    if (found == words_.end()) continue;
    if (stem.text != word && !has_forms(found->second.front().kind)) continue;
    const bool fits =
        std::any_of(found->second.begin(), found->second.end(), [&](const Entry& one) { return one.kind == wanted; });
    if (any == nullptr || fits) plural = stem.plural;
    if (fits) return &found->second;
    if (any == nullptr) any = &found->second;
    if (stem.text == word && wanted != WordKind::noun && wanted != WordKind::verb) break;
  }
  return any;
}

Word Lexicon::choose(const std::string& text, const std::vector<Word>& before, char punctuation,
                     const std::string& next) const {
  Word word{text, text, WordKind::unknown, false, punctuation};
  if (text == "'s") return word.kind = WordKind::function, word;
  if (text.starts_with('{')) return word.kind = WordKind::noun, word;
  if (is_digits(text)) {
    word.kind = WordKind::number;
    return word;
  }
  const bool starts = before.empty() || punctuation != ' ';
  const Word* last = before.empty() ? nullptr : &before.back();
  // `the box stands open`, `let it stand open`: no stand
  static const std::set<std::string> kStates = {"open", "wide", "ajar", "shut", "closed", "up", "empty"};
  const bool says = last != nullptr && last->kind == WordKind::noun && last->text != "'s" &&
                    (text == "stands" || text == "lies" || text == "rests" || text == "hangs" || text == "ends" ||
                     text == "stick" || kStates.contains(next));
  const bool noun_due = !starts && !says && leads_to_noun(*last);
  const bool verb_due = starts || says || last->kind == WordKind::order || last->kind == WordKind::harmless ||
                        kBeforeVerbs.contains(last->text);
  static const std::set<std::string> kLeave = {"been", "have", "has", "is", "somebody", "someone", "was", "being"};
  if (text == "can" && (starts || last->kind == WordKind::noun || !noun_due))
    return word.kind = WordKind::function, word;
  if (text == "half" && (next == "a" || next == "an")) return word.kind = WordKind::number, word;
  if (text == "left" && last != nullptr && kLeave.contains(last->text)) return word.kind = WordKind::function, word;
  std::vector<WordKind> order;
  if (noun_due)
    order = {WordKind::noun, WordKind::colour, WordKind::place, WordKind::adjective, WordKind::exclusion};
  else if (verb_due)
    order = {WordKind::order, WordKind::verb, WordKind::noun};
  else
    order = {WordKind::function, WordKind::noun, WordKind::place, WordKind::verb};
  if (noun_due) order.push_back(WordKind::verb);
  // `the drawer pushed shut`, `the block marked 2`: done to what was named, and no noun
  if (last != nullptr && last->kind == WordKind::noun && text.ends_with("ed"))
    order.insert(order.begin(), WordKind::verb);
  bool plural = false;
  for (const WordKind kind : order) {
    const std::vector<Entry>* known = entries(text, plural, kind);
    if (known == nullptr) continue;
    for (const Entry& one : *known)
      if (one.kind == kind) {
        word.sense = one.sense;
        word.kind = kind;
        word.plural = kind == WordKind::noun && plural;
        return word;
      }
  }
  if (const std::vector<Entry>* known = entries(text, plural, WordKind::function)) {
    word.sense = known->front().sense;
    word.kind = known->front().kind;
    word.plural = word.kind == WordKind::noun && plural;
  }
  return word;
}

std::vector<Word> Lexicon::read(std::string_view sentence) const {
  std::vector<Word> words;
  const std::vector<PlainWord> all = plain_words(sentence);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const PlainWord& plain = all[i];
    Word word = choose(plain.text, words, plain.before, i + 1 < all.size() ? all[i + 1].text : "");
    const std::size_t hyphen = plain.text.find('-');
    if (word.kind == WordKind::unknown && hyphen != std::string::npos) {
      char before = plain.before;
      std::istringstream parts(plain.text);
      for (std::string part; std::getline(parts, part, '-'); before = ' ')
        if (!part.empty() && part != "coloured" && part != "colored") words.push_back(choose(part, words, before, ""));
      continue;
    }
    words.push_back(std::move(word));
  }
  return words;
}

std::string Lexicon::sense_of_noun(std::string_view word) const {
  bool plural = false;
  const std::string text(word);
  if (const std::vector<Entry>* known = entries(text, plural, WordKind::noun))
    for (const Entry& one : *known)
      if (one.kind == WordKind::noun) return one.sense;
  return text;
}

const std::set<std::string>& Lexicon::skills_of(const std::string& verb) const {
  static const std::set<std::string> kNone;
  const auto found = skills_.find(verb);
  return found == skills_.end() ? kNone : found->second;
}

}  // namespace stampede
