#include <catch2/catch.hpp>
#include <cmath>

#include "db/table_text.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;

namespace {

void check_segment(const SegmentRecord& a, const SegmentRecord& b) {
  CHECK(a.kind == b.kind);
  CHECK(a.ordinal == b.ordinal);
  CHECK(a.parent == b.parent);
  CHECK(a.robot == b.robot);
  CHECK(a.skill == b.skill);
  CHECK(a.case_name == b.case_name);
  CHECK(a.arguments == b.arguments);
  CHECK(a.controller == b.controller);
  CHECK(a.span.start_step == b.span.start_step);
  CHECK(a.span.end_step == b.span.end_step);
  CHECK(a.span.first_frame == b.span.first_frame);
  CHECK(a.span.end_frame == b.span.end_frame);
  CHECK(a.outcome == b.outcome);
  CHECK(a.reason == b.reason);
  CHECK(a.detail == b.detail);
  CHECK(a.precondition_held == b.precondition_held);
  CHECK(a.effect_held == b.effect_held);
  CHECK(a.preconditions == b.preconditions);
  CHECK(a.declared_effects == b.declared_effects);
  CHECK(a.forgotten == b.forgotten);
  CHECK(a.searched_for == b.searched_for);
  CHECK(a.missing_effects == b.missing_effects);
  CHECK(a.label == b.label);
  CHECK(a.labelled_by == b.labelled_by);
  REQUIRE(a.parameters.size() == b.parameters.size());
  for (std::size_t i = 0; i < a.parameters.size(); ++i) {
    const ParameterRecord &p = a.parameters[i], &q = b.parameters[i];
    CHECK(std::tie(p.name, p.values, p.text, p.unit, p.frame, p.chosen_by) ==
          std::tie(q.name, q.values, q.text, q.unit, q.frame, q.chosen_by));
  }
}

}  // namespace

TEST_CASE("an episode read back is the one that was stored, to the last bit") {
  const Folder folder;
  const EpisodeRecord a = sample_episode("lift", "colour=red", 7);
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  REQUIRE(catalogue.add(a, kEngine) == 1);
  catalogue.close();
  const EpisodeRecord b = Catalogue::open(folder / "a.db").read_episode(1);

  CHECK(
      std::tie(a.made.key, a.task, a.world, a.variation, a.axes, a.seed, a.made.split, a.outcome, a.reason, a.detail) ==
      std::tie(b.made.key, b.task, b.world, b.variation, b.axes, b.seed, b.made.split, b.outcome, b.reason, b.detail));
  CHECK(std::tie(a.made.options, a.physics_hz, a.frame_hz, a.steps, a.state_hash, a.made.draws, a.made.wall_s,
                 a.made.physics_wall_s) == std::tie(b.made.options, b.physics_hz, b.frame_hz, b.steps, b.state_hash,
                                                    b.made.draws, b.made.wall_s, b.made.physics_wall_s));
  CHECK(a.scene.document == b.scene.document);
  CHECK(std::tie(a.labels.verdicts, a.beside_goal) == std::tie(b.labels.verdicts, b.beside_goal));
  CHECK(std::tie(a.scene.posed, a.scene.hands, a.scene.predicates, a.labels.keyframes) ==
        std::tie(b.scene.posed, b.scene.hands, b.scene.predicates, b.labels.keyframes));
  REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    INFO("frame " << i);
    const FrameRecord &f = a.frames[i], &g = b.frames[i];
    CHECK(std::tie(f.step, f.reward, f.done, f.joint_position, f.joint_velocity, f.joint_effort, f.object_pose) ==
          std::tie(g.step, g.reward, g.done, g.joint_position, g.joint_velocity, g.joint_effort, g.object_pose));
    CHECK(f.camera_pose == g.camera_pose);
    REQUIRE(g.hands.size() == 1);
    CHECK(std::tie(f.hands[0].tip, f.hands[0].twist, f.hands[0].opening, f.hands[0].touch) ==
          std::tie(g.hands[0].tip, g.hands[0].twist, g.hands[0].opening, g.hands[0].touch));
    REQUIRE(f.action.has_value() == g.action.has_value());
    if (f.action)
      CHECK(std::tie(f.action->joint_position, f.action->tool_pose, f.action->gripper) ==
            std::tie(g.action->joint_position, g.action->tool_pose, g.action->gripper));
  }
  REQUIRE(a.commands.size() == b.commands.size());
  for (std::size_t i = 0; i < a.commands.size(); ++i) {
    CHECK(a.commands[i].step == b.commands[i].step);
    CHECK(operation_kind(a.commands[i].operation) == operation_kind(b.commands[i].operation));
    CHECK(operation_to_bytes(a.commands[i].operation) == operation_to_bytes(b.commands[i].operation));
    CHECK(robot_of(a.commands[i].operation) == robot_of(b.commands[i].operation));
  }
  REQUIRE(a.labels.segments.size() == b.labels.segments.size());
  for (std::size_t i = 0; i < a.labels.segments.size(); ++i) check_segment(a.labels.segments[i], b.labels.segments[i]);
  REQUIRE(b.labels.attempts.size() == 1);
  check_segment(a.labels.attempts[0].segment, b.labels.attempts[0].segment);
  CHECK(a.labels.attempts[0].before_segment == b.labels.attempts[0].before_segment);
  CHECK(a.labels.attempts[0].try_number == b.labels.attempts[0].try_number);
  CHECK(a.agent_actions == b.agent_actions);
  CHECK(std::signbit(b.agent_actions.at(0).asked.values.at(1)));
}

