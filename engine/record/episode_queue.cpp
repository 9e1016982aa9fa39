#include "engine/record/episode_queue.h"

#include <algorithm>

#include "engine/record/observation.h"

namespace stampede {
namespace {

constexpr std::size_t kImagesInMemory = 8'000'000;  // the rest of an ImageStore lies in a file

std::int64_t bytes_of(const EpisodeRecord& episode) {
  std::size_t frame = sizeof(FrameRecord) + sizeof(ActionRecord);
  frame += episode.scene.joints.size() * 4 * sizeof(double) + episode.scene.posed.size() * sizeof(Pose);
  frame += episode.scene.hands.size() * sizeof(HandRecord) + episode.scene.cameras.size() * sizeof(Pose);
  std::size_t bytes = episode.frames.size() * frame + episode.scene.document.size();
  for (const Command& command : episode.commands) {
    bytes += sizeof(Command);
    if (const auto* follow = std::get_if<operation::Follow>(&command.operation))
      bytes += follow->trajectory.knots.size() * 200;
  }
  for (const DefinitionRecord& definition : episode.made.definitions) bytes += definition.source.size();
  for (const DocumentRecord& document : episode.labels.documents) bytes += document.text.size();
  for (const ChannelRecord& channel : episode.channels) bytes += channel.values.size() * sizeof(double);
  if (episode.images) bytes += std::min(static_cast<std::size_t>(episode.images->bytes()), kImagesInMemory);
  return static_cast<std::int64_t>(bytes) + 400 * static_cast<std::int64_t>(episode.labels.facts.size());
}

}  // namespace

EpisodeQueue::EpisodeQueue(std::int64_t bytes) : bytes_(bytes) {}

std::map<std::int64_t, EpisodeQueue::Waiting>::iterator EpisodeQueue::ready() {
  while (!gone_.empty() && *gone_.begin() == next_) {
    gone_.erase(gone_.begin());
    ++next_;
  }
  if (waiting_.empty()) return waiting_.end();
  const auto first = waiting_.begin();
  return ending_ || first->first == next_ ? first : waiting_.end();
}

bool EpisodeQueue::has(std::string_view key) const {
  const std::lock_guard lock(mutex_);
  return known_.contains(key);
}

void EpisodeQueue::know(std::vector<std::string> keys) {
  const std::lock_guard lock(mutex_);
  known_.insert(std::make_move_iterator(keys.begin()), std::make_move_iterator(keys.end()));
}

void EpisodeQueue::finished(std::int64_t place, EpisodeRecord episode) {
  if (episode.reason == Reason::interrupted) return abandon(place);
  const std::int64_t bytes = bytes_of(episode);
  std::unique_lock lock(mutex_);
  if (!known_.insert(episode.made.key).second) {
    gone_.insert(place);
    return changed_.notify_all();
  }
  changed_.wait(lock, [&] {
    ready();
    return failure_ || place == next_ || queued_ == 0 || queued_ + bytes <= bytes_;
  });
  queued_ += bytes;
  waiting_.emplace(place, Waiting{std::move(episode), bytes});
  changed_.notify_all();
  if (bytes_ == 0) changed_.wait(lock, [&] { return failure_ || queued_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

void EpisodeQueue::abandon(std::int64_t place) {
  const std::lock_guard lock(mutex_);
  if (place < next_ || waiting_.contains(place)) return;
  gone_.insert(place);
  changed_.notify_all();
}

void EpisodeQueue::end() {
  const std::lock_guard lock(mutex_);
  ending_ = true;
  changed_.notify_all();
}

void EpisodeQueue::fail(std::exception_ptr why) {
  const std::lock_guard lock(mutex_);
  failure_ = std::move(why);
  changed_.notify_all();
}

std::optional<EpisodeQueue::Finished> EpisodeQueue::next() {
  std::unique_lock lock(mutex_);
  queued_ -= std::exchange(given_, 0);
  changed_.notify_all();
  changed_.wait(lock, [&] { return ending_ || ready() != waiting_.end(); });
  const auto first = ready();
  if (first == waiting_.end()) return std::nullopt;
  gone_.insert(first->first);
  given_ = first->second.bytes;
  Finished result{first->first, std::move(first->second.episode)};
  waiting_.erase(first);
  return result;
}

}  // namespace stampede
