#include "said.h"

#include <nlohmann/json.hpp>

#include "engine/base/text_file.h"
#include "shipped.h"

namespace said {
namespace {

using namespace stampede;

void read(const char* file, bool unseen, std::vector<Sentence>& sentences) {
  const nlohmann::json tasks =
      nlohmann::json::parse(read_text_file(STAMPEDE_SOURCE_DIR "/tests/scripting/sentences/data/" + std::string(file)));
  for (const nlohmann::json& one : tasks) {
    const std::string task = one.at("task"), variation = one.at("variation");
    const auto checker = std::make_shared<const SentenceChecker>(shipped::meaning(task, variation));
    for (const std::string text : one.at("good")) sentences.push_back({task, text, "", checker, unseen});
    for (const nlohmann::json& bad : one.at("bad"))
      sentences.push_back({task, bad.at("text"), bad.at("kind"), checker, unseen});
  }
}

}  // namespace

const std::vector<Sentence>& all() {
  static const std::vector<Sentence> sentences = [] {
    std::vector<Sentence> read_ones;
    read("said.json", false, read_ones);
    read("said_unseen.json", true, read_ones);
    return read_ones;
  }();
  return sentences;
}

}  // namespace said
