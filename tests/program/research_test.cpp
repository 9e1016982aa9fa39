// Research problems as data sets, from the command line: both parts, splits, scores, baselines, and what must not leak.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "db/catalogue.h"
#include "db/plain_file.h"
#include "db/research/baseline.h"
#include "db/research/dataset.h"
#include "db/research/scorer.h"
#include "engine/base/hash.h"
#include "engine/base/scratch_folder.h"
#include "engine/base/text.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;
using research::all_problems;
using research::ResearchProblem;

// Demonstrations and failures, made once; data sets of them, when they are asked for.
class Made {
 public:
  Made() {
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--episodes", "6"},
          {"--episodes", "4", "--seed", "700", "--behaviour", "random_applicable", "--skills", "3"}}) {
      std::vector<std::string> words = {"run", "pick_and_lift", "stack_blocks",      "--root",
                                        kRoot, "--out",         folder_ / "demos.db"};
      words.insert(words.end(), more.begin(), more.end());
      const Said run = say(words);
      INFO(run.err);
      REQUIRE((run.code == kDone || run.code == kNo));
    }
  }
  Said dataset(const std::string& problem, const std::string& catalogue, const std::string& name,
               const std::string& split = "seeds") const {
    const std::string to = folder_ / name;
    return say({"dataset", problem, catalogue, "--out", to + "/given", "--hidden", to + "/hidden", "--split", split});
  }
  // Six of the demonstrations as recordings of a real robot: without touch, poses of things, goals and plans.
  std::string recordings() const {
    const std::string real = folder_ / "real.db";
    if (fs::exists(real)) return real;
    std::vector<std::string> words = {"import", "recording"};
    for (const std::string episode : {"1", "2", "3", "4", "5", "6"}) {
      words.push_back(folder_ / ("lab" + episode));
      REQUIRE(say({"export", "recording", folder_ / "demos.db", "--episode", episode, "--out", words.back(), "--root",
                   kRoot})
                  .code == kDone);
    }
    words.insert(words.end(), {"--out", real, "--root", kRoot});
    const Said said = say(words);
    INFO(said.err);
    REQUIRE(said.code == kDone);
    return real;
  }
  // The demonstrations with two recordings.
  std::string mixed() const {
    (void)recordings();
    fs::copy_file(folder_ / "demos.db", folder_ / "mixed.db", fs::copy_options::skip_existing);
    const Said said = say(
        {"import", "recording", folder_ / "lab1", folder_ / "lab2", "--out", folder_ / "mixed.db", "--root", kRoot});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    return folder_ / "mixed.db";
  }
  // The folder of a problem's data set of several tasks.
  std::string varied(const std::string& problem) const {
    const std::string file = folder_ / "varied.db";
    if (!fs::exists(file))
      for (const std::vector<std::string>& more :
           {std::vector<std::string>{"--episodes", "3"},
            {"--episodes", "1", "--seed", "900", "--behaviour", "random_applicable", "--skills", "4"}}) {
        std::vector<std::string> words = {
            "run", "put_item_in_drawer", "push_buttons", "close_drawer", "--root", kRoot, "--out", file};
        words.insert(words.end(), more.begin(), more.end());
        REQUIRE(say(words).code == kDone);
      }
    REQUIRE(dataset(problem, file, "varied_" + problem).code == kDone);
    return folder_ / ("varied_" + problem);
  }
  // Folders of a problem's data set.
  std::string given(const std::string& problem) const { return ready(problem) + "/given"; }
  std::string hidden(const std::string& problem) const { return ready(problem) + "/hidden"; }
  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  std::string ready(const std::string& problem) const {
    if (!fs::exists(folder_ / (problem + "/given/given.db"))) {
      const Said said = dataset(problem, folder_ / "demos.db", problem);
      INFO(problem << said.err);
      REQUIRE(said.code == kDone);
    }
    return folder_ / problem;
  }
  Folder folder_;
};

const Made& made() {
  static const Made files;
  return files;
}

PlainFile given_file(const std::string& name) { return PlainFile::open(made().given(name) + "/given.db"); }
PlainFile hidden_file(const std::string& name) { return PlainFile::open(made().hidden(name) + "/hidden.db"); }

std::set<std::string> texts_of(const PlainFile& file, const std::string& select) {
  std::set<std::string> texts;
  for (const auto& row : file.query(select).rows)
    for (const SqlValue& value : row)
      if (const auto* text = std::get_if<std::string>(&value)) texts.insert(*text);
  return texts;
}

std::string answers_file(const std::string& name, const std::string& text) {
  std::ofstream(made().path(name), std::ios::binary) << text;
  return made().path(name);
}

// An answer for each of the test split, in rows that end alike.
std::string rows_of(const std::string& problem, const std::string& rest) {
  const Rows rows = given_file(problem).query("SELECT episode FROM episodes WHERE split = 'test'");
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) text += std::to_string(rows.integer(i, "episode")) + "," + rest + "\n";
  return text;
}

