// Writes what happened, in words: segments, facts, passages, sentences, documents.
#pragma once

#include <optional>

#include "db/catalogue.h"
#include "db/sqlite.h"

namespace stampede {

class LabelWriter {
 public:
  explicit LabelWriter(const sql::Database& database);
  void write(std::int64_t id, const EpisodeRecord& episode);
  // What people and models say of a real episode, in place of what was said. Throws Error for others.
  void replace(std::int64_t id, const EpisodeRecord& episode);

 private:
  // What the rows of a segment are found by, and of one that was undone where it was tried.
  struct SegmentPlace {
    std::int64_t episode = 0;
    bool undone = false;
    int ordinal = 0, try_number = 0;
    std::optional<std::int64_t> was_ordinal = {}, before_segment = {};
  };
  void write_segments(std::int64_t id, const EpisodeRecord& episode);
  void write_segment(const SegmentPlace& at, const SegmentRecord& segment);
  void write_parameters(const SegmentPlace& at, const SegmentRecord& segment);
  void write_preconditions(const SegmentPlace& at, const SegmentRecord& segment);
  void write_effects(const SegmentPlace& at, const SegmentRecord& segment);
  void write_facts(std::int64_t id, const EpisodeRecord& episode);     // and what follows from them
  void write_passages(std::int64_t id, const EpisodeRecord& episode);  // vias, contacts, grasps
  void write_sentences(std::int64_t id, const EpisodeRecord& episode);
  void write_documents(std::int64_t id, const EpisodeRecord& episode);  // and verdicts
  void write_keyframes(std::int64_t id, const EpisodeRecord& episode);

  const sql::Database& database_;
  sql::Statement segment_, parameter_, precondition_, effect_, effects_held_, undeclared_, via_, fact_, observed_fact_,
      contact_, grasp_, language_, text_store_, document_, verdict_, keyframe_;
};

}  // namespace stampede
