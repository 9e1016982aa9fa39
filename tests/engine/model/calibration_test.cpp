#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/model/camera.h"
#include "tests/support/panda.h"

using namespace stampede;
using Catch::Contains;

namespace {

class CalibrationFile {
 public:
  explicit CalibrationFile(const std::string& text) {
    std::string name = (std::filesystem::temp_directory_path() / "stampede_calibration_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = std::filesystem::path(name) / "lab.json";
    std::ofstream(path_) << text;
  }
  ~CalibrationFile() { std::filesystem::remove_all(path_.parent_path()); }
  CalibrationFile(const CalibrationFile&) = delete;
  CalibrationFile& operator=(const CalibrationFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

const std::string kGood = R"({"cameras": [
  {"name": "front", "width": 640, "height": 480,
   "camera_matrix": [[612.5, 0, 319.5], [0, 611.25, 239.5], [0, 0, 1]],
   "distortion": [0.1, -0.2, 0.001, 0.002, 0.05],
   "mount": "world",
   "mount_from_camera": [[0, 0.6, -0.8, 1.5], [1, 0, 0, 0.25], [0, -0.8, -0.6, 1.25], [0, 0, 0, 1]],
   "near": 0.1, "far": 3.5},
  {"name": "hand_eye", "width": 100, "height": 80, "pixel_centres": "half",
   "camera_matrix": [[90, 0, 50], [0, 90, 40], [0, 0, 1]],
   "mount": "robot.hand",
   "mount_from_camera": [[1, 0, 0, 0.05], [0, 1, 0, 0], [0, 0, 1, 0.02], [0, 0, 0, 1]]}
]})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  REQUIRE(text.find(from) != std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

// Place, message and cure, when it is refused as it should be.
std::string file_complaint(const std::string& text) {
  const CalibrationFile file(text);
  try {
    (void)load_calibration(file.path(), table_scene(1));
  } catch (const Error& error) {
    CHECK_THAT(error.where(), Catch::StartsWith(file.path().string()));
    CHECK_FALSE(error.hint().empty());
    return error.where().substr(file.path().string().size()) + ": " + error.message() + " | " + error.hint();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a calibrated camera sees a point where OpenCV's formula puts it, half a pixel further") {
  const CalibrationFile file(kGood);
  const std::vector<Camera> cameras = load_calibration(file.path(), table_scene(1));
  REQUIRE(cameras.size() == 2);
  const Camera& front = cameras[0];
  CHECK(front.name == "front");
  CHECK(front.mount_body.empty());
  CHECK((front.mount_from_camera * Vector3::Zero() - Vector3(1.5, 0.25, 1.25)).norm() < 1e-12);
  CHECK((front.mount_from_camera.linear().col(2) - Vector3(-0.8, 0, -0.6)).norm() < 1e-12);
  const auto [u, v] = project(front, {0.1, 0.2, 1});
  const double r2 = 0.05, radial = 1 + 0.1 * r2 - 0.2 * r2 * r2 + 0.05 * r2 * r2 * r2;
  const double x = 0.1 * radial + 2 * 0.001 * 0.02 + 0.002 * (r2 + 0.02);
  const double y = 0.2 * radial + 0.001 * (r2 + 0.08) + 2 * 0.002 * 0.02;
  CHECK(u == Approx(612.5 * x + 319.5 + 0.5).epsilon(1e-12));
  CHECK(v == Approx(611.25 * y + 239.5 + 0.5).epsilon(1e-12));
  CHECK(front.near_m == 0.1);
  CHECK(front.far_m == 3.5);
}

TEST_CASE("a camera on a link names robot and part, half pixels are taken as they are") {
  const CalibrationFile file(kGood);
  const Scene scene = table_scene(1);
  const Camera hand_eye = load_calibration(file.path(), scene).at(1);
  CHECK(hand_eye.mount_body == scene.robot.name);
  CHECK(scene.robot.body.parts.at(static_cast<std::size_t>(hand_eye.mount_part)).name == "hand");
  CHECK(hand_eye.centre_x == 50);
  CHECK(hand_eye.distortion == std::array<double, 5>{});
  CHECK(hand_eye.near_m == Camera().near_m);
}

TEST_CASE("near and far stay the world's where the file gives none") {
  Scene scene = table_scene(0);
  Camera known;
  known.name = "hand_eye", known.near_m = 0.123, known.distortion[0] = 9;
  scene.cameras.push_back(known);
  const CalibrationFile file(kGood);
  const Camera hand_eye = load_calibration(file.path(), scene).at(1);
  CHECK(hand_eye.near_m == 0.123);
  CHECK(hand_eye.distortion[0] == 0);
}

TEST_CASE("a rotation of few digits becomes an exact one") {
  const CalibrationFile file(with("[0, 0.6, -0.8, 1.5]", "[0, 0.6001, -0.7999, 1.5]"));
  const Matrix3 rotation = load_calibration(file.path(), table_scene(0)).at(0).mount_from_camera.linear();
  CHECK((rotation * rotation.transpose() - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("unreadable calibration files are errors") {
  const Scene scene = table_scene(0);
  CHECK_THROWS_AS(load_calibration("/nowhere/lab.json", scene), Error);
  CHECK_THROWS_AS(load_calibration("/tmp", scene), Error);
  CHECK_THAT(file_complaint(""), Contains(":1: this file is empty"));
  CHECK_THAT(file_complaint(kGood.substr(0, 200)), Contains(":5: this JSON ends too early"));
  CHECK_THAT(file_complaint("[]"), Contains("object is expected"));
  CHECK_THAT(file_complaint("{}"), Contains("'cameras' is missing"));
  CHECK_THAT(file_complaint(R"({"cameras": []})"), Contains("no camera"));
  CHECK_THAT(file_complaint(R"({"cameras": {}})"), Contains("at cameras: a list is expected"));
  CHECK_THAT(file_complaint(R"({"cameras": [3]})"), Contains("at cameras[0]: an object"));
}

TEST_CASE("every wrong shape is named with its place") {
  CHECK(file_complaint(kGood) == "accepted");
  CHECK_THAT(file_complaint(with("\"width\": 640, ", "")), Contains("at cameras[0]: the field 'width' is missing"));
  CHECK_THAT(file_complaint(with("\"distortion\"", "\"distorsion\"")), Contains("did you mean 'distortion'"));
  for (const std::string size : {"0", "-1", "4097", "1.5", "\"640\"", "99999999999"})
    CHECK_THAT(file_complaint(with("640", size)),
               Contains("at cameras[0].width: a whole number of pixels from 1 to 4096"));
  CHECK_THAT(file_complaint(with("[[612.5, 0, 319.5], ", "[")),
             Contains("at cameras[0].camera_matrix: it has 2 entries"));
  CHECK_THAT(file_complaint(with("612.5, 0, 319.5", "612.5, 0")),
             Contains("camera_matrix[0]: it has 2 entries, not 3"));
  CHECK_THAT(file_complaint(with("612.5", "null")), Contains("camera_matrix[0][0]: a number is expected"));
  CHECK_THAT(file_complaint(with("612.5", "-612.5")), Contains("focal lengths must be positive"));
  CHECK_THAT(file_complaint(with("611.25", "0")), Contains("focal lengths must be positive"));
  CHECK_THAT(file_complaint(with("612.5, 0,", "612.5, 0.1,")), Contains("skewed"));
  CHECK_THAT(file_complaint(with("0.002, 0.05]", "0.002]")),
             Contains("at cameras[0].distortion: it has 4 entries, not 5"));
  CHECK_THAT(file_complaint(with("\"half\"", "\"middle\"")), Contains("at cameras[1].pixel_centres"));
  CHECK_THAT(file_complaint(with("\"near\": 0.1", "\"near\": 0")), Contains("near must be above 0"));
  CHECK_THAT(file_complaint(with("\"far\": 3.5", "\"far\": 0.05")), Contains("far beyond"));
  CHECK_THAT(file_complaint(with("\"front\"", "\"Front view\"")), Contains("at cameras[0].name"));
  CHECK_THAT(file_complaint(with("\"hand_eye\"", "\"front\"")), Contains("two cameras named 'front'"));
}

TEST_CASE("mounts that do not exist and matrices that are no rotations are refused") {
  CHECK_THAT(file_complaint(with("robot.hand", "robot.hnad")), Contains("did you mean 'robot.hand'"));
  CHECK_THAT(file_complaint(with("\"mount\": \"world\"", "\"mount\": 3")), Contains("cameras[0].mount: a text"));
  CHECK_THAT(file_complaint(with("[0, 0.6, -0.8, 1.5]", "[0, 0.6, -0.9, 1.5]")), Contains("is no rotation"));
  CHECK_THAT(file_complaint(with("[0, 0.6, -0.8, 1.5]", "[0, 0.6, 0.8, 1.5]")), Contains("is no rotation"));
  CHECK_THAT(file_complaint(with("[1, 0, 0, 0.25]", "[-1, 0, 0, 0.25]")), Contains("mirror image"));
  CHECK_THAT(file_complaint(with("1.25], [0, 0, 0, 1]", "1.25], [0, 0, 1, 1]")), Contains("last row"));
  CHECK_THAT(file_complaint(with("1.25], [0, 0, 0, 1]", "1.25]")), Contains("it has 3 entries, not 4"));
}

TEST_CASE("the camera file that the README shows is one") {
  std::ifstream file(std::string(STAMPEDE_SOURCE_DIR) + "/scripting/LANGUAGE.md");
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  const std::size_t begin = readme.find("```json\n") + 8;
  const CalibrationFile shown(readme.substr(begin, readme.find("```", begin) - begin));
  const std::vector<Camera> cameras = load_calibration(shown.path(), table_scene(1));
  REQUIRE(cameras.size() == 1);
  CHECK(cameras[0].name == "front");
  CHECK(cameras[0].focal_x == 601.2);
  CHECK(cameras[0].centre_x == Approx(318.9 + 0.5));
}
