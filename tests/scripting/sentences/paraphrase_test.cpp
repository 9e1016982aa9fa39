// From a model's answer to a file of sentences: what is asked, what passes, what is kept.
#include "scripting/sentences/paraphrase.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"
#include "engine/language/similarity.h"
#include "model_answers.h"
#include "shipped.h"
#include "stub_server.h"

using namespace stampede;
using Catch::Matchers::Contains;
using stub::asks_back;
using stub::right_answer;

namespace {

ChatSettings quick_settings(const std::string& url) {
  ChatSettings one;
  one.url = url;
  one.model = "small";
  one.retries = 0;
  one.timeout_s = 5;
  return one;
}

}  // namespace

TEST_CASE("what passes is kept, what fails is counted by reason, and nothing is asked twice") {
  const Meaning& meaning = shipped::meaning("put_rubbish_in_bin");
  const SentenceChecker checker(meaning);
  stub::Server server([&](int, const std::string& body) {
    if (asks_back(body)) return stub::Reply{stub::chat(right_answer(body, meaning))};
    return stub::Reply{
        stub::chat("1. \"Put the rubbish into the bin.\"\n2. Throw the banana into the bin\n- take the rubbish off the "
                   "table and drop it in the "
                   "bin\n4. Please put the rubbish into the bin\nDo not put the rubbish into the bin\nMettez le papier "
                   "dans la poubelle")};
  });
  ChatClient client(quick_settings(server.url()));
  SentenceFile file{"put_rubbish_in_bin", {}, {}};
  std::vector<Refused> refused;
  const ParaphraseJob job{LanguageLevel::task, "", Grain::goal, 6, 6, 0};
  const ParaphraseTally tally =
      paraphrase(job, checker, {"open the box", "close the door"}, client, file, nullptr, &refused);
  std::string told;
  for (const Refused& one : refused) told += one.reason + " (" + one.detail + "): " + one.text + "\n";
  INFO(told);
  CHECK(tally.received == 6);
  CHECK(tally.passed == 2);
  CHECK(tally.refused.at("unknown_thing") == 1);
  CHECK(tally.refused.at("near_duplicate") == 1);
  CHECK(tally.refused.at("negated") == 1);
  CHECK(tally.refused.at("other_language") == 1);
  REQUIRE(file.sentences.size() == 2);
  CHECK(file.sentences[0].text == "Put the rubbish into the bin");
  CHECK(file.sentences[0].model == "small");
  CHECK(file.sentences[0].checks.size() == 3);
  const int asked = server.requests();
  CHECK(paraphrase(job, checker, {}, client, file, nullptr, nullptr).jobs_there == 1);
  CHECK(server.requests() == asked);
}

TEST_CASE("what a server answers that speaks no chat is asked for again by the same command") {
  const SentenceChecker checker(shipped::meaning("put_rubbish_in_bin"));
  const ParaphraseJob job{LanguageLevel::task, "", Grain::goal, 2, 1, 0};
  SentenceFile file{"put_rubbish_in_bin", {}, {}};
  for (const char* body : {"<html>log in first</html>", "{\"ok\": true}"}) {
    stub::Server server([&](int, const std::string&) { return stub::Reply{stub::http(200, body)}; });
    ChatClient client(quick_settings(server.url()));
    const ParaphraseTally tally = paraphrase(job, checker, {}, client, file, nullptr, nullptr);
    CHECK(tally.refused.at("no_answer") == 2);
    CHECK(file.asked.empty());
  }
}

TEST_CASE("a key that an answer repeats is not shown") {
  const SentenceChecker checker(shipped::meaning("put_rubbish_in_bin"));
  stub::Server server([&](int, const std::string&) {
    return stub::Reply{stub::chat("put sk-SECRET123 into the bin\nput the rubbish where Bearer sk-SECRET123 is")};
  });
  ChatSettings settings = quick_settings(server.url());
  settings.key = "sk-SECRET123";
  ChatClient client(settings);
  SentenceFile file{"put_rubbish_in_bin", {}, {}};
  std::vector<Refused> refused;
  paraphrase({LanguageLevel::task, "", Grain::goal, 2, 2, 0}, checker, {}, client, file, nullptr, &refused);
  REQUIRE(refused.size() == 2);
  for (const Refused& one : refused) CHECK((one.text + one.detail).find("SECRET") == std::string::npos);
}

