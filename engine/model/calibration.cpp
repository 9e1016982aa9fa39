// Calibration files: the cameras of a laboratory, for simulated pictures that match its own.
#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/read_json.h"
#include "engine/model/camera.h"

namespace stampede {
namespace {

using Json = nlohmann::json;

constexpr int kMostPixels = 4096;         // a side
constexpr double kRotationSlack = 1e-3;   // files hold few digits
constexpr double kOpenCvHalfPixel = 0.5;  // there the centre of the first pixel is (0, 0), here (0.5, 0.5)

// A value of the file, which knows where it stands.
class Value {
 public:
  Value(const Json& json, std::string file, std::string path)
      : json_(json), file_(std::move(file)), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what, const std::string& cure) const {
    throw Error(file_ + (path_.empty() ? "" : " at " + path_), what, cure);
  }
  Value field(const std::string& name, const std::string& cure) const {
    if (!json_.contains(name)) fail("the field '" + name + "' is missing", cure);
    return Value(json_.at(name), file_, path_.empty() ? name : path_ + "." + name);
  }
  bool has(const std::string& name) const { return json_.contains(name); }

  void only(const std::vector<std::string>& known) const {
    if (!json_.is_object()) fail("an object is expected", "write { … }");
    for (const auto& [name, value] : json_.items())
      if (std::find(known.begin(), known.end(), name) == known.end())
        fail("there is no field '" + name + "'", did_you_mean(name, known));
  }
  std::vector<Value> list(const std::string& what) const {
    if (!json_.is_array()) fail("a list is expected: " + what, "write [ … ]");
    std::vector<Value> values;
    for (std::size_t i = 0; i < json_.size(); ++i)
      values.emplace_back(json_[i], file_, path_ + "[" + std::to_string(i) + "]");
    return values;
  }
  std::vector<Value> list(std::size_t size, const std::string& what) const {
    std::vector<Value> values = list(what);
    if (values.size() != size)
      fail("it has " + std::to_string(values.size()) + " entries, not " + std::to_string(size), "give " + what);
    return values;
  }
  double number() const {
    if (!json_.is_number()) fail("a number is expected", "write it as 1.5");
    return json_.get<double>();
  }
  std::string text() const {
    if (!json_.is_string()) fail("a text is expected", "write it in quotes");
    return json_.get<std::string>();
  }
  int pixels() const {
    const bool whole = json_.is_number_integer();
    if (!whole || json_.get<std::int64_t>() < 1 || json_.get<std::int64_t>() > kMostPixels)
      fail("a whole number of pixels from 1 to 4096 is expected", "give the size of the calibrated pictures");
    return json_.get<int>();
  }
  Eigen::MatrixXd matrix(int size, const std::string& what) const {
    Eigen::MatrixXd result(size, size);
    const std::vector<Value> rows = list(static_cast<std::size_t>(size), what);
    for (int row = 0; row < size; ++row) {
      const auto columns = rows[static_cast<std::size_t>(row)].list(static_cast<std::size_t>(size), what);
      for (int column = 0; column < size; ++column)
        result(row, column) = columns[static_cast<std::size_t>(column)].number();
    }
    return result;
  }

