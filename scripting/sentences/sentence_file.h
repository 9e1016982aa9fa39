// Sentences of a task that a language model made and checks let pass: `tasks/NAME.sentences.json`, beside the task.
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/language/rules.h"
#include "engine/record/record.h"
#include "scripting/library/library.h"

namespace stampede {

inline constexpr int kSentenceFileVersion = 1;

// Of what, and by whom.
struct SentenceOrigin {
  LanguageLevel level = LanguageLevel::task;
  // Of task: the variation, empty where there is one; of others: the skill, predicate, subgoal or motion.
  std::string of;
  Grain grain = Grain::goal;
  std::string model;
  std::string prompt;  // hash of what was asked
  auto operator<=>(const SentenceOrigin&) const = default;
};

struct StoredSentence : SentenceOrigin {
  std::string text;
  std::vector<std::string> checks;  // that it passed: words, asked_back, near_duplicate
  int line = 0;                     // in its file, for messages
};

// What was asked for, so that it is not asked again.
struct AskedFor : SentenceOrigin {
  int count = 0;                            // asked for
  std::map<std::string, int> refused = {};  // by reason
};

struct SentenceFile {
  std::string task;
  std::vector<AskedFor> asked;
  std::vector<StoredSentence> sentences;
  std::vector<const StoredSentence*> of(LanguageLevel level, const std::string& name) const;
};

// Where a task's sentences are, beside its Lua file.
std::filesystem::path sentence_path(const std::filesystem::path& task_file);

// Throws Error with place and cure: no JSON, another version, a field that is missing or of the wrong kind.
SentenceFile read_sentence_file(const std::filesystem::path& path, const std::string& shown);
// One sentence a line, sorted, so that versions of it can be compared. Never half written.
void write_sentence_file(const SentenceFile& file, const std::filesystem::path& path);

// Mistakes of a file: variations that are not there, sentences that do not pass the offline checks any more, twins.
// Makes a start of each variation that it speaks of. `seed`: of these.
std::vector<Error> mistakes_in(const SentenceFile& file, const std::string& shown,
                               const std::shared_ptr<const Library>& library);

}  // namespace stampede
