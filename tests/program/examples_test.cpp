// Every example of a help text is run as it stands, but for how much of it and where.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "scripting/commands/commands.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// As a shell splits it: blanks, and quotes of both kinds.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  char quote = 0;
  for (const char c : line + " ") {
    if (quote != 0 && c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (quote == 0 && c == ' ') {
      if (!word.empty()) words.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  }
  return words;
}

// Less of the same.
void shorten(std::vector<std::string>& words) {
  const std::map<std::string, std::string> least = {{"--episodes", "1"}, {"--shards", "1"},   {"--workers", "1"},
                                                    {"--skills", "2"},   {"--size", "32x32"}, {"--cell", "32x32"}};
  for (std::size_t i = 0; i + 1 < words.size(); ++i)
    if (const auto found = least.find(words[i]); found != least.end()) words[i + 1] = found->second;
}

// As a shell does where a word is `>`.
Said say_into_file(std::vector<std::string> words) {
  const auto into = std::ranges::find(words, ">");
  if (into == words.end()) return say(words);
  const std::string file = *std::next(into);
  words.erase(into, into + 2);
  const Said said = say(words);
  std::ofstream(file, std::ios::binary) << said.out;
  return said;
}

// A folder with what examples name: a catalogue, PDDL files, a BDDL problem. The current one while it lives.
class Workplace {
 public:
  Workplace() : before_(fs::current_path()) {
    fs::current_path(folder_.text());
    const Said run =
        say({"run", "push_buttons", "--episodes", "5", "--root", STAMPEDE_SOURCE_DIR, "--out", "demos.db"});
    INFO(run.err);
    REQUIRE(run.code == kDone);
    const std::string pddl = say({"plan", "put_item_in_drawer", "--pddl", "--root", STAMPEDE_SOURCE_DIR}).out;
    const std::size_t problem = pddl.find("(define (problem"), plan = pddl.find("; plan");
    REQUIRE(plan != std::string::npos);
    put("domain.pddl", pddl.substr(0, problem));
    put("problem.pddl", pddl.substr(problem, plan - problem));
    put("plan.txt", pddl.substr(plan));
    put("problem0.bddl",
        "(define (problem LIBERO_Tabletop_Manipulation) (:domain robosuite) (:language put the mug on the plate)\n"
        "(:regions (left (:target desk) (:ranges ((-0.03 -0.3 0.03 -0.27)))) (middle (:target desk) (:ranges ((0 -0.03 "
        "0.1 0.03)))))\n(:fixtures desk - table)\n(:objects porcelain_mug_1 - porcelain_mug plate_1 - plate)\n"
        "(:obj_of_interest plate_1)\n(:init (On plate_1 desk_left) (On porcelain_mug_1 desk_middle))\n"
        "(:goal (And (On porcelain_mug_1 plate_1))))\n");
    put("policy.sh",
        "while read -r line; do case $line in '{\"type\":\"reset\"'*) echo "
        "'{\"space\":\"skill\",\"skill\":\"reach\",\"arguments\":[\"target\",\"panda.hand\"]}';; "
        "*'\"terminated\":true'*) ;; *) echo '{\"space\":\"hold\"}';; esac; done\n");
    for (const char* which : {"1", "2"})
      REQUIRE(
          say({"export", "recording", "demos.db", "--episode", which, "--out", std::string("lab/000") + which}).code ==
          kDone);
    put("labels.json", "{\"language\": [{\"text\": \"push the buttons\"}]}");
    fs::create_directory("my_tasks");
    for (const auto& [program, answer] :
         {std::pair("sbatch", "17"), {"scontrol", ""}, {"squeue", ""}, {"scancel", ""}}) {
      put(program, std::string("#!/bin/sh\necho ") + answer + "\n");  // tests/program/slurm is a real one
      fs::permissions(program, fs::perms::owner_all);
    }
    setenv("PATH", (folder_.text() + ":" + path_).c_str(), 1);
    fs::create_directory("shards");
    for (const char* part : {"shards/part1.db", "part1.db", "part2.db", "old.db", "now.db", "buttons.db"})
      fs::copy_file("demos.db", part);
    REQUIRE(say({"index", "shards"}).code == kDone);
  }
  ~Workplace() {
    fs::current_path(before_);
    setenv("PATH", path_.c_str(), 1);
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

 private:
  static void put(const char* name, const std::string& text) { std::ofstream(name, std::ios::binary) << text; }
  fs::path before_;
  std::string path_ = std::getenv("PATH");
  Folder folder_;
};

}  // namespace

TEST_CASE("every example of every help text runs") {
  const Workplace here;
  int examples = 0;
  for (const CommandRow& command : all_commands()) {
    CHECK_FALSE(command.examples.empty());
    for (const std::string& example : command.examples) {
      std::vector<std::string> words = words_of(example);
      REQUIRE(words.at(0) == "stampede");
      REQUIRE(words.at(1) == command.name);
      words.erase(words.begin());
      bool own = false;
      for (std::string& word : words) {
        own = own || word == "--path";
        if (word == "~/my_tasks") word = "my_tasks";
      }
      shorten(words);
      for (const char* more : {"--root", STAMPEDE_SOURCE_DIR}) words.emplace_back(more);
      const bool writes = command.name == "new" || command.name == "doc";  // nothing of ours, by a test
      if (writes && !own)
        for (const char* more : {"--path", "my_tasks"}) words.emplace_back(more);
      const Said said = say_into_file(words);
      INFO(example << "\n" << said.err);
      const bool drawn = example.find("--behaviour random") != std::string::npos;  // reaches its goal by chance
      const bool asked = example == "stampede cluster status run1";                // nobody works on it here
      CHECK((said.code == kDone || ((drawn || asked) && said.code == kNo)));
      ++examples;
    }
  }
  CHECK(examples > 25);
}

namespace {

// Files that a page shows: the name in a line of its own, then the block.
void put_files_of(const std::string& page, const Folder& folder) {
  std::istringstream lines(page);
  std::string before, name, text;
  bool inside = false;
  for (std::string line; std::getline(lines, line); before = line) {
    if (line == "```lua" && before.starts_with("`my/") && before.ends_with("`:")) {
      name = before.substr(1, before.size() - 3);
      inside = true;
    } else if (inside && line == "```") {
      put(folder, name, std::exchange(text, {}));
      inside = false;
    } else if (inside) {
      text += line + "\n";
    }
  }
}

}  // namespace

TEST_CASE("the page of the first task: its files are right, and its commands do what it says") {
  const Workplace place;
  const Folder folder;
  const std::string page = file_text(STAMPEDE_SOURCE_DIR "/tasks/FIRST.md");
  put_files_of(page, folder);
  std::istringstream lines(page);
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("stampede ")) continue;
    std::vector<std::string> words = words_of(line);
    words.erase(words.begin());
    if (words[0] == "new") continue;  // its file is there already
    ++commands;
    shorten(words);
    for (std::string& word : words)
      if (word == "my") word = folder / "my";
    if (words[0] != "query" && words[0] != "render") words.insert(words.end(), {"--root", STAMPEDE_SOURCE_DIR});
    const Said said = say(words);
    INFO(line << "\n" << said.out << said.err);
    CHECK(said.code == kDone);
    if (words[0] == "plan") CHECK(says(said.out, "tap"));
  }
  CHECK(commands == 7);
}

