// Pictures on their way into an image store: encoded beside the drawing where cores are spare, stored in order.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "engine/record/observation.h"
#include "engine/render/png.h"

namespace stampede {

// The bytes are the same for any number of threads; with none, pictures are encoded where they are added. Lifetime: one
// thread, and what it refers to outlives it. Bounded: whoever adds helps when others fall behind. Errors of an encoder
// come out of add and finish.
class EncodeQueue {
 public:
  // `cameras`: indices into the scene's, one a picture of each frame.
  EncodeQueue(const Observation& observation, const std::vector<int>& cameras, ImageStore& images, int encoders);
  ~EncodeQueue();
  EncodeQueue(const EncodeQueue&) = delete;
  EncodeQueue& operator=(const EncodeQueue&) = delete;

  // One picture a camera, which are taken; `views` are for point clouds. Leaves others to draw into, of any content.
  void add(std::int64_t frame, std::vector<Picture>& pictures, std::vector<View> views);
  void finish();  // all that was added is in the store

 private:
  struct File {
    ImageRecord image;
    std::size_t picture = 0;
    bool as_before = false;  // the same pixels as in the frame before
    Bytes bytes;
  };
  enum class State { waiting, taken, done };
  struct Frame {
    std::shared_ptr<std::vector<Picture>> pictures;
    std::vector<View> views;
    std::vector<File> files;  // in the store's order
    State state = State::waiting;
    std::exception_ptr error;
  };
  std::vector<File> files_of(std::int64_t frame, const std::vector<Picture>& pictures) const;
  void encode(Frame& frame) const;
  void encode_one(std::unique_lock<std::mutex>& lock, Frame& frame);
  Frame* waiting_frame();
  void leave_at_most(std::size_t count);
  void store(Frame& frame);
  void work();

  const Observation& observation_;
  const std::vector<int>& cameras_;
  ImageStore& images_;
  std::shared_ptr<std::vector<Picture>> before_;  // of the frame added last
  std::vector<Bytes> stored_;                     // of the frame before, by their place in it

  std::mutex mutex_;
  std::condition_variable more_, done_;
  std::deque<Frame> frames_;  // in order; ends move, those between stay where they are
  bool over_ = false;
  std::vector<std::thread> encoders_;  // last: they start when the rest is there
};

}  // namespace stampede