void add_to(Hasher& hash, const SqlValue& value) {
  std::visit(
      [&](const auto& held) {
        using Held = std::remove_cvref_t<decltype(held)>;
        if constexpr (std::is_arithmetic_v<Held>)
          hash.number(held);
        else if constexpr (std::is_same_v<Held, std::string>)
          hash.text(held);
        else if constexpr (std::is_same_v<Held, SqlBlob>)
          hash.bytes(held.bytes.data(), held.bytes.size());
      },
      value);
}

// Of demonstrations and failures in several tasks, drawers among them: both parts of a problem's data set, what the
// baselines answer, and what the scorers say of that.
std::string hash_of_all(const ResearchProblem& problem) {
  const std::string folder = made().varied(problem.name), answers = folder + "/answers.json";
  Hasher hash;
  for (const std::string part : {"given", "hidden"}) {
    const PlainFile file = PlainFile::open(folder + "/" + part + "/" + part + ".db");
    for (const std::string& line : split(file_text(folder + "/" + part + "/README.md"), '\n'))
      if (!says(line, "Physics and demonstrations by Stampede") && !says(line, made().path(""))) hash.text(line);
    for (const std::string& table : file.tables())
      for (const auto& row : file.query("SELECT * FROM " + table).rows)
        for (const SqlValue& value : row) add_to(hash, value);
  }
  for (const research::Baseline& baseline : research::all_baselines()) {
    if (std::ranges::find(baseline.problems, problem.name) == baseline.problems.end()) continue;
    REQUIRE(say({"baseline", baseline.name, folder + "/given", "--out", answers}).code == kDone);
    hash.text(file_text(answers));
    std::vector<std::string> words = {"score", problem.name, answers, "--hidden", folder + "/hidden", "--json"};
    if (research::draws_timelines(problem)) words.insert(words.end(), {"--figure", folder + "/figure.svg"});
    const Said scored = say(words);
    REQUIRE(scored.code == kDone);
    hash.text(nlohmann::json::parse(scored.out)["figures"].dump());
    if (research::draws_timelines(problem)) hash.text(file_text(folder + "/figure.svg"));
  }
  return hash.digest();
}

std::map<std::string, std::string> known_hashes() {
  return {
      {"abstractions", "6a12dff3b80f4a62f083d6b55a749295"},
      {"inventions", "4d5fca84dd71607850ee3bbf74ad6b14"},
      {"symbols", "c99fb549536e992c2144767df3f3af0a"},
      {"concepts", "4b9fa9f89e582eae85f720d2657ba69a"},
      {"segments_supervised", "fdc41a2b274ad009da83c635c68ed5dd"},
      {"segments", "8a116cfcf8188f1c87a89b80b56a83ab"},
      {"conditions_supervised", "aa30caf75de4434c75ba8dc03c73594a"},
      {"conditions", "d3eef0e1ac4a0df036a1502f5a5cc56d"},
      {"segments_and_conditions", "ccf45edda709ed51258e32d12e471b5b"},
      {"motions", "35a18f5391d51c3bdb9220fbe1cac937"},
      {"behaviour", "bf4cf148305769081803708d0ff27d7d"},
      {"controllers", "ea7ce661f62933bd32ac2283a628deb1"},
      {"transfer", "45d81a6d84ac03d74b06efcff124cdbd"},
      {"rewards", "adb891f0539584f2265bde6c31fa2c2c"},
      {"transition_models", "c30d51760cb86daf35ba768aa9ab9705"},
  };
}

std::string id_of(const std::string& name) { return research::dataset_id(given_file(name)); }

}  // namespace

