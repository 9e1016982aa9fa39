// `stampede query` with several files: what a user of shards types, and what is told of slips.
#include <catch2/catch.hpp>

#include "say.h"

namespace stampede::program {
namespace {

struct RunInShards {
  Folder folder;
  std::string all = folder / "all.db", a = folder / "a.db", b = folder / "b.db";
  RunInShards() {
    const std::vector<std::string> run = {"run", "reach_target", "--root", kRoot, "--episodes", "4", "--out"};
    const auto made = [&](std::vector<std::string> further) {
      std::vector<std::string> words = run;
      words.insert(words.end(), further.begin(), further.end());
      return say(words).code == kDone;
    };
    REQUIRE((made({all}) && made({a, "--shard", "1/2"}) && made({b, "--shard", "2/2"})));
  }
};

Said csv_of(std::vector<std::string> words) {
  words.insert(words.begin(), "query");
  words.insert(words.end(), {"--format", "csv"});
  return say(words);
}

}  // namespace

TEST_CASE("one question to the shards of a run is answered as by the file of the whole run") {
  const RunInShards run;
  const std::string before = file_text(run.a) + file_text(run.b);
  for (const std::string question :
       {"SELECT task, count(*) AS n FROM episodes GROUP BY task", "success_by_task", "time_by_skill",
        "SELECT seed, fact, start_s, end_s FROM episodes JOIN facts USING (episode, seed) ORDER BY 1, 2, 3",
        "SELECT seed, frame, joint, position FROM joints JOIN episodes USING (episode) ORDER BY 1, 2, 3"}) {
    INFO(question);
    const Said whole = csv_of({run.all, question}), shards = csv_of({run.a, run.b, question});
    CHECK((whole.code == kDone && shards.code == kDone));
    CHECK(shards.out == whole.out);
  }
  const Said from = csv_of({run.a, run.b, "SELECT DISTINCT file_of(episode) AS file FROM segments ORDER BY 1"});
  CHECK(from.out == "file\n" + run.a + "\n" + run.b + "\n");
  CHECK(file_text(run.a) + file_text(run.b) == before);
  CHECK(!std::filesystem::exists(run.a + "-wal"));
}

TEST_CASE("slips with several files are told with their cure") {
  const RunInShards run;
  struct Slip {
    std::vector<std::string> words;
    ExitCode code;
    std::string complaint, cure;
  };
  const std::vector<Slip> slips = {
      {{run.a, run.b}, kUsage, "the last argument is the question, and '" + run.b + "' is a file", "FILE... QUESTION"},
      {{"SELECT 1", run.a}, kUsage, "'" + run.a + "' is a file", "FILE... QUESTION"},
      {{"--hash", run.a, run.b}, kUsage, "--hash takes one FILE", "one catalogue at a time"},
      {{"--datasette", run.a, run.b}, kUsage, "--datasette takes one FILE", "one catalogue at a time"},
      {{"--hash"}, kUsage, "--hash needs FILE", "name a catalogue"},
      {{run.a, run.folder / "none.db", "SELECT 1"}, kCatalogue, "none.db: there is no such file", "run --out"},
      {{run.a, run.b, "sucess_by_task"}, kBadInput, "no query named 'sucess_by_task'", "success_by_task"},
      {{run.a, run.b, "DELETE FROM episode"}, kBadInput, "a query only reads", "use SELECT"},
  };
  for (Slip slip : slips) {
    slip.words.insert(slip.words.begin(), "query");
    const Said said = say(slip.words);
    INFO(said.err);
    CHECK(said.code == slip.code);
    CHECK(said.out.empty());
    CHECK(says(said.err, slip.complaint));
    CHECK(says(said.err, slip.cure));
  }
  CHECK(csv_of({run.a, run.a, "SELECT count(*) AS n FROM episodes"}).out == "n\n2\n");
}

}  // namespace stampede::program
