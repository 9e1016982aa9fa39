// A renderer in a thread of its own: it belongs to the thread that made it, and whoever asks may come from any.
#pragma once

#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include "engine/render/renderer.h"

namespace stampede {

class RenderThread {
 public:
  RenderThread() : thread_([this] { loop(); }) {}
  ~RenderThread() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    moved_.notify_one();
    thread_.join();
  }
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  // Waits until the work is done there; throws what it threw. One caller at a time.
  void run(const std::function<void(Renderer&)>& work) {
    std::packaged_task<void()> task([this, &work] {
      if (!renderer_) renderer_ = make_renderer();
      work(*renderer_);
    });
    std::future<void> done = task.get_future();
    {
      const std::lock_guard lock(mutex_);
      task_ = std::move(task);
    }
    moved_.notify_one();
    done.get();
  }

 private:
  void loop() {
    while (true) {
      std::unique_lock lock(mutex_);
      moved_.wait(lock, [this] { return over_ || task_.valid(); });
      if (!task_.valid()) break;
      std::packaged_task<void()> task = std::move(task_);
      task_ = {};
      lock.unlock();
      task();
    }
    renderer_.reset();  // in its own thread
  }

  std::mutex mutex_;
  std::condition_variable moved_;
  std::packaged_task<void()> task_;
  bool over_ = false;
  std::unique_ptr<Renderer> renderer_;  // touched by the thread alone
  std::thread thread_;                  // last: it starts when the rest is there
};

}  // namespace stampede