TEST_CASE("data sets for research problems", "[research]") {
  SECTION("pages, tables, answers, scores and figures of every problem are what they are known by") {
    for (const ResearchProblem& problem : all_problems()) {
      CAPTURE(problem.name);
      CHECK(hash_of_all(problem) == known_hashes()[problem.name]);
    }
  }
  SECTION("every problem has both parts, a page for each, and an example of answers") {
    for (const ResearchProblem& problem : all_problems()) {
      INFO(problem.name);
      const PlainFile given = given_file(problem.name), hidden = hidden_file(problem.name);
      CHECK(research::dataset_id(given) == research::dataset_id(hidden));
      CHECK(research::dataset_problem(given) == problem.name);
      const std::string page = file_text(made().given(problem.name) + "/README.md");
      for (const std::string& part :
           {problem.title, problem.serves, research::dataset_id(given), std::string("## Splits")})
        CHECK(says(page, part));
      for (const std::string& table : given.tables()) CHECK(says(page, "`" + table + "`"));
      for (const research::TableUse& use : problem.given) {
        const std::string of = use.part == research::Part::all    ? "all"
                               : use.part == research::Part::test ? "test"
                                                                  : "train, validation";
        CHECK(says(page, "| `" + use.table() + "` | " + of + " |"));
      }
      CHECK(says(file_text(made().hidden(problem.name) + "/README.md"), "pick_and_lift, stack_blocks"));
      CHECK(fs::exists(made().given(problem.name) + "/answers.example.json"));
      for (const research::TableUse& use : problem.hidden)
        if (use.table() != "images") CHECK(hidden.has(use.table()));
    }
  }
  SECTION("nothing of the given part names an episode's source: no keys, seeds, variations, scenes") {
    for (const ResearchProblem& problem : all_problems()) {
      INFO(problem.name);
      const PlainFile given = given_file(problem.name);
      const std::string bytes = file_text(made().given(problem.name) + "/given.db");
      for (const std::string& key : texts_of(hidden_file(problem.name), "SELECT key FROM sources"))
        CHECK_FALSE(says(bytes, key));
      std::set<std::string> tables;
      for (const research::TableUse& use : problem.given) tables.insert(use.table());
      for (const char* table : {"dataset", "episodes", "pieces"}) tables.insert(table);
      for (const std::string& table : given.tables()) {
        CHECK(tables.contains(table));
        const Rows columns = given.query("SELECT name FROM pragma_table_info('" + table + "')");
        for (std::size_t i = 0; i < columns.size(); ++i)
          for (const char* banned :
               {"key", "seed", "scene", "state_hash", "label", "subgoal", "step", "time_s", "segment"}) {
            INFO(table);
            CHECK(columns.text(i, "name") != banned);
          }
      }
    }
  }
  SECTION(
      "hidden labels are nowhere in the given part of segments: no names, and nothing that changes where skills do") {
    const PlainFile given = given_file("segments"), hidden = hidden_file("segments");
    CHECK(given.tables() == std::vector<std::string>{"dataset", "episodes", "hands", "joints"});
    const std::set<std::string> skills = texts_of(hidden, "SELECT skill FROM skills");
    CHECK(skills.contains("pick"));
    std::set<std::string> told;
    for (const std::string& table : given.tables()) told.merge(texts_of(given, "SELECT * FROM " + table));
    for (const std::string& skill : skills) CHECK_FALSE(told.contains(skill));
    // Every frame has the same rows, without gaps, NULLs or other names: only measured numbers differ from frame to
    // frame.
    const Rows uneven = given.query(
        "SELECT e.episode FROM episodes e JOIN (SELECT episode, frame, count(*) AS n, group_concat(joint || "
        "ifnull(arm_joint, '')) AS names "
        "FROM "
        "joints "
        "GROUP BY episode, frame) j ON j.episode = e.episode GROUP BY e.episode "
        "HAVING count(*) <> e.frames OR max(j.frame) <> e.frames - 1 OR min(j.n) <> max(j.n) OR count(DISTINCT names) "
        "<> "
        "1");
    CHECK(uneven.size() == 0);
    for (const std::string table : {"joints", "hands"}) {
      const Rows columns = given.query("SELECT name FROM pragma_table_info('" + table + "')");
      for (std::size_t i = 0; i < columns.size(); ++i)
        if (columns.text(i, "name") != "arm_joint")  // NULL of fingers
          CHECK(given.query("SELECT count(*) AS n FROM " + table + " WHERE " + columns.text(i, "name") + " IS NULL")
                    .integer(0, "n") == 0);
    }
    // Whole numbers are frames and counts alone: no column counts segments.
    const Rows whole =
        given.query("SELECT DISTINCT typeof(velocity) AS t FROM joints UNION SELECT typeof(opening) FROM hands");
    CHECK(whole.size() == 1);
    CHECK(whole.text(0, "t") == "real");
  }
  SECTION("where labels are given, it is for training alone") {
    for (const auto& [problem, table] : {std::pair{"segments_supervised", "skills"},
                                         {"conditions_supervised", "effects"},
                                         {"behaviour", "plans"},
                                         {"behaviour", "actions"},
                                         {"controllers", "controls"},
                                         {"rewards", "rewards"}}) {
      INFO(problem << " " << table);
      const PlainFile given = given_file(problem);
      const std::string of =
          std::string("SELECT count(*) AS n FROM ") + table + " JOIN episodes USING (episode) WHERE split ";
      CHECK(given.query(of + "<> 'test'").integer(0, "n") > 0);
      CHECK(given.query(of + "= 'test'").integer(0, "n") == 0);
    }
    // Of test episodes moments so far apart that one does not tell what was done in the one before.
    const Rows moments =
        given_file("behaviour")
            .query("SELECT max(frame % 20) AS off FROM joints JOIN episodes USING (episode) WHERE split = 'test'");
    CHECK(moments.integer(0, "off") == 0);
    const PlainFile models = given_file("transition_models");
    for (const auto& [table, frame] : {std::pair{"poses", "frame"},
                                       {"hands", "frame"},
                                       {"joints", "frame"},
                                       {"object_joints", "frame"},
                                       {"facts", "first_frame"},
                                       {"facts", "end_frame - 1"}}) {
      INFO(table);
      const Rows future =
          models.query(std::string("SELECT count(*) AS n FROM ") + table +
                       " JOIN episodes USING (episode) WHERE split = 'test' AND (" + frame + ") % 40 NOT IN (39, 0)");
      CHECK(future.integer(0, "n") == 0);
    }
  }
  SECTION("numbers of two data sets do not tell which episodes are the same, nor in which order they were made") {
    const auto seeds = [](const std::string& problem) {
      const Rows rows = hidden_file(problem).query("SELECT task, seed FROM sources ORDER BY episode");
      std::vector<std::string> list;
      for (std::size_t i = 0; i < rows.size(); ++i)
        list.push_back(rows.text(i, "task") + std::to_string(rows.integer(i, "seed")));
      return list;
    };
    const std::vector<std::string> here = seeds("segments"), there = seeds("behaviour");
    CHECK(std::set(here.begin(), here.end()) == std::set(there.begin(), there.end()));
    CHECK(here != there);
    CHECK_FALSE(std::is_sorted(here.begin(), here.end()));
  }
  SECTION("every baseline answers from the given part, and its answers are scored") {
    std::set<std::string> answered;
    for (const research::Baseline& baseline : research::all_baselines())
      for (const std::string& problem : baseline.problems) {
        INFO(baseline.name << " " << problem);
        const std::string file = made().path(baseline.name + "_" + problem + ".json");
        const Said said = say({"baseline", baseline.name, made().given(problem), "--out", file});
        INFO(said.err);
        REQUIRE(said.code == kDone);
        const Said scored = say({"score", problem, file, "--hidden", made().hidden(problem), "--json"});
        INFO(scored.err);
        REQUIRE(scored.code == kDone);
        const auto json = nlohmann::json::parse(scored.out);
        CHECK(json["dataset"] == id_of(problem));
        CHECK(json["figures"].size() > 2);
        for (const auto& figure : json["figures"]) {
          CHECK(figure["value"].is_number());
          // Better than chance, by far: what was invented means something, and does what skills do.
          if (baseline.name == "thresholds" && (figure["name"] == "coverage" || figure["name"] == "effects_f1"))
            CHECK(figure["value"].get<double>() > 0.6);
        }
        answered.insert(problem);
      }
    for (const std::string problem :
         {"segments", "segments_supervised", "motions", "behaviour", "rewards", "transition_models"})
      CHECK(answered.contains(problem));
  }
  SECTION("a timeline is drawn, and scores go to a file") {
    const std::string answers = made().path("k.json"), figure = made().path("k.svg"), out = made().path("score.json");
    REQUIRE(say({"baseline", "keyframes", made().given("segments"), "--out", answers}).code == kDone);
    const Said said =
        say({"score", "segments", answers, "--hidden", made().hidden("segments"), "--figure", figure, "--out", out});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    CHECK(says(said.out, "f1_within_5"));
    const std::string svg = file_text(figure);
    CHECK(svg.starts_with("<svg"));
    CHECK(svg.ends_with("</svg>\n"));
    for (const char* part : {"gripper opening", "rad/s", ">pick<", "stroke-dasharray"}) CHECK(says(svg, part));
    for (const char* joint : {">joint1<", ">joint7<"}) CHECK(says(svg, joint));  // a legend of the lines
    CHECK(nlohmann::json::parse(file_text(out))["problem"] == "segments");
  }
  SECTION("a part of the answers is no answer: what is missing or said twice is refused, with how much it is") {
    for (const auto& [problem, baseline, half] : {std::tuple{"concepts", "geometry", "moments that are asked about"},
                                                  {"symbols", "geometry_symbols", "moments that are asked about"},
                                                  {"motions", "k_means", "pieces of the test split"},
                                                  {"behaviour", "stay", "frame "},
                                                  {"inventions", "thresholds", "frames that are asked about"}}) {
      INFO(problem);
      const std::string file = made().path(std::string("whole_") + problem + ".json"), cut = made().path("cut.json");
      REQUIRE(say({"baseline", baseline, made().given(problem), "--out", file}).code == kDone);
      const auto scored = [&](nlohmann::json answers) {
        std::ofstream(cut) << answers.dump();
        return say({"score", problem, cut, "--hidden", made().hidden(problem)});
      };
      const auto whole = nlohmann::json::parse(file_text(file));
      CHECK(scored(whole).code == kDone);
      auto some = whole;
      // Of two episodes none is to lack all its frames; of moments many are to lack all their answers.
      const std::size_t all = whole["answers"].size(), kept = problem == std::string("behaviour") ? all - 1 : all / 2;
      some["answers"].erase(some["answers"].begin() + static_cast<long>(kept), some["answers"].end());
      const Said first_part = scored(some);
      INFO(first_part.err);
      CHECK(first_part.code == kBadInput);
      CHECK(says(first_part.err, "there is no answer for "));
      CHECK(says(first_part.err, half));
      some["answers"] = nlohmann::json::array();
      CHECK(scored(some).code == kBadInput);
      some = whole;
      some["answers"].push_back(whole["answers"].front());
      const Said twice = scored(some);
      INFO(twice.err);
      CHECK(twice.code == kBadInput);
      CHECK(says(twice.err, "answered twice"));
    }
  }
  SECTION("where nothing holds, a row says so, and what is not said does not hold") {
    const PlainFile hidden = hidden_file("concepts");
    const Rows episodes = hidden.query("SELECT episode, frames FROM episodes WHERE split = 'test'");
    std::string text = "# dataset: " + id_of("concepts") + "\nepisode,frame,fact\n";
    for (std::size_t i = 0; i < episodes.size(); ++i)
      for (std::int64_t frame = 0; frame < episodes.integer(i, "frames"); frame += 20)
        text += std::to_string(episodes.integer(i, "episode")) + "," + std::to_string(frame) + ",\n";
    const Said said =
        say({"score", "concepts", answers_file("nothing", text), "--hidden", made().hidden("concepts"), "--json"});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    const auto scores = nlohmann::json::parse(said.out);
    for (const auto& figure : scores["figures"])
      if (figure["name"] == "recall" || figure["name"] == "f1") CHECK(figure["value"] == 0);
  }
  SECTION("both pages count what training still shows of what is held out") {
    const Catalogue demos = Catalogue::open(made().path("demos.db"));
    const std::string value =
        demos.query("SELECT value FROM axes JOIN demos USING (episode) WHERE axis = 'colour' ORDER BY 1")
            .text(0, "value");
    const Said said = made().dataset("concepts", made().path("demos.db"), "leaky", "colour=" + value);
    INFO(said.err);
    REQUIRE(said.code == kDone);
    const Rows train = demos.query(
        "SELECT episode FROM demos e WHERE frames > 0 AND NOT EXISTS (SELECT 1 FROM axes a WHERE a.episode = "
        "e.episode AND axis = 'colour' AND value = ?1)",
        {.parameters = {value}});
    std::int64_t things = 0, words = 0, sentences = 0, any = 0;
    for (std::size_t i = 0; i < train.size(); ++i) {
      const SqlValue episode = train.integer(i, "episode");
      const Rows seen = demos.query("SELECT count(*) AS n FROM objects WHERE episode = ?1 AND colour = ?2",
                                    {.parameters = {episode, value}});
      const Rows told = demos.query("SELECT text FROM instructions WHERE episode = ?1", {.parameters = {episode}});
      std::int64_t own = 0;
      for (std::size_t k = 0; k < told.size(); ++k)
        own += (" " + told.text(k, "text") + " ").find(" " + value + " ") == std::string::npos ? 0 : 1;
      sentences += own;
      things += seen.integer(0, "n") > 0 ? 1 : 0, words += own > 0 ? 1 : 0;
      any += seen.integer(0, "n") > 0 || own > 0 ? 1 : 0;
    }
    CHECK(things > 0);  // blocks that are in the way
    const std::string row = "| " + value + " | 0 | " + std::to_string(things) + " | " + std::to_string(words) + " | " +
                            std::to_string(sentences) + " | " + std::to_string(any) + " |\n";
    INFO(row);
    for (const std::string part : {"leaky/given", "leaky/hidden"})
      CHECK(says(file_text(made().path(part + "/README.md")), row));
    CHECK(says(said.err, "remark: what is held out shows in training: " + value + ": " + std::to_string(any) + " of " +
                             std::to_string(train.size())));
    CHECK(says(file_text(made().given("segments") + "/README.md"), "is that of a training episode: "));
  }
  SECTION("data sets that cannot be made say why") {
    const std::string demos = made().path("demos.db");
    const auto refused = [&](const std::vector<std::string>& words, ExitCode code, const std::string& why) {
      const Said said = say(words);
      INFO(said.err);
      CHECK(said.code == code);
      CHECK(says(said.err, why));
    };
    refused({"dataset", "segment", demos, "--out", made().path("x")}, kBadInput, "did you mean 'segments'");
    refused({"dataset", "segments", demos}, kUsage, "--out");
    refused({"dataset", "segments"}, kUsage, "a catalogue");
    refused({"dataset", "segments", demos, "--out", made().path("x"), "--hidden", made().path("x")}, kUsage,
            "the same folder");
    refused({"dataset", "segments", made().path("none.db"), "--out", made().path("x")}, kCatalogue, "no such file");
    refused({"dataset", "segments", demos, "--out", made().path("x"), "--split", "shape=round"}, kBadInput,
            "axis 'shape'");
    refused({"dataset", "segments", demos, "--out", demos + "/x"}, kCatalogue, "cannot be made");
    refused({"baseline", "keyframe", made().given("segments"), "--out", made().path("x.json")}, kBadInput,
            "did you mean 'keyframes'");
    refused({"baseline", "keyframes", made().given("motions"), "--out", made().path("x.json")}, kBadInput,
            "does not answer motions");
    refused({"baseline", "keyframes", made().path("nowhere"), "--out", made().path("x.json")}, kCatalogue,
            "no such file");
    CHECK_FALSE(fs::exists(made().path("x.json")));
  }
  SECTION("answers that cannot be scored say why") {
    const auto refused = [&](const std::string& problem, const std::string& text, const std::string& why) {
      const Said said = say({"score", problem, answers_file("wrong", text), "--hidden", made().hidden(problem)});
      INFO(text << "\n" << said.err);
      CHECK(said.code == kBadInput);
      CHECK(says(said.err, why));
    };
    const auto head = [](const std::string& problem) { return "# dataset: " + id_of(problem) + "\n"; };
    refused("segments", "# dataset: 0123\nepisode,first_frame,end_frame\n", "answers for another data set");
    refused("segments", "episode,first_frame,end_frame\n", "does not say which data set");
    refused("segments", head("segments") + "episode,first_frame,end_frame\n", "of the test split, the first: ");
    refused("motions", head("motions") + "piece,cluster\n9999,a\n", "no piece 9999");
    refused("rewards", head("rewards") + "episode,frame,value\n" + rows_of("rewards", "100000,0.5"), "is not there");
    refused("rewards", head("rewards") + "episode,frame,value\n" + rows_of("rewards", "0,0.5"),
            "no answer for frame 10");
    refused("rewards", head("rewards") + "episode,frame,value\n1,0,nan\n", "finite number");
    refused("concepts", head("concepts") + "episode,frame,fact\n1,0,(onn block1 table)\n", "did you mean 'on'");
    refused("concepts", head("concepts") + "episode,frame,fact\n1,0,on block1\n", "no ground atom");
    refused("symbols", head("symbols") + "piece,moment,symbol\n1,during,(s)\n", "no moment");
    refused("symbols", "{\"dataset\": \"" + id_of("symbols") + "\", \"answers\": [], \"more\": \"x\"}",
            "no field 'more'");
    const Said mixed = say({"score", "motions", answers_file("wrong", "x"), "--hidden", made().hidden("segments")});
    CHECK(mixed.code == kBadInput);
    CHECK(says(mixed.err, "a data set of segments, not of motions"));
    CHECK(say({"score", "segments", made().path("wrong"), "--hidden", made().given("segments")}).code == kCatalogue);
    CHECK(say({"score", "segments", made().path("wrong")}).code == kUsage);
    const auto idle = [&](const std::string& problem, const std::vector<std::string>& option, const std::string& why) {
      std::vector<std::string> words = {"score", problem, made().path("wrong"), "--hidden", made().hidden(problem)};
      words.insert(words.end(), option.begin(), option.end());
      const Said said = say(words);
      INFO(said.err);
      CHECK(said.code == kUsage);
      CHECK(says(said.err, why));
    };
    idle("motions", {"--figure", made().path("f.svg")},
         "--figure is for segments_supervised, segments, segments_and_conditions");
    idle("controllers", {"--figure", made().path("f.svg")}, "there is no figure of controllers");
    idle("rewards", {"--physics", "2"},
         "--physics is for abstractions, inventions, conditions_supervised, conditions, segments_and_conditions");
    idle("segments", {"--episode", "2"}, "--episode without --figure");
    CHECK_FALSE(fs::exists(made().path("f.svg")));
  }
}

