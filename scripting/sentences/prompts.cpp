#include "scripting/sentences/prompts.h"

#include <algorithm>
#include <sstream>

#include "engine/base/hash.h"
#include "engine/base/random.h"
#include "engine/base/read_json.h"

namespace stampede {
namespace {

using nlohmann::json;

constexpr std::size_t kMostThings = 12, kMostFacts = 16, kMostGoals = 4;

std::string grain_words(Grain grain) {
  if (grain == Grain::steps) return "Say each step, in order, in one sentence.";
  if (grain == Grain::motions)
    return "Say each motion of the hand, in order: where it reaches, what it grips, where it moves, where it lets go.";
  return "Say only what is to be achieved, in one short instruction.";
}

// Things by what they are called, each name once: those that the instruction is about, then others.
std::vector<const SpokenThing*> things_by_phrase(const Meaning& meaning) {
  std::vector<const SpokenThing*> things;
  std::set<std::string> said;
  for (const bool wanted : {true, false})
    for (const SpokenThing& thing : meaning.things)
      if (thing.roles.wanted == wanted && !thing.region && things.size() < kMostThings &&
          said.insert(thing.phrase).second)
        things.push_back(&thing);
  return things;
}

std::string scene_words(const Meaning& meaning) {
  std::string text = "Things: ";
  for (const SpokenThing* thing : things_by_phrase(meaning)) text += (text.ends_with(": ") ? "" : ", ") + thing->phrase;
  std::size_t told = 0;
  text += ".";
  for (const std::string& fact : meaning.facts)
    if (told++ < kMostFacts) text += " " + fact + ".";
  return text;
}

std::string asking(const std::string& scene, const std::vector<std::string>& own, int count) {
  std::string text = scene + "\nInstruction: " + own.front();
  if (own.size() > 1) text += "\nAlso said as: " + own[1];
  return text + "\nWrite " + std::to_string(count) + (count == 1 ? " other way" : " other ways") +
         " to say it, one a line.";
}

std::string without_marks(std::string line) {
  const auto strip = [&](const char* marks) {
    const std::size_t first = line.find_first_not_of(marks);
    line.erase(0, first == std::string::npos ? line.size() : first);
    line.erase(line.find_last_not_of(marks) + 1);
  };
  strip(" \t\r");
  std::size_t digits = line.find_first_not_of("0123456789");
  if (digits != std::string::npos && digits > 0 && (line[digits] == '.' || line[digits] == ')' || line[digits] == ':'))
    line.erase(0, digits + 1);
  strip(" \t\r-*\"'`,");
  if (line.ends_with(".") || line.ends_with("!")) line.pop_back();
  strip(" \t\r\"'`");
  return line;
}

// From the first such bracket to the last; null: there is none, or no JSON between.
json json_between(const std::string& answer, char first, char last) {
  const std::size_t open = answer.find(first), close = answer.rfind(last);
  if (open == std::string::npos || close == std::string::npos || close < open) return {};
  return json_if_any(std::string_view(answer).substr(open, close - open + 1)).value_or(json());
}

}  // namespace

ChatRequest paraphrase_request(const Meaning& meaning, Grain grain, int count, std::int64_t seed) {
  ChatRequest request;
  request.seed = seed;
  request.temperature = 0.8;
  request.most_tokens = std::min(2000, count * (grain == Grain::goal ? 40 : grain == Grain::steps ? 90 : 140));
  request.messages.push_back(
      {"system",
       "You reword instructions for a robot arm. Keep every colour, number, side and order. Use plain English. "
       "Write only the instructions. " +
           grain_words(grain) + (meaning.slots ? " Keep words in braces, such as {obj}, as they are." : "")});
  const bool slots = meaning.slots;
  request.messages.push_back(
      {"user", asking("Things: banana, basket, work table.",
                      {slots ? "move {obj} to the {below}" : "put the banana in the basket"}, 1)});
  request.messages.push_back(
      {"assistant", slots ? "bring {obj} over to the {below}" : "place the banana into the basket"});
  request.messages.push_back({"user", asking("Things: red bell, green bell, work table.",
                                             {slots ? "ring the {bell}" : "ring the green bell"}, 1)});
  request.messages.push_back({"assistant", slots ? "make the {bell} ring" : "let the green bell ring"});
  request.messages.push_back({"user", asking(meaning.slots ? "Any scene." : scene_words(meaning), meaning.own, count)});
  return request;
}

std::string prompt_text(const ChatRequest& request) {
  std::string text;
  for (const ChatMessage& message : request.messages) text += "[" + message.role + "] " + message.text + "\n";
  return text;
}

std::string prompt_hash(const ChatRequest& request) {
  Hasher hasher;
  hasher.text(prompt_text(request))
      .text(request.json_schema)
      .number(request.seed)
      .number(request.temperature)
      .number(request.most_tokens);
  return hasher.digest().substr(0, 16);
}

std::vector<std::string> sentences_in(const std::string& answer) {
  std::vector<std::string> found;
  const json list = json_between(answer, '[', ']');
  if (list.is_array() && !list.empty() &&
      std::all_of(list.begin(), list.end(), [](const json& one) { return one.is_string(); })) {
    for (const json& one : list) found.push_back(without_marks(one.get<std::string>()));
    return found;
  }
  std::istringstream lines(answer);
  for (std::string line; std::getline(lines, line);)
    if (std::string plain = without_marks(std::move(line)); !plain.empty()) found.push_back(std::move(plain));
  return found;
}

BackQuestion back_question(const Meaning& meaning, const std::string& sentence,
                           const std::vector<std::string>& distractors, std::int64_t seed) {
  BackQuestion question;
  Random random(RandomKey("asked back").with(meaning.task).with(meaning.variation).with(sentence).with(seed));
  std::vector<const SpokenThing*> things = things_by_phrase(meaning);
  random.shuffle(things);
  std::vector<std::string> goals = {meaning.own.front()};
  for (const std::string& one : distractors)
    if (goals.size() < kMostGoals && std::find(meaning.own.begin(), meaning.own.end(), one) == meaning.own.end() &&
        std::find(goals.begin(), goals.end(), one) == goals.end())
      goals.push_back(one);
  random.shuffle(goals);
  std::string text = "Instruction: " + sentence + "\nThings:";
  for (std::size_t i = 0; i < things.size() && !meaning.slots; ++i) {
    text += "\n" + std::to_string(i + 1) + ". " + things[i]->phrase;
    if (things[i]->roles.wanted) question.wanted.insert(static_cast<int>(i + 1));
    if (things[i]->roles.handled) question.handled.insert(static_cast<int>(i + 1));
  }
  text += "\nGoals:";
  for (std::size_t i = 0; i < goals.size(); ++i) {
    text += "\n" + std::to_string(i + 1) + ". " + goals[i];
    if (goals[i] == meaning.own.front()) question.goal = static_cast<int>(i + 1);
  }
  text +=
      "\nWhich of the things does the instruction speak of, and which goal does it mean? Answer as JSON: {\"things\": "
      "[numbers], \"goal\": number}";
  question.request.seed = seed;
  question.request.temperature = 0;
  question.request.most_tokens = 80;
  question.request.messages = {{"system", "You answer in JSON only."}, {"user", std::move(text)}};
  question.request.json_schema =
      R"({"type":"object","properties":{"things":{"type":"array","items":{"type":"integer"},"maxItems":12},)"
      R"("goal":{"type":"integer"}},"required":["things","goal"]})";
  return question;
}

std::optional<std::string> wrong_answer(const BackQuestion& question, const std::string& answer) {
  const json said = json_between(answer, '{', '}');
  if (!said.is_object() || !said.contains("goal") || !said["goal"].is_number_integer()) return "it names no goal";
  if (said["goal"] != question.goal) return "it takes another goal for this one";
  if (question.wanted.empty()) return std::nullopt;
  bool handled = question.handled.empty();
  if (!said.contains("things") || !said["things"].is_array()) return "it names no things";
  for (const json& one : said["things"]) {
    if (!one.is_number_integer() || !question.wanted.contains(one.get<int>()))
      return "it names a thing that has no part in it";
    handled |= question.handled.contains(one.get<int>());
  }
  return handled ? std::nullopt : std::optional<std::string>("it does not name what is handled");
}

}  // namespace stampede
