#include "engine/language/rules.h"

#include <array>

#include "engine/base/enum_names.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 21> kRejections = {
    "too_short",      "too_long",     "not_a_sentence", "refused",       "other_language", "unknown_word",
    "unknown_thing",  "other_thing",  "missing_thing",  "wrong_colour",  "wrong_count",    "wrong_side",
    "unproved",       "other_action", "swapped_roles",  "swapped_order", "negated",        "misses_steps",
    "near_duplicate", "asked_back",   "no_answer"};

std::array<std::span<const Rule>, 3> all_rules() { return {word_rules(), thing_rules(), deed_rules()}; }

}  // namespace

std::string_view to_string(Rejection reason) { return enum_name(kRejections, reason); }

int most_words(Grain grain) { return grain == Grain::goal ? 40 : grain == Grain::steps ? 80 : 120; }

SentenceChecker::SentenceChecker(Meaning meaning) : meaning_(std::move(meaning)), claims_(claims_of(meaning_)) {}

Verdict SentenceChecker::check(const std::string& text, Grain grain) const {
  const Sentence sentence(text, meaning_, claims_, grain);
  for (const std::span<const Rule> rules : all_rules())
    for (const Rule& rule : rules)
      if (Fault fault = rule.fault(sentence)) return {rule.reason, std::move(*fault)};
  return {};
}

std::vector<std::string_view> SentenceChecker::broken(const std::string& text, Grain grain) const {
  const Sentence sentence(text, meaning_, claims_, grain);
  std::vector<std::string_view> names;
  for (const std::span<const Rule> rules : all_rules())
    for (const Rule& rule : rules)
      if (rule.fault(sentence)) names.push_back(rule.name);
  return names;
}

}  // namespace stampede