TEST_CASE("the same episodes make the same bytes, in whatever order they are stored", "[research]") {
  const std::string other = made().path("other.db");
  for (const char* task : {"stack_blocks", "pick_and_lift"}) {
    REQUIRE(say({"run", task, "--root", kRoot, "--out", other, "--episodes", "4", "--seed", "700", "--behaviour",
                 "random_applicable", "--skills", "3"})
                .code != kUsage);
    REQUIRE(say({"run", task, "--root", kRoot, "--out", other, "--episodes", "6"}).code == kDone);
  }
  for (const std::string problem : {"segments", "motions", "transition_models"}) {
    const std::string again = "again_" + problem;
    REQUIRE(made().dataset(problem, other, again).code == kDone);
    for (const std::string part : {"/given/given.db", "/hidden/hidden.db", "/given/README.md"})
      CHECK(file_text(made().path(again + part)) ==
            file_text(fs::path(made().given(problem)).parent_path().string() + part));
  }
}

TEST_CASE("recordings serve the problems that they have something for, and no others", "[research]") {
  const std::string real = made().recordings();
  std::string served;
  for (const ResearchProblem& problem : all_problems()) {
    const Said said = made().dataset(problem.name, real, "real_" + problem.name);
    INFO(problem.name << "\n" << said.err);
    if (said.code == kDone) served += problem.name + " ";
    if (said.code == kDone) continue;
    CHECK(said.code == kBadInput);
    CHECK(says(said.err, real + ": there is nothing to "));
    CHECK(says(said.err, "which " + problem.name + " needs"));
    CHECK(says(said.err, "`stampede run`"));
    CHECK_FALSE(fs::exists(made().path("real_" + problem.name)));
  }
  CHECK(served == "segments_supervised segments motions behaviour controllers transfer transition_models ");
}

