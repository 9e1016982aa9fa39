#include "scripting/sentences/sentence_file.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "engine/base/read_file.h"
#include "engine/base/read_json.h"
#include "engine/base/text_file.h"
#include "scripting/sentences/meaning_of.h"
#include "scripting/session/episode_job.h"

namespace stampede {
namespace {

using nlohmann::json;

class Reader {
 public:
  Reader(std::string text, std::string shown) : text_(std::move(text)), shown_(std::move(shown)) {}

  SentenceFile read() {
    const json document =
        json_from_text(text_, shown_, "make the file anew with `stampede paraphrase`, or put it right there");
    if (!document.is_object()) fail(1, "it holds no object", "a file of sentences is one JSON object");
    const json version = document.value("version", json());
    if (version != kSentenceFileVersion)
      fail(1,
           "its version is " + (version.is_null() ? "not said" : version.dump()) + ", not " +
               std::to_string(kSentenceFileVersion),
           "make it anew with `stampede paraphrase`");
    only(document, {"version", "task", "asked", "sentences"});
    SentenceFile file;
    file.task = text_of(document, "task");
    for (const json& one : list_of(document, "asked")) file.asked.push_back(asked_from(one));
    std::size_t from = 0;
    for (const json& one : list_of(document, "sentences")) file.sentences.push_back(sentence_from(one, from));
    return file;
  }

 private:
  [[noreturn]] void fail(int line, const std::string& what, const std::string& hint) const {
    throw Error(shown_ + ":" + std::to_string(line), what, hint);
  }

  void only(const json& object, const std::vector<std::string>& known) const {
    require_known_fields(object, known, shown_ + ":" + std::to_string(line_));
  }

  std::string text_of(const json& object, const char* name) const {
    const auto found = object.is_object() ? object.find(name) : object.end();
    if (!object.is_object() || found == object.end() || !found->is_string())
      fail(line_, std::string("there is no text '") + name + "'", "every entry has one");
    return found->get<std::string>();
  }

  const json& list_of(const json& object, const char* name) const {
    static const json kNone = json::array();
    const auto found = object.find(name);
    if (found == object.end()) return kNone;
    if (!found->is_array()) fail(line_, std::string("'") + name + "' is no list", "write it as [ … ]");
    return *found;
  }

  int count_of(const json& value, const std::string& name) const {
    constexpr std::int64_t kMost = 1'000'000;
    if (!value.is_number_integer() || value.get<std::int64_t>() < 0 || value.get<std::int64_t>() > kMost)
      fail(line_, "'" + name + "' is no count", "write a whole number, 0 to 1000000");
    return value.get<int>();
  }

  // The fields that both kinds of entries have; `further`: those that only this kind has.
  SentenceOrigin origin_from(const json& one, std::vector<std::string> further) const {
    SentenceOrigin origin;
    const std::string level = text_of(one, "level");
    if (const auto found = language_level_from(level))
      origin.level = *found;
    else
      fail(line_, "there is no level '" + level + "'", "it is task, world, subgoal, skill or motion");
    further.insert(further.end(), {"level", "of", "grain", "model", "prompt"});
    only(one, further);
    origin.of = text_of(one, "of");
    const std::string grain = text_of(one, "grain");
    if (const auto found = language_grain_from(grain))
      origin.grain = *found;
    else
      fail(line_, "there is no grain '" + grain + "'", "it is goal, steps or motions");
    origin.model = text_of(one, "model");
    origin.prompt = text_of(one, "prompt");
    return origin;
  }

  AskedFor asked_from(const json& one) const {
    AskedFor asked{origin_from(one, {"count", "refused"})};
    if (one.contains("count")) asked.count = count_of(one["count"], "count");
    if (!one.contains("refused")) return asked;
    if (!one["refused"].is_object()) fail(line_, "'refused' is no object", "write it as { \"reason\": 1 }");
    for (const auto& [reason, count] : one["refused"].items()) asked.refused[reason] = count_of(count, reason);
    return asked;
  }

  // A sentence's line is where its text stands.
  StoredSentence sentence_from(const json& one, std::size_t& from) {
    const json text = one.is_object() ? one.value("text", json()) : json();
    if (text.is_string() && from != std::string::npos) {  // in a file that is written otherwise it is not looked for
      const std::size_t at = text_.find("\"text\": " + text.dump(), from);
      if (at != std::string::npos)
        line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(from),
                                             text_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
      from = at;
    }
    const std::string said = text_of(one, "text");
    StoredSentence sentence{origin_from(one, {"text", "checks"}), said, {}};
    sentence.line = line_;
    for (const json& check : list_of(one, "checks")) {
      if (!check.is_string()) fail(line_, "'checks' is no list of texts", "write it as [\"words\"]");
      sentence.checks.push_back(check);
    }
    return sentence;
  }

