// Sentences of a model through the program: asked, checked, asked back, stored, resumed; in episodes; in questions.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "../scripting/sentences/model_answers.h"
#include "../scripting/sentences/stub_server.h"
#include "db/catalogue.h"
#include "engine/start/options.h"
#include "scripting/library/library.h"
#include "scripting/sentences/meaning_of.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

constexpr const char* kVariation = "colour=maroon";

// A task of one's own, so that its file of sentences stands in no other's folder.
struct Mine {
  Folder folder;
  Mine() { put(folder, "tasks/press_it.lua", file_text(std::string(kRoot) + "/tasks/push_button.lua")); }
  std::string file() const { return folder / "tasks/press_it.sentences.json"; }

  Said say(const std::vector<std::string>& words) const {
    std::vector<std::string> all = words;
    for (const char* word : {"--root", kRoot, "--path"}) all.emplace_back(word);
    all.push_back(folder.text());
    return program::say(all);
  }
  Said paraphrase(const stub::Server& server) const {
    return say({"paraphrase", "press_it", "--variation", kVariation, "--url", server.url(), "--model", "small",
                "--count", "4", "--retries", "0", "--json"});
  }
};

}  // namespace

TEST_CASE("a model is asked, its sentences are checked, asked back, stored, and not asked for again") {
  const Mine mine;
  const auto library = Library::load({{kRoot}});
  const Meaning meaning = meaning_of(library, "push_button", kVariation, 0, sentences_of(library, "push_button"));
  const stub::Server server([&](int, const std::string& body) {
    if (stub::asks_back(body)) return stub::Reply{stub::chat(stub::right_answer(body, meaning))};
    return stub::Reply{
        stub::chat("Could you tap the maroon button?\nPress the white button\nNever touch the maroon "
                   "button\nI want the maroon button pushed down")};
  });
  const Said first = mine.paraphrase(server);
  INFO(first.out + first.err);
  REQUIRE(first.code == kDone);
  const nlohmann::json told = nlohmann::json::parse(first.out);
  CHECK(told["received"] == 4);
  CHECK(told["passed"] == 2);
  CHECK(told["refused"]["wrong_colour"] == 1);
  CHECK(told["refused"]["negated"] == 1);
  const int asked = server.requests();
  CHECK(asked == 3);  // once for sentences, once for each that passed
  const std::string stored = file_text(mine.file());
  CHECK(nlohmann::json::parse(stored)["sentences"].size() == 2);

  const nlohmann::json again = nlohmann::json::parse(mine.paraphrase(server).out);
  CHECK(again["there_already"] == 1);
  CHECK(server.requests() == asked);
  CHECK(file_text(mine.file()) == stored);
  CHECK(checked(mine.folder).code == kDone);

  // Any number of workers makes the same catalogue, and a second run nothing new.
  const auto run = [&](const std::string& out, const char* workers) {
    return mine.say({"run", "press_it", "--variation", kVariation, "--episodes", "2", "--sentences", "--workers",
                     workers, "--out", mine.folder / out});
  };
  const auto hash = [&](const std::string& out) { return say({"query", mine.folder / out, "--hash"}).out; };
  REQUIRE(run("one.db", "1").code == kDone);
  REQUIRE(run("two.db", "2").code == kDone);
  CHECK(says(hash("one.db"), "content_hash"));
  CHECK(hash("one.db") == hash("two.db"));
  const std::string before = hash("one.db");
  CHECK(run("one.db", "2").code == kDone);
  CHECK(hash("one.db") == before);
  const Said rows = say({"query", mine.folder / "one.db", "--json",
                         "SELECT DISTINCT text FROM language WHERE source = 'model' ORDER BY text"});
  INFO(rows.out + rows.err);
  CHECK(says(rows.out, "Could you tap the maroon button"));
}

