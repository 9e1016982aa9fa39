#include "scripting/library/english_reader.h"

#include <algorithm>

#include "scripting/library/name_lists.h"

namespace stampede {
namespace {

// Texts of words between blanks, or one such text.
std::vector<std::string> each_word(const Value& value) {
  if (value.is_text()) return words_in(value.text);
  std::vector<std::string> words;
  for (const Value& item : value.items)
    for (std::string& word : words_in(item.text)) words.push_back(std::move(word));
  return words;
}

std::set<std::string> set_of(const Value& value) {
  const std::vector<std::string> words = each_word(value);
  return {words.begin(), words.end()};
}

// What a field of the file becomes.
class EnglishReader {
 public:
  EnglishReader(const Definition& file, English& english) : file_(file), english_(english) {}

  void read() {
    const Value& words = file_.node;
    using Reader = void (EnglishReader::*)(const Value&);
    static const std::map<std::string, Reader> kFields = {{"kinds", &EnglishReader::kinds},
                                                          {"endings", &EnglishReader::endings},
                                                          {"irregular", &EnglishReader::irregular},
                                                          {"phrases", &EnglishReader::phrases},
                                                          {"light_verbs", &EnglishReader::light_verbs},
                                                          {"particles", &EnglishReader::particles},
                                                          {"prepositions", &EnglishReader::prepositions},
                                                          {"directions", &EnglishReader::directions},
                                                          {"opposites", &EnglishReader::opposites},
                                                          {"ranks", &EnglishReader::ranks},
                                                          {"classes", &EnglishReader::classes}};
    for (const auto& [name, reader] : kFields) (this->*reader)(words[name]);
    const std::vector<std::string> known = keys_of(kFields);
    for (const auto& [name, value] : words.fields)
      if (!kFields.contains(name)) file_.complain(name, "there is no such field", did_you_mean(name, known));
  }

 private:
  void kinds(const Value& value) {
    const std::vector<std::string> known(kWordKinds.begin(), kWordKinds.end());
    for (std::size_t i = 0; i < kWordKinds.size(); ++i) {
      const Value& words = value[kWordKinds[i]];
      for (const std::string& word : each_word(words)) english_.add(word, word, static_cast<WordKind>(i));
      for (const auto& [sense, synonyms] : words.fields)
        for (const std::string& word : each_word(synonyms)) english_.add(word, sense, static_cast<WordKind>(i));
    }
    for (const auto& [name, words] : value.fields)
      if (!listed(known, name)) file_.complain_unknown("kinds." + name, "kind of words", name, known);
  }

  void endings(const Value& value) {
    for (const Value& one : value.items) {
      if (one.items.size() != 2 || one.items[0].text.empty())
        file_.complain("endings", "an ending is { what a form ends with, what the word has there }",
                       "{ \"ies\", \"y\" }");
      else
        english_.endings.push_back(
            {one.items[0].text, one.items[1].text, one["unless"].text, one["plural"].boolean, one["done"].boolean});
    }
  }

  void irregular(const Value& value) {
    for (const auto& [form, word] : value.fields)
      english_.irregular[form] = word.is_text() || word.items.empty()
                                     ? English::Stem{word.text}
                                     : English::Stem{word.items[0].text, word["plural"].boolean};
  }

  // `hold = { "take hold of", "get hold of" }`: both are read as it.
  void phrases(const Value& value) {
    for (const auto& [to, from] : value.fields)
      for (const Value& phrase : from.is_text() ? std::vector<Value>{from} : from.items) {
        std::vector<std::string> words = words_in(phrase.text);
        if (words.empty()) continue;
        auto& list = english_.phrases[words.front()];
        std::erase_if(list, [&](const auto& one) { return one.first == words; });
        list.emplace_back(std::move(words), words_in(to));
        std::stable_sort(list.begin(), list.end(),
                         [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
      }
  }

  void light_verbs(const Value& value) {
    for (const Value& one : value.items)
      english_.light_verbs.push_back(
          {set_of(one["verbs"]), set_of(one["with"]), one["means"].text, one["beside"].boolean, one["unless"].boolean});
  }

  void particles(const Value& value) {
    for (const auto& [verb, words] : value.fields) english_.particles[verb] = set_of(words);
  }

  // `to = "on onto"`: each word's is the name.
  static void name_each(const Value& value, std::map<std::string, std::string>& names) {
    for (const auto& [name, words] : value.fields)
      for (const std::string& word : each_word(words)) names[word] = name;
  }
  void prepositions(const Value& value) { name_each(value, english_.prepositions); }
  void directions(const Value& value) { name_each(value, english_.directions); }

  void opposites(const Value& value) {
    for (const auto& [one, other] : value.fields) {
      english_.opposites[one] = other.text;
      english_.opposites[other.text] = one;
    }
  }

  void ranks(const Value& value) {
    for (const auto& [word, rank] : value.fields) english_.ranks[word] = static_cast<int>(rank.number);
  }

  void classes(const Value& value) {
    const std::vector<std::string> known(kWordClasses.begin(), kWordClasses.end());
    for (const auto& [name, words] : value.fields) {
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        file_.complain_unknown("classes." + name, "class of words", name, known);
      else
        for (const std::string& word : each_word(words))
          english_.classes[word].set(static_cast<std::size_t>(found - known.begin()));
    }
  }

  const Definition& file_;
  English& english_;
};

}  // namespace

void read_english(const Definition& file, English& english) { EnglishReader(file, english).read(); }

void WordsOfThings::add_nouns(const std::string& name, const Value& nouns) {
  const std::vector<std::string> words = name_words(name), others = each_word(nouns);
  if (words.empty() || others.empty()) return;
  const std::string sense = lexicon_.sense_of_noun(words.back());
  english_.add(words.back(), sense, WordKind::noun);
  for (const std::string& noun : others) english_.add(noun, sense, WordKind::noun);
}

void WordsOfThings::add_verbs(const std::string& skill, const std::vector<std::string>& verbs) {
  for (const std::string& verb : verbs) {
    const std::vector<Word> words = lexicon_.read(verb);
    if (words.empty()) continue;
    const Word& word = words.front();
    if (word.kind != WordKind::verb) english_.add(word.text, word.text, WordKind::verb);
    english_.skills[word.kind == WordKind::verb ? word.sense : word.text].insert(skill);
  }
}

}  // namespace stampede
