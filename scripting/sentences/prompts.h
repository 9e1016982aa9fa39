// What a model is asked, and how its answers are read.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/language/rules.h"
#include "scripting/sentences/chat_client.h"

namespace stampede {

// Asks for `count` ways to say it, told what the scene holds. Two examples go before, so that small models see the
// form.
ChatRequest paraphrase_request(const Meaning& meaning, Grain grain, int count, std::int64_t seed);
std::string prompt_hash(const ChatRequest& request);
std::string prompt_text(const ChatRequest& request);  // for people

// The sentences of an answer: a JSON list of texts, or lines; numbers, bullets and quotes around them fall away.
std::vector<std::string> sentences_in(const std::string& answer);

// Asks which things and which goal a sentence means, both shuffled among others.
struct BackQuestion {
  ChatRequest request;
  std::set<int> wanted;   // numbers of things that may be meant
  std::set<int> handled;  // of these one at least is
  int goal = 0;           // number of the goal
};
// `distractors`: goals of other tasks and variations, the likest first.
BackQuestion back_question(const Meaning& meaning, const std::string& sentence,
                           const std::vector<std::string>& distractors, std::int64_t seed);
// Nothing: it was right. Otherwise what was wrong, for people.
std::optional<std::string> wrong_answer(const BackQuestion& question, const std::string& answer);

}  // namespace stampede
