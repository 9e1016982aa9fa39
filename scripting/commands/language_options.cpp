#include "scripting/commands/language_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ostream>

#include "scripting/session/episode_job.h"

namespace stampede::program {
namespace {

std::string option_or(const Arguments& arguments, const char* option, const char* variable) {
  if (arguments.has(option)) return arguments.text(option);
  const char* value = std::getenv(variable);
  return value == nullptr ? "" : value;
}

double number_of(const Arguments& arguments, const char* option, double least, double most) {
  const std::string text = arguments.text(option);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least && value <= most))
    throw UsageError(fmt::format("{} is a number from {} to {}, not '{}'", option, least, most, text));
  return value;
}

}  // namespace

std::vector<OptionRow> model_options() {
  return {
      {"--url",
       "URL",
       "the server, such as http://localhost:8080/v1; default: STAMPEDE_LLM_URL; its key: STAMPEDE_LLM_KEY",
       Takes::text,
       "",
       {},
       false},
      {"--model", "NAME", "the model, as the server calls it; default: STAMPEDE_LLM_MODEL", Takes::text, "", {}, false},
      {"--timeout", "SECONDS", "how long one answer may take", Takes::text, "120", {}, false},
      {"--retries", "N", "of a server that is away, slow, busy or broken", Takes::integer, "4", {}, false},
      {"--rate", "N", "requests a minute, at most; 0: as fast as it answers", Takes::text, "0", {}, false},
      {"--price-in", "P", "of a million tokens asked, for the cost", Takes::text, "0", {}, false},
      {"--price-out", "P", "of a million tokens answered", Takes::text, "0", {}, false}};
}

ChatSettings chat_settings(const Arguments& arguments) {
  ChatSettings settings;
  settings.url = option_or(arguments, "--url", "STAMPEDE_LLM_URL");
  settings.model = option_or(arguments, "--model", "STAMPEDE_LLM_MODEL");
  if (settings.url.empty())
    throw UsageError("there is no language model to ask", "say --url, or set STAMPEDE_LLM_URL; --dry-run asks nobody");
  if (settings.model.empty()) throw UsageError("which model?", "say --model, or set STAMPEDE_LLM_MODEL");
  if (const char* key = std::getenv("STAMPEDE_LLM_KEY")) settings.key = key;
  if (settings.key.find_first_of("\r\n") != std::string::npos)
    throw UsageError("STAMPEDE_LLM_KEY has more than one line");
  settings.timeout_s = number_of(arguments, "--timeout", 0.1, 3600);
  const std::int64_t retries = arguments.integer("--retries").value_or(4);
  if (retries < 0 || retries > 100) throw UsageError("--retries is from 0 to 100");
  settings.retries = static_cast<int>(retries);
  settings.requests_per_minute = number_of(arguments, "--rate", 0, 1e6);
  settings.price_in = number_of(arguments, "--price-in", 0, 1e9);
  settings.price_out = number_of(arguments, "--price-out", 0, 1e9);
  return settings;
}

std::string cost_line(const ChatCost& cost, const ChatSettings& settings) {
  std::string line = fmt::format("{} requests, {} of them again; {} tokens asked, {} answered; {:.1f} s", cost.requests,
                                 cost.retries, cost.prompt_tokens, cost.completion_tokens, cost.seconds);
  if (settings.price_in > 0 || settings.price_out > 0) line += fmt::format("; cost {:.4f}", cost.price(settings));
  return line + "\n";
}

void write_cost(const ChatCost& cost, const ChatSettings& settings, JsonText& json) {
  json.key("cost").object().field("requests", cost.requests).field("retries", cost.retries);
  json.field("prompt_tokens", cost.prompt_tokens).field("completion_tokens", cost.completion_tokens);
  json.field("seconds", cost.seconds).field("price", cost.price(settings)).end();
}

std::filesystem::path sentence_path_of(const Library& library, const std::string& task) {
  task_info(library, task);
  const std::filesystem::path beside = sentence_path(library.file(DefinitionKind::task, task)->path);
  const std::vector<std::filesystem::path>& roots = library.roots().folders;  // the last goes first
  for (auto root = roots.rbegin(); root != roots.rend(); ++root)
    if (const std::filesystem::path path = *root / "tasks" / beside.filename(); std::filesystem::exists(path))
      return path;
  return beside;
}

std::string shown_sentence_path(const Library& library, const std::string& task) {
  task_info(library, task);
  return sentence_path(library.file(DefinitionKind::task, task)->shown_path).string();
}

std::map<std::string, std::vector<MadeSentence>> made_sentences(const Library& library,
                                                                const std::vector<std::string>& tasks,
                                                                Console& console) {
  std::map<std::string, std::vector<MadeSentence>> all;
  for (const std::string& task : tasks) {
    const std::filesystem::path path = sentence_path_of(library, task);
    const std::string shown = shown_sentence_path(library, task);
    if (!std::filesystem::exists(path))
      throw Error(shown, "task '" + task + "' has no file of sentences",
                  "make it: stampede paraphrase " + task + "; or leave --sentences out");
    const SentenceFile file = read_sentence_file(path, shown);
    if (file.task != task)
      throw Error(shown, "it is of task '" + file.task + "'", "make it anew: stampede paraphrase " + task);
    for (const StoredSentence& one : file.sentences)
      all[task].push_back({one.level, one.of, one.text, one.grain, one.model});
    const std::vector<std::string>& variations = task_info(library, task).variation_texts;
    const auto lacking = std::count_if(variations.begin(), variations.end(), [&](const std::string& variation) {
      return file.of(LanguageLevel::task, variation).empty();
    });
    if (lacking > 0)
      console.err << fmt::format("{}: no sentences for {} of {} variations of {}; those of others stay without\n",
                                 shown, lacking, variations.size(), task);
  }
  return all;
}

}  // namespace stampede::program
