#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <thread>

#include "db/sqlite.h"
#include "db/table_text.h"
#include "engine/base/stopping.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

struct Filled {
  Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  Filled() { catalogue.add(sample_episode("lift", "colour=red", 1), kEngine); }
};

std::string only(const Catalogue& catalogue, const std::string& sql) {
  const QueryResult result = catalogue.query(sql);
  REQUIRE(result.rows.size() == 1);
  return std::get<std::string>(result.rows[0][0]);
}

}  // namespace

TEST_CASE("transitions compare what a segment declares with what became of the facts") {
  const Filled filled;
  const auto column = [&](const std::string& name) {
    return only(filled.catalogue, "SELECT " + name + " FROM transitions WHERE skill = 'pick'");
  };
  CHECK(column("before") == R"j(["(hand_empty)","(near block1 block2)","(on block1 table)","(on block2 table)"])j");
  CHECK(column("after") ==
        R"j(["(clear table)","(holding panda.hand block1)","(lifted block1)","(on block2 table)"])j");
  CHECK(column("added") == R"j(["(clear table)","(holding panda.hand block1)","(lifted block1)"])j");
  CHECK(column("removed") == R"j(["(hand_empty)","(near block1 block2)","(on block1 table)"])j");
  CHECK(column("declared") == R"j(["(holding panda.hand block1)","(not (on block1 table))","(open chest)"])j");
  CHECK(column("missing") == R"j(["(open chest)"])j");
  // near is forgotten and clear derived: neither counts.
  CHECK(column("undeclared") == R"j(["(not (hand_empty))","(lifted block1)"])j");
}

TEST_CASE("preconditions are told literal by literal, also of what was undone") {
  const Filled filled;
  const QueryResult rows = filled.catalogue.query(
      "SELECT undone, segment, skill, case_name, ordinal, choice, negated, predicate, arg1, literal, held FROM "
      "preconditions ORDER BY undone, segment, ordinal");
  CHECK(rows.rows.size() == 8);
  QueryResult kept = rows;
  kept.rows.resize(4);
  CHECK(to_csv(kept) ==
        "undone,segment,skill,case_name,ordinal,choice,negated,predicate,arg1,literal,held\n"
        "0,0,pick,off_surface,0,,0,hand_empty,,(hand_empty),1\n"
        "0,0,pick,off_surface,1,,1,on,block2,(not (on block2 block1)),1\n"
        "0,0,pick,off_surface,2,0,0,on,block1,(on block1 table),1\n"
        "0,0,pick,off_surface,3,0,0,on,block1,(on block1 shelf),0\n");
  CHECK(std::get<std::int64_t>(rows.rows.back()[0]) == 1);
}

TEST_CASE("what an agent asked for is told action by action") {
  const Filled filled;
  const auto told = [&](const std::string& columns) {
    return to_csv(filled.catalogue.query("SELECT " + columns + " FROM agent_actions ORDER BY ordinal"));
  };
  CHECK(told("frame, end_frame, space, gripper, reference, controller, most_frames, skill, segment") ==
        "frame,end_frame,space,gripper,reference,controller,most_frames,skill,segment\n"
        "0,1,joint_delta,0.04,,,0,,\n"
        "1,5,skill,,,joint_impedance,4,pick,\n"
        "1,2,tool_delta,,tool,,0,,0\n"
        "2,6,tool_path,,world,,0,,0\n"
        "5,8,go_on,,,,0,,\n"
        "8,8,gripper,,,,0,,\n");
  CHECK(told("time_s, reward, terminated, truncated") ==
        "time_s,reward,terminated,truncated\n0.0,0.25,0,0\n0.05,0.5,0,0\n0.05,,0,0\n0.1,,0,0\n0.25,1.0,1,0\n0.4,0.0,0,"
        "1\n");
  const auto value = [&](const std::string& what) { return only(filled.catalogue, "SELECT " + what); };
  CHECK(value("numbers FROM agent_actions WHERE ordinal = 0") == "[0.3333333333333333,-0]");
  CHECK(value("numbers FROM agent_actions WHERE ordinal = 4") == "[]");
  CHECK(value("arguments ->> 1 FROM agent_actions WHERE space = 'skill'") == "table");
  CHECK(value("parameters -> 'height' FROM agent_actions WHERE space = 'skill'") == "[0.1]");
}