TEST_CASE("names, labels and documents come back too") {
  const Folder folder;
  const EpisodeRecord a = sample_episode("lift", "colour=red", 7);
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const EpisodeRecord b = catalogue.read_episode(catalogue.add(a, kEngine));
  REQUIRE(b.scene.objects.size() == a.scene.objects.size());
  for (std::size_t i = 0; i < a.scene.objects.size(); ++i) {
    const Object &o = a.scene.objects[i], &p = b.scene.objects[i];
    CHECK(std::tie(o.name, o.kind, o.class_name, o.type, o.traits, o.attributes, o.body, o.part, o.numbers) ==
          std::tie(p.name, p.kind, p.class_name, p.type, p.traits, p.attributes, p.body, p.part, p.numbers));
    CHECK(o.size == p.size);
  }
  REQUIRE(b.scene.joints.size() == a.scene.joints.size());
  for (std::size_t i = 0; i < a.scene.joints.size(); ++i) {
    const JointName &j = a.scene.joints[i], &k = b.scene.joints[i];
    CHECK(std::tie(j.name, j.part, j.kind, j.unit, j.lower, j.upper, j.driven) ==
          std::tie(k.name, k.part, k.kind, k.unit, k.lower, k.upper, k.driven));
  }
  REQUIRE(b.labels.observed_facts.size() == 1);
  CHECK(b.labels.observed_facts[0].fact == a.labels.observed_facts[0].fact);
  CHECK(b.labels.observed_facts[0].first_frame == 1);
  CHECK(b.labels.observed_facts[0].open_end);
  REQUIRE(b.labels.facts.size() == a.labels.facts.size());
  for (std::size_t i = 0; i < a.labels.facts.size(); ++i) {
    const FactRecord &f = a.labels.facts[i], &g = b.labels.facts[i];
    CHECK(std::tie(f.fact, f.start_step, f.end_step, f.first_frame, f.end_frame, f.open_start, f.open_end, f.observed,
                   f.margin) == std::tie(g.fact, g.start_step, g.end_step, g.first_frame, g.end_frame, g.open_start,
                                         g.open_end, g.observed, g.margin));
  }
  REQUIRE(b.labels.vias.size() == 1);
  CHECK(std::tie(a.labels.vias[0].segment, a.labels.vias[0].name, a.labels.vias[0].pose, a.labels.vias[0].passed,
                 a.labels.vias[0].step, a.labels.vias[0].speed) ==
        std::tie(b.labels.vias[0].segment, b.labels.vias[0].name, b.labels.vias[0].pose, b.labels.vias[0].passed,
                 b.labels.vias[0].step, b.labels.vias[0].speed));
  REQUIRE(b.labels.contacts.size() == 1);
  CHECK(std::tie(a.labels.contacts[0].object_b, a.labels.contacts[0].part_b, a.labels.contacts[0].end_frame,
                 a.labels.contacts[0].peak_force) ==
        std::tie(b.labels.contacts[0].object_b, b.labels.contacts[0].part_b, b.labels.contacts[0].end_frame,
                 b.labels.contacts[0].peak_force));
  REQUIRE(b.labels.grasps.size() == 1);
  CHECK(std::tie(a.labels.grasps[0].object, a.labels.grasps[0].object_from_tip, a.labels.grasps[0].width,
                 a.labels.grasps[0].held) == std::tie(b.labels.grasps[0].object, b.labels.grasps[0].object_from_tip,
                                                      b.labels.grasps[0].width, b.labels.grasps[0].held));
  REQUIRE(b.labels.language.size() == 2);
  CHECK(b.labels.language[0].segment == -1);
  CHECK(b.labels.language[1].segment == 0);
  CHECK(b.labels.language[1].text == a.labels.language[1].text);
  REQUIRE(b.labels.documents.size() == 2);
  CHECK(b.labels.documents[1].text == a.labels.documents[1].text);
  REQUIRE(b.made.definitions.size() == 2);
  CHECK(b.made.definitions[0].source == a.made.definitions[0].source);
  REQUIRE(b.channels.size() == 1);
  CHECK(b.channels[0].steps == a.channels[0].steps);
  CHECK(b.channels[0].values == a.channels[0].values);
  REQUIRE(b.scene.cameras.size() == 2);
  CHECK(b.scene.cameras[0].mount_from_camera.matrix() == a.scene.cameras[0].mount_from_camera.matrix());
  const Camera &c = a.scene.cameras[1], &d = b.scene.cameras[1];
  CHECK(std::tie(c.name, c.mount_body, c.mount_part, c.width, c.height, c.focal_x, c.focal_y, c.centre_x, c.centre_y,
                 c.distortion, c.near_m, c.far_m) == std::tie(d.name, d.mount_body, d.mount_part, d.width, d.height,
                                                              d.focal_x, d.focal_y, d.centre_x, d.centre_y,
                                                              d.distortion, d.near_m, d.far_m));
  CHECK(c.mount_from_camera.matrix() == d.mount_from_camera.matrix());  // exactly: it is drawn with
  REQUIRE(b.scene.masks.size() == a.scene.masks.size());
  for (std::size_t i = 0; i < a.scene.masks.size(); ++i) {
    const MaskEntry &m = a.scene.masks[i], &n = b.scene.masks[i];
    CHECK(std::tie(m.instance, m.name, m.object, m.class_name, m.semantic) ==
          std::tie(n.instance, n.name, n.object, n.class_name, n.semantic));
  }
}

