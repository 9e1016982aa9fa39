// Sentences that a person wrote without knowledge of the parser: eight right ones and eight wrong ones of forty tasks.
#include <catch2/catch.hpp>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "scripting/session/text_file.h"
#include "shipped.h"

using namespace stampede;

namespace {

struct Said {
  std::string task, text, kind;  // kind of mistake; empty: it is right
  Verdict verdict;
};

std::vector<Said> check_all() {
  const nlohmann::json tasks =
      nlohmann::json::parse(read_text_file(STAMPEDE_SOURCE_DIR "/tests/scripting/language/data/said.json"));
  std::vector<Said> all;
  for (const nlohmann::json& one : tasks) {
    const std::string task = one.at("task"), variation = one.at("variation");
    const SentenceChecker checker(
        meaning_of(shipped::library(), task, variation, 0, sentences_of(shipped::library(), task)));
    for (const std::string text : one.at("good")) all.push_back({task, text, "", checker.check(text)});
    for (const nlohmann::json& bad : one.at("bad"))
      all.push_back({task, bad.at("text"), bad.at("kind"), checker.check(bad.at("text"))});
  }
  return all;
}

const std::vector<Said>& said() {
  static const std::vector<Said> all = check_all();
  return all;
}

constexpr std::size_t kHeldOut = 320;  // of the first 20 tasks the parser's makers saw the sentences

}  // namespace

TEST_CASE("what a person said wrongly is turned down, all of it") {
  int wrong = 0;
  for (const Said& one : said()) {
    if (one.kind.empty()) continue;
    ++wrong;
    INFO(one.task << " | " << one.kind << " | " << one.text);
    CHECK_FALSE(one.verdict.ok());
  }
  CHECK(wrong == 320);
}

TEST_CASE("most of what a person said rightly passes") {
  int seen = 0, held = 0;
  for (std::size_t i = 0; i < said().size(); ++i)
    if (said()[i].kind.empty() && said()[i].verdict.ok()) (i < kHeldOut ? seen : held) += 1;
  INFO(seen << " and " << held << " of 160 each");
  CHECK(seen >= 104);
  CHECK(held >= 72);
}

// For people: test_language "[figures]"
TEST_CASE("figures of what a person said", "[.figures]") {
  for (const bool held : {false, true}) {
    std::map<std::string, int> refused;
    int good = 0, passed = 0, bad = 0, accepted = 0;
    for (std::size_t i = 0; i < said().size(); ++i) {
      if ((i >= kHeldOut) != held) continue;
      const Said& one = said()[i];
      (one.kind.empty() ? good : bad) += 1;
      if (one.verdict.ok()) {
        (one.kind.empty() ? passed : accepted) += 1;
        if (!one.kind.empty())
          std::cout << (held ? "held" : "seen") << " ACCEPTED " << one.task << ": " << one.text << "\n";
        continue;
      }
      if (!one.kind.empty()) continue;
      ++refused[std::string(to_string(*one.verdict.reason))];
      std::cout << (held ? "held" : "seen") << " refused " << one.task << ": " << one.text << " | "
                << to_string(*one.verdict.reason) << " " << one.verdict.detail << "\n";
    }
    std::cout << (held ? "HELD" : "SEEN") << " good passed " << passed << " of " << good << ", bad accepted "
              << accepted << " of " << bad << "\n";
    for (const auto& [reason, count] : refused) std::cout << "  " << reason << " " << count << "\n";
  }
}
