// Asks for sentences, checks each, asks back, and keeps what passes.
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "scripting/sentences/prompts.h"
#include "scripting/sentences/sentence_file.h"

namespace stampede {

struct ParaphraseJob {
  LanguageLevel level = LanguageLevel::task;
  std::string of;
  Grain grain = Grain::goal;
  int count = 10;        // sentences asked for
  int each_request = 5;  // of these, at once
  std::int64_t seed = 0;
};

struct ParaphraseTally {
  std::int64_t asked = 0, received = 0, passed = 0, jobs_there = 0;
  std::map<std::string, std::int64_t> refused;  // by reason
  void add(const ParaphraseTally& other);
};

struct Refused {
  std::string text, reason, detail;
};

// Of a job whose meaning `checker` knows. What passes is added to the file, and that it was asked for, unless an
// answer could not be read; a job that the file has already asks nothing. `refused`: what did not pass, for people; may
// be null. Throws what ChatClient::ask throws; the file is then as it was.
ParaphraseTally paraphrase(const ParaphraseJob& job, const SentenceChecker& checker,
                           const std::vector<std::string>& distractors, ChatClient& client, SentenceFile& file,
                           const std::atomic<bool>* stop, std::vector<Refused>* refused);

// The requests of a job, without asking anybody.
std::vector<ChatRequest> requests_of(const ParaphraseJob& job, const Meaning& meaning);

}  // namespace stampede