namespace {

// A Lua or JSON block of the page of the language: its file, and where it is marked as wrong what is said of it.
struct Example {
  std::string name, text;
  bool wrong = false;
  std::vector<std::string> complaints;
};

// A Lua file is named in its first line, `-- tasks/tower.lua: …`; another one in the line before its block.
std::vector<Example> examples_of(const std::string& page) {
  std::vector<Example> examples;
  std::istringstream lines(page);
  std::string before, fence;
  for (std::string line; std::getline(lines, line); before = line) {
    if (fence.empty() && (line.starts_with("```lua") || line.starts_with("```json"))) {
      fence = line;
      examples.push_back(
          {line == "```json" ? before.substr(1, before.size() - 3) : "", "", line == "```lua wrong", {}});
    } else if (!fence.empty() && line == "```") {
      fence.clear();
    } else if (!fence.empty()) {
      Example& one = examples.back();
      if (one.name.empty()) one.name = line.substr(3, line.find(".lua") + 1);
      one.text += line + "\n";
    } else if (line.starts_with("> ")) {
      examples.back().complaints.push_back(line.substr(2));
    }
  }
  return examples;
}

}  // namespace

TEST_CASE(
    "the page of the language: its files are right, its tasks run, and what is wrong on it is refused in its words") {
  const Folder folder;
  const std::vector<Example> examples = examples_of(file_text(STAMPEDE_SOURCE_DIR "/scripting/LANGUAGE.md"));
  std::set<std::string> kinds;
  int wrong = 0;
  for (const Example& one : examples) {
    INFO(one.name);
    REQUIRE(one.name.find('/') != std::string::npos);
    if (one.wrong) continue;
    put(folder, one.name, one.text);
    kinds.insert(one.name.substr(0, one.name.rfind('/')));
  }
  CHECK(kinds ==
        std::set<std::string>{"skills", "tasks", "worlds", "worlds/objects", "worlds/predicates", "worlds/robots"});
  put(folder, "worlds/robots/slow_panda.urdf", file_text(STAMPEDE_SOURCE_DIR "/worlds/robots/panda.urdf"));
  const Said right = checked(folder);
  INFO(right.out << right.err);
  CHECK(right.code == kDone);
  for (const Example& one : examples) {
    INFO(one.name);
    if (one.wrong) {
      ++wrong;
      put(folder, one.name, one.text);
      const Said said = checked(folder, {fs::path(one.name).stem()});
      INFO(said.out << said.err);
      CHECK(said.code == kBadInput);
      CHECK_FALSE(one.complaints.empty());
      for (const std::string& complaint : one.complaints) CHECK(says(said.out, complaint + "\n"));
      fs::remove(folder / one.name);
    } else if (one.name.starts_with("tasks/")) {
      const Said said = say({"run", fs::path(one.name).stem(), "--root", STAMPEDE_SOURCE_DIR, "--path", folder.text(),
                             "--workers", "1", "--out", folder / "demos.db"});
      INFO(said.out << said.err);
      CHECK(said.code == kDone);
    }
  }
  CHECK(wrong >= 3);
}

}  // namespace stampede::program
