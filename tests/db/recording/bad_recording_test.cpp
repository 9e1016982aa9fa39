#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <ctime>

#include "engine/base/error.h"
#include "tests/support/lab.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

// Where it is wrong, and how it is mended.
template <typename Edit>
void cured(const Edit& edit, const std::string& complaint, const std::string& cure) {
  const Lab lab;
  lab.change(edit);
  INFO(complaint);
  try {
    lab.import();
    FAIL("nothing was refused");
  } catch (const Error& error) {
    CHECK_THAT(error.message(), Contains(complaint));
    CHECK_THAT(error.hint(), Contains(cure));
  }
}

template <typename Damage>
void refuse(const Damage& damage, const std::string& place, const std::string& complaint) {
  const Lab lab;
  damage(lab);
  INFO(complaint);
  CHECK_THROWS_WITH(lab.import(), Contains(place) && Contains(complaint));
}

}  // namespace

TEST_CASE("what recording.json says wrongly is named with its place") {
  const auto edited = [](const auto& edit, const std::string& place, const std::string& complaint) {
    refuse([&](const Lab& lab) { lab.change(edit); }, place, complaint);
  };
  edited([](auto& j) { j["streams"] = nlohmann::json::array({j["streams"][1]}); }, "streams",
         "no stream of kind \"joints\"");
  edited([](auto& j) { j["streams"][0]["file"] = "none.csv"; }, "streams[0].file", "there is no file");
  edited([](auto& j) { j["streams"][0]["file"] = "../joints.csv"; }, "streams[0].file", "");
  edited([](auto& j) { j["streams"][0]["kind"] = "joint"; }, "streams[0].kind", "did you mean 'joints'?");
  edited([](auto& j) { j["streams"][0]["clock"] = "am"; }, "streams[0].clock", "did you mean 'arm'?");
  edited([](auto& j) { j["streams"].push_back(j["streams"][0]); }, "streams[2]", "another stream of the same kind");
  edited([](auto& j) { j.erase("outcome"); }, "recording.json", "'outcome' is missing");
  edited([](auto& j) { j["colour"] = 1; }, "recording.json", "there is no field 'colour'");
  edited([](auto& j) { j["frame_hz"] = 0; }, "frame_hz", "1 to 1000");
  edited([](auto& j) { j["end_s"] = 100.01; }, "recording.json", "no two frames");
  edited(
      [](auto& j) {
        j["clocks"]["late"] = {{"offset_s", 60}};
        j["streams"][1]["clock"] = "late";
      },
      "streams[1]", "none of its readings lies within the recording");
  edited([](auto& j) { j["robot"]["base"]["quaternion"] = {1, 1, 0, 0}; }, "quaternion", "length 1");
  refuse([](const Lab& lab) { lab.write("recording.json", "{\n\"task\": ,\n}"); }, "recording.json:2", "no JSON");
}

TEST_CASE("what recording.json says wrongly is told with its cure") {
  cured([](auto& j) { j["clocks"]["arm"]["drift_ppm"] = 1e6; }, "below 100000", "write 40");
  cured([](auto& j) { j["streams"][0]["clock"] = "camera"; }, "no clock 'camera'", "known: arm");
  cured(
      [](auto& j) {
        j.erase("clocks");
        j["streams"][1].erase("clock");
      },
      "no clock 'arm'", "\"clocks\": {\"arm\": {}}");
  cured([](auto& j) { j["stampede_recording"] = 2; }, "version 1", "\"stampede_recording\": 1");
  cured([](auto& j) { j["outcome"] = "good"; }, "no outcome 'good'", "write \"success\" or \"failure\"");
  cured([](auto& j) { j["frame_hz"] = 29.97; }, "29.97", "\"frame_hz\": 30");
  cured([](auto& j) { j["outcome"] = "failure", j["reason"] = "tiredness"; }, "no reason 'tiredness'", "unreachable");
  cured(
      [](auto& j) {
        j["robot"]["base"]["quaternion"] = {0, 0, 0, 0};
      },
      "length 1, and this one has not", "[0, 0, 0, 1]");
  cured(
      [](auto& j) {
        j["streams"].push_back({{"kind", "rgb"}, {"camera", "front"}, {"folder", "front_rgb"}});
      },
      "there is no folder", "copy it into the recording");
}

