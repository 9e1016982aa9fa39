#include "engine/record/arrays.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/record/array_maker.h"
#include "engine/record/observation.h"

namespace stampede {
namespace {

constexpr double kWideOpen = 0.9;  // of the first finger's range: RLBench's border of `gripper_open`

std::int64_t count_of(std::size_t size) { return static_cast<std::int64_t>(size); }

// The columns [from, from + count) of a table whose rows are `width` wide.
std::vector<double> cut(const std::vector<double>& table, std::size_t width, std::size_t from, std::size_t count) {
  std::vector<double> values;
  if (width == 0) return values;
  values.reserve(table.size() / width * count);
  for (std::size_t row = 0; row + width <= table.size(); row += width)
    values.insert(values.end(), table.begin() + static_cast<std::ptrdiff_t>(row + from),
                  table.begin() + static_cast<std::ptrdiff_t>(row + from + count));
  return values;
}

std::vector<double> picked(const std::vector<double>& table, std::size_t width,
                           const std::vector<std::size_t>& places) {
  std::vector<double> values;
  if (width == 0) return values;
  values.reserve(table.size() / width * places.size());
  for (std::size_t row = 0; row + width <= table.size(); row += width)
    for (const std::size_t place : places) values.push_back(table[row + place]);
  return values;
}

Transform transform_at(const double* v) { return to_transform({{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}}); }

// 4 x 4, row by row, for each pose of a table of rows of `width` that start with it.
std::vector<double> matrices(const std::vector<double>& table, std::size_t width, std::size_t from) {
  std::vector<double> values;
  if (width == 0) return values;
  values.reserve(table.size() / width * 16);
  for (std::size_t row = from; row < table.size(); row += width) {
    const auto matrix = transform_at(&table[row]).matrix();
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 4; ++k) values.push_back(matrix(i, k));
  }
  return values;
}

}  // namespace

ArrayMaker::ArrayMaker(const EpisodeRecord& episode, const FrameTables& tables, const ArrayRequest& request)
    : episode_(episode), tables_(tables), request_(request), used_(request.columns.size(), false) {
  arrays_.task = episode.task;
  arrays_.variation = episode.variation;
  arrays_.seed = episode.seed;
  arrays_.frames = count_of(tables.frames);
  arrays_.frame_hz = episode.frame_hz;
  std::vector<std::size_t> driven;
  for (std::size_t i = 0; i < episode.scene.joints.size(); ++i) {
    const JointName& joint = episode.scene.joints[i];
    (joint.driven && joint.part.body < 0 ? driven : other_joints_).push_back(i);
  }
  // Commanded joints are the arm's, or where nothing was commanded those that turn; fingers follow them on the chain.
  const auto turning = static_cast<std::size_t>(
      std::ranges::count_if(driven, [&](std::size_t joint) { return episode.scene.joints[joint].kind == "hinge"; }));
  const std::size_t arm = std::min(tables.commanded > 0 ? tables.commanded : turning, driven.size());
  arm_.assign(driven.begin(), driven.begin() + static_cast<std::ptrdiff_t>(arm));
  fingers_.assign(driven.begin() + static_cast<std::ptrdiff_t>(arm), driven.end());
}

bool ArrayMaker::wanted(std::string_view name) {
  if (request_.columns.empty()) return name != "applicable";
  bool found = false;
  for (std::size_t i = 0; i < request_.columns.size(); ++i) {
    const std::string& one = request_.columns[i];
    if (name != one && !(name.starts_with(one) && name.substr(one.size()).starts_with("/"))) continue;
    used_[i] = true;
    found = true;
  }
  known_.emplace_back(name);
  return found;
}

void ArrayMaker::add(ColumnWords words, std::vector<std::int64_t> shape, ColumnValues data) {
  ArrayColumn& column = arrays_.columns.emplace_back();
  column.name = std::move(words.name);
  column.unit = std::move(words.unit);
  column.frame = std::move(words.frame);
  column.labels = std::move(words.labels);
  column.rate_hz = words.rate_hz < 0 ? arrays_.frame_hz : words.rate_hz;
  column.shape = std::move(shape);
  column.data = std::move(data);
}