TEST_CASE("what is done otherwise than by the goal is turned down") {
  const SentenceChecker stack(meaning_of(shipped::library(), "stack_blocks", "colour=red,height=3", 0,
                                         sentences_of(shipped::library(), "stack_blocks")));
  CHECK(stack.check("stack three red cubes").ok());
  CHECK_FALSE(stack.check("put three red cubes side by side").ok());
  CHECK_FALSE(stack.check("using any colour but red, stack three blocks").ok());
  const SentenceChecker buttons(shipped::meaning("push_buttons"));
  const Meaning& meaning = buttons.meaning();
  std::vector<std::string> colours;
  for (const SpokenThing& thing : meaning.things)
    if (thing.heads.contains("button") && thing.name.find('.') == std::string::npos && !thing.colours.empty())
      colours.push_back(*thing.colours.begin());
  REQUIRE(colours.size() == 3);
  CHECK_FALSE(
      buttons.check("press both the " + colours[0] + " and the " + colours[1] + " button at the same time").ok());
  CHECK_FALSE(buttons.check("press the " + colours[0] + " button with the " + colours[1] + " one").ok());
}

TEST_CASE("a model that does not know its own sentence again loses it") {
  const Meaning& meaning = shipped::meaning("put_rubbish_in_bin");
  const SentenceChecker checker(meaning);
  const std::vector<std::string> wrong = {"{\"things\": [], \"goal\": 99}", "I am sorry, as an AI I cannot",
                                          "{\"things\": \"all\"}", "{\"goal\": 1"};
  for (const std::string& answer : wrong) {
    stub::Server server([&](int, const std::string& body) {
      return stub::Reply{stub::chat(asks_back(body) ? answer : "put the rubbish into the bin")};
    });
    ChatClient client(quick_settings(server.url()));
    SentenceFile file{"put_rubbish_in_bin", {}, {}};
    const ParaphraseTally tally = paraphrase({LanguageLevel::task, "", Grain::goal, 1, 1, 0}, checker, {"open the box"},
                                             client, file, nullptr, nullptr);
    INFO(answer);
    CHECK(tally.passed == 0);
    CHECK(tally.refused.at("asked_back") == 1);
  }
}

