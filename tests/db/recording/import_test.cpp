#include <catch2/catch.hpp>
#include <cmath>

#include "db/catalogue.h"
#include "db/recording/export_recording.h"
#include "db/stored_episode.h"
#include "engine/base/base64.h"
#include "engine/model/kinematics.h"
#include "engine/record/observation.h"
#include "engine/render/png.h"
#include "tests/support/lab.h"

using namespace stampede;
using namespace stampede::test;

namespace {
const EngineInfo kEngine{"test", "test"};
}

TEST_CASE("a recording becomes frames at a strict rate, with the kinematics of its robot") {
  const Lab lab;
  const EpisodeRecord e = lab.import();
  REQUIRE(e.real);
  REQUIRE(e.frames.size() == 41);  // 2 s at 20 Hz
  CHECK(e.physics_hz == 1'000'000);
  const StoredEpisode stored = stored_of(e);
  REQUIRE(stored.scene);
  const Arm arm(stored.scene->robot);
  for (std::size_t i = 0; i < e.frames.size(); ++i) {
    const FrameRecord& frame = e.frames[i];
    CHECK(frame.step == static_cast<std::int64_t>(i) * 50'000);
    const double t = 0.05 * static_cast<double>(i);
    JointVector q(7);
    for (int j = 0; j < 7; ++j) {
      CHECK(frame.joint_position[static_cast<std::size_t>(j)] == Approx(swing(t, j)).margin(1e-5));
      q[j] = frame.joint_position[static_cast<std::size_t>(j)];
    }
    CHECK(frame.joint_velocity[0] == Approx(0.4 * std::cos(2 * t)).margin(0.02));
    CHECK(std::isnan(frame.joint_effort[0]));  // nobody recorded it
    CHECK(frame.hands.at(0).tip == to_pose(arm.world_from_tip(q)));
    CHECK(std::isnan(frame.hands[0].touch[0]));
    CHECK(frame.joint_position[7] == Approx(frame.hands[0].opening / 2));
    CHECK(frame.camera_pose.size() == 2);
    CHECK(frame.action.has_value() == (i + 1 < e.frames.size()));
  }
  CHECK(e.frames[0].hands[0].opening == Approx(0.08));
  CHECK(e.frames[40].hands[0].opening == Approx(0.02));
  CHECK(e.frames[20].camera_pose[0] == e.frames[0].camera_pose[0]);        // front
  CHECK_FALSE(e.frames[20].camera_pose[1] == e.frames[0].camera_pose[1]);  // wrist
  CHECK(e.made.options.at("velocities") == "differences");
  CHECK(e.made.options.at("actions") == "measured");
  CHECK_FALSE(e.labels.keyframes.at("stopped").empty());
}

TEST_CASE("gaps are NULL, and offsets move streams against each other") {
  const Lab lab;
  std::string text = lab.read("joints.csv");
  const std::size_t from = text.find("\n100.5"), to = text.find("\n100.8");
  lab.write("joints.csv", text.erase(from, to - from));
  lab.change([](auto& json) {
    json["clocks"]["hand"] = {{"offset_s", 0.5}};
    json["streams"][1]["clock"] = "hand";
  });
  const EpisodeRecord e = lab.import();
  CHECK(std::isnan(e.frames[12].joint_position[0]));
  CHECK(std::isnan(e.frames[12].hands[0].tip.position[0]));
  CHECK(e.frames[12].camera_pose.empty());
  CHECK_FALSE(std::isnan(e.frames[17].joint_position[0]));
  CHECK(e.streams.at(0).missing == 6);
  CHECK(e.streams.at(0).longest_gap_s == Approx(0.31).margin(0.02));
  CHECK(std::isnan(e.frames[5].hands[0].opening));  // the hand's clock begins half a second later
  CHECK(e.streams.at(1).missing == 10);
  const StoredEpisode stored = stored_of(e);
  CHECK_NOTHROW(state_at(*stored.scene, e, 12));
}

TEST_CASE("a drift counts from the first stamp of its clock where no other is given") {
  const Lab lab;
  constexpr double kUnix = 1'695'000'000;
  std::string gripper = "time_s,opening_m\n";
  for (int row = 0; row <= 50; ++row)
    gripper += std::to_string(kUnix + 0.5 + row * 0.02) + (row < 25 ? ",0.08\n" : ",0.02\n");
  lab.write("gripper.csv", gripper);
  lab.write("pull.csv", "time_s,pull_n\n1695000000,1\n1695000001,2\n");
  lab.change([](auto& json) {
    json["clocks"]["hand"] = {{"offset_s", 100 - kUnix}, {"drift_ppm", 10'000}};
    json["streams"][1]["clock"] = "hand";
    json["streams"].push_back(
        {{"kind", "channel"}, {"name", "pull"}, {"unit", "n"}, {"file", "pull.csv"}, {"clock", "hand"}});
  });
  const EpisodeRecord e = lab.import();
  CHECK(e.streams.at(1).reference_s == kUnix);  // the channel's, which began first
  CHECK(e.streams.at(2).reference_s == kUnix);
  CHECK(e.channels.at(0).steps == std::vector<std::int64_t>{0, 1'010'000});
  CHECK(std::isnan(e.frames[10].hands[0].opening));
  CHECK(e.frames[11].hands[0].opening == Approx(0.08));
  lab.change([](auto& json) { json["clocks"]["hand"]["reference_s"] = kUnix + 100; });
  CHECK(lab.import().channels.at(0).steps.size() == 1);  // a second earlier: the first reading is before frame 0
}

TEST_CASE("pictures are kept byte by byte, with the time at which they were taken") {
  const Lab lab;
  lab.add_pictures("front", 30, 100.01, 15);
  const EpisodeRecord e = lab.import();
  REQUIRE(e.images);
  CHECK(e.streams.back().rule == "nearest");
  CHECK(e.streams.back().readings == 30);
  CHECK(static_cast<std::int64_t>(e.images->count()) == 41 - e.streams.back().missing);
  CHECK(e.image_times.at(0).time_s == Approx(0.01).margin(1e-5));
  const std::string first = lab.read("front/0.png");
  CHECK(std::string(reinterpret_cast<const char*>(e.images->read(0).data()), e.images->read(0).size()) == first);
  Catalogue catalogue = Catalogue::write(lab.folder() / "real.db");
  CHECK(catalogue.add_if_new(e, kEngine) == 1);
  CHECK_FALSE(catalogue.add_if_new(lab.import(ImportOptions{{}, {}, 1}), kEngine));  // the same recording, the same key
  const auto rows = catalogue.query("SELECT encoding, taken_s, time_s FROM images ORDER BY frame LIMIT 1").rows;
  CHECK(std::get<std::string>(rows.at(0)[0]) == "png");
  CHECK(std::get<double>(rows[0][1]) == Approx(0.01).margin(1e-5));
}

TEST_CASE("a recording is stored with the key that it has alone, whichever of its streams come first") {
  const Lab lab;
  lab.add_pictures("front", 30, 100.01, 15);
  lab.write("pull.csv", "time_s,pull_n\n100.5,1\n101,2\n");
  lab.change([](auto& json) {
    json["streams"].push_back({{"kind", "channel"}, {"name", "pull"}, {"unit", "n"}, {"file", "pull.csv"}});
  });
  lab.add_pictures("wrist", 30, 100.02, 15);
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db", Journal::in_place);
  const StoredRecording first = store_recording(lab.folder(), panda_stager(), {}, catalogue, kEngine);
  CHECK(first.added);
  CHECK(first.id == 1);
  CHECK(first.episode.made.key == lab.import().made.key);
  CHECK(catalogue.find(first.episode.made.key) == 1);
  const StoredRecording again = store_recording(lab.folder(), panda_stager(), {}, catalogue, kEngine);
  CHECK_FALSE(again.added);
  CHECK(again.id == 1);
  lab.replace("pull.csv", "101,2", "101,3");
  const StoredRecording other = store_recording(lab.folder(), panda_stager(), {{}, {}, 1}, catalogue, kEngine);
  CHECK(other.added);
  CHECK(other.id == 2);
  CHECK(other.episode.made.key == lab.import().made.key);
  for (const int workers : {1, 3}) {
    Catalogue one = Catalogue::write(lab.folder() / (std::to_string(workers) + ".db"));
    store_recording(lab.folder(), panda_stager(), {{}, {}, workers}, one, kEngine);
    CHECK(one.episode_hash(1) == catalogue.episode_hash(2));
  }
}

namespace {

// 16 by 8: three channels, one after the other or in passes, and one channel.
const std::string kJpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAKBueIx4ZKCMgoy0qqC+8P//8Nzc8P////////////////////////////////////////////////"
    "//////////2wBDAaq0tPDS8P//////////////////////////////////////////////////////////////////////////////wAARCAAI"
    "ABADASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAL/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QAFQEBAQAAAAAAAAAAAAAAAAAAAQP/xA"
    "AUEQEAAAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwCQAo//2Q==";
const std::string kProgressive =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAKBueIx4ZKCMgoy0qqC+8P//8Nzc8P////////////////////////////////////////////////"
    "//////////2wBDAaq0tPDS8P//////////////////////////////////////////////////////////////////////////////wgARCAAI"
    "ABADASIAAhEBAxEB/8QAFQABAQAAAAAAAAAAAAAAAAAAAAH/xAAVAQEBAAAAAAAAAAAAAAAAAAABAv/aAAwDAQACEAMQAAABgK//xAAUEAEAAA"
    "AAAAAAAAAAAAAAAAAQ/9oACAEBAAEFAj//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAEDAQE/AX//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oA"
    "CAECAQE/AX//xAAUEAEAAAAAAAAAAAAAAAAAAAAQ/9oACAEBAAY/Aj//xAAUEAEAAAAAAAAAAAAAAAAAAAAQ/9oACAEBAAE/IT//2gAMAwEAAg"
    "ADAAAAEAv/xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAEDAQE/EH//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAECAQE/EH//xAAUEAEAAAAA"
    "AAAAAAAAAAAAAAAQ/9oACAEBAAE/ED//2Q==";
const std::string kGreyJpeg =
    "/9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAKBueIx4ZKCMgoy0qqC+8P//8Nzc8P////////////////////////////////////////////////"
    "//////////wAALCAAIABABAREA/8QAFQABAQAAAAAAAAAAAAAAAAAAAAL/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAA/AIH/2Q==";

// One camera with this picture.
EpisodeRecord with_picture(const Lab& lab, const std::string& bytes) {
  lab.add_pictures("front", 1, 100.5, 20, 16, 8);
  lab.change([](auto& json) { json.erase("cameras"); });  // theirs is of another size
  lab.write("front/0.JPG", bytes);
  lab.write("front.csv", "time_s,file\n100.5,0.JPG\n");
  return lab.import();
}

}  // namespace

TEST_CASE("colours may be JPEG, baseline or progressive, and are kept byte by byte") {
  for (const std::string& text : {kJpeg, kProgressive}) {
    const Lab lab;
    const std::string jpeg = from_base64(text);
    const EpisodeRecord e = with_picture(lab, jpeg);
    REQUIRE(e.images->count() > 0);
    const std::vector<std::uint8_t> kept = e.images->read(0);
    CHECK(std::string(kept.begin(), kept.end()) == jpeg);
    CHECK((e.images->record(0).width == 16 && e.images->record(0).height == 8));
    Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
    catalogue.add(e, kEngine);
    const auto rows = catalogue.query("SELECT encoding, width, height FROM images LIMIT 1").rows;
    CHECK(std::get<std::string>(rows.at(0)[0]) == "jpeg");
    CHECK((std::get<std::int64_t>(rows[0][1]) == 16 && std::get<std::int64_t>(rows[0][2]) == 8));
    for (std::size_t cut : {std::size_t{3}, std::size_t{20}, std::size_t{170}, jpeg.size() - 1}) {
      INFO(cut);
      const Lab other;
      CHECK_THROWS_WITH(with_picture(other, jpeg.substr(0, cut)), Catch::Contains("front/0.JPG"));
    }
    const Lab zeros;  // some cameras fill their buffers
    CHECK(with_picture(zeros, jpeg + std::string(5, '\0')).images->count() > 0);
  }
  const Lab grey, deep;
  CHECK_THROWS_WITH(with_picture(grey, from_base64(kGreyJpeg)), Catch::Contains("8 bits and 3 channels"));
  std::string twelve = from_base64(kJpeg);
  const std::size_t frame = twelve.find("\xff\xc0");
  twelve[frame + 4] = 12;
  CHECK_THROWS_WITH(with_picture(deep, twelve), Catch::Contains("8 bits and 3 channels"));
  const Lab none;
  std::string unframed = from_base64(kJpeg);
  unframed[frame + 1] = '\xc4';  // tables, where the frame was
  CHECK_THROWS_WITH(with_picture(none, unframed), Catch::Contains("front/0.JPG"));
}

TEST_CASE("a bad picture late in a recording leaves the catalogue as it was, and the first one is named") {
  const Lab lab;
  lab.add_pictures("front", 41, 100, 20);
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db", Journal::in_place);
  store_recording(lab.folder(), panda_stager(), {}, catalogue, kEngine);
  const std::string before = catalogue.content_hash();
  lab.change([](auto& json) { json["task"] = "another"; });  // so that nothing is read before it is stored
  for (const char* name : {"front/38.png", "front/39.png"}) lab.write(name, lab.read(name).substr(0, 60));
  for (const int workers : {1, 4})
    CHECK_THROWS_WITH(store_recording(lab.folder(), panda_stager(), {{}, {}, workers}, catalogue, kEngine),
                      Catch::Contains("front/38.png") && Catch::Contains("ends too early"));
  CHECK(catalogue.content_hash() == before);
  CHECK(catalogue.episodes().size() == 1);
}

TEST_CASE("pictures that are named twice are told") {
  const Lab lab;
  lab.add_pictures("front", 10, 100, 20);
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  CHECK(store_recording(lab.folder(), panda_stager(), {}, catalogue, kEngine).notes.empty());
  lab.replace("front.csv", ",4.png", ",3.png");
  lab.replace("front.csv", ",5.png", ",3.png");
  const auto notes = store_recording(lab.folder(), panda_stager(), {}, catalogue, kEngine).notes;
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes[0], Catch::Contains("front.csv:6: the picture '3.png' was named before, at ") &&
                           Catch::Contains("front.csv:5; so were 1 more"));
}

TEST_CASE("depths become metres in our unit, and those out of range no reading") {
  const Lab lab;
  Picture millimetres;
  millimetres.width = 160, millimetres.height = 120;
  millimetres.depth.assign(160 * 120, 0);
  millimetres.depth[5] = 0.0250F, millimetres.depth[6] = 0.1234F, millimetres.depth[7] = 0.4F;  // 250, 1234, 4000
  const Bytes png = to_png(millimetres, PictureKind::depth);
  lab.write("depth/100.5.png", {png.begin(), png.end()});
  lab.change([](auto& json) {
    json["streams"].push_back({{"kind", "depth"},
                               {"camera", "front"},
                               {"folder", "depth"},
                               {"unit_m", 0.001},
                               {"near_m", 0.3},
                               {"far_m", 3}});
  });
  const EpisodeRecord e = lab.import();
  REQUIRE(e.images->count() == 1);
  CHECK(e.images->record(0).frame == 10);
  Picture metres;
  from_png(e.images->read(0), PictureKind::depth, metres);
  CHECK(metres.depth[5] == 0);
  CHECK(metres.depth[6] == Approx(1.234).margin(1e-4));
  CHECK(metres.depth[7] == 0);
}

TEST_CASE("an episode that is exported as a recording comes back") {
  const Lab lab;
  lab.add_pictures("front", 41, 100, 20);
  lab.write("labels.json", R"({"segments": [{"kind": "skill", "name": "wave", "start_s": 0, "end_s": 1}],
                              "language": [{"text": "wave your arm"}]})");
  lab.change([](auto& json) { json["labels"] = "labels.json"; });
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  const std::int64_t id = *catalogue.add_if_new(lab.import(), kEngine);
  export_recording(catalogue, read_stored(catalogue, id), lab.folder() / "again");
  const EpisodeRecord a = catalogue.read_episode(id), b = record_of(lab.folder() / "again", panda_stager(), {});
  REQUIRE(a.frames.size() == b.frames.size());
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    CHECK(a.frames[i].joint_position == b.frames[i].joint_position);
    CHECK(a.frames[i].hands[0].tip == b.frames[i].hands[0].tip);
  }
  CHECK(b.images->count() == 41);
  REQUIRE(b.labels.segments.size() == 1);
  CHECK(b.labels.segments[0].skill == "wave");
  CHECK(b.labels.segments[0].labelled_by == Labeller::person);
  CHECK(a.scene.cameras[0].mount_from_camera.isApprox(b.scene.cameras[0].mount_from_camera, 1e-12));
}

