#include "engine/record/encode_queue.h"

#include <algorithm>
#include <utility>

#include "engine/base/stopping.h"
#include "engine/render/point_cloud.h"

namespace stampede {
namespace {

constexpr std::size_t kMostFrames = 6;  // that wait, so that the one who draws need not stop for one slow picture
constexpr int kMostEncoders = 2;        // two of them are faster than any drawing

bool same_pixels(const Picture& a, const Picture& b, PictureKind kind) {
  switch (kind) {
    case PictureKind::rgb:
      return a.rgb == b.rgb;
    case PictureKind::depth:
      return a.depth == b.depth;
    case PictureKind::instance:
      return a.instance == b.instance;
    case PictureKind::semantic:
      return a.semantic == b.semantic;
  }
  return false;
}

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

}  // namespace

EncodeQueue::EncodeQueue(const Observation& observation, const std::vector<int>& cameras, ImageStore& images,
                         int encoders)
    : observation_(observation), cameras_(cameras), images_(images) {
  for (int i = 0; i < std::min(encoders, kMostEncoders); ++i) encoders_.emplace_back([this] { work(); });
}

EncodeQueue::~EncodeQueue() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  more_.notify_all();
  for (std::thread& encoder : encoders_) encoder.join();
}

std::vector<EncodeQueue::File> EncodeQueue::files_of(std::int64_t frame, const std::vector<Picture>& pictures) const {
  std::vector<File> files;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture& picture = pictures[i];
    const Picture* before = before_ && i < before_->size() ? &(*before_)[i] : nullptr;
    if (before != nullptr && (before->width != picture.width || before->height != picture.height)) before = nullptr;
    const auto add = [&](std::string_view kind) -> File& {
      File& file = files.emplace_back();
      file.image = {frame, cameras_[i], std::string(kind), picture.width, picture.height};
      file.picture = i;
      return file;
    };
    for (const PictureKind kind : kPictureKinds) {
      if (!observation_.kinds.has(kind)) continue;
      File& file = add(to_string(kind));
      file.as_before = before != nullptr && same_pixels(picture, *before, kind);
      if (kind == PictureKind::instance) file.image.visible = visible_pixels(picture);
    }
    if (observation_.points) add("points");
  }
  return files;
}

void EncodeQueue::encode(Frame& frame) const {
  for (File& file : frame.files) {
    if (file.as_before) continue;
    heed_stop();
    const Picture& picture = (*frame.pictures)[file.picture];
    const std::optional<PictureKind> kind = picture_kind_from(file.image.kind);
    file.bytes = kind ? to_png(picture, *kind) : bytes_of(to_ply(point_cloud(picture, frame.views[file.picture])));
  }
}

void EncodeQueue::encode_one(std::unique_lock<std::mutex>& lock, Frame& frame) {
  frame.state = State::taken;
  lock.unlock();
  std::exception_ptr error;
  try {
    encode(frame);
  } catch (...) {
    error = std::current_exception();
  }
  lock.lock();
  frame.error = error;
  frame.state = State::done;
  done_.notify_one();
}

EncodeQueue::Frame* EncodeQueue::waiting_frame() {
  const auto found =
      std::find_if(frames_.begin(), frames_.end(), [](const Frame& f) { return f.state == State::waiting; });
  return found == frames_.end() ? nullptr : &*found;
}

void EncodeQueue::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    more_.wait(lock, [this] { return over_ || waiting_frame() != nullptr; });
    if (over_) return;
    encode_one(lock, *waiting_frame());
  }
}

void EncodeQueue::store(Frame& frame) {
  if (frame.error) std::rethrow_exception(frame.error);
  stored_.resize(frame.files.size());
  for (std::size_t i = 0; i < frame.files.size(); ++i) {
    File& file = frame.files[i];
    if (!file.as_before) stored_[i] = std::move(file.bytes);
    images_.append(std::move(file.image), stored_[i]);
  }
}

void EncodeQueue::leave_at_most(std::size_t count) {
  std::unique_lock lock(mutex_);
  while (!frames_.empty() && (frames_.size() > count || frames_.front().state == State::done)) {
    if (frames_.front().state == State::done) {
      Frame frame = std::move(frames_.front());
      frames_.pop_front();
      lock.unlock();
      store(frame);
      lock.lock();
    } else if (Frame* waiting = waiting_frame(); waiting != nullptr) {
      encode_one(lock, *waiting);
    } else {
      done_.wait(lock, [this] { return frames_.front().state == State::done; });
    }
  }
}

void EncodeQueue::add(std::int64_t frame, std::vector<Picture>& pictures, std::vector<View> views) {
  Frame next;
  next.files = files_of(frame, pictures);
  next.views = std::move(views);
  next.pictures = std::make_shared<std::vector<Picture>>(std::move(pictures));
  pictures.clear();
  if (before_.use_count() == 1) pictures = std::move(*before_);  // stored already: its room is used again
  before_ = next.pictures;
  {
    const std::lock_guard lock(mutex_);
    frames_.push_back(std::move(next));
  }
  more_.notify_one();
  leave_at_most(encoders_.empty() ? 0 : kMostFrames);
}

void EncodeQueue::finish() { leave_at_most(0); }

}  // namespace stampede