TEST_CASE("wide rows are told value by value, in as many rows as there are of them") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  SampleSize size;
  size.joints = 30;  // three rows a frame
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1, size);
  for (FrameRecord& frame : episode.frames)
    if (frame.action) frame.action->joint_position.assign(20, frame.action->gripper + 1);  // two rows
  episode.channels[0].components.resize(19, "more");
  episode.channels[0].values.clear();
  for (int i = 0; i < 38; ++i) episode.channels[0].values.push_back(i);
  const EpisodeRecord back = catalogue.read_episode(catalogue.add(episode, kEngine));
  CHECK(back.frames[3].joint_position == episode.frames[3].joint_position);
  CHECK(back.frames[3].joint_effort == episode.frames[3].joint_effort);
  CHECK(back.frames[3].action->joint_position == episode.frames[3].action->joint_position);
  CHECK(back.frames[3].action->tool_pose == episode.frames[3].action->tool_pose);
  CHECK(back.channels[0].values == episode.channels[0].values);
  const auto number = [&](const std::string& sql) { return std::get<double>(catalogue.query(sql).rows.at(0)[0]); };
  for (const int joint : {0, 11, 12, 29}) {
    INFO(joint);
    const auto index = static_cast<std::size_t>(joint);
    const std::string of = " FROM joints WHERE frame = 3 AND joint = '" + episode.scene.joints[index].name + "'";
    CHECK(number("SELECT position" + of) == episode.frames[3].joint_position[index]);
    CHECK(number("SELECT velocity" + of) == episode.frames[3].joint_velocity[index]);
  }
  CHECK(number("SELECT value FROM actions WHERE frame = 3 AND space = 'joint_position' AND component = 17") ==
        episode.frames[3].action->joint_position[17]);
  CHECK(number("SELECT value FROM actions WHERE frame = 3 AND space = 'tool_pose' AND component = 6") ==
        episode.frames[3].action->tool_pose.quaternion[3]);
  CHECK(number("SELECT value FROM sensors WHERE sample = 1 AND component = 17") == 19 + 17);
  CHECK(catalogue.query("SELECT * FROM joints").rows.size() == 30 * episode.frames.size());
  CHECK(catalogue.query("SELECT * FROM actions").rows.size() == 28 * (episode.frames.size() - 1));
  CHECK(catalogue.query("SELECT * FROM sensors").rows.size() == 38);
  CHECK(catalogue.query("SELECT DISTINCT name FROM sensors").rows.size() == 3);
}

TEST_CASE("dense views carry the last pose forward") {
  const Filled filled;
  const auto count = [&](const std::string& sql) {
    return std::get<std::int64_t>(filled.catalogue.query(sql).rows[0][0]);
  };
  CHECK(count("SELECT count(*) FROM object_state") == 12 + 1);  // one moves, one rests
  CHECK(count("SELECT count(*) FROM poses") == 2 * 12);
  CHECK(count("SELECT count(DISTINCT x) FROM poses WHERE object = 'block2'") == 1);
  CHECK(count("SELECT sum(changed) FROM poses") == 13);
  CHECK(count("SELECT count(*) FROM camera_pose") == 2 + 12);  // front moves once, wrist at every frame
  CHECK(count("SELECT count(*) FROM camera_poses") == 2 * 12);
  CHECK(count("SELECT count(*) FROM frames WHERE skill = 'pick'") == 6);
  CHECK(count("SELECT count(*) FROM tries WHERE skill = 'pick'") == 2);
  CHECK(count("SELECT try_number FROM tries WHERE skill = 'pick' AND NOT undone") == 2);
  CHECK(count("SELECT steps FROM plans") == 2);
}

TEST_CASE("one failure is one row of `failures`: of the goal, of a skill, of a start") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const auto fail = [](SegmentRecord& segment, Reason reason) {
    segment.outcome = Outcome::failure, segment.reason = reason;
  };
  EpisodeRecord goal = sample_episode("lift", "colour=red", 1);
  goal.labels.attempts.clear();
  SegmentRecord& hold = goal.labels.segments.back();
  hold.kind = SegmentKind::motion, hold.skill = "hold";
  fail(hold, Reason::goal_false);
  SegmentRecord subgoal = hold;
  subgoal.kind = SegmentKind::subgoal, subgoal.skill = "goal", subgoal.ordinal = 3;
  goal.labels.segments.push_back(subgoal);
  EpisodeRecord skill = goal;
  skill.made.key = "skill", skill.seed = 2;
  fail(skill.labels.segments[0], Reason::grasp_missed);
  fail(skill.labels.segments[1], Reason::grasp_missed);  // the motion in which it happened
  skill.labels.segments[2].outcome = Outcome::success, skill.labels.segments[2].reason = Reason::none;
  fail(skill.labels.segments[3], Reason::grasp_missed);
  EpisodeRecord start = sample_episode("lift", "colour=red", 3);
  start.labels.attempts.clear();
  int number = 0;
  for (auto [episode, reason] : {std::pair(&goal, Reason::goal_false), std::pair(&skill, Reason::grasp_missed),
                                 std::pair(&start, Reason::init_impossible)}) {
    episode->outcome = Outcome::failure, episode->reason = reason;
    CHECK(catalogue.add(*episode, kEngine) == ++number);
  }
  CHECK(to_csv(catalogue.query("SELECT episode, level, skill, reason FROM failures ORDER BY episode")) ==
        "episode,level,skill,reason\n1,episode,hold,goal_false\n2,episode,pick,grasp_missed\n"
        "3,episode,,init_impossible\n");
}

