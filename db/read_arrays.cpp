// An episode as arrays, straight from the tables: each is read once, in the order of its key, and only where a wanted
// column needs it.
#include <algorithm>
#include <cmath>
#include <limits>

#include "db/check_numbers.h"
#include "db/episode_reader.h"
#include "engine/record/arrays.h"

namespace stampede {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Columns of a row from `first` on.
void take(const sql::Statement& row, int first, std::size_t count, double* to) {
  for (std::size_t i = 0; i < count; ++i) to[i] = known_or_nan(row, first + static_cast<int>(i));
}

class ArrayReader : private EpisodeReader {
 public:
  using EpisodeReader::EpisodeReader;
  EpisodeArrays read(const ArrayRequest& request);

 private:
  // So many items a frame, each so wide.
  struct ItemTable {
    std::vector<double>& values;
    std::size_t items, width;
    const char* name;
  };
  double* slot(const ItemTable& table, std::int64_t frame, std::int64_t which) const;
  void read_head();
  void read_frame_rows();
  void read_joint_rows();
  void read_hand_rows();
  void read_pose_rows(const std::string& which, const char* table, std::size_t items, std::vector<double>& poses);
  void read_action_rows();
  void read_segment_heads();
  void read_stored_pictures(EpisodeArrays& arrays);
  FrameTables tables_;
};

// Where an item of a frame is.
double* ArrayReader::slot(const ItemTable& table, std::int64_t frame, std::int64_t which) const {
  const auto row = static_cast<std::size_t>(frame), item = static_cast<std::size_t>(which);  // huge where negative
  if (row >= tables_.frames || item >= table.items || table.width == 0) damaged(table.name);
  return &table.values[(row * table.items + item) * table.width];
}

void ArrayReader::read_head() {
  sql::Statement row(database_,
                     "SELECT task, coalesce(variation, ''), coalesce(seed, 0), physics_hz, frame_hz, frames, "
                     "(SELECT count(*) FROM frame f WHERE f.episode = e.id), "
                     "(SELECT count(*) FROM action_channel a WHERE a.episode = e.id AND a.space = 'joint_position'), "
                     "source = 'real' "
                     "FROM episode e WHERE id = ?1");
  if (!row.start(id_).step()) throw_no_episode(database_, id_);
  std::int64_t frames = 0, rows = 0, commanded = 0;
  row.read(record_.task, record_.variation, record_.seed, record_.physics_hz, record_.frame_hz, frames, rows, commanded,
           record_.real);
  if (frames != rows || record_.physics_hz < 1 || record_.frame_hz < 1 || record_.frame_hz > record_.physics_hz ||
      record_.physics_hz > kMostHz)
    damaged("episode");
  tables_.frames = static_cast<std::size_t>(frames);
  tables_.commanded = static_cast<std::size_t>(commanded);
}

void ArrayReader::read_frame_rows() {
  each("step, reward, done", "frame", "frame", [&](sql::Statement& row) {
    double reward = 0;
    bool done = false;
    row.read(tables_.step.emplace_back(), reward, done);
    tables_.reward.push_back(known_or_nan(row, 1));
    tables_.done.push_back(done ? 1 : 0);
  });
  if (tables_.step.size() != tables_.frames) damaged("frame");
}

void ArrayReader::read_joint_rows() {
  const std::size_t joints = record_.scene.joints.size();
  for (auto* table : {&tables_.joint_position, &tables_.joint_velocity, &tables_.joint_effort})
    table->assign(tables_.frames * joints, kUnknown);
  each("frame, part, " + numbered("position", kJointsARow) + ", " + numbered("velocity", kJointsARow) + ", " +
           numbered("effort", kJointsARow),
       "joint_state", "frame, part", [&](sql::Statement& row) {
         std::int64_t frame = 0;
         std::size_t part = 0;
         row.read(frame, part);
         int column = 2;
         for (auto* table : {&tables_.joint_position, &tables_.joint_velocity, &tables_.joint_effort}) {
           const std::span<double> all(slot({*table, 1, joints, "joint_state"}, frame, 0), joints);
           take_values(row, column, part_in(all, part, kJointsARow, "joint_state"), "joint_state");
           column += static_cast<int>(kJointsARow);
         }
       });
}

void ArrayReader::read_hand_rows() {
  constexpr std::size_t kWidth = FrameTables::kHand;
  const std::size_t hands = record_.scene.hands.size();
  tables_.hand.assign(tables_.frames * hands * kWidth, kUnknown);
  each("frame, hand, " + std::string(kPoseColumns) +
           ", linear_x, linear_y, linear_z, angular_x, angular_y, angular_z, opening, touch_1, touch_2",
       "hand_state", "frame, hand", [&](sql::Statement& row) {
         const std::int64_t frame = sqlite3_column_int64(row.handle(), 0), hand = sqlite3_column_int64(row.handle(), 1);
         take(row, 2, kWidth, slot({tables_.hand, hands, kWidth, "hand_state"}, frame, hand));
       });
}

// Rows are there where a pose changed: what lies between two of them is filled once.
void ArrayReader::read_pose_rows(const std::string& which, const char* table, std::size_t items,
                                 std::vector<double>& poses) {
  constexpr std::size_t kWidth = FrameTables::kPose;
  poses.assign(tables_.frames * items * kWidth, kUnknown);
  each(which + ", frame, " + kPoseColumns, table, which + ", frame", [&](sql::Statement& row) {
    const std::int64_t item = sqlite3_column_int64(row.handle(), 0), frame = sqlite3_column_int64(row.handle(), 1);
    take(row, 2, kWidth, slot({poses, items, kWidth, table}, frame, item));
  });
  const std::size_t stride = items * kWidth;
  for (std::size_t i = stride; i < poses.size(); i += kWidth)
    if (std::isnan(poses[i])) std::copy_n(&poses[i - stride], kWidth, &poses[i]);
}

void ArrayReader::read_action_rows() {
  constexpr std::size_t kWidth = FrameTables::kPose;
  const std::size_t joints = tables_.commanded;
  tables_.action_joint_position.assign(tables_.frames * joints, kUnknown);
  tables_.action_tool_pose.assign(tables_.frames * kWidth, kUnknown);
  tables_.action_gripper.assign(tables_.frames, kUnknown);
  const std::vector<ActionChannel> channels = read_action_channels();
  each("frame, part, " + numbered("value", kChannelsARow), "action", "frame, part", [&](sql::Statement& row) {
    std::int64_t frame = 0;
    std::size_t part = 0;
    row.read(frame, part);
    each_channel(row, part, channels, [&](const ActionChannel& channel, double value) {
      const auto put = [&](std::vector<double>& table, std::size_t width) {
        *slot({table, width, 1, "action"}, frame, static_cast<std::int64_t>(channel.component)) = value;
      };
      if (channel.space == "joint_position") put(tables_.action_joint_position, joints);
      if (channel.space == "tool_pose") put(tables_.action_tool_pose, kWidth);
      if (channel.space == "gripper") put(tables_.action_gripper, 1);
    });
  });
}

void ArrayReader::read_segment_heads() {
  each(
      "ordinal, coalesce(parent, -1), kind, skill, case_name, arguments, first_frame, end_frame, outcome, reason, "
      "label",
      "(SELECT * FROM segment WHERE undone = 0)", "ordinal", [&](sql::Statement& row) {
        SegmentRecord& s = record_.labels.segments.emplace_back();
        std::string kind, arguments, outcome, reason;
        row.read(s.ordinal, s.parent, kind, s.skill, s.case_name, arguments, s.span.first_frame, s.span.end_frame,
                 outcome, reason, s.label);
        s.kind = known_word(database_, "kind", kind, segment_kind_from(kind));
        s.arguments = from_json_list(database_, arguments);
        s.outcome = known_word(database_, "outcome", outcome, outcome_from(outcome));
        s.reason = known_word(database_, "reason", reason, reason_from(reason));
      });
}

void ArrayReader::read_stored_pictures(EpisodeArrays& arrays) {
  std::map<std::pair<std::string, std::string>, std::vector<std::int64_t>> stored;
  each("camera, kind, frame", "image", "frame", [&](sql::Statement& row) {
    std::int64_t camera = 0, frame = 0;
    std::string kind;
    row.read(camera, kind, frame);
    if (frame < 0 || frame >= static_cast<std::int64_t>(tables_.frames)) damaged("image");
    stored[{at(record_.scene.cameras, camera, "image").name, kind}].push_back(frame);
  });
  for (auto& [which, frames] : stored) set_stored(arrays, which.first, which.second, std::move(frames));
}

EpisodeArrays ArrayReader::read(const ArrayRequest& request) {
  const ArrayNeeds needs = needs_of(request);
  read_head();
  read_names();
  read_cameras();
  if (needs.samples) {
    read_channels();
    for (const ChannelRecord& channel : record_.channels)
      if (channel.values.size() != channel.steps.size() * channel.components.size()) damaged("sample");
  }
  if (needs.frames) read_frame_rows();
  if (needs.joints) read_joint_rows();
  if (needs.hands) read_hand_rows();
  if (needs.objects) read_pose_rows("posed", "object_state", record_.scene.posed.size(), tables_.object_pose);
  if (needs.cameras) read_pose_rows("camera", "camera_pose", record_.scene.cameras.size(), tables_.camera_pose);
  if (needs.actions) read_action_rows();
  if (needs.agent) read_agent_actions();
  if (needs.segments) read_segment_heads();
  if (needs.facts) read_facts();
  if (needs.documents) read_documents();
  EpisodeArrays arrays = arrays_of(record_, tables_, request);
  if (needs.pictures) read_stored_pictures(arrays);
  return arrays;
}

}  // namespace

EpisodeArrays read_arrays(const sql::Database& database, std::int64_t id, const ArrayRequest& request) {
  return ArrayReader(database, id).read(request);
}

EpisodeArrays Catalogue::read_arrays(std::int64_t id, const ArrayRequest& request) const {
  return stampede::read_arrays(impl_->database, id, request);
}

}  // namespace stampede