TEST_CASE("labels that take no frame are not exported: they could not come back") {
  const Lab lab;
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  const std::int64_t id = *catalogue.add_if_new(lab.import(), kEngine);
  EpisodeRecord e = catalogue.read_episode(id);
  for (const Span& span : {Span{0, 1'950'000, 0, 39}, Span{1'960'000, 2'000'000, 40, 41}}) {
    SegmentRecord& segment = e.labels.segments.emplace_back();
    segment.kind = SegmentKind::skill, segment.skill = "wave", segment.span = span;
    segment.labelled_by = Labeller::person;
    segment.ordinal = static_cast<int>(e.labels.segments.size()) - 1;
  }
  catalogue.set_labels(id, e);
  export_recording(catalogue, read_stored(catalogue, id), lab.folder() / "again");
  CHECK(record_of(lab.folder() / "again", panda_stager(), {}).labels.segments.size() == 1);
}

TEST_CASE("cameras that nobody calibrated are exported as such") {
  const Lab lab;
  lab.add_pictures("front", 10, 100, 20);
  lab.change([](auto& json) { json.erase("cameras"); });
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  const std::int64_t id = *catalogue.add_if_new(lab.import(), kEngine);
  export_recording(catalogue, read_stored(catalogue, id), lab.folder() / "again");
  CHECK_FALSE(std::filesystem::exists(lab.folder() / "again/cameras.json"));
  const EpisodeRecord again = record_of(lab.folder() / "again", panda_stager(), {});
  CHECK(again.made.options.at("uncalibrated") == "front");
  CHECK(again.images->count() == 10);
}

