#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "lab.h"

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
  edited([](auto& j) { j["robot"]["name"] = "pandas"; }, "recording.json", "did you mean 'panda'?");
  edited([](auto& j) { j["world"] = "kitchen9"; }, "recording.json", "there is no world");
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
  cured([](auto& j) { j["robot"]["name"] = "my_lab_robot"; }, "no robot 'my_lab_robot'", "`robot.urdf`");
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
