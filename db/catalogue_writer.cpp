#include "db/catalogue_writer.h"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <set>
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

}  // namespace

struct CatalogueWriter::Impl {
  struct Waiting {
    EpisodeRecord episode;
    std::int64_t bytes = 0;
  };

  Impl(const std::filesystem::path& path, CatalogueWriterOptions chosen)
      : options(std::move(chosen)), catalogue(Catalogue::write(path)) {
    for (const EpisodeSummary& episode : catalogue.episodes()) known.insert(episode.key);
  }

  // What can be committed now; all calls hold the mutex.
  std::map<std::size_t, Waiting>::iterator next_ready() {
    while (next < order.size() && gone.contains(next)) ++next;
    if (waiting.empty()) return waiting.end();
    const auto first = waiting.begin();
    return ending || first->first <= next ? first : waiting.end();
  }

  void write_all();
  void write_one(std::unique_lock<std::mutex>& lock, std::map<std::size_t, Waiting>::iterator ready);

  CatalogueWriterOptions options;
  Catalogue catalogue;  // of the writing thread once that runs
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::set<std::string, std::less<>> known;               // keys that are stored or received
  std::vector<EpisodeIdentity> order;                     // announced, in order of commits
  std::map<std::string, std::size_t, std::less<>> place;  // key -> index in order
  std::set<std::size_t> gone;                             // abandoned or committed
  std::map<std::size_t, Waiting> waiting;                 // by place
  std::vector<Waiting> unannounced;
  std::size_t next = 0;  // first place that is neither committed nor abandoned
  std::int64_t queued = 0;
  bool ending = false;
  std::exception_ptr failure;
  std::thread thread;
};

void CatalogueWriter::Impl::write_one(std::unique_lock<std::mutex>& lock,
                                      std::map<std::size_t, Waiting>::iterator ready) {
  Waiting item;
  if (!unannounced.empty()) {
    item = std::move(unannounced.front());
    unannounced.erase(unannounced.begin());
  } else {
    gone.insert(ready->first);
    item = std::move(ready->second);
    waiting.erase(ready);
  }
  lock.unlock();
  const std::int64_t id = catalogue.add(item.episode, options.engine);
  if (options.committed) options.committed(id, item.episode);
  lock.lock();
  queued -= item.bytes;
  changed.notify_all();
}

void CatalogueWriter::Impl::write_all() {
  std::unique_lock lock(mutex);
  try {
    while (true) {
      changed.wait(lock, [&] { return ending || !unannounced.empty() || next_ready() != waiting.end(); });
      const auto ready = next_ready();
      if (ready == waiting.end() && unannounced.empty()) return;  // ending
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

std::vector<EpisodeIdentity> CatalogueWriter::expect(std::vector<EpisodeIdentity> episodes) {
  const std::lock_guard lock(impl_->mutex);
  std::sort(episodes.begin(), episodes.end());
  episodes.erase(std::unique(episodes.begin(), episodes.end()), episodes.end());
  std::erase_if(episodes,
                [&](const EpisodeIdentity& e) { return impl_->known.contains(e.key) || impl_->place.contains(e.key); });
  for (const EpisodeIdentity& episode : episodes) {
    impl_->place.emplace(episode.key, impl_->order.size());
    impl_->order.push_back(episode);
  }
  return episodes;
}

void CatalogueWriter::finished(EpisodeRecord episode) {
  if (episode.reason == Reason::interrupted) return abandon(episode.key);
  check_record(episode);  // here, where the fault is, not in the writing thread
  const std::int64_t bytes = bytes_of(episode);
  std::unique_lock lock(impl_->mutex);
  if (!impl_->known.insert(episode.key).second) return;
  const auto place = impl_->place.find(episode.key);
  const bool announced = place != impl_->place.end();
  impl_->changed.wait(lock, [&] {
    impl_->next_ready();
    const bool next_in_line = announced && place->second <= impl_->next;
    return impl_->failure || next_in_line || impl_->queued == 0 || impl_->queued + bytes <= impl_->options.queue_bytes;
  });
  if (impl_->failure) std::rethrow_exception(impl_->failure);
  impl_->queued += bytes;
  Impl::Waiting item{std::move(episode), bytes};
  if (announced) {
    impl_->waiting.emplace(place->second, std::move(item));
  } else {
    impl_->unannounced.push_back(std::move(item));
  }
  impl_->changed.notify_all();
}

void CatalogueWriter::abandon(std::string_view key) {
  const std::lock_guard lock(impl_->mutex);
  const auto place = impl_->place.find(key);
  if (place == impl_->place.end() || impl_->waiting.contains(place->second)) return;
  impl_->gone.insert(place->second);
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