TEST_CASE("what many scenes share is stored once") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  for (int seed = 0; seed < 5; ++seed) catalogue.add(sample_episode("lift", "colour=red", seed), kEngine);
  const auto count = [&](const std::string& table) {
    return std::get<std::int64_t>(catalogue.query("SELECT count(*) FROM " + table).rows[0][0]);
  };
  CHECK(count("scene") == 5);  // they differ in their seed
  CHECK(count("asset") == 1);  // the shapes
  CHECK(count("definition") == 2);
  CHECK(count("engine_run") == 1);
  CHECK(count("text_store") == 2);
}

TEST_CASE("a record that contradicts itself, or holds no number, leaves nothing behind") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const std::string empty = catalogue.content_hash();
  EpisodeRecord ragged = sample_episode("lift", "colour=red", 1);
  ragged.frames[3].joint_effort.pop_back();
  CHECK_THROWS_AS(catalogue.add(ragged, kEngine), Error);
  EpisodeRecord astray = sample_episode("lift", "colour=red", 1);
  astray.frames[11].joint_effort[0] = std::nan("");
  CHECK_THROWS_WITH(catalogue.add(astray, kEngine), Catch::Matchers::Contains("NaN"));
  CHECK(catalogue.episodes().empty());
  CHECK(catalogue.content_hash() == empty);
  CHECK(catalogue.add(sample_episode("lift", "colour=red", 1), kEngine) == 1);
}

