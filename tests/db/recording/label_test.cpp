#include <catch2/catch.hpp>
#include <ctime>

#include "db/recording/label_file.h"
#include "tests/support/lab.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

EpisodeRecord two_seconds() {
  EpisodeRecord e;
  e.real = true;
  e.physics_hz = 1'000'000, e.frame_hz = 20, e.steps = 2'000'000;
  e.frames.resize(41);
  e.scene.hands = {"panda.hand"};
  return e;
}

Labels labels_of(const std::string& text, const char* name = "labels.json") {
  const Lab lab;
  lab.write(name, text);
  return read_labels(lab.folder() / name, name, two_seconds());
}

}  // namespace

TEST_CASE("labels become segments in order, with parents, and sentences that name them") {
  const Labels labels = labels_of(R"({ "labelled_by": "model", "model": "tagger", "segments": [
      { "kind": "motion", "name": "move", "first_frame": 2, "end_frame": 10 },
      { "kind": "skill", "name": "pick", "arguments": ["cup"], "start_s": 0.1, "end_s": 1, "label": "take the cup" },
      { "kind": "subgoal", "name": "tidy", "start_s": 0, "end_s": 2, "outcome": "failure", "reason": "dropped" } ],
    "facts": [ { "fact": ["on", "cup", "table"], "start_s": 0, "end_s": 0.5 } ],
    "language": [ { "level": "motion", "segment": 0, "text": "reach out", "grain": "motions" } ] })");
  REQUIRE(labels.segments.size() == 3);
  CHECK((labels.segments[0].skill == "tidy" && labels.segments[0].parent == -1));
  CHECK((labels.segments[1].skill == "pick" && labels.segments[1].parent == 0));
  CHECK((labels.segments[2].skill == "move" && labels.segments[2].parent == 1));
  CHECK(labels.segments[0].span.end_frame == 41);  // the last frame belongs to what ends there
  CHECK((labels.segments[1].span.first_frame == 2 && labels.segments[1].span.end_frame == 20));
  CHECK(labels.segments[0].reason == Reason::dropped);
  CHECK(labels.segments[1].labelled_by == Labeller::model);
  CHECK((labels.facts.at(0).open_start && !labels.facts[0].open_end && labels.facts[0].end_step == 500'000));
  REQUIRE(labels.language.size() == 2);
  CHECK((labels.language[0].text == "take the cup" && labels.language[0].segment == 1));
  CHECK((labels.language[1].segment == 2 && labels.language[1].model == "tagger"));
  CHECK(labels.language[1].grain == LanguageGrain::motions);
}

TEST_CASE("what is put takes the place of its sort: sentences of the same level, and of segments that are gone") {
  EpisodeRecord e = two_seconds();
  const LanguageRecord task{LanguageLevel::task, "an old task"}, world{LanguageLevel::world, "an old world"},
      skill{LanguageLevel::skill, "an old skill", 0};
  e.labels.language = {task, world, skill};
  e.labels.segments.resize(1);
  e.labels.facts.resize(2);
  const LanguageRecord other{LanguageLevel::task, "another task"};
  put_labels({{}, {}, {other}}, e);
  CHECK(e.labels.language == std::vector{world, skill, other});
  CHECK((e.labels.segments.size() == 1 && e.labels.facts.size() == 2));
  SegmentRecord wave;
  wave.skill = "wave";
  put_labels({{wave}, {}, {}}, e);
  CHECK(e.labels.language == std::vector{world, other});
  CHECK(e.labels.segments.at(0).skill == "wave");
  put_labels({{}, std::vector<FactRecord>(3), {}}, e);
  CHECK(e.labels.facts.size() == 3);
}

TEST_CASE("what begins at the last frame has no time left") {
  const auto at = [](int first, int end) {
    return labels_of(
        "kind,name,first_frame,end_frame\nskill,wave," + std::to_string(first) + "," + std::to_string(end) + "\n",
        "labels.csv");
  };
  CHECK(at(39, 41).segments.at(0).span.end_frame == 41);
  CHECK_THROWS_WITH(at(40, 41), Contains("begins at the last frame") && Contains("a frame earlier"));
  CHECK_THROWS_WITH(at(5, 5), Contains("ends before it has begun"));
}

TEST_CASE("a CSV says the same") {
  const Labels labels = labels_of(
      "kind,name,arguments,start_s,end_s,outcome,text\nskill,pick,cup table,0.1,1,success,\"take it, gently\"\n"
      "fact,on,cup table,,,,\nlanguage,task,,,,,tidy up\nlanguage,skill,,0.1,1,,grasp\n",
      "labels.csv");
  CHECK(labels.segments.at(0).arguments == std::vector<std::string>{"cup", "table"});
  CHECK(labels.segments[0].label == "take it, gently");
  CHECK(labels.facts.at(0).end_frame == 41);
  REQUIRE(labels.language.size() == 3);
  CHECK(labels.language[2].segment == 0);
}

TEST_CASE("frames of a recording's own labels are those of its own rate, whatever the rate of the import") {
  const Lab lab;  // 20 Hz, 2 s
  lab.write("labels.json", R"({"segments": [
      {"kind": "skill", "name": "wave", "first_frame": 4, "end_frame": 20},
      {"kind": "skill", "name": "rest", "first_frame": 20, "end_frame": 41}],
    "facts": [{"fact": ["raised", "arm"], "first_frame": 10, "end_frame": 40}]})");
  lab.change([](auto& json) { json["labels"] = "labels.json"; });
  for (const int hz : {10, 20, 30, 40}) {
    const EpisodeRecord e = lab.import({hz, {}, 1});
    const auto frames = static_cast<std::int64_t>(e.frames.size());
    INFO(hz);
    REQUIRE(e.labels.segments.size() == 2);
    CHECK((e.labels.segments[0].span.first_frame == hz / 5 && e.labels.segments[0].span.end_frame == hz));
    CHECK(e.labels.segments[0].span.start_step == e.physics_hz / 5);
    CHECK((e.labels.segments[1].span.first_frame == hz && e.labels.segments[1].span.end_frame == frames));
    CHECK(e.labels.facts.at(0).start_step == e.physics_hz / 2);
    CHECK(e.labels.facts[0].end_step == e.steps);
  }
  lab.replace("labels.json", "\"end_frame\": 41", "\"end_frame\": 42");
  CHECK_THROWS_WITH(lab.import({40, {}, 1}), Contains("there is no frame 42: at 20 frames a second there are 41") &&
                                                 Contains("end_frame is 41 at most"));
}