TEST_CASE("an arm without a recorded hand is stored, and its hand is not known") {
  const Lab lab;
  lab.change([](auto& json) { json["streams"].erase(1); });
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  const EpisodeRecord e = catalogue.read_episode(*catalogue.add_if_new(lab.import(), kEngine));
  CHECK(std::isnan(e.frames[3].hands.at(0).opening));
  CHECK(std::isnan(e.frames[3].action->gripper));
  CHECK(e.frames[3].action->joint_position.at(2) == e.frames[4].joint_position.at(2));
}

TEST_CASE("labels come later too, and take the place of those of the same sort") {
  const Lab lab;
  lab.write("labels.json", R"({"segments": [{"kind": "skill", "name": "point", "start_s": 0, "end_s": 1}],
                              "facts": [{"fact": ["raised", "arm"], "start_s": 0.5, "end_s": 1.5}],
                              "language": [{"text": "wave your arm"}]})");
  lab.change([](auto& json) { json["labels"] = "labels.json"; });
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  const std::int64_t id = *catalogue.add_if_new(lab.import(), kEngine);
  EpisodeRecord e = catalogue.read_episode(id);
  const auto rows = [&](const std::string& of) { return catalogue.query("SELECT * FROM " + of).rows; };
  e.labels.keyframes["by_hand"] = {0, 7, 40};
  catalogue.set_labels(id, e);
  const auto facts = rows("facts"), sentences = rows("instructions"),
             keyframes = rows("(SELECT method, frame FROM keyframes)");
  REQUIRE((!e.labels.segments.empty() && !facts.empty() && !sentences.empty() && keyframes.size() > 2));
  for (const std::string skill : {"wave", "wave", "point"}) {
    SegmentRecord segment;
    segment.kind = SegmentKind::skill, segment.skill = skill, segment.span = {0, 1'000'000, 0, 20};
    segment.labelled_by = Labeller::model;
    e.labels.segments = {segment};
    catalogue.set_labels(id, e);
    CHECK(rows("frames WHERE skill = '" + skill + "'").size() == 20);
    CHECK(rows("frames WHERE skill IS NOT NULL").size() == 20);  // none of those that were there before
    CHECK(rows("segments").size() == 1);
    CHECK(rows("segments WHERE labelled_by = 'model' AND skill = '" + skill + "'").size() == 1);
    CHECK(rows("facts") == facts);
    CHECK(rows("instructions") == sentences);
    CHECK(rows("(SELECT method, frame FROM keyframes)") == keyframes);
  }
}