TEST_CASE("baselines leave out what no recording has, and say where only some have it", "[research]") {
  for (const research::Baseline& baseline : research::all_baselines())
    for (const std::string& problem : baseline.problems) {
      const std::string name = "real_" + problem, file = made().path(baseline.name + "_" + name + ".json");
      if (!fs::exists(made().path(name + "/given")) && made().dataset(problem, made().recordings(), name).code != kDone)
        continue;  // of those there is a test of its own
      const PlainFile given = PlainFile::open(made().path(name + "/given/given.db"));
      CHECK(given.query("SELECT count(touch_1) AS n FROM hands").integer(0, "n") == 0);
      const Said said = say({"baseline", baseline.name, made().path(name + "/given"), "--out", file});
      INFO(baseline.name << " " << problem << "\n" << said.err);
      REQUIRE(said.code == kDone);
      const Said scored = say({"score", problem, file, "--hidden", made().path(name + "/hidden")});
      INFO(scored.err);
      CHECK(scored.code == kDone);
      CHECK_FALSE(says(scored.out, "thing_error"));  // nobody knows where things were
    }
  REQUIRE(made().dataset("segments", made().mixed(), "mixed").code == kDone);
  const Said mixed = say({"baseline", "change_points", made().path("mixed/given"), "--out", made().path("mixed.json")});
  INFO(mixed.err);
  CHECK(mixed.code == kBadInput);
  CHECK(
      says(mixed.err, made().path("mixed/given") + "/given.db, table hands: the column touch_1 is NULL in some rows"));
  CHECK(says(mixed.err, "all measured alike"));
}

