// What `check --physics --why` tells of failed steps: how often, of what, how near it came, and a picture.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "db/query.h"
#include "engine/base/output_file.h"
#include "engine/record/record.h"
#include "engine/start/impasse.h"

namespace stampede::program {

// Undone tries count too: what stands first is the bottleneck. Repeatable: in whatever order workers tell, and by
// however many.
class FailedSteps {
 public:
  void add(const Impasse& impasse);  // from any thread
  void add(const EpisodeRecord& episode);
  // One picture a step that found no grasp or place, into the folder, which is made. Throws Error: it cannot be
  // written.
  void draw(const std::filesystem::path& folder, const OutputRules& rules);
  QueryResult table() const;

 private:
  using Key = std::tuple<std::string, std::string, std::string>;  // task, step, reason
  struct Step {
    std::int64_t times = 0, looked = 0;
    std::map<std::string, std::int64_t> details;
    std::map<std::string, std::pair<std::int64_t, std::optional<Looked>>> causes;  // how often, and the nearest miss
    std::optional<Looked> nearest;
    std::optional<Impasse> first;  // of the least seed
    std::string picture;
  };
  std::string why(const Step& step) const;

  std::mutex mutex_;
  std::map<Key, Step> steps_;
  std::set<std::tuple<std::string, std::string, std::int64_t>> starts_;  // that told of an impasse
};

// Ghosts of the hand, or of the object, in the scene of that moment, with a legend: red touches something, grey is out
// of reach, orange fails otherwise, green would do. `file`: PNG. Throws Error.
void draw_impasse(const Impasse& impasse, const std::filesystem::path& file, const OutputRules& rules);

}  // namespace stampede::program