void ArrayMaker::add_rows(ColumnWords words, std::size_t width, std::vector<double> data) {
  add(std::move(words), {arrays_.frames, count_of(width)}, std::move(data));
}

void ArrayMaker::times() {
  if (wanted("time")) {
    std::vector<double> values;
    for (const std::int64_t step : tables_.step) values.push_back(static_cast<double>(step) / episode_.physics_hz);
    add({"time", "s"}, {arrays_.frames}, std::move(values));
  }
  if (wanted("step")) add({"step", ""}, {arrays_.frames}, tables_.step);
  if (wanted("reward")) add({"reward", ""}, {arrays_.frames}, tables_.reward);
  if (wanted("done")) add({"done", ""}, {arrays_.frames}, tables_.done);
}

void ArrayMaker::joints_of(const std::string& prefix, const std::vector<std::size_t>& places) {
  std::vector<std::string> labels;
  std::string unit = "rad", rate = "rad/s", force = "N m";
  bool mixed = false;
  for (const std::size_t place : places) {
    labels.push_back(episode_.scene.joints[place].name);
    mixed = mixed || episode_.scene.joints[place].unit != episode_.scene.joints[places.front()].unit;
  }
  if (mixed) unit = "rad or m", rate = "rad/s or m/s", force = "N m or N";
  if (!mixed && !places.empty() && episode_.scene.joints[places.front()].unit == "m")
    unit = "m", rate = "m/s", force = "N";
  const std::size_t width = episode_.scene.joints.size();
  const auto column = [&](const std::string& name, const std::string& own_unit, const std::vector<double>& table) {
    if (wanted(name)) add_rows({name, own_unit, "", labels}, places.size(), picked(table, width, places));
  };
  column(prefix + "joint_positions", unit, tables_.joint_position);
  column(prefix + "joint_velocities", rate, tables_.joint_velocity);
  column(prefix + "joint_forces", force, tables_.joint_effort);
}

void ArrayMaker::hands() {
  const std::size_t width = episode_.scene.hands.size() * FrameTables::kHand;
  for (std::size_t i = 0; i < episode_.scene.hands.size(); ++i) {
    const std::string prefix =
        i == 0 ? "gripper_" : episode_.scene.hands[i] + "/gripper_";  // the first has RLBench's names
    const std::size_t from = i * FrameTables::kHand;
    const auto wants = [&](const char* name) { return wanted(prefix + name); };
    if (wants("pose")) add_rows({prefix + "pose", "m, 1", "world", kPoseLabels}, 7, cut(tables_.hand, width, from, 7));
    if (wants("matrix"))
      add({prefix + "matrix", "m", "world"}, {arrays_.frames, 4, 4}, matrices(tables_.hand, width, from));
    if (wants("velocity"))
      add_rows({prefix + "velocity", "m/s, rad/s", "world", kTwistLabels}, 6, cut(tables_.hand, width, from + 7, 6));
    if (wants("opening")) add({prefix + "opening", "m"}, {arrays_.frames}, cut(tables_.hand, width, from + 13, 1));
    if (wants("touch_forces")) add_rows({prefix + "touch_forces", "N"}, 2, cut(tables_.hand, width, from + 14, 2));
  }
  if (fingers_.empty() || !wanted("gripper_open")) return;
  const JointName& finger = episode_.scene.joints[fingers_.front()];
  std::vector<double> open = picked(tables_.joint_position, episode_.scene.joints.size(), {fingers_.front()});
  for (double& value : open) value = (value - finger.lower) / (finger.upper - finger.lower) > kWideOpen ? 1 : 0;
  add({"gripper_open", ""}, {arrays_.frames}, std::move(open));
}