TEST_CASE("pages say which episodes are simulated and which recorded, and who labelled them", "[research]") {
  const auto page = [](const std::string& catalogue, const std::string& name) {
    const Said said = made().dataset("segments_supervised", catalogue, name);
    INFO(said.err);
    REQUIRE(said.code == kDone);
    return file_text(made().path(name + "/given/README.md"));
  };
  const std::string simulated = page(made().path("demos.db"), "page_simulated");
  CHECK(says(simulated, " failed simulated episodes of a robot arm."));
  for (const char* part : {"No person is in it", "Labels by the simulator as it ran, never by people", "by template",
                           "Known weakness", "MIT, as Stampede.\n"})
    CHECK(says(simulated, part));

  const std::string real = made().recordings(), labels = made().path("labels.json");
  std::ofstream(labels) << R"({"labelled_by": "person", "segments": [{"kind": "skill", "name": "pick",
      "arguments": ["block"], "start_s": 0.1, "end_s": 0.5, "label": "pick up the block"}]})";
  const std::string recorded = page(real, "page_real");
  CHECK(says(recorded, "Made of 6 successful and 0 failed episodes, all recorded of a real robot arm."));
  CHECK(says(recorded, " by model. Sentences: "));
  CHECK(says(recorded, "Who made the recordings answers for what they show."));
  CHECK(says(recorded, "of the recordings, what their makers say"));
  for (const char* part : {"No person", "simulator", "never by people", "Known weakness", "Physics"})
    CHECK_FALSE(says(recorded, part));

  const std::string mixed = made().mixed();
  const std::string last = say({"query", mixed, "SELECT max(episode) FROM episodes", "--format", "csv"}).out;
  const Said labelled =
      say({"import", "labels", labels, mixed, "--episode",
           last.substr(last.find('\n') + 1, last.rfind('\n') - last.find('\n') - 1), "--root", kRoot});
  INFO(labelled.err);
  REQUIRE(labelled.code == kDone);
  const std::string both = page(mixed, "page_mixed");
  CHECK(says(both, " simulated, 2 recorded of a real one."));
  CHECK(says(both, "by model, 1 by person, "));
  CHECK(says(both, "by simulator. Sentences: "));
  CHECK(says(both, "Known weakness"));
  CHECK_FALSE(says(both, "never by people"));
}