TEST_CASE("a real episode comes back with what it does not know, and with who labelled it") {
  const Folder folder;
  EpisodeRecord a = real_episode();
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const EpisodeRecord b = catalogue.read_episode(catalogue.add(a, kEngine));
  CHECK((b.real && b.variation.empty() && b.state_hash.empty() && b.steps == a.steps));
  CHECK(std::isnan(b.frames[2].joint_position[0]));
  CHECK(b.frames[2].joint_position[1] == a.frames[2].joint_position[1]);
  CHECK(std::isnan(b.frames[0].reward));
  CHECK((std::isnan(b.frames[3].hands[0].tip.position[0]) && std::isnan(b.frames[3].hands[0].touch[1])));
  CHECK(std::isnan(b.channels.at(0).values.at(1)));
  CHECK(b.streams == a.streams);
  CHECK(b.image_times == a.image_times);
  CHECK(b.labels.segments[0].labelled_by == Labeller::person);
  CHECK(b.labels.facts[0].labelled_by == Labeller::model);
  CHECK(b.labels.language == a.labels.language);
  const auto row = catalogue.query("SELECT source, variation, seed, draws, state_hash FROM episodes").rows.at(0);
  CHECK(std::get<std::string>(row[0]) == "real");
  for (std::size_t i = 1; i < row.size(); ++i) CHECK(std::holds_alternative<std::monostate>(row[i]));
  CHECK(catalogue.query("SELECT * FROM streams").rows.size() == 1);
  CHECK(catalogue.query("SELECT * FROM hands WHERE x IS NULL").rows.size() == 1);
  CHECK(catalogue.query("SELECT * FROM instructions WHERE grain = 'goal' AND model = 'small' AND source = 'model'")
            .rows.size() == 1);
  const EpisodeArrays arrays = catalogue.read_arrays(1);
  for (const ArrayColumn& column : arrays.columns)
    if (column.name == "reward") CHECK(std::isnan(std::get<std::vector<double>>(column.data).at(0)));
}

TEST_CASE("what a simulated episode does not know is refused still") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  EpisodeRecord astray = sample_episode("lift", "colour=red", 7);
  astray.frames[3].hands[0].tip.position[0] = std::nan("");
  CHECK_THROWS_WITH(catalogue.add(astray, kEngine), Catch::Matchers::Contains("NaN"));
}

TEST_CASE("a margin that a predicate did not give comes back as not known, other sensors' gaps are refused") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  EpisodeRecord measured = sample_episode("lift", "colour=red", 7);
  measured.channels.push_back(measured.channels.at(0));
  ChannelRecord& margins = measured.channels.at(1);
  margins.name = "margins";
  margins.values.at(1) = std::nan("");
  const std::int64_t id = catalogue.add(measured, kEngine);
  const EpisodeRecord back = catalogue.read_episode(id);
  CHECK(std::isnan(back.channels.at(1).values.at(1)));
  CHECK(back.channels.at(1).values.at(2) == margins.values.at(2));
  CHECK(std::isnan(catalogue.read_arrays(id, {{"sensor/margins"}}).column("sensor/margins").reals()[1]));
  const QueryResult gaps = catalogue.query("SELECT sensor, sample, component FROM sensors WHERE value IS NULL");
  CHECK(to_csv(gaps) == "sensor,sample,component\nmargins,0,1\n");
  measured.channels.at(0).values.at(1) = std::nan("");
  measured.made.key = "another";
  CHECK_THROWS_WITH(catalogue.add(measured, kEngine), Catch::Matchers::Contains("NaN"));
}