void ArrayMaker::objects() {
  const std::size_t width = episode_.scene.posed.size() * FrameTables::kPose;
  const std::size_t hand_width = episode_.scene.hands.size() * FrameTables::kHand;
  for (std::size_t i = 0; i < episode_.scene.posed.size(); ++i) {
    const std::string& name = episode_.scene.posed[i];
    if (wanted("object_pose/" + name))
      add_rows({"object_pose/" + name, "m, 1", "world", kPoseLabels}, 7,
               cut(tables_.object_pose, width, i * FrameTables::kPose, 7));
    if (hand_width == 0 || !wanted("object_pose_in_tool/" + name)) continue;
    std::vector<double> values;
    for (std::size_t row = 0; row < tables_.frames; ++row) {
      const Transform world_from_tip = transform_at(&tables_.hand[row * hand_width]);
      const double* own = &tables_.object_pose[row * width + i * FrameTables::kPose];
      const Pose pose = to_pose(world_from_tip.inverse() * transform_at(own));
      values.insert(values.end(), pose.position.begin(), pose.position.end());
      values.insert(values.end(), pose.quaternion.begin(), pose.quaternion.end());
    }
    add_rows({"object_pose_in_tool/" + name, "m, 1", "tool", kPoseLabels}, 7, std::move(values));
  }
}

void ArrayMaker::low_dimensional_state() {
  if (!wanted("task_low_dim_state")) return;
  std::vector<std::string> labels;
  for (const std::string& name : episode_.scene.posed)
    for (const std::string& part : kPoseLabels) labels.push_back(name + "." + part);
  for (const std::size_t joint : other_joints_) labels.push_back(episode_.scene.joints[joint].name);
  const std::size_t width = episode_.scene.posed.size() * FrameTables::kPose, joints = episode_.scene.joints.size();
  std::vector<double> values;
  values.reserve(tables_.frames * labels.size());
  for (std::size_t row = 0; row < tables_.frames; ++row) {
    for (std::size_t i = 0; i < width; ++i) values.push_back(tables_.object_pose[row * width + i]);
    for (const std::size_t joint : other_joints_) values.push_back(tables_.joint_position[row * joints + joint]);
  }
  const std::size_t columns = labels.size();
  add_rows({"task_low_dim_state", "m, 1; rad or m", "world", std::move(labels)}, columns, std::move(values));
}

void ArrayMaker::actions() {
  std::vector<std::string> joints;
  for (const std::size_t place : arm_) joints.push_back(episode_.scene.joints[place].name);
  if (wanted("action/joint_position"))
    add_rows({"action/joint_position", "rad", "", std::move(joints)}, tables_.commanded, tables_.action_joint_position);
  if (wanted("action/tool_pose"))
    add_rows({"action/tool_pose", "m, 1", "world", kPoseLabels}, 7, tables_.action_tool_pose);
  if (wanted("action/gripper")) add({"action/gripper", "m"}, {arrays_.frames}, tables_.action_gripper);
}

void ArrayMaker::sensors() {
  for (const ChannelRecord& channel : episode_.channels) {
    const std::int64_t rows = count_of(channel.steps.size());
    if (wanted("sensor_time/" + channel.name)) {
      std::vector<double> times;
      for (const std::int64_t step : channel.steps) times.push_back(static_cast<double>(step) / episode_.physics_hz);
      add({"sensor_time/" + channel.name, "s", "", {}, channel.rate_hz}, {rows}, std::move(times));
    }
    if (wanted("sensor/" + channel.name))
      add({"sensor/" + channel.name, channel.unit, "sensor", channel.components, channel.rate_hz},
          {rows, count_of(channel.components.size())}, channel.values);
  }
}

void ArrayMaker::cameras() {
  const std::size_t width = episode_.scene.cameras.size() * FrameTables::kPose;
  for (std::size_t i = 0; i < episode_.scene.cameras.size(); ++i) {
    const Camera& camera = episode_.scene.cameras[i];
    const std::string prefix = camera.name + "_camera_";
    if (wanted(prefix + "extrinsics"))
      add({prefix + "extrinsics", "m", "world"}, {arrays_.frames, 4, 4},
          matrices(tables_.camera_pose, width, i * FrameTables::kPose));
    if (wanted(prefix + "intrinsics"))
      add({prefix + "intrinsics", "pixel", "", {}, 0}, {3, 3},
          std::vector<double>{camera.focal_x, 0, camera.centre_x, 0, camera.focal_y, camera.centre_y, 0, 0, 1});
    if (wanted(prefix + "near")) add({prefix + "near", "m", "", {}, 0}, {}, std::vector<double>{camera.near_m});
    if (wanted(prefix + "far")) add({prefix + "far", "m", "", {}, 0}, {}, std::vector<double>{camera.far_m});
    const auto pictures = [&](const char* suffix, const char* type, const char* unit, bool colour) {
      const std::string name = camera.name + suffix;
      if (!wanted(name)) return;
      ArrayPictures& one = arrays_.pictures.emplace_back();
      one.name = name, one.camera = camera.name, one.type = type, one.unit = unit, one.frame = camera.name;
      one.shape = {arrays_.frames, camera.height, camera.width};
      if (colour) one.shape.push_back(3);
    };
    pictures("_rgb", "uint8", "", true);
    pictures("_depth", "float32", "m", false);
    pictures("_mask", "uint16", "", false);
    pictures("_semantic_mask", "uint16", "", false);
  }
}