TEST_CASE("a folder is written to if it is new, empty, or holds the same problem's data set", "[research]") {
  const Folder folder;
  const auto dataset = [&](const std::string& problem, const std::string& out, const std::string& hidden) {
    return say({"dataset", problem, made().path("demos.db"), "--out", out, "--hidden", hidden});
  };
  const auto refused = [&](const Said& said, ExitCode code, const std::string& why, const std::string& where) {
    INFO(said.err);
    CHECK(said.code == code);
    CHECK(says(said.err, why));
    CHECK(says(said.err, where));
  };
  const std::string given = folder / "given", hidden = folder / "hidden", mine = folder / "mine";
  put(folder, "mine/README.md", "my own page");
  const Said first = dataset("motions", mine, hidden);
  refused(first, kBadInput, "is not empty", mine);
  CHECK(says(first.err, "new or empty"));
  refused(dataset("motions", given, mine), kBadInput, "is not empty", mine);
  CHECK(file_text(mine + "/README.md") == "my own page");
  CHECK_FALSE(fs::exists(given));
  CHECK_FALSE(fs::exists(hidden));

  fs::create_directories(given);
  put(folder, "given/given.db.unfinished", "mine");
  refused(dataset("motions", given, hidden), kBadInput, "is not empty", given);
  CHECK(file_text(given + "/given.db.unfinished") == "mine");
  fs::remove(given + "/given.db.unfinished");
  const ScratchFolder of_another(given + "/given.db");  // as a program that was killed leaves it
  REQUIRE(dataset("motions", given, hidden).code == kDone);
  put(folder, "given/notes.txt", "what I saw");
  const std::string bytes = file_text(given + "/given.db"), page = file_text(given + "/README.md");
  refused(dataset("segments", given, folder / "other"), kBadInput, "a data set of motions", given);
  refused(dataset("motions", hidden, folder / "other"), kBadInput, "is not empty", hidden);
  CHECK(file_text(given + "/given.db") == bytes);
  put(folder, "given/README.md", "changed");
  REQUIRE(dataset("motions", given, hidden).code == kDone);
  CHECK(file_text(given + "/given.db") == bytes);
  CHECK(file_text(given + "/README.md") == page);
  CHECK(file_text(given + "/notes.txt") == "what I saw");
}