 private:
  const Json& json_;
  std::string file_, path_;
};

const char* const kIntrinsics = "3 rows of 3: [fx, 0, cx], [0, fy, cy], [0, 0, 1], in pixels";
const char* const kExtrinsics = "4 rows of 4: rotation and origin (m) of the optical frame, then [0, 0, 0, 1]";

void read_intrinsics(const Value& value, Camera& camera) {
  const Value at = value.field("camera_matrix", std::string("give ") + kIntrinsics);
  const Eigen::MatrixXd matrix = at.matrix(3, kIntrinsics);
  if (!(matrix(0, 0) > 0) || !(matrix(1, 1) > 0)) at.fail("focal lengths must be positive", "give them in pixels");
  if (matrix(0, 1) != 0 || matrix(1, 0) != 0) at.fail("pixels must not be skewed", std::string("give ") + kIntrinsics);
  if (matrix(2, 0) != 0 || matrix(2, 1) != 0 || matrix(2, 2) != 1)
    at.fail("its last row is not [0, 0, 1]", std::string("give ") + kIntrinsics);
  camera.focal_x = matrix(0, 0), camera.focal_y = matrix(1, 1);
  camera.centre_x = matrix(0, 2), camera.centre_y = matrix(1, 2);
  const std::string centres = value.has("pixel_centres") ? value.field("pixel_centres", "").text() : "integer";
  if (centres != "integer" && centres != "half")
    value.field("pixel_centres", "")
        .fail("no such convention: '" + centres + "'", "write \"integer\" (OpenCV) or \"half\"");
  if (centres == "integer") camera.centre_x += kOpenCvHalfPixel, camera.centre_y += kOpenCvHalfPixel;
}

void read_distortion(const Value& value, Camera& camera) {
  camera.distortion = {};
  if (!value.has("distortion")) return;
  const auto numbers = value.field("distortion", "").list(5, "[k1, k2, p1, p2, k3]; k3 is 0 where there are four");
  for (std::size_t i = 0; i < numbers.size(); ++i) camera.distortion.at(i) = numbers[i].number();
}

void read_mount(const Value& value, const Scene& scene, Camera& camera) {
  camera.mount_body.clear();
  camera.mount_part = 0;
  const Value at = value.field("mount", "write \"world\", or \"robot.LINK\" for a camera that moves with a link");
  const std::string mount = at.text();
  if (mount == "world") return;
  std::vector<std::string> known{"world"};
  for (const Part& part : scene.robot.body.parts) known.push_back("robot." + part.name);
  const auto found = std::find(known.begin() + 1, known.end(), mount);
  if (found == known.end()) at.fail("there is nothing named '" + mount + "' to mount on", did_you_mean(mount, known));
  camera.mount_body = scene.robot.name;
  camera.mount_part = static_cast<int>(found - known.begin()) - 1;
}

void read_extrinsics(const Value& value, Camera& camera) {
  const Value at = value.field("mount_from_camera", std::string("give ") + kExtrinsics);
  const Eigen::Matrix4d matrix = at.matrix(4, kExtrinsics);
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    at.fail("its last row is not [0, 0, 0, 1]", std::string("give ") + kExtrinsics);
  const Matrix3 rotation = matrix.topLeftCorner<3, 3>();
  const double error = (rotation.transpose() * rotation - Matrix3::Identity()).cwiseAbs().maxCoeff();
  if (!(error < kRotationSlack))
    at.fail("its upper left 3 x 3 is no rotation", "its columns must be of length 1 and at right angles");
  if (rotation.determinant() < 0)
    at.fail("its upper left 3 x 3 is a mirror image, no rotation", "x is right, y down, z forward in the picture");
  camera.mount_from_camera = make_transform(Vector3(matrix.topRightCorner<3, 1>()), Quaternion(rotation).normalized());
}

void read_range(const Value& value, Camera& camera) {
  if (value.has("near")) camera.near_m = value.field("near", "").number();
  if (value.has("far")) camera.far_m = value.field("far", "").number();
  if (!(camera.near_m > 0) || !(camera.far_m > camera.near_m))
    value.fail("near must be above 0 and far beyond it", "give both in m, such as 0.01 and 4.5");
}

std::string name_of(const Value& value) {
  const Value at = value.field("name", "name the camera as the world does, to replace it, or anew");
  const std::string name = at.text();
  const bool plain = name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
  if (name.empty() || !plain || name[0] < 'a')
    at.fail("'" + name + "' is not a name", "use small letters, digits and _, a letter first");
  return name;
}

Camera camera_of(const Value& value, const Scene& scene) {
  value.only({"name", "width", "height", "camera_matrix", "distortion", "mount", "mount_from_camera", "near", "far",
              "pixel_centres"});
  Camera camera;
  camera.name = name_of(value);
  for (const Camera& other : scene.cameras)
    if (other.name == camera.name) camera = other;  // its near and far stay where the file gives none
  camera.width = value.field("width", "give it in pixels").pixels();
  camera.height = value.field("height", "give it in pixels").pixels();
  read_intrinsics(value, camera);
  read_distortion(value, camera);
  read_mount(value, scene, camera);
  read_extrinsics(value, camera);
  read_range(value, camera);
  return camera;
}

}  // namespace

std::vector<Camera> load_calibration(const std::filesystem::path& file, const Scene& scene) {
  const Json json = json_from_file(file, "write { \"cameras\": [ … ] }");
  const Value root(json, file.string(), "");
  root.only({"cameras"});
  std::vector<Camera> cameras;
  std::set<std::string> names;
  for (const Value& value : root.field("cameras", "write { \"cameras\": [ … ] }").list("cameras")) {
    cameras.push_back(camera_of(value, scene));
    if (!names.insert(cameras.back().name).second)
      value.fail("there are two cameras named '" + cameras.back().name + "'", "rename one");
  }
  if (cameras.empty()) root.fail("it holds no camera", "write { \"cameras\": [ … ] }");
  return cameras;
}

}  // namespace stampede