TEST_CASE("every named query runs and describes itself") {
  const Filled filled;
  CHECK(named_queries().size() >= 10);
  for (const NamedQuery& query : named_queries()) {
    INFO(query.name);
    CHECK(query.sql.starts_with("-- "));
    CHECK(query.description.ends_with("."));
    CHECK_NOTHROW(filled.catalogue.query(query.name));
  }
  CHECK(find_named_query("nonsense") == nullptr);
  CHECK_THROWS_WITH(filled.catalogue.query("nonsense"), Contains("failures_by_reason"));
}

TEST_CASE("named queries answer what they promise") {
  const Filled filled;  // one episode: a pick that was undone once, then succeeded, and a wait
  CHECK(to_csv(filled.catalogue.query("failures_by_reason")) ==
        "level,kind,skill,reason,failures,undone\ntry,skill,pick,grasp_missed,1,1\n");
  CHECK(to_csv(filled.catalogue.query("success_by_task")) ==
        "task,split,episodes,successes,success_rate\nlift,train,1,1,1.0\n");
  CHECK_THAT(to_csv(filled.catalogue.query("first_try_success")), Contains("pick,off_surface,1,0.0,2,0.5\n"));
  CHECK_THAT(to_csv(filled.catalogue.query("effects_by_skill")), Contains("pick,off_surface,1,1,1,1.0\n"));
  CHECK_THAT(to_csv(filled.catalogue.query("undeclared_changes")), Contains("pick,off_surface,(lifted block1),1,1\n"));
  CHECK_THAT(to_csv(filled.catalogue.query("missing_effects")),
             Contains("pick,off_surface,success,(open chest),1,1\n"));
  CHECK_THAT(to_csv(filled.catalogue.query("longest_facts")), Contains("(on block2 table),1,lift,0.0,0.55,0.55,1\n"));
  CHECK_THAT(to_csv(filled.catalogue.query("slowest_segments")), Contains("0.3,joint_impedance\n"));
  CHECK(filled.catalogue.query("red_picks").rows.size() == 1);
  CHECK_THAT(to_csv(filled.catalogue.query("via_speeds")), Contains("pick,approach,1,0.7,0.7\n"));
  CHECK(to_csv(filled.catalogue.query("hardest_contacts")).find("12.5") != std::string::npos);
  // The via is passed in frame 1 and 18/240 s; keyframe 0 is within one frame.
  CHECK(filled.catalogue.query("keyframes_without_vias").rows.empty());
}

