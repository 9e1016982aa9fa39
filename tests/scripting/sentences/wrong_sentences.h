// Sentences that are wrong on purpose, made by rules from right ones.
#pragma once

#include <string>
#include <vector>

#include "scripting/sentences/meaning_of.h"

namespace wrong {

struct Sentence {
  std::string rule;  // colour, count, order, thing, negation, side, roles
  std::string text;
  std::string from;  // the right one
};

// All that the rules make of a meaning's own sentences.
std::vector<Sentence> sentences_from(const stampede::Meaning& meaning);

}  // namespace wrong
