// Each rule is needed: some wrong sentence breaks it and no other, so that without it that sentence would pass.
#include <catch2/catch.hpp>
#include <iostream>
#include <map>

#include "said.h"
#include "shipped.h"
#include "wrong_sentences.h"

using namespace stampede;

namespace {

std::vector<const Rule*> all_rules() {
  std::vector<const Rule*> all;
  for (const std::span<const Rule> rules : {word_rules(), thing_rules(), deed_rules()})
    for (const Rule& rule : rules) all.push_back(&rule);
  return all;
}

// Of labels and of signs, which no task's sentence has.
struct Slip {
  std::string text;
  Grain grain = Grain::goal;
};

std::vector<std::pair<SentenceChecker, std::vector<Slip>>> slips() {
  const Library& library = *shipped::library();
  std::string padded = "put the {obj} on the {below}";
  for (int i = 0; i < 40; ++i) padded = "carefully " + padded;
  std::vector<std::pair<SentenceChecker, std::vector<Slip>>> all;
  all.emplace_back(SentenceChecker(meaning_of_label(library, "place", "put the {obj} on the {below}", "place")),
                   std::vector<Slip>{{padded},
                                     {"put the {obj} on the {below} #"},
                                     {"sorry assistant, put the {obj} on the {below}"},
                                     {"put the {obj} on the {below} bitteschön"}});
  all.emplace_back(SentenceChecker(meaning_of_label(library, "on", "the {obj} is on the {surface}", "")),
                   std::vector<Slip>{{"the {surface} is on the {obj}"}});
  all.emplace_back(SentenceChecker(meaning_of_label(library, "open_hand", "open the hand", "")),
                   std::vector<Slip>{{"open"}, {"open the hand {obj}"}});
  all.emplace_back(SentenceChecker(shipped::meaning("put_rubbish_in_bin")),
                   std::vector<Slip>{{"put the rubbish into the bin", Grain::motions}});
  return all;
}

class Needs {
 public:
  void add(const SentenceChecker& checker, const std::string& text, Grain grain = Grain::goal) {
    const std::vector<std::string_view> broken = checker.broken(text, grain);
    INFO(text);
    CHECK_FALSE(broken.empty());
    CHECK(checker.check(text, grain).ok() == broken.empty());
    if (broken.size() == 1) needed_.emplace(broken.front(), text);
  }
  std::string example(const Rule& rule) const {
    const auto found = needed_.find(rule.name);
    return found == needed_.end() ? "" : found->second;
  }

 private:
  std::map<std::string_view, std::string> needed_;
};

}  // namespace

TEST_CASE("without any one of its rules, the check lets something wrong pass", "[meanings]") {
  Needs needs;
  for (const said::Sentence& one : said::all())
    if (!one.kind.empty()) needs.add(*one.checker, one.text);
  for (const Meaning& meaning : shipped::meanings()) {
    const SentenceChecker checker(meaning);
    for (const wrong::Sentence& one : wrong::sentences_from(meaning)) needs.add(checker, one.text);
  }
  for (const auto& [checker, wrong_ones] : slips())
    for (const Slip& slip : wrong_ones) needs.add(checker, slip.text, slip.grain);
  for (const Rule* rule : all_rules()) {
    INFO(rule->name);
    CHECK_FALSE(needs.example(*rule).empty());
  }
}

TEST_CASE("rules have names of their own") {
  std::map<std::string_view, int> names;
  for (const Rule* rule : all_rules()) ++names[rule->name];
  for (const auto& [name, count] : names) {
    INFO(name);
    CHECK(count == 1);
  }
}
