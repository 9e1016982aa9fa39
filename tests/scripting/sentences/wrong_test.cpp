// Sentences that are wrong on purpose are turned down, all of them.
#include <catch2/catch.hpp>
#include <map>

#include "engine/base/random.h"
#include "shipped.h"
#include "wrong_sentences.h"

using namespace stampede;

TEST_CASE("all that rules make wrong is turned down", "[meanings]") {
  std::map<std::string, int> made;
  for (const Meaning& meaning : shipped::meanings()) {
    const SentenceChecker checker(meaning);
    for (const wrong::Sentence& one : wrong::sentences_from(meaning)) {
      ++made[one.rule];
      INFO(one.rule << " | " << meaning.task << " " << meaning.variation << ": " << one.text << " | " << one.from);
      CHECK_FALSE(checker.check(one.text).ok());
    }
  }
  for (const char* rule : {"colour", "count", "order", "thing", "negation", "side", "roles"}) {
    INFO(rule);
    CHECK(made[rule] > 50);
  }
}