TEST_CASE("SQL knows median, percentile, standard deviation and regular expressions") {
  const Filled filled;
  const auto number = [&](const std::string& what, const std::string& values) {
    const QueryResult rows =
        filled.catalogue.query("WITH v(x) AS (VALUES " + values + ") SELECT 1.0 * " + what + " AS y FROM v");
    return rows.is_null(0, "y") ? -1 : rows.real(0, "y");
  };
  CHECK(number("median(x)", "(3), (1), (2)") == 2);
  CHECK(number("median(x)", "(4), (1), (NULL), (2), (3.5)") == 2.75);
  CHECK(number("median(x)", "(7)") == 7);
  CHECK(number("median(x)", "(NULL)") == -1);
  CHECK(number("percentile(x, 0)", "(5), (1), (3)") == 1);
  CHECK(number("percentile(x, 100)", "(5), (1), (3)") == 5);
  CHECK(number("percentile(x, 90)", "(0), (10), (20), (30)") == Approx(27));
  CHECK(number("stddev(x)", "(2), (4), (4), (4), (5), (5), (7), (9)") == Approx(std::sqrt(32.0 / 7)));
  CHECK(number("stddev_pop(x)", "(2), (4), (4), (4), (5), (5), (7), (9)") == Approx(2));
  CHECK(number("stddev(x)", "(2)") == -1);
  CHECK(number("stddev_pop(x)", "(2)") == 0);
  CHECK(to_csv(filled.catalogue.query("SELECT group_concat(m) FROM (WITH v(x) AS (VALUES (1), (9), (2), (8)) SELECT "
                                      "median(x) OVER (ROWS 1 PRECEDING) AS m FROM v)")) ==
        "group_concat(m)\n\"1.0,5.0,5.5,5.0\"\n");
  CHECK(only(filled.catalogue,
             "SELECT group_concat(fact, ' ') FROM (SELECT DISTINCT fact FROM facts WHERE fact REGEXP "
             "'^\\(on block[0-9] table\\)$' ORDER BY fact)") == "(on block1 table) (on block2 table)");
  CHECK(number("sum(x REGEXP 'a.c')", "('abc'), ('xaxcx'), ('ac'), (NULL)") == 2);
  for (const std::string wrong : {"SELECT median('a')", "SELECT percentile(1, 101)", "SELECT percentile(1, NULL)",
                                  "SELECT percentile(x, x) FROM (SELECT 1 AS x UNION SELECT 2)",
                                  "SELECT 'a' REGEXP '('", "SELECT stddev(x'00')"}) {
    INFO(wrong);
    CHECK_THROWS_AS(filled.catalogue.query(wrong), Error);
  }
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT 'a' REGEXP '('"),
                    Contains("regexp: (: ") && !Contains(std::string(1, '\0')));
}

TEST_CASE("text of a file is shown cut between letters, and without what a terminal would obey") {
  CHECK(sql::shown("plain") == "plain");
  CHECK(sql::shown("a\nb\x1b[2J\x7f"
                   "c\xc2\x9b"
                   "d\xc3\xa9") == "a b [2J c d\xc3\xa9");
  const std::string cut = " \xe2\x80\xa6";
  CHECK(sql::shown(std::string(200, 'a')) == std::string(200, 'a'));
  CHECK(sql::shown(std::string(201, 'a')) == std::string(200, 'a') + cut);
  CHECK(sql::shown(std::string(199, 'a') + "\xc3\xa9") == std::string(199, 'a') + cut);
  CHECK(sql::shown(std::string(198, 'a') + "\xc3\xa9 b") == std::string(198, 'a') + "\xc3\xa9" + cut);
  CHECK(sql::shown(std::string(300, '\x80')) == cut);
}

TEST_CASE("progress and applicable skills of each frame are tables, and say what arrays say") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  for (const int seed : {1, 2}) {
    EpisodeRecord episode = sample_episode("lift", "colour=red", seed);
    episode.labels.documents = {
        {DocumentKind::pddl_domain,
         "(define (domain d) (:requirements :typing) (:types thing)\n(:predicates (hand_empty) (on ?a - "
         "thing ?b - thing))\n(:action pick :parameters (?a - thing) :precondition (and (hand_empty) (on "
         "?a table)) :effect (not (hand_empty)))\n(:constants table - thing))"},
        {DocumentKind::pddl_problem,
         "(define (problem p) (:domain d) (:objects block1 block2 - thing) (:init (hand_empty))\n(:goal "
         "(and (on block2 table) (hand_empty))))"}};
    catalogue.add(episode, kEngine);
  }
  const EpisodeArrays arrays = catalogue.read_arrays(2, {{"progress", "applicable"}});
  const auto shares = arrays.column("progress").reals();
  const QueryResult progress = catalogue.query("SELECT * FROM progress WHERE episode = 2 ORDER BY frame");
  CHECK(progress.columns == std::vector<std::string>{"episode", "task", "frame", "time_s", "progress"});
  REQUIRE(progress.size() == shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) CHECK(progress.real(i, "progress") == shares[i]);
  CHECK(std::set<double>(shares.begin(), shares.end()) == std::set<double>{0.5, 1});
  CHECK(progress.text(3, "task") == "lift");
  CHECK(progress.real(3, "time_s") == Approx(0.15));
  const auto values = arrays.column("applicable").booleans();
  const QueryResult able = catalogue.query("SELECT frame, skill, arguments FROM applicable WHERE episode = 2");
  CHECK(able.size() == static_cast<std::size_t>(std::count(values.begin(), values.end(), 1)));
  REQUIRE(able.size() > 0);
  CHECK(able.text(0, "skill") == "pick");
  CHECK_THAT(able.text(0, "arguments"), Contains("\"block"));
  const auto count = [&](const std::string& sql) { return catalogue.query(sql).integer(0, "n"); };
  CHECK(count("SELECT count(*) AS n FROM progress") == 2 * arrays.frames);
  CHECK(count("SELECT count(*) AS n FROM episodes JOIN applicable USING (episode) WHERE seed = 1") ==
        static_cast<std::int64_t>(able.size()));
  CHECK(count("SELECT count(*) AS n FROM progress WHERE episode = 9") == 0);
  CHECK_THROWS_AS(catalogue.query("CREATE VIRTUAL TABLE temp.x USING progress"), Error);
  CHECK_THROWS_AS(catalogue.query("DELETE FROM progress"), Error);
}