  std::string text_, shown_;
  int line_ = 1;
};

// Keys in our order, on one line.
using Fields = std::vector<std::pair<const char*, json>>;

Fields with_origin(Fields fields, const SentenceOrigin& origin) {
  fields.insert(fields.end(), {{"level", to_string(origin.level)},
                               {"of", origin.of},
                               {"grain", to_string(origin.grain)},
                               {"model", origin.model},
                               {"prompt", origin.prompt}});
  return fields;
}

std::string line_of(const Fields& fields) {
  std::string line = "{";
  for (const auto& [name, value] : fields)
    line += (line.size() > 1 ? ", \"" : "\"") + std::string(name) +
            "\": " + value.dump(-1, ' ', false, json::error_handler_t::replace);
  return line + "}";
}

// By origin, each on a line of its own.
template <typename One, typename Line>
std::string list_text(std::vector<One> all, Line&& fields_of) {
  std::stable_sort(all.begin(), all.end(), [](const SentenceOrigin& a, const SentenceOrigin& b) { return a < b; });
  std::string text = "[";
  for (std::size_t i = 0; i < all.size(); ++i) text += (i == 0 ? "\n    " : ",\n    ") + line_of(fields_of(all[i]));
  return text + (all.empty() ? "]" : "\n  ]");
}

Error mistake(const std::string& shown, const StoredSentence& sentence, std::string what, std::string hint) {
  return {shown + ":" + std::to_string(sentence.line), std::move(what), std::move(hint)};
}

}  // namespace

std::vector<const StoredSentence*> SentenceFile::of(LanguageLevel level, const std::string& name) const {
  std::vector<const StoredSentence*> found;
  for (const StoredSentence& one : sentences)
    if (one.level == level && one.of == name) found.push_back(&one);
  return found;
}

std::filesystem::path sentence_path(const std::filesystem::path& task_file) {
  std::filesystem::path path = task_file;
  return path.replace_extension(".sentences.json");
}

SentenceFile read_sentence_file(const std::filesystem::path& path, const std::string& shown) {
  return Reader(read_file(path), shown).read();
}

void write_sentence_file(const SentenceFile& file, const std::filesystem::path& path) {
  const std::string asked = list_text(file.asked, [](const AskedFor& one) {
    Fields fields = with_origin({}, one);
    fields.insert(fields.end(), {{"count", one.count}, {"refused", one.refused}});
    return fields;
  });
  const std::string sentences = list_text(file.sentences, [](const StoredSentence& one) {
    Fields fields = with_origin({{"text", one.text}}, one);
    fields.emplace_back("checks", one.checks);
    return fields;
  });
  write_text_file(path, "{\n  \"version\": " + std::to_string(kSentenceFileVersion) +
                            ",\n  \"task\": " + json(file.task).dump() + ",\n  \"asked\": " + asked +
                            ",\n  \"sentences\": " + sentences + "\n}\n");
}

std::vector<Error> mistakes_in(const SentenceFile& file, const std::string& shown,
                               const std::shared_ptr<const Library>& library) {
  std::vector<Error> mistakes;
  const Library::TaskInfo* task = library->task(file.task);
  if (task == nullptr) {
    mistakes.emplace_back(shown + ":1", "there is no task '" + file.task + "'",
                          "the file is called as its task is: rename or delete it");
    return mistakes;
  }
  const std::vector<OwnSentences> all = sentences_of(library, file.task);
  std::map<std::pair<LanguageLevel, std::string>, std::optional<SentenceChecker>> checkers;
  std::set<std::tuple<LanguageLevel, std::string, std::string>> seen;
  for (const StoredSentence& sentence : file.sentences) {
    auto [found, is_new] = checkers.try_emplace({sentence.level, sentence.of});
    if (is_new) {
      try {
        if (auto meaning = meaning_for(library, {file.task, sentence.level, sentence.of}, 0, all))
          found->second.emplace(std::move(*meaning));
      } catch (const Error& error) {
        mistakes.push_back(mistake(shown, sentence, error.message(), error.hint()));
        continue;
      }
    }
    if (!found->second) {
      mistakes.push_back(mistake(
          shown, sentence, "there is no '" + sentence.of + "' of level " + std::string(to_string(sentence.level)),
          "delete the line, or make the file anew with `stampede paraphrase " + file.task + "`"));
      continue;
    }
    if (!seen.emplace(sentence.level, sentence.of, sentence.text).second)
      mistakes.push_back(mistake(shown, sentence, "the sentence is there twice", "delete the line"));
    const Verdict verdict = found->second->check(sentence.text, sentence.grain);
    if (!verdict.ok())
      mistakes.push_back(mistake(
          shown, sentence,
          "'" + sentence.text + "' does not pass: " + std::string(to_string(*verdict.reason)) + ", " + verdict.detail,
          "delete the line, or make the file anew with `stampede paraphrase " + file.task + "`"));
  }
  return mistakes;
}

}  // namespace stampede
