// Finished episodes of a run, from any number of threads to who keeps them, one by one in a fixed order.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/record/record.h"

namespace stampede {

// Where a run's episodes go. Each has a place, 0, 1, 2 …, and is kept in that order; each place is finished or
// abandoned once. Start the work on them in this order: then a full queue can never hold up the next in line. Lifetime:
// called from any thread.
class EpisodeSink {
 public:
  virtual ~EpisodeSink() = default;
  virtual bool has(std::string_view key) const = 0;  // kept already, or received
  // One whose key is there, or that was interrupted, leaves no trace. Throws why episodes cannot be kept any more.
  virtual void finished(std::int64_t place, EpisodeRecord episode) = 0;
  virtual void abandon(std::int64_t place) = 0;  // it will not come: do not wait for it
};

// One that hands them to a thread of its owner's.
class EpisodeQueue final : public EpisodeSink {
 public:
  // `bytes`: of episodes that wait. A full queue makes finished() wait; one of no bytes lets it return once the episode
  // has been kept.
  explicit EpisodeQueue(std::int64_t bytes = kBytes);

  static constexpr std::int64_t kBytes = 512'000'000;

  bool has(std::string_view key) const override;
  void finished(std::int64_t place, EpisodeRecord episode) override;
  void abandon(std::int64_t place) override;

  void know(std::vector<std::string> keys);  // of episodes that are there
  void end();                                // no more will come
  void fail(std::exception_ptr why);         // what finished() throws from now on; what it was given is received

  struct Finished {
    std::int64_t place = 0;
    EpisodeRecord episode;
  };
  // Waits for the next in line; once all has come, gives what is left over the gaps. Nothing: that was all.
  std::optional<Finished> next();

 private:
  struct Waiting {
    EpisodeRecord episode;
    std::int64_t bytes = 0;
  };
  std::map<std::int64_t, Waiting>::iterator ready();  // what can be given now

  std::int64_t bytes_;
  mutable std::mutex mutex_;  // held by all that touches the rest
  std::condition_variable changed_;
  std::set<std::string, std::less<>> known_;  // keys of episodes that are kept or received
  std::set<std::int64_t> gone_;               // places from `next_` on that were abandoned or given
  std::map<std::int64_t, Waiting> waiting_;   // by place
  std::int64_t next_ = 0;                     // first place that is neither given nor abandoned
  std::int64_t queued_ = 0, given_ = 0;       // bytes: of all, and of the one that its keeper is busy with
  bool ending_ = false;
  std::exception_ptr failure_;
};

}  // namespace stampede
