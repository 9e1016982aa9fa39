// What people or models say happened: segments, facts and sentences, from JSON or CSV. See README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "db/recording/recording_file.h"
#include "db/recording/resample.h"
#include "engine/record/record.h"

namespace stampede {

struct Labels {
  std::vector<SegmentRecord> segments;  // as an episode holds them: by start, then depth, with parents
  std::vector<FactRecord> facts;
  std::vector<LanguageRecord> language;
};

// Of labels that lie in their recording: `clock` may be used, and frames are those of the recording's own frame_hz,
// whatever the rate at which it is imported. Without a recording they are the episode's.
struct LabelClock {
  const RecordingFile* recording = nullptr;
  FrameTimes frames;
};

// For an episode of these frames, steps and rates. Throws Error, with the line or the place in the JSON: unknown kinds
// and fields, spans that are empty, lie beyond the end, overlap another of their kind or cross one that they are part
// of.
Labels read_labels(const std::filesystem::path& file, const std::string& shown, const EpisodeRecord& episode,
                   const LabelClock& clock = {});

// Takes the place of what the episode has of each sort; of what the labels have none, all stays.
void put_labels(Labels labels, EpisodeRecord& episode);

}  // namespace stampede