EpisodeArrays ArrayMaker::make() {
  times();
  joints_of("", arm_);
  joints_of("gripper_", fingers_);
  hands();
  low_dimensional_state();
  objects();
  joints_of("object_", other_joints_);
  actions();
  agent_actions();
  labels();
  sensors();
  cameras();
  for (std::size_t i = 0; i < used_.size(); ++i)
    if (!used_[i])
      throw Error(request_.columns[i], "this episode has no column of that name",
                  did_you_mean(request_.columns[i], known_));
  return std::move(arrays_);
}

ArrayNeeds needs_of(const ArrayRequest& request) {
  ArrayNeeds needs;
  const bool all = request.columns.empty();
  const auto starts = [&](std::initializer_list<const char*> words) {
    return all || std::any_of(request.columns.begin(), request.columns.end(), [&](const std::string& column) {
             return std::any_of(words.begin(), words.end(), [&](const char* word) { return column.starts_with(word); });
           });
  };
  const auto ends = [&](const char* word) {
    return all || std::any_of(request.columns.begin(), request.columns.end(),
                              [&](const std::string& column) { return column.ends_with(word); });
  };
  needs.frames = starts({"time", "step", "reward", "done"});
  needs.joints = starts({"joint_", "object_joint_", "gripper_joint_", "gripper_open", "task_low_dim_state"});
  needs.objects = starts({"object_pose", "task_low_dim_state"});
  needs.hands = starts({"gripper_", "object_pose_in_tool"}) ||
                std::any_of(request.columns.begin(), request.columns.end(),
                            [](const std::string& column) { return column.find("/gripper_") != std::string::npos; });
  needs.cameras = ends("_camera_extrinsics");
  needs.actions = starts({"action"});
  needs.samples = starts({"sensor"});
  needs.facts = starts({"facts", "known", "progress", "applicable"});
  needs.agent = starts({"agent_"});
  needs.segments = starts({"subgoal", "skill", "motion"});
  needs.documents = starts({"progress", "applicable"});
  needs.pictures = ends("_rgb") || ends("_depth") || ends("_mask");
  return needs;
}

EpisodeArrays arrays_of(const EpisodeRecord& labels, const FrameTables& tables, const ArrayRequest& request) {
  return ArrayMaker(labels, tables, request).make();
}

void set_stored(EpisodeArrays& arrays, const std::string& camera, const std::string& kind,
                std::vector<std::int64_t> frames) {
  for (ArrayPictures& one : arrays.pictures) {
    const PictureRequest request = one.request();
    const bool same = (kind == "rgb" && request.rgb) || (kind == "depth" && request.depth) ||
                      (kind == "instance" && request.instance) || (kind == "semantic" && request.semantic);
    if (one.camera == camera && same) one.stored = std::move(frames);
  }
}

EpisodeArrays episode_arrays(const EpisodeRecord& episode, const ArrayRequest& request) {
  EpisodeArrays arrays = arrays_of(episode, frame_tables(episode), request);
  if (!episode.images) return arrays;
  std::map<std::pair<int, std::string>, std::vector<std::int64_t>> stored;
  for (std::size_t i = 0; i < episode.images->count(); ++i) {
    const ImageRecord& image = episode.images->record(i);
    stored[{image.camera, image.kind}].push_back(image.frame);
  }
  for (auto& [which, frames] : stored)
    set_stored(arrays, episode.scene.cameras.at(static_cast<std::size_t>(which.first)).name, which.second,
               std::move(frames));
  return arrays;
}

}  // namespace stampede