TEST_CASE("subgoals have sentences: the author's and a model's, each beside its segment") {
  const Folder folder;
  std::string text = file_text(std::string(kRoot) + "/tasks/push_buttons.lua");
  const std::string at = "  instructions =";
  text.insert(text.find(at),
              "  subgoals = function(v) return { { \"first_one\", is.pressed(\"button1.cap\"), \"push the {first} "
              "button\" } } end,\n");
  put(folder, "tasks/press_all.lua", text);
  const auto mine = [&](std::vector<std::string> words) {
    for (const std::string& word : {std::string("--root"), std::string(kRoot), std::string("--path"), folder.text()})
      words.push_back(word);
    return say(words);
  };
  const Said listed = mine({"list", "press_all", "--json"});
  const std::size_t begin = listed.out.find("count=");
  const std::string first = listed.out.substr(begin, listed.out.find('"', begin) - begin);
  const auto library = Library::load({{kRoot, folder.text()}});
  const Meaning meaning = *meaning_for(library, {"press_all", LanguageLevel::subgoal, subgoal_key("first_one", first)},
                                       0, sentences_of(library, "press_all"));
  const std::string colour = meaning.own.front().substr(9, meaning.own.front().find(" button") - 9);
  const stub::Server server([&](int, const std::string& body) {
    if (stub::asks_back(body)) return stub::Reply{stub::chat(stub::right_answer(body, meaning))};
    return stub::Reply{stub::chat("Could you tap the " + colour + " button?\nPush the white button\nDo not push the " +
                                  colour + " button")};
  });
  const Said asked = mine({"paraphrase", "press_all", "--level", "subgoal", "--variation", first, "--url", server.url(),
                           "--model", "small", "--count", "3", "--retries", "0", "--json"});
  INFO(asked.out + asked.err);
  REQUIRE(asked.code == kDone);
  CHECK(nlohmann::json::parse(asked.out)["passed"] == 1);
  CHECK(checked(folder).code == kDone);
  REQUIRE(mine({"run", "press_all", "--variation", first, "--sentences", "--out", folder / "p.db"}).code == kDone);
  const Said rows = say({"query", folder / "p.db", "--json",
                         "SELECT l.text, l.source, s.kind FROM language l JOIN segment s ON s.episode = l.episode AND "
                         "s.ordinal = l.segment WHERE l.level = 'subgoal' ORDER BY l.source"});
  INFO(rows.out + rows.err);
  CHECK(says(rows.out, "push the " + colour + " button"));
  CHECK(says(rows.out, "Could you tap the " + colour + " button"));
  const Said none = mine({"paraphrase", "close_box", "--level", "subgoal", "--dry-run"});
  CHECK(none.code == kBadInput);
  CHECK(says(none.err, "no subgoals with a sentence"));
}

TEST_CASE("a file of sentences under --path goes before the one beside the task, and what it lacks is told") {
  const Folder folder;
  put(folder, "tasks/push_button.sentences.json",
      R"({"version": 1, "task": "push_button", "asked": [], "sentences": [{"text": "tap the maroon button", "level": "task",
 "of": "colour=maroon", "grain": "goal", "model": "small", "prompt": "0", "checks": []}]})");
  const Said ran = say({"run", "push_button", "--variation", kVariation, "--sentences", "--root", kRoot, "--path",
                        folder.text(), "--out", folder / "p.db"});
  INFO(ran.out + ran.err);
  REQUIRE(ran.code == kDone);
  CHECK(says(ran.err, "no sentences for 17 of 18 variations of push_button"));
  CHECK(says(say({"query", folder / "p.db", "SELECT text FROM language WHERE source = 'model'"}).out,
             "tap the maroon button"));
}

