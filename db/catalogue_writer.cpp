#include "db/catalogue_writer.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "db/episode_writer.h"
#include "engine/episode/observation.h"

namespace stampede {
namespace {

constexpr std::size_t kImagesInMemory = 8'000'000;  // the rest of an ImageStore lies in a file

std::int64_t bytes_of(const EpisodeRecord& episode) {
  std::size_t frame = sizeof(FrameRecord) + sizeof(ActionRecord);
  frame += episode.joints.size() * 4 * sizeof(double) + episode.posed.size() * sizeof(Pose);
  frame += episode.hands.size() * sizeof(HandRecord) + episode.cameras.size() * sizeof(Pose);
  std::size_t bytes = episode.frames.size() * frame + episode.scene_document.size();
  for (const Command& command : episode.commands) {
    bytes += sizeof(Command);
    if (const auto* follow = std::get_if<operation::Follow>(&command.operation))
      bytes += follow->trajectory.knots.size() * 200;
  }
  for (const DefinitionRecord& definition : episode.definitions) bytes += definition.source.size();
  for (const DocumentRecord& document : episode.documents) bytes += document.text.size();
  for (const ChannelRecord& channel : episode.channels) bytes += channel.values.size() * sizeof(double);
  if (episode.images) bytes += std::min(static_cast<std::size_t>(episode.images->bytes()), kImagesInMemory);
  return static_cast<std::int64_t>(bytes) + 400 * static_cast<std::int64_t>(episode.facts.size());
}

// Of episodes stored since the last call, another run's too: it may write to the same file.
std::vector<std::string> keys_after(const Catalogue& catalogue, std::int64_t& last_id) {
  std::vector<std::string> keys;
  for (const auto& row : catalogue.query("SELECT id, key FROM episode WHERE id > ?1", {{last_id}, 0}).rows) {
    last_id = std::max(last_id, std::get<std::int64_t>(row[0]));
    keys.push_back(std::get<std::string>(row[1]));
  }
  return keys;
}

}  // namespace

struct CatalogueWriter::Impl {
  struct Waiting {
    EpisodeRecord episode;
    std::int64_t bytes = 0;
  };

  Impl(const std::filesystem::path& path, CatalogueWriterOptions chosen)
      : options(std::move(chosen)), catalogue(Catalogue::write(path)) {
    for (std::string& key : keys_after(catalogue, last_seen)) known.insert(std::move(key));
  }

  // What can be committed now; all calls hold the mutex.
  std::map<std::int64_t, Waiting>::iterator next_ready() {
    while (!gone.empty() && *gone.begin() == next) {
      gone.erase(gone.begin());
      ++next;
    }
    if (waiting.empty()) return waiting.end();
    const auto first = waiting.begin();
    return ending || first->first == next ? first : waiting.end();
  }

  void write_all();
  void write_one(std::unique_lock<std::mutex>& lock, std::map<std::int64_t, Waiting>::iterator ready);

  CatalogueWriterOptions options;
  Catalogue catalogue;         // of the writing thread once that runs
  std::int64_t last_seen = 0;  // greatest id whose key is known
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::set<std::string, std::less<>> known;  // keys that are stored or received
  std::set<std::int64_t> gone;               // places from `next` on that were abandoned or committed
  std::map<std::int64_t, Waiting> waiting;   // by place
  std::int64_t next = 0;                     // first place that is neither committed nor abandoned
  std::int64_t queued = 0;
  bool ending = false;
  std::exception_ptr failure;
  std::thread thread;
};

void CatalogueWriter::Impl::write_one(std::unique_lock<std::mutex>& lock,
                                      std::map<std::int64_t, Waiting>::iterator ready) {
  gone.insert(ready->first);
  const Waiting item = std::move(ready->second);
  waiting.erase(ready);
  lock.unlock();
  const std::optional<std::int64_t> id = catalogue.add_if_new(item.episode, options.engine);
  if (id && options.committed) options.committed(*id, item.episode);
  std::vector<std::string> others = keys_after(catalogue, last_seen);
  lock.lock();
  known.insert(std::make_move_iterator(others.begin()), std::make_move_iterator(others.end()));
  queued -= item.bytes;
  changed.notify_all();
}

void CatalogueWriter::Impl::write_all() {
  std::unique_lock lock(mutex);
  try {
    while (true) {
      changed.wait(lock, [&] { return ending || next_ready() != waiting.end(); });
      const auto ready = next_ready();
      if (ready == waiting.end()) return;  // ending
      write_one(lock, ready);
    }
  } catch (...) {
    if (!lock.owns_lock()) lock.lock();
    failure = std::current_exception();
    changed.notify_all();
  }
}

CatalogueWriter::CatalogueWriter(const std::filesystem::path& path, CatalogueWriterOptions options)
    : impl_(std::make_unique<Impl>(path, std::move(options))) {
  impl_->thread = std::thread([this] { impl_->write_all(); });
}

CatalogueWriter::~CatalogueWriter() {
  try {
    finish();
  } catch (...) {  // a destructor cannot say; finish() does
  }
}

bool CatalogueWriter::has(std::string_view key) const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->known.contains(key);
}

void CatalogueWriter::finished(std::int64_t place, EpisodeRecord episode) {
  if (episode.reason == Reason::interrupted) return abandon(place);
  check_record(episode);  // here, where the fault is, not in the writing thread
  const std::int64_t bytes = bytes_of(episode);
  std::unique_lock lock(impl_->mutex);
  if (!impl_->known.insert(episode.key).second) {
    impl_->gone.insert(place);
    return impl_->changed.notify_all();
  }
  impl_->changed.wait(lock, [&] {
    impl_->next_ready();
    return impl_->failure || place == impl_->next || impl_->queued == 0 ||
           impl_->queued + bytes <= impl_->options.queue_bytes;
  });
  if (impl_->failure) std::rethrow_exception(impl_->failure);
  impl_->queued += bytes;
  impl_->waiting.emplace(place, Impl::Waiting{std::move(episode), bytes});
  impl_->changed.notify_all();
}

void CatalogueWriter::abandon(std::int64_t place) {
  const std::lock_guard lock(impl_->mutex);
  if (place < impl_->next || impl_->waiting.contains(place)) return;
  impl_->gone.insert(place);
  impl_->changed.notify_all();
}

void CatalogueWriter::finish() {
  if (!impl_->thread.joinable()) return;
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->ending = true;
    impl_->changed.notify_all();
  }
  impl_->thread.join();
  const std::exception_ptr failure = impl_->failure;
  try {
    impl_->catalogue.close();
  } catch (...) {
    if (!failure) throw;
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace stampede
