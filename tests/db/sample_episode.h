// A made-up episode in which every field of the record has a value that would be missed.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "engine/record/observation.h"

namespace stampede::test {

struct SampleSize {
  int frames = 12, joints = 3, objects = 2;
};
EpisodeRecord real_episode();  // with gaps, labels and streams
EpisodeRecord sample_episode(const std::string& task, const std::string& variation, std::int64_t seed,
                             const SampleSize& size = {});

// Made-up pictures: `kinds` of each camera at each frame listed. The bytes differ by frame, camera, kind and seed.
std::shared_ptr<ImageStore> sample_images(const EpisodeRecord& episode, const std::vector<std::int64_t>& frames,
                                          const std::vector<std::string>& kinds = {"rgb", "depth", "instance"},
                                          std::size_t bytes = 600);

inline const EngineInfo kEngine{"0.1.0", "probe"};

// A folder of its own that goes with the test.
class Folder {
 public:
  Folder();
  ~Folder();
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string bytes_of(const std::filesystem::path& file);                      // it must be there
void change(const std::filesystem::path& catalogue, const std::string& sql);  // as any program could, past Catalogue

// The catalogues in tests/db/data: `schema5.db.gz` was made by release 5, and so on.
std::vector<std::filesystem::path> stored_releases();
void unpack(const std::filesystem::path& packed, const std::filesystem::path& to);

}  // namespace stampede::test
