// How the rules judge what people would say.
#include "said.h"

#include <catch2/catch.hpp>
#include <iostream>
#include <map>

using namespace stampede;

namespace {

struct Tally {
  int right = 0, passed = 0, wrong = 0, accepted = 0;
};

Tally tally_of(bool unseen) {
  Tally tally;
  for (const said::Sentence& one : said::all()) {
    if (one.unseen != unseen) continue;
    const bool right = one.kind.empty();
    (right ? tally.right : tally.wrong) += 1;
    if (one.checker->check(one.text).ok()) (right ? tally.passed : tally.accepted) += 1;
  }
  return tally;
}

}  // namespace

TEST_CASE("what is said wrongly is turned down, all of it", "[meanings]") {
  int wrong = 0;
  for (const said::Sentence& one : said::all()) {
    if (one.kind.empty()) continue;
    ++wrong;
    INFO(one.task << " | " << one.kind << " | " << one.text);
    CHECK_FALSE(one.checker->check(one.text).ok());
  }
  CHECK(wrong == 980);
}

TEST_CASE("most of what is said rightly passes", "[meanings]") {
  const Tally seen = tally_of(false), unseen = tally_of(true);
  INFO(seen.passed << " of " << seen.right << " and " << unseen.passed << " of " << unseen.right);
  CHECK(seen.passed >= 340);
  CHECK(unseen.passed >= 210);
}

// For people: test_sentences "[figures]"
TEST_CASE("figures of what is said", "[.figures]") {
  for (const bool unseen : {false, true}) {
    const char* set = unseen ? "unseen" : "seen";
    std::map<std::string, int> refused, kinds;
    for (const said::Sentence& one : said::all()) {
      if (one.unseen != unseen) continue;
      const Verdict verdict = one.checker->check(one.text);
      if (verdict.ok() && !one.kind.empty()) {
        ++kinds[one.kind];
        std::cout << set << " ACCEPTED " << one.task << " (" << one.kind << "): " << one.text << "\n";
      }
      if (verdict.ok() || !one.kind.empty()) continue;
      ++refused[std::string(to_string(*verdict.reason))];
      std::cout << set << " refused " << one.task << ": " << one.text << " | " << to_string(*verdict.reason) << " "
                << verdict.detail << "\n";
    }
    const Tally tally = tally_of(unseen);
    std::cout << set << " right passed " << tally.passed << " of " << tally.right << ", wrong accepted "
              << tally.accepted << " of " << tally.wrong << "\n";
    for (const auto& [kind, count] : kinds) std::cout << "  accepted " << kind << " " << count << "\n";
    for (const auto& [reason, count] : refused) std::cout << "  " << reason << " " << count << "\n";
  }
}