TEST_CASE("bad rows are named with their line") {
  const auto edited = [](const std::string& from, const std::string& to, const std::string& place,
                         const std::string& complaint) {
    refuse([&](const Lab& lab) { lab.replace("joints.csv", from, to); }, place, complaint);
  };
  edited("\n100.030000", "\n100.010000", "joints.csv:5", "its clock runs backwards");
  edited("\n100.030000,", "\n100.030000,nan", "joints.csv:5", "no finite number");
  edited("\n100.030000,", "\nnan,", "joints.csv:5", "no finite number");
  edited("\n100.030000,", "\n100.030000,-50", "joints.csv:5", "");
  edited("joint4_position_rad", "elbow_position_rad", "joints.csv:1", "no column 'elbow_position_rad'");
  edited(",joint7_position_rad", "", "joints.csv:1", "'joint7_position_rad' is missing");
  edited("\n100.030000,", "\n100.030000,9,", "joints.csv:5", "has 9 fields");
  refuse([](const Lab& lab) { lab.replace("gripper.csv", ",0.08", ",8.0"); }, "gripper.csv:2", "opens by 0.080 m");
  refuse([](const Lab& lab) { lab.write("joints.csv", ""); }, "joints.csv", "empty");
  refuse(
      [](const Lab& lab) {
        const std::string text = lab.read("joints.csv");
        lab.write("joints.csv", text.substr(0, text.size() - 30));
      },
      "joints.csv:202", "the file ends too early");
  refuse(
      [](const Lab& lab) {
        std::string text = lab.read("joints.csv");
        std::replace(text.begin(), text.end(), ',', ';');
        lab.write("joints.csv", text);
      },
      "joints.csv:1", "not separated by commas");
  refuse(
      [](const Lab& lab) {  // 100 Hz in milliseconds
        std::string text = lab.read("joints.csv"), slow = text.substr(0, text.find('\n') + 1);
        std::size_t at = slow.size();
        for (int row = 0; row <= 200; ++row) {
          const std::size_t comma = text.find(',', at), end = text.find('\n', at) + 1;
          slow += std::to_string(100'000 + 10 * row) + text.substr(comma, end - comma);
          at = end;
        }
        lab.write("joints.csv", slow);
      },
      "joints.csv", "10.000 s apart");
  refuse(
      [](const Lab& lab) {  // degrees
        lab.replace("joints.csv", "\n100.020000,0.", "\n100.020000,45.");
      },
      "joints.csv:4", "another robot");
}

TEST_CASE("bad pictures are named") {
  const auto damaged = [](const auto& damage, const std::string& place, const std::string& complaint) {
    refuse(
        [&](const Lab& lab) {
          lab.add_pictures("front", 5, 100, 20);
          damage(lab);
        },
        place, complaint);
  };
  damaged(
      [](const Lab& lab) {
        const std::string png = lab.read("front/3.png");
        lab.write("front/3.png", png.substr(0, png.size() - 20));
      },
      "front/3.png", "ends too early");
  damaged(
      [](const Lab& lab) {
        std::string png = lab.read("front/3.png");
        png[60] = static_cast<char>(png[60] ^ 1);
        lab.write("front/3.png", png);
      },
      "front/3.png", "a checksum does not agree");
  damaged([](const Lab& lab) { lab.write("front/3.png", "GIF89a"); }, "front/3.png", "neither a PNG nor a JPEG");
  damaged([](const Lab& lab) { lab.write("front/3.png", "\xff\xd8\xff\xe0 but no more"); }, "front/3.png",
          "ends too early");
  damaged([](const Lab& lab) { lab.replace("front.csv", "4.png", "44.png"); }, "front.csv:6",
          "there is no picture '44.png'");
  damaged([](const Lab& lab) { lab.replace("front.csv", "100.15", "100.0"); }, "front.csv:5",
          "its clock runs backwards");
  damaged([](const Lab& lab) { lab.change([](auto& j) { j["streams"][2]["camera"] = "fron"; }); }, "streams[2]",
          "did you mean 'front'?");
  damaged(
      [](const Lab& lab) {
        lab.change([](auto& j) {
          j["streams"][2]["kind"] = "depth";
          j["streams"][2]["unit_m"] = 0.001;
        });
      },
      "front/0.png", "16 bits and one channel");
  refuse([](const Lab& lab) { lab.add_pictures("front", 5, 100, 20, 80, 60); }, "front/0.png",
         "80 x 60 pixels, and camera front was measured at 160 x 120");
}

TEST_CASE("files of a recording lie in it, as plain files") {
  namespace fs = std::filesystem;
  const Lab elsewhere;
  elsewhere.add_pictures("front", 5, 100, 20);
  const fs::path picture = elsewhere.folder() / "front" / "0.png";
  const auto linked = [&](const auto& damage, const std::string& place, const std::string& complaint) {
    refuse(
        [&](const Lab& lab) {
          lab.add_pictures("front", 5, 100, 20);
          damage(lab);
        },
        place, complaint);
  };
  REQUIRE(fs::exists(picture));
  const auto in_place_of = [](const fs::path& path, const fs::path& target) {
    fs::remove_all(path);
    fs::create_symlink(target, path);
  };
  linked([&](const Lab& lab) { in_place_of(lab.folder() / "front/0.png", picture); }, "front/0.png",
         "a link to a file outside of the recording");
  linked([&](const Lab& lab) { in_place_of(lab.folder() / "front", picture.parent_path()); }, "recording.json",
         "outside");
  linked([&](const Lab& lab) { in_place_of(lab.folder() / "front/0.png", "/dev/zero"); }, "0.png",
         "there is no picture");
  linked(
      [](const Lab& lab) {
        fs::remove(lab.folder() / "front/0.png");
        REQUIRE(mkfifo((lab.folder() / "front/0.png").c_str(), 0600) == 0);
      },
      "0.png", "there is no picture");
  linked(
      [&](const Lab& lab) {  // named by their stamps
        in_place_of(lab.folder() / "front/0.png", picture);
        lab.change([](auto& j) { j["streams"].back().erase("times"); });
      },
      "front/0.png", "a link to a file outside of the recording");
  refuse(
      [](const Lab& lab) {
        fs::remove(lab.folder() / "gripper.csv");
        REQUIRE(mkfifo((lab.folder() / "gripper.csv").c_str(), 0600) == 0);
      },
      "gripper.csv", "it is no file");
  refuse(
      [&](const Lab& lab) {
        fs::copy_file(lab.folder() / "recording.json", elsewhere.folder() / "other.json");
        in_place_of(lab.folder() / "recording.json", elsewhere.folder() / "other.json");
      },
      "recording.json", "outside");
  for (const std::string name : {"../x.csv", "/etc/hostname", "a/../../x.csv"})
    refuse([&](const Lab& lab) { lab.change([&](auto& j) { j["streams"][1]["file"] = name; }); }, "streams[1].file",
           "");
  const Lab within;  // a link that stays inside is one
  within.add_pictures("front", 5, 100, 20);
  fs::rename(within.folder() / "front/0.png", within.folder() / "first.png");
  fs::create_symlink("../first.png", within.folder() / "front/0.png");
  CHECK(within.import().images->count() == 5);
}

TEST_CASE("a CSV that was cut in its last number, or is no UTF-8, is refused with its line") {
  refuse(
      [](const Lab& lab) {
        std::string text = lab.read("joints.csv");
        while (text.back() == '\n' || text.back() == '\r') text.pop_back();
        lab.write("joints.csv", text.substr(0, text.size() - 2));
      },
      "joints.csv:202", "the file ends within this line");
  refuse([](const Lab& lab) { lab.replace("gripper.csv", "opening_m", "\xff_m"); }, "gripper.csv:1", "the byte 0xFF");
}

TEST_CASE("what would cost too much is told with its limit, before it costs anything") {
  const std::clock_t start = std::clock();
  const auto channel = [](const Lab& lab, const std::string& text) {
    lab.write("x.csv", text);
    lab.change([](auto& j) {
      j["streams"].push_back({{"kind", "channel"}, {"name", "x"}, {"unit", "N"}, {"file", "x.csv"}, {"clock", "arm"}});
    });
  };
  std::string header = "time_s", row = "100.5";
  for (int i = 0; i < 100'000; ++i) header += ",c" + std::to_string(i), row += ",0";
  refuse([&](const Lab& lab) { channel(lab, header + "\n" + row + "\n"); }, "x.csv:1",
         "it has 100001 columns, at most 4096");
  refuse([](const Lab& lab) { lab.change([](auto& j) { j["end_s"] = 100'000.0; }); }, "recording.json",
         "more than a million frames");
  refuse(
      [](const Lab& lab) {
        lab.change([](auto& j) {
          const auto one = j["streams"][0];
          for (int i = 0; i < 300; ++i) j["streams"].push_back(one);
        });
      },
      "streams", "streams, at most 256");
  refuse([](const Lab& lab) { lab.write("recording.json", "{\"task\":" + std::string(1'000'000, '[')); },
         "recording.json:1", "brackets are 65 deep");
  CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 20);
}
