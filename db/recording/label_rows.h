// Labels as they stand in a file, whatever its form. Inside this room only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "db/recording/label_file.h"

namespace stampede {

// Seconds from frame 0, or frames; nothing: not said.
struct LabelSpan {
  std::optional<double> start_s, end_s;
  std::optional<std::int64_t> first_frame, end_frame;
  bool given() const { return start_s || end_s || first_frame || end_frame; }
};

struct LabelRow {
  std::string place;  // for complaints
  std::string kind;   // subgoal skill motion fact language
  std::string name;   // of the segment; predicate; level of the sentence
  std::vector<std::string> arguments;
  LabelSpan span;
  std::string outcome = "success", reason, text;
  std::string labelled_by = "person", model, grain;
  std::optional<std::int64_t> segment;  // of a sentence: which of the file's segments
};

std::vector<LabelRow> label_rows(const std::filesystem::path& file, const std::string& shown, const LabelClock& clock);

}  // namespace stampede