TEST_CASE("refusals in text, other languages and markup are turned down") {
  const SentenceChecker checker(shipped::meaning("push_buttons"));
  for (const char* text :
       {"I'm sorry, but as an AI I cannot do that", "Нажмите красную кнопку", "按下按钮", "Drücken Sie den Knopf",
        "{\"a\": 1}", "<p>push the button</p>", "push", "", "the the the", "\xff\xfe\xfd \x80"})
    CHECK_FALSE(checker.check(text).ok());
  CHECK(checker.check("I'm sorry, I am unable to assist").reason == Rejection::refused);
  CHECK(checker.check("按下 红色 按钮").reason == Rejection::other_language);
  CHECK(checker.check(std::string(100'000, 'a') + " push").reason.has_value());
  std::string longest;
  for (int i = 0; i < 20'000; ++i) longest += "push the button then ";
  CHECK(checker.check(longest).reason == Rejection::too_long);
}

TEST_CASE("answers are lists, lines, or lists with numbers and quotes") {
  CHECK(sentences_in("[\"a b\", \"c d.\"]") == std::vector<std::string>{"a b", "c d"});
  CHECK(sentences_in("1. a b\n2) \"c d!\"\n\n* e f\n- 'g h'") == std::vector<std::string>{"a b", "c d", "e f", "g h"});
  CHECK(sentences_in("Here: [\"a b\", 3]").size() == 1);
  CHECK(sentences_in("").empty());
}

TEST_CASE("labels with slots keep them, in their order") {
  const SentenceChecker checker(
      meaning_of_label(*shipped::library(), "place", "put the {obj} on the {below}", "place"));
  CHECK(checker.check("set the {obj} down on the {below}").ok());
  CHECK(checker.check("put the {below} on the {obj}").reason == Rejection::swapped_roles);
  CHECK(checker.check("put the {obj} down").reason == Rejection::missing_thing);
  CHECK(checker.check("put the {thing} on the {below}").reason.has_value());
  CHECK(checker.check("do not put the {obj} on the {below}").reason == Rejection::negated);
  CHECK(checker.check("put the {obj} under the {below}").reason == Rejection::swapped_roles);
}

TEST_CASE("similar sentences are near-duplicates, others are not") {
  const English& english = *shipped::library()->english();
  CHECK(similarity("put the cube in the drawer", "Please put a cube in the drawer.", english) == 1);
  CHECK(similarity("put the cube in the drawer", "stow the block away", english) < 0.3);
  const std::vector<std::string> known = {"push the red button"};
  CHECK(near_duplicate("now push the red button", known, english) == &known[0]);
  CHECK(near_duplicate("press down what is red", known, english) == nullptr);
}

TEST_CASE("a file of sentences comes back as it was, and says where it is wrong") {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "push_button.sentences.json";
  SentenceFile file{
      "push_button", {{{LanguageLevel::task, "colour=maroon", Grain::goal, "m", "abc"}, 3, {{"negated", 2}}}}, {}};
  file.sentences.push_back(
      {{LanguageLevel::task, "colour=maroon", Grain::goal, "m", "abc"}, "tap the maroon button", {"words"}, 0});
  file.sentences.push_back({{LanguageLevel::skill, "pick", Grain::goal, "m", "abc"}, "grab the {obj}", {"words"}, 0});
  write_sentence_file(file, path);
  const SentenceFile again = read_sentence_file(path, "x");
  REQUIRE(again.sentences.size() == 2);
  CHECK(again.sentences[0].text == "tap the maroon button");
  CHECK(again.sentences[0].line > 5);
  CHECK(again.sentences[1].line == again.sentences[0].line + 1);
  CHECK(again.asked.front().refused.at("negated") == 2);
  CHECK(mistakes_in(again, "x", shipped::library()).empty());
  const std::string text = read_text_file(path);
  write_sentence_file(again, path);
  CHECK(read_text_file(path) == text);

  const auto told = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    write_text_file(path, changed);
    try {
      const std::vector<Error> mistakes = mistakes_in(read_sentence_file(path, "x"), "x", shipped::library());
      return mistakes.empty() ? std::string("none") : std::string(mistakes.front().what());
    } catch (const Error& error) {
      return std::string(error.what());
    }
  };
  CHECK_THAT(told("\"version\": 1", "\"version\": 9"), Contains("x:1") && Contains("version"));
  CHECK_THAT(told("\"sentences\": [", "\"sentences\": [,"), Contains("x:") && Contains("no JSON"));
  CHECK_THAT(told("tap the maroon", "tap the white"), Contains("wrong_colour") && Contains("delete the line"));
  CHECK_THAT(told("\"of\": \"colour=maroon\", \"grain\": \"goal\", \"model\": \"m\", \"prompt\": \"abc\", \"checks\"",
                  "\"of\": \"colour=plaid\", \"grain\": \"goal\", \"model\": \"m\", \"prompt\": \"abc\", \"checks\""),
             Contains("there is no 'colour=plaid'"));
  CHECK_THAT(told("\"level\": \"skill\"", "\"level\": \"dream\""), Contains("there is no level 'dream'"));
  CHECK_THAT(told("\"text\": \"grab", "\"txt\": \"grab"), Contains("there is no text 'text'"));
}
