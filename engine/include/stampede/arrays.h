// One episode as named arrays: what learners, exporters and other languages read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "stampede/action.h"
#include "stampede/basics.h"
#include "stampede/picture.h"
#include "stampede/world_state.h"

namespace stampede {

// One array. Shapes: `shape` starts with the number of rows (frames, or samples of a sensor); a constant (rate_hz 0)
// has no rows. `data` is contiguous, the last index fastest. Units: `unit`, or one of each kind (`m, 1` for a pose:
// metres, then a quaternion). What is not known is NaN, or -1 in a column of ids.
struct STAMPEDE_EXPORT ArrayColumn {
  std::string name;                      // joint_positions, object_pose/cup …: engine/episode/README.md has them all
  std::vector<std::int64_t> shape;       // for numpy and its like
  std::string unit;                      // empty: none
  std::string frame = {};                // of reference: world, tool, or a name; empty: none
  double rate_hz = 0;                    // of the rows; 0: a constant
  std::vector<std::string> labels = {};  // of the last axis: joints, components, atoms; empty: see the unit
  std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::uint8_t>> data = {};

  std::string_view type() const;  // float64 int64 bool; a bool is one byte, 0 or 1
  // Throws Error when the column is of another type. Lifetime: the column's.
  std::span<const double> reals() const;
  std::span<const std::int64_t> integers() const;
  std::span<const std::uint8_t> booleans() const;
};

// What the columns `subgoal`, `skill` and `motion` count: a labelled stretch of the episode.
struct ArraySegment {
  std::int64_t id = 0, parent = -1;  // -1: none
  std::string kind;                  // subgoal skill motion
  std::string name, case_name;       // of the subgoal, skill or robot call
  std::vector<std::string> arguments;
  std::int64_t first_frame = 0, end_frame = 0;  // half-open
  bool success = true;
  std::string reason, label;  // why it failed; `pick up the red block`
};

// What one camera sees, at every frame. Nothing is drawn yet: Session::picture(episode, frame, pictures.request()) is
// the array of one frame. Shapes: shape is that of all frames together.
struct STAMPEDE_EXPORT ArrayPictures {
  std::string name;                 // front_rgb front_depth front_mask front_point_cloud
  std::string camera, type;         // uint8, float32, uint16
  std::vector<std::int64_t> shape;  // frames, height, width, channels where there are more than one
  std::string unit, frame;
  std::vector<std::int64_t> stored;  // frames whose picture the catalogue keeps
  PictureRequest request() const;
};

struct STAMPEDE_EXPORT EpisodeArrays {
  std::string task, variation;
  std::int64_t seed = 0;
  std::int64_t frames = 0;
  double frame_hz = 0;
  std::vector<ArrayColumn> columns;
  std::vector<StateFact> atoms;            // of `facts` and `known`, in the order of their last axis
  std::vector<ArraySegment> segments;      // by id
  std::vector<AskedAction> agent_actions;  // what `agent_action` counts, by id
  std::vector<StateFact> skills;           // of `applicable`: name of the action and its arguments
  std::vector<ArrayPictures> pictures;     // those that can be drawn

  const ArrayColumn* find(std::string_view name) const;    // nullptr: there is none
  const ArrayColumn& column(std::string_view name) const;  // throws Error with the nearest name as cure
  // Where an object was as seen from another, or from a camera: `object_pose` from it. Shapes: frames x 7. Throws Error
  // when the poses of the two were not asked for.
  ArrayColumn pose_in(const std::string& object, const std::string& reference) const;
};

// Names of columns, or of groups: `object_pose` is all object_pose/NAME. Empty: all but `applicable`, which costs more
// than all others together. What is not asked for is not read.
struct ArrayRequest {
  std::vector<std::string> columns = {};
};

}  // namespace stampede
