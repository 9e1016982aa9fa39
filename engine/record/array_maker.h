// Cuts the columns of EpisodeArrays from tables and labels, one group after the other. Inside this room only.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/record/arrays.h"

namespace stampede {

inline const std::vector<std::string> kPoseLabels = {"x", "y", "z", "qx", "qy", "qz", "qw"};
inline const std::vector<std::string> kTwistLabels = {"linear_x",  "linear_y",  "linear_z",
                                                      "angular_x", "angular_y", "angular_z"};

class ArrayMaker {
 public:
  // Lifetime: refers to its arguments.
  ArrayMaker(const EpisodeRecord& episode, const FrameTables& tables, const ArrayRequest& request);
  EpisodeArrays make();  // once

 private:
  using ColumnValues = decltype(ArrayColumn::data);
  struct ColumnWords {
    std::string name, unit, frame = {};
    std::vector<std::string> labels = {};
    double rate_hz = -1;  // less than 0: a row a frame
  };
  bool wanted(std::string_view name);
  void add(ColumnWords words, std::vector<std::int64_t> shape, ColumnValues data);
  void add_rows(ColumnWords words, std::size_t width, std::vector<double> data);  // a row a frame

  void times();
  void joints_of(const std::string& prefix, const std::vector<std::size_t>& places);
  void hands();
  void low_dimensional_state();
  void objects();
  void actions();
  void sensors();
  void cameras();
  void labels();  // facts, segments, progress: array_labels.cpp
  void facts();
  void goal();
  void segments();
  void agent_actions();  // array_agent.cpp
  void asked_ids();
  void asked_values();
  void asked_openings();
  void asked_rewards();

  const EpisodeRecord& episode_;
  const FrameTables& tables_;
  const ArrayRequest& request_;
  std::vector<bool> used_;                                 // of the request's columns
  std::vector<std::string> known_;                         // all names, for messages
  std::vector<std::size_t> arm_, fingers_, other_joints_;  // places in EpisodeScene::joints
  std::vector<std::uint8_t> rows_;                         // frames x atoms: which hold
  EpisodeArrays arrays_;
};

}  // namespace stampede
