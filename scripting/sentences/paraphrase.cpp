#include "scripting/sentences/paraphrase.h"

#include <algorithm>

#include "engine/base/hash.h"
#include "engine/language/similarity.h"

namespace stampede {
namespace {

// Of all its requests.
std::string hash_of(const std::vector<ChatRequest>& requests) {
  Hasher hasher;
  for (const ChatRequest& request : requests) hasher.text(prompt_hash(request));
  return hasher.digest().substr(0, 16);
}

}  // namespace

void ParaphraseTally::add(const ParaphraseTally& other) {
  asked += other.asked;
  received += other.received;
  passed += other.passed;
  jobs_there += other.jobs_there;
  for (const auto& [reason, count] : other.refused) refused[reason] += count;
}

std::vector<ChatRequest> requests_of(const ParaphraseJob& job, const Meaning& meaning) {
  std::vector<ChatRequest> requests;
  for (int done = 0; done < job.count; done += job.each_request)
    requests.push_back(paraphrase_request(meaning, job.grain, std::min(job.each_request, job.count - done),
                                          job.seed + static_cast<std::int64_t>(requests.size())));
  return requests;
}

ParaphraseTally paraphrase(const ParaphraseJob& job, const SentenceChecker& checker,
                           const std::vector<std::string>& distractors, ChatClient& client, SentenceFile& file,
                           const std::atomic<bool>* stop, std::vector<Refused>* refused) {
  ParaphraseTally tally;
  const Meaning& meaning = checker.meaning();
  const std::string& model = client.settings().model;
  const std::vector<ChatRequest> requests = requests_of(job, meaning);
  const std::string prompt = hash_of(requests);
  const SentenceOrigin origin{job.level, job.of, job.grain, model, prompt};
  if (std::any_of(file.asked.begin(), file.asked.end(), [&](const SentenceOrigin& one) { return one == origin; })) {
    tally.jobs_there = 1;
    return tally;
  }
  std::vector<std::string> known = meaning.own;
  for (const StoredSentence* one : file.of(job.level, job.of)) known.push_back(one->text);
  std::vector<StoredSentence> kept;
  const auto refuse = [&](const std::string& text, Rejection reason, const std::string& detail) {
    ++tally.refused[std::string(to_string(reason))];
    if (refused != nullptr) refused->push_back({text, std::string(to_string(reason)), detail});
  };
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const int wanted = std::min(job.each_request, job.count - static_cast<int>(i) * job.each_request);
    tally.asked += wanted;
    const ChatAnswer answer = client.ask(requests[i], stop);
    if (!answer.ok()) {
      refuse("", Rejection::no_answer, answer.problem);
      continue;
    }
    std::vector<std::string> sentences = sentences_in(answer.text);
    if (answer.cut && sentences.size() > 1) sentences.pop_back();  // half a sentence
    if (static_cast<int>(sentences.size()) > wanted) sentences.resize(static_cast<std::size_t>(wanted));
    if (sentences.empty()) refuse("", Rejection::no_answer, "no text");
    for (const std::string& sentence : sentences) {
      ++tally.received;
      if (const Verdict verdict = checker.check(sentence, job.grain); !verdict.ok()) {
        refuse(sentence, *verdict.reason, verdict.detail);
        continue;
      }
      if (const std::string* twin = near_duplicate(sentence, known, meaning.lexicon.english())) {
        refuse(sentence, Rejection::near_duplicate, *twin);
        continue;
      }
      const BackQuestion back = back_question(meaning, sentence, distractors, job.seed);
      const ChatAnswer said = client.ask(back.request, stop);
      if (const auto wrong = said.ok() ? wrong_answer(back, said.text) : std::optional<std::string>(said.problem)) {
        refuse(sentence, Rejection::asked_back, *wrong);
        continue;
      }
      known.push_back(sentence);
      kept.push_back({origin, sentence, {"words", "near_duplicate", "asked_back"}});
    }
  }
  tally.passed = static_cast<std::int64_t>(kept.size());
  for (StoredSentence& one : kept) file.sentences.push_back(std::move(one));
  if (tally.refused.contains("no_answer")) return tally;  // asked again by the same command
  AskedFor asked{origin, job.count, {}};
  for (const auto& [reason, count] : tally.refused) asked.refused[reason] = static_cast<int>(count);
  file.asked.push_back(std::move(asked));
  return tally;
}

}  // namespace stampede