TEST_CASE("Ctrl-C ends paraphrase, and what is done is kept") {
  const Mine mine;
  const auto library = Library::load({{kRoot}});
  const Meaning meaning = meaning_of(library, "push_button", kVariation, 0, sentences_of(library, "push_button"));
  std::atomic<bool> stop = false;
  const stub::Server server([&](int n, const std::string& body) {
    if (stub::asks_back(body)) return stub::Reply{stub::chat(stub::right_answer(body, meaning))};
    if (n < 2) return stub::Reply{stub::chat("Could you tap the maroon button?")};
    stop = true;
    return stub::Reply{stub::chat("I want the maroon button pushed down"), 5};
  });
  std::ostringstream out, err;
  Console console{out, err, false, false, 100, &stop};
  const std::vector<std::string> words = {"paraphrase", "press_it", "--variation", kVariation, "--grain",
                                          "goal",       "--grain",  "steps",       "--url",    server.url(),
                                          "--model",    "small",    "--count",     "1",        "--retries",
                                          "0",          "--root",   kRoot,         "--path",   mine.folder.text()};
  CHECK(run_program(all_commands(), words, console) == kInterrupted);
  INFO(out.str() + err.str());
  CHECK(says(err.str(), "interrupted: what is done is kept"));
  const nlohmann::json kept = nlohmann::json::parse(file_text(mine.file()));
  CHECK(kept["sentences"].size() == 1);
  CHECK(kept["asked"].size() == 1);
}

TEST_CASE("nobody is asked about what lies hidden") {
  const Folder folder;
  const std::string db = folder / "q.db";
  REQUIRE(say({"run", "find_item_in_drawer", "--seed", "3", "--root", kRoot, "--out", db}).code == kDone);
  REQUIRE(say({"questions", db, "--root", kRoot, "--per-frame", "60", "--frames", "8", "--out", folder / "q"}).code ==
          kDone);
  std::istringstream in(file_text(folder / "q"));
  int before = 0, after = 0;
  for (std::string text; std::getline(in, text);) {
    const nlohmann::json line = nlohmann::json::parse(text);
    INFO(text);
    const bool of_it = says(line["question"], "tin") && line["type"] != "next_skill";
    if (line["frame"] == 0) CHECK_FALSE(of_it);
    ++(line["frame"] == 0 ? before : after);
  }
  CHECK((before > 0 && after > 0));
}

TEST_CASE("questions about stored pictures name their camera, hold by the catalogue's facts, and come out the same") {
  const Folder folder;
  const std::string db = folder / "q.db";
  REQUIRE(say({"run", "meat_off_grill", "--variation", "meat=chicken", "--root", kRoot, "--images", "keyframes",
               "--size", "48x48", "--kinds", "rgb,instance", "--out", db})
              .code == kDone);
  const auto asked = [&](const std::string& out) {
    const Said said =
        say({"questions", db, "--root", kRoot, "--per-frame", "40", "--frames", "4", "--out", folder / out});
    INFO(said.out + said.err);
    CHECK(said.code == kDone);
    return file_text(folder / out);
  };
  const std::string lines = asked("a.jsonl");
  CHECK(asked("b.jsonl") == lines);
  const Catalogue catalogue = Catalogue::open(db);
  std::set<std::string> cameras, types;
  for (const ImageEntry& image : catalogue.images(1)) cameras.insert(image.camera);
  const EpisodeRecord episode = catalogue.read_episode(1);
  const auto holds = [&](const std::string& fact, std::int64_t frame) {
    return std::any_of(episode.labels.facts.begin(), episode.labels.facts.end(), [&](const FactRecord& one) {
      return to_text(one.fact) == fact && one.first_frame <= frame && frame < one.end_frame;
    });
  };
  std::istringstream in(lines);
  for (std::string text; std::getline(in, text);) {
    const nlohmann::json line = nlohmann::json::parse(text);
    INFO(text);
    const std::string type = line["type"], answer = line["answer"];
    types.insert(type);
    REQUIRE(line["camera"].is_string());
    CHECK(cameras.contains(line["camera"]));
    if (type == "where") CHECK(holds(line["fact"], line["frame"]));
    if (type == "side") CHECK((answer == "yes" || answer == "no"));
  }
  for (const char* type : {"where", "changed", "side", "holds"}) CHECK(types.contains(type));
}

}  // namespace stampede::program