TEST_CASE("neither part of a data set may lie in the other, whatever the folders are called", "[research]") {
  const Folder folder;
  const std::string out = folder / "out";
  fs::create_directories(out);
  fs::create_directory_symlink(out, folder / "link");
  const auto refused = [&](const std::string& given, const std::string& hidden, const std::string& why) {
    const Said said = say({"dataset", "segments", made().path("demos.db"), "--out", given, "--hidden", hidden});
    INFO(given << " " << hidden << "\n" << said.err);
    CHECK(said.code == kUsage);
    CHECK(says(said.err, why));
    CHECK(says(said.err, "side by side"));
  };
  refused(out, out + "/", "the same folder");
  refused(out, folder / "link", "the same folder");
  refused("not_there_yet", fs::absolute("not_there_yet").string(), "the same folder");
  refused(out, out + "/hidden", "--hidden " + out + "/hidden lies in --out");
  refused(out, folder / "link/deep/hidden", "lies in --out");
  refused(out + "/a/../given", out, "lies in --hidden " + out);
  CHECK(fs::is_empty(out));
  CHECK(say({"dataset", "segments", made().path("demos.db"), "--out", out, "--hidden", out + "_hidden"}).code == kDone);
}

TEST_CASE("a catalogue without successes serves no problem of demonstrations", "[research]") {
  const std::string failed = made().path("failed.db");
  say({"run", "stack_blocks", "--root", kRoot, "--out", failed, "--episodes", "4", "--seed", "700", "--behaviour",
       "random_applicable", "--skills", "1"});
  const Said said = made().dataset("segments", failed, "failed");
  CHECK(said.code == kBadInput);
  CHECK(says(said.err, "no episode of this catalogue succeeded"));
  CHECK(made().dataset("rewards", failed, "failed").code == kDone);
}

TEST_CASE("pictures: with their cameras, and none that tells where a skill begins", "[research]") {
  for (const auto& [which, file] : {std::pair{"keyframes", "some.db"}, {"all", "every.db"}}) {
    INFO(which);
    const std::string seen = made().path(file);
    REQUIRE(say({"run", "stack_blocks", "--root", kRoot, "--out", seen, "--episodes", "3", "--images", which,
                 "--camera", "front", "--size", "16x16"})
                .code == kDone);
    REQUIRE(made().dataset("segments_and_conditions", seen, file + std::string("_set")).code == kDone);
    const std::string folder = made().path(file + std::string("_set"));
    const PlainFile given = PlainFile::open(folder + "/given/given.db"),
                    hidden = PlainFile::open(folder + "/hidden/hidden.db");
    const Rows wrong = given.query(
        "SELECT count(*) AS n FROM images WHERE x IS NULL OR qw IS NULL OR focal_x IS NULL OR substr(data, 2, 3) <> "
        "CAST('PNG' AS BLOB)");
    CHECK(wrong.integer(0, "n") == 0);
    CHECK(says(file_text(folder + "/given/README.md"), "Pictures: yes"));
    const Rows frames = given.query("SELECT episode, frame FROM images GROUP BY 1, 2");
    const Rows whole = given.query("SELECT sum(frames) AS n FROM episodes");
    const bool every = std::string(which) == "all";
    CHECK((static_cast<std::int64_t>(frames.size()) == whole.integer(0, "n")) == every);
    CHECK(frames.size() > 6);
    std::size_t starts = 0;  // skills that begin where there is a picture
    const Rows skills = hidden.query("SELECT episode, first_frame FROM skills WHERE first_frame > 0");
    for (std::size_t i = 0; i < skills.size(); ++i)
      starts += given
                    .query("SELECT DISTINCT 1 FROM images WHERE episode = ?1 AND frame = ?2",
                           {skills.integer(i, "episode"), skills.integer(i, "first_frame")})
                    .size();
    CHECK((starts == skills.size()) == every);
  }
  CHECK(says(file_text(made().given("rewards") + "/README.md"), "Pictures: none (they are of catalogues"));
  CHECK(says(file_text(made().given("segments") + "/README.md"), "Pictures: not of this problem"));
}

TEST_CASE("the list of problems, for people and programs", "[research]") {
  const Said text = say({"dataset", "--list"}), json = say({"dataset", "--list", "--json"});
  CHECK(says(text.out, "transition_models"));
  const auto problems = nlohmann::json::parse(json.out);
  CHECK(problems.size() == all_problems().size());
  CHECK(nlohmann::json::parse(say({"baseline", "--list", "--json"}).out).size() == research::all_baselines().size());
}

}  // namespace stampede::program