TEST_CASE("bad labels are refused with their line") {
  const std::string head = "kind,name,arguments,start_s,end_s\n";
  const auto refuse = [&](const std::string& rows, const std::string& complaint) {
    INFO(rows);
    CHECK_THROWS_WITH(labels_of(head + rows, "labels.csv"), Contains("labels.csv:") && Contains(complaint));
  };
  refuse("skill,a,,0,1\nskill,b,,0.9,1.5\n", "overlaps the skill a");
  refuse("skill,a,,0,3\n", "ends after the episode");
  refuse("skill,a,,1,1\n", "ends before it has begun");
  refuse("skill,a,,-1,1\n", "begins before the first frame");
  refuse("skil,a,,0,1\n", "did you mean 'skill'?");
  refuse("skill,a,,0,\n", "given in part");
  refuse("skill,a,,,\n", "has no span");
  refuse("skill,a,,0,x\n", "no finite number");
  refuse("subgoal,g,,0,1\nskill,a,,0.5,1.5\n", "lies partly within the subgoal g");
  refuse("skill,a,,0,1\nmotion,m,,0.8,1\nskill,b,,0.9,1.5\n", "labels.csv:4: it overlaps the skill a");
  refuse("fact,on,a b,0,1\nfact,on,a b,0.5,2\n", "holds twice at once");
  refuse("fact,on,a b c d e,0,1\n", "4 arguments at most");
  refuse("skill,a,,0\n", "this row has 4 fields");
  CHECK_THROWS_WITH(labels_of(R"({"segments": [{"kind": "skill", "name": "a b", "start_s": 0, "end_s": 1}]})"),
                    Contains("segments[0]") && Contains("cannot be a name"));
  CHECK_THROWS_WITH(labels_of(R"({"language": [{"level": "skill", "segment": 4, "text": "x"}]})"),
                    Contains("is no skill"));
  CHECK_THROWS_WITH(labels_of(R"({"labelled_by": "simulator", "facts": [{"fact": ["on"]}]})"),
                    Contains("person or model"));
  CHECK_THROWS_WITH(labels_of(R"({"clock": "arm"})"), Contains("in seconds from frame 0"));
  for (const char* none : {"{}", R"({"segments": [], "facts": []})", R"({"labelled_by": "person"})"})
    CHECK_THROWS_WITH(labels_of(none), Contains("it holds no labels"));
  CHECK_THROWS_WITH(labels_of("{"), Contains("labels.json:1: this JSON ends too early"));
  CHECK_THROWS_WITH(labels_of("{\n, }"), Contains("labels.json:2: this is no JSON"));
}

