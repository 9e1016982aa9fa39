// Sentences that are wrong on purpose are turned down, all of them.
#include <catch2/catch.hpp>
#include <map>

#include "engine/base/random.h"
#include "shipped.h"
#include "wrong_sentences.h"

using namespace stampede;

TEST_CASE("all that rules make wrong is turned down") {
  std::map<std::string, int> made, passed;
  for (const Meaning& meaning : shipped::meanings()) {
    const SentenceChecker checker(meaning);
    for (const wrong::Sentence& one : wrong::sentences_from(meaning)) {
      ++made[one.rule];
      if (!checker.check(one.text).ok()) continue;
      ++passed[one.rule];
      UNSCOPED_INFO(one.rule << " | " << meaning.task << " " << meaning.variation << ": " << one.text << " | " << one.from);
    }
  }
  for (const auto& [rule, count] : made) UNSCOPED_INFO(rule << ": " << passed[rule] << " of " << count);
  int all = 0;
  for (const auto& [rule, count] : passed) all += count;
  CHECK(all == 0);
}
