#include "scripting/language/sentence_check.h"

#include <array>

#include "scripting/language/one_sentence.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 21> kRejections = {
    "too_short",      "too_long",     "not_a_sentence", "refused",       "other_language", "unknown_word",
    "unknown_thing",  "other_thing",  "missing_thing",  "wrong_colour",  "wrong_count",    "wrong_side",
    "unproved",       "other_action", "swapped_roles",  "swapped_order", "negated",        "misses_steps",
    "near_duplicate", "asked_back",   "no_answer"};

}  // namespace

Verdict OneSentence::check() const {
  for (const auto part :
       {&OneSentence::form, &OneSentence::words, &OneSentence::denials, &OneSentence::slots, &OneSentence::marks,
        &OneSentence::mentions, &OneSentence::coverage, &OneSentence::actions, &OneSentence::roles,
        &OneSentence::contained, &OneSentence::order, &OneSentence::ends, &OneSentence::undone, &OneSentence::steps})
    if (Maybe bad = (this->*part)()) return *bad;
  return {};
}

std::string_view to_string(Rejection reason) { return kRejections.at(static_cast<std::size_t>(reason)); }

int most_words(Grain grain) { return grain == Grain::goal ? 40 : grain == Grain::steps ? 80 : 120; }

SentenceChecker::SentenceChecker(Meaning meaning) : meaning_(std::move(meaning)), claims_(claims_of(meaning_)) {}

Verdict SentenceChecker::check(const std::string& sentence, Grain grain) const {
  return OneSentence(sentence, meaning_, claims_, grain).check();
}

}  // namespace stampede
