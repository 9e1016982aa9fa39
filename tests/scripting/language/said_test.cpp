// Sentences that were written without knowledge of the parser, right ones and wrong ones as near to them as can be.
// said.json, of forty tasks: the parser's rules were widened by these. said_unseen.json, of the fifty others: they were
// not.
#include <catch2/catch.hpp>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "engine/base/text_file.h"
#include "shipped.h"

using namespace stampede;

namespace {

struct Said {
  std::string task, text, kind;  // kind of mistake; empty: it is right
  Verdict verdict;
};

std::vector<Said> check_all(const char* file) {
  const nlohmann::json tasks =
      nlohmann::json::parse(read_text_file(STAMPEDE_SOURCE_DIR "/tests/scripting/language/data/" + std::string(file)));
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

struct Tally {
  int right = 0, passed = 0, wrong = 0, accepted = 0;
};

const std::vector<Said>& said(bool unseen) {
  static const std::vector<Said> all[] = {check_all("said.json"), check_all("said_unseen.json")};
  return all[unseen ? 1 : 0];
}

Tally tally_of(bool unseen) {
  Tally tally;
  for (const Said& one : said(unseen)) {
    const bool right = one.kind.empty();
    (right ? tally.right : tally.wrong) += 1;
    if (one.verdict.ok()) (right ? tally.passed : tally.accepted) += 1;
  }
  return tally;
}

}  // namespace

TEST_CASE("what is said wrongly is turned down, all of it") {
  int wrong = 0;
  for (const bool unseen : {false, true})
    for (const Said& one : said(unseen)) {
      if (one.kind.empty()) continue;
      ++wrong;
      INFO(one.task << " | " << one.kind << " | " << one.text);
      CHECK_FALSE(one.verdict.ok());
    }
  CHECK(wrong == 980);
}

TEST_CASE("most of what is said rightly passes") {
  const Tally seen = tally_of(false), unseen = tally_of(true);
  INFO(seen.passed << " of " << seen.right << " and " << unseen.passed << " of " << unseen.right);
  CHECK(seen.passed >= 340);
  CHECK(unseen.passed >= 210);
}

// For people: test_language "[figures]"
TEST_CASE("figures of what is said", "[.figures]") {
  for (const bool unseen : {false, true}) {
    const char* set = unseen ? "unseen" : "seen";
    std::map<std::string, int> refused, kinds;
    for (const Said& one : said(unseen)) {
      if (one.verdict.ok() && !one.kind.empty()) {
        ++kinds[one.kind];
        std::cout << set << " ACCEPTED " << one.task << " (" << one.kind << "): " << one.text << "\n";
      }
      if (one.verdict.ok() || !one.kind.empty()) continue;
      ++refused[std::string(to_string(*one.verdict.reason))];
      std::cout << set << " refused " << one.task << ": " << one.text << " | " << to_string(*one.verdict.reason) << " "
                << one.verdict.detail << "\n";
    }
    const Tally tally = tally_of(unseen);
    std::cout << set << " right passed " << tally.passed << " of " << tally.right << ", wrong accepted "
              << tally.accepted << " of " << tally.wrong << "\n";
    for (const auto& [kind, count] : kinds) std::cout << "  accepted " << kind << " " << count << "\n";
    for (const auto& [reason, count] : refused) std::cout << "  " << reason << " " << count << "\n";
  }
}
