// Sentences that were written without knowledge of the parser, right ones and wrong ones as near to them as can be.
// said.json, of forty tasks: the parser's rules were widened by these. said_unseen.json, of the fifty others: they were
// not.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/language/rules.h"

namespace said {

struct Sentence {
  std::string task, text, kind;  // kind of mistake; empty: it is right
  std::shared_ptr<const stampede::SentenceChecker> checker;
  bool unseen = false;
};

const std::vector<Sentence>& all();

}  // namespace said