TEST_CASE("two columns of one name are two in every form of an answer") {
  const Filled filled;
  const QueryResult rows = filled.catalogue.query(
      "SELECT a.episode, b.episode, a.seed + 1 AS episode_2, a.episode FROM episodes a JOIN episodes b USING (task)");
  CHECK(rows.columns == std::vector<std::string>{"episode", "episode_3", "episode_2", "episode_4"});
  CHECK(to_json(rows) == "[\n {\"episode\": 1, \"episode_3\": 1, \"episode_2\": 2, \"episode_4\": 1}\n]\n");
  CHECK(filled.catalogue.query("SELECT 1 AS a, 2 AS a").columns == std::vector<std::string>{"a", "a_2"});
}

TEST_CASE("a sensor's unit is that of each component") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  const std::vector<std::string> six = {"force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"};
  episode.channels = {{"wrench", "N, N m", six, 120, {0}, {1, 2, 3, 4, 5, 6}},
                      {"odd", "a, \"b\"", {"u", "v", "w"}, 120, {0}, {1, 2, 3}},
                      {"pair", "\"b\", c", {"u", "v"}, 120, {0}, {1, 2}}};
  catalogue.add(episode, kEngine);
  const auto units = [&](const std::string& sensor) {
    return to_csv(catalogue.query("SELECT name, unit FROM sensors WHERE sensor = '" + sensor + "' ORDER BY component"));
  };
  CHECK(units("wrench") == "name,unit\nforce_x,N\nforce_y,N\nforce_z,N\ntorque_x,N m\ntorque_y,N m\ntorque_z,N m\n");
  CHECK(units("odd") == "name,unit\nu,\"a, \"\"b\"\"\"\nv,\"a, \"\"b\"\"\"\nw,\"a, \"\"b\"\"\"\n");
  CHECK(units("pair") == "name,unit\nu,\"\"\"b\"\"\"\nv,c\n");
}

TEST_CASE("a grasp says whence the hand came, in the object's frame and in the world's") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  EpisodeRecord episode = sample_episode("lift", "colour=red", 1);
  const double half = std::sqrt(0.5);
  episode.labels.grasps[0].object_from_tip.quaternion = {1, 0, 0, 0};  // z of the tip is down
  for (FrameRecord& frame : episode.frames) frame.hands.at(0).tip.quaternion = {0, half, 0, half};  // along x
  catalogue.add(episode, kEngine);
  const QueryResult rows = catalogue.query("SELECT * FROM grasps");
  const auto direction = [&](const std::string& head) {
    return std::vector<double>{rows.real(0, head + "_x"), rows.real(0, head + "_y"), rows.real(0, head + "_z")};
  };
  CHECK(direction("approach") == std::vector<double>{0, 0, -1});
  CHECK(direction("world_approach")[0] == Approx(1));
  CHECK(direction("world_approach")[1] == Approx(0));
  CHECK(direction("world_approach")[2] == Approx(0).margin(1e-12));
}

TEST_CASE("a query cannot write") {
  const Filled filled;
  const std::string before = filled.catalogue.content_hash();
  for (const char* text :
       {"DELETE FROM episode", "DROP VIEW demos", "PRAGMA user_version = 9", "PRAGMA journal_mode = DELETE",
        "ATTACH 'x.db' AS x", "INSERT INTO split VALUES ('train', NULL, NULL, 1, 2)", "CREATE TEMP TABLE t (a)",
        "SELECT 1; DELETE FROM timing", "BEGIN", "VACUUM INTO 'y.db'", "SELECT load_extension('x')",
        "WITH a AS (SELECT 1) UPDATE episode SET seed = 3", "REINDEX", "ANALYZE", "SAVEPOINT a",
        "UPDATE sqlite_master SET sql = ''"}) {
    INFO(text);
    CHECK_THROWS_AS(filled.catalogue.query(text), Error);
  }
  CHECK(filled.catalogue.content_hash() == before);
  CHECK(filled.catalogue.episodes().size() == 1);
}