TEST_CASE("labels that are no lists of labels are refused, never taken for none") {
  const auto refuse = [](const std::string& text, const std::string& place, const std::string& complaint) {
    INFO(text);
    CHECK_THROWS_WITH(labels_of(text), Contains(place) && Contains(complaint));
  };
  refuse("[]", "labels.json", "an object: { … }");
  refuse("3", "labels.json", "an object: { … }");
  refuse(R"({"segments": "x"})", "labels.json: segments", "a list: [ … ]");
  refuse(R"({"segments": {}})", "labels.json: segments", "a list: [ … ]");
  refuse(R"({"facts": null})", "labels.json: facts", "a list: [ … ]");
  refuse(R"({"language": 3})", "labels.json: language", "a list: [ … ]");
  refuse(R"({"segmnets": []})", "labels.json", "did you mean 'segments'?");
  refuse(R"({"segments": [[]]})", "labels.json: segments[0]", "an object: { … }");
  refuse(R"({"segments": [{"kind": "skill", "name": "a", "arguments": {"b": 1}, "start_s": 0, "end_s": 1}]})",
         "segments[0].arguments", "a list of texts");
  refuse(R"({"facts": [{"fact": {}}]})", "facts[0].fact", "a list of texts");
}

TEST_CASE("a labels file that was cut, is no UTF-8 or is nested a million deep is refused with its line") {
  CHECK_THROWS_WITH(labels_of("kind,name,start_s,end_s\nskill,a,0,1\nskill,b,1,1.2", "labels.csv"),
                    Contains("labels.csv:3: the file ends within this line"));
  CHECK_THROWS_WITH(labels_of("kind,name,start_s,end_s\nskill,\xe9,0,1\n", "labels.csv"),
                    Contains("labels.csv:2: the byte 0xE9"));
  CHECK_THROWS_WITH(labels_of("{\"segments\":" + std::string(1'000'000, '[')),
                    Contains("labels.json:1: brackets are 65 deep"));
}

namespace {

// Of reading so many labels, of all sorts, on the processor.
double seconds_of_labels(int count) {
  std::string rows = "kind,name,arguments,start_s,end_s,text\nsubgoal,all,,0,2,\n";
  for (int i = 0; i < count; ++i) {
    const std::string span = "," + std::to_string(1.9 / count * i) + "," + std::to_string(1.9 / count * (i + 1));
    rows += (i % 2 == 0 ? "skill,s," : "fact,f,a") + span + ",\n";
    if (i % 2 == 0) rows += "motion,m," + span + ",\nlanguage,skill," + span + ",do it\n";
  }
  const std::clock_t start = std::clock();
  const Labels labels = labels_of(rows, "labels.csv");
  const std::clock_t end = std::clock();
  const auto all = static_cast<std::size_t>(count);
  CHECK(labels.segments.size() == all + 1);
  CHECK(labels.facts.size() == all / 2);
  CHECK((labels.segments[1].parent == 0 && labels.segments[2].parent == 1));
  CHECK((labels.language.back().segment == count - 1 && labels.language.size() == all / 2));
  return static_cast<double>(end - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("a hundred thousand labels are read in the time of so many lines") {
  CHECK(seconds_of_labels(100'000) < 20 * seconds_of_labels(10'000));  // a hundred times as long, if each looked at all
}
