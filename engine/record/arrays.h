// An episode as named arrays, from a record in memory or from tables that were read from elsewhere.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/record/frame_tables.h"
#include "engine/record/record.h"
#include "engine/render/picture.h"
#include "stampede/arrays.h"

namespace stampede {

// Throws Error for a column that this episode does not have, with the nearest name as cure. Repeatable: the columns and
// their order depend on the episode and the request alone.
EpisodeArrays episode_arrays(const EpisodeRecord& episode, const ArrayRequest& request = {});

// The same from what a catalogue holds. `labels`: the episode without its frames, and of the rest what `needs_of` asks
// for. `tables.frames` and `tables.commanded` always count.
EpisodeArrays arrays_of(const EpisodeRecord& labels, const FrameTables& tables, const ArrayRequest& request);

// Which parts of an episode the wanted columns are made of; what is false need not be read.
struct ArrayNeeds {
  bool frames = false, joints = false, objects = false, hands = false, cameras = false, actions = false;
  bool samples = false, facts = false, segments = false, agent = false, documents = false, pictures = false;
};
ArrayNeeds needs_of(const ArrayRequest& request);

// What a picture's column says: `front_rgb` is {front, rgb}. Nothing: it is none, by its ending.
struct PictureColumn {
  std::string camera;
  PictureKind kind = PictureKind::rgb;
};
std::optional<PictureColumn> picture_column(std::string_view name);

// Sets which frames of a camera have stored pictures of a kind: rgb depth instance semantic.
void set_stored(EpisodeArrays& arrays, const std::string& camera, const std::string& kind,
                std::vector<std::int64_t> frames);

// Of the columns of `now`, each of which `stored` must have: the earliest row that differs, in words. Empty: none does.
// Every bit counts but the sign of zero, which SQLite does not keep.
std::string first_difference(const EpisodeArrays& stored, const EpisodeArrays& now);

}  // namespace stampede
