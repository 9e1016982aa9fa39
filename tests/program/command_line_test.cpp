#include <catch2/catch.hpp>

#include "scripting/commands/commands.h"
#include "scripting/program/help.h"
#include "tests/program/say.h"

namespace stampede::program {

TEST_CASE("the reference holds the help of every command, word for word, and is fresh") {
  const std::string reference = file_text(STAMPEDE_SOURCE_DIR "/scripting/commands/reference.md");
  CHECK(reference == command_reference(all_commands()));
  for (const CommandRow& command : all_commands()) {
    const Said said = say({command.name, "--help"});
    CHECK(say({"help", command.name}).out == said.out);
    CHECK(said.code == kDone);
    CHECK(said.err.empty());
    CHECK(reference.find("```\n" + said.out + "```") != std::string::npos);
  }
}

TEST_CASE("shell completion is fresh, and bash completes every command and each of its options by it") {
  const std::string completion = file_text(STAMPEDE_SOURCE_DIR "/scripting/commands/completion.bash");
  CHECK(completion == bash_completion(all_commands()));
  const Folder folder;
  const auto proposed = [&](const std::string& words) {  // each between spaces
    const std::string script = folder / "ask.bash", answer = folder / "answer";
    std::ofstream(script) << completion << "COMP_WORDS=(stampede " << words
                          << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_stampede\necho \" ${COMPREPLY[*]} \" >"
                          << answer << "\n";
    REQUIRE(std::system(("bash " + script).c_str()) == 0);
    return file_text(answer);
  };
  for (const CommandRow& command : all_commands()) {
    INFO(command.name);
    CHECK_THAT(proposed(command.name.substr(0, 1)), Catch::Contains(" " + command.name + " "));
    const std::string options = proposed(command.name + " --");
    for (const OptionRow& option : all_options(command)) CHECK_THAT(options, Catch::Contains(" " + option.name + " "));
  }
  CHECK(proposed("x") == "  \n");
}

TEST_CASE("the program's own help lists the commands and the exit codes") {
  const Said said = say({"--help"});
  CHECK(said.code == kDone);
  for (const CommandRow& command : all_commands()) CHECK(said.out.find("  " + command.name + " ") != std::string::npos);
  CHECK(said.out.find("5 budget spent; 6 interrupted; 70 a bug of ours") != std::string::npos);
}

TEST_CASE("command lines that make no sense end with 2, say so on stderr, and propose a cure") {
  struct Case {
    std::vector<std::string> words;
    std::string complaint, cure;
  };
  const std::vector<Case> cases = {
      {{}, "which command?", "--help"},
      {{"rum"}, "there is no command 'rum'", "did you mean 'run'?"},
      {{"run"}, "needs TASK", "names of tasks"},
      {{"run", "t", "--episode", "3"}, "no option --episode", "did you mean --episodes?"},
      {{"run", "t", "--episodes", "many"}, "--episodes takes a whole number, not 'many'", ""},
      {{"run", "t", "--on-failure", "cry"}, "--on-failure cannot be 'cry'", "undo, stop, recover"},
      {{"run", "t", "--episodes", "0"}, "--episodes is at least 1", ""},
      {{"run", "t", "--seed", "1000000"}, "belong to the test split", "--split test"},
      {{"run", "t", "--seed", "999999", "--episodes", "2"}, "belong to the test split", "--split test"},
      {{"run", "t", "--split", "test", "--seed", "5"}, "the test split has seeds from 1000000 up", "leave --seed out"},
      {{"show", "demos.db", "first"}, "an episode is a number", "SELECT episode"},
      {{"query", "demos.db"}, "needs FILE and QUESTION", "--list"},
      {{"show", "a.db", "1", "2"}, "'2' has no place", "--help"},
      {{"new", "chair", "name"}, "there is no kind of file 'chair'", "task, skill, predicate, object"},
      {{"new", "task", "My Task"}, "My Task", "my_task"},
      {{"new", "task", "repeat"}, "repeat", "take "},
  };
  for (const Case& one : cases) {
    const Said said = say(one.words);
    INFO((one.words.empty() ? "" : one.words.back()) + " -> " + said.err);
    CHECK(said.code == kUsage);
    CHECK(said.out.empty());
    CHECK(said.err.find(one.complaint) != std::string::npos);
    CHECK(said.err.find(one.cure) != std::string::npos);
  }
}

TEST_CASE("a catalogue that is not there or not ours ends with 4, a missing root with 3") {
  const Folder folder;
  CHECK(say({"show", folder / "none.db", "1"}).code == kCatalogue);
  std::ofstream(folder / "letter.db") << "Dear database, you are not one.";
  CHECK(say({"query", folder / "letter.db", "SELECT 1"}).code == kCatalogue);
  CHECK(say({"replay", folder / "letter.db"}).code == kCatalogue);
  CHECK(say({"list", "--root", folder / "nowhere"}).code == kBadInput);
}

TEST_CASE("ready questions are listed without a catalogue, as table and as JSON") {
  CHECK(say({"query", "--list"}).out.find("failures_by_reason") != std::string::npos);
  const Said json = say({"query", "--list", "--json"});
  CHECK(json.code == kDone);
  CHECK(json.out.front() == '[');
}

}  // namespace stampede::program
