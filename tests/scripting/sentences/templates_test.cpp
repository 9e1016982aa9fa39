// The authors' own sentences pass: all of them, and most even where the parser may not learn from the one in question.
#include <catch2/catch.hpp>

#include "shipped.h"

using namespace stampede;

TEST_CASE("every sentence of every shipped task passes", "[meanings]") {
  int sentences = 0;
  for (const Meaning& meaning : shipped::meanings()) {
    const SentenceChecker checker(meaning);
    for (const std::string& sentence : meaning.own) {
      const Verdict verdict = checker.check(sentence);
      INFO(meaning.task << " " << meaning.variation << ": " << sentence << ": "
                        << (verdict.ok() ? "" : to_string(*verdict.reason)) << " " << verdict.detail);
      CHECK(verdict.ok());
      ++sentences;
    }
  }
  CHECK(sentences > 400);
}

TEST_CASE("sentences pass that nobody told the parser of", "[meanings]") {
  int passed = 0, sentences = 0;
  for (const Meaning& meaning : shipped::meanings())
    for (std::size_t i = 0; i < meaning.own.size(); ++i) {
      Meaning less = meaning;
      less.own.erase(less.own.begin() + static_cast<std::ptrdiff_t>(i));
      for (OwnSentences& other : less.elsewhere)
        if (other.sentences.size() == meaning.own.size())
          other.sentences.erase(other.sentences.begin() + static_cast<std::ptrdiff_t>(i));
      const Verdict verdict = SentenceChecker(less).check(meaning.own[i]);
      ++sentences;
      passed += verdict.ok() ? 1 : 0;
    }
  INFO(passed << " of " << sentences);
  CHECK(passed * 10 > sentences * 3);  // they were written to differ
}