TEST_CASE("one statement is a question, whatever blanks and semicolons follow it") {
  const Filled filled;
  for (const std::string end : {"", ";", " ; \n", ";;", "\t"})
    CHECK(std::get<std::int64_t>(filled.catalogue.query("SELECT 7" + end).rows.at(0)[0]) == 7);
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT 7; SELECT 8"), Contains("one"));
}

TEST_CASE("a query may ask what columns there are") {
  const Filled filled;
  CHECK(filled.catalogue.query("SELECT name FROM pragma_table_info('demos')").rows.size() > 10);
}

TEST_CASE("mistakes in SQL are told with what there is") {
  const Filled filled;
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT * FROM episods"),
                    Contains("no such table") && Contains("did you mean 'episode'?") && Contains("transitions"));
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT sed FROM episodes"),
                    Contains("no such column") && Contains("episodes has") && Contains(" seed"));
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT 1; SELECT 2"), Contains("more than one"));
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT 1; SELECT * FROM episods"), Contains("did you mean 'episode'?"));
  CHECK_THROWS_AS(filled.catalogue.query("-- nothing"), Error);
  CHECK_NOTHROW(filled.catalogue.query("SELECT 1; -- and a comment"));
  CHECK_THROWS_WITH(filled.catalogue.query("SELECT ?1"), Contains("takes 1 parameter"));
  CHECK(std::get<std::int64_t>(filled.catalogue.query("SELECT ?1 + 1", {{std::int64_t{4}}, 0}).rows[0][0]) == 5);
}

TEST_CASE("answers are bounded and can be interrupted") {
  const Filled filled;
  const char* endless = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i FROM n";
  const QueryResult few = filled.catalogue.query(endless, {{}, 3});
  CHECK(few.rows.size() == 3);
  CHECK(few.cut);
  std::atomic<bool> done = false;
  std::thread other([&] {
    while (!done) {
      filled.catalogue.interrupt();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  CHECK_THROWS_WITH(filled.catalogue.query(std::string("SELECT sum(i) FROM (") + endless + ")"),
                    Contains("interrupted"));
  done = true;
  other.join();
  const std::atomic<bool> stop = true;
  const StopScope scope(&stop);
  CHECK_THROWS_AS(filled.catalogue.query(std::string("SELECT sum(i) FROM (") + endless + ")"), Interrupted);
}

TEST_CASE("answers as table, CSV and JSON") {
  QueryResult result;
  result.columns = {"name", "n", "x"};
  result.rows = {{std::string("a,\"b\"\nc"), std::int64_t{10}, 0.1},
                 {std::monostate{}, std::int64_t{-1}, 2.0},
                 {std::string(), std::monostate{}, SqlBlob{std::string("\x01\xff", 2)}},
                 {std::string("größe\x80"), std::int64_t{3}, INFINITY}};
  CHECK(to_csv(result) == "name,n,x\n\"a,\"\"b\"\"\nc\",10,0.1\n,-1,2.0\n\"\",,01ff\ngröße\x80,3,Infinity\n");
  CHECK(to_json(result) ==
        "[\n {\"name\": \"a,\\\"b\\\"\\nc\", \"n\": 10, \"x\": 0.1},\n {\"name\": null, \"n\": -1, \"x\": 2.0},\n"
        " {\"name\": \"\", \"n\": null, \"x\": \"01ff\"},\n {\"name\": \"größe\\ufffd\", \"n\": 3, \"x\": "
        "\"Infinity\"}\n]\n");
  QueryResult small;
  small.columns = {"skill", "n"};
  small.rows = {{std::string("öffnen"), std::int64_t{5}},
                {std::string("a\tb"), std::int64_t{123}},
                {std::monostate{}, std::monostate{}},
                {std::string(), std::int64_t{0}},
                {std::string("NULL"), std::int64_t{0}}};
  small.cut = true;
  CHECK(to_table(small) ==
        "skill      n\n------  ----\nöffnen     5\na\\tb     123\nNULL    NULL\n           0\n'NULL'     0\n… and more "
        "rows\n");
  CHECK(to_json({{"a"}, {}, false}) == "[]\n");
}
