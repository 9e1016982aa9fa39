// Results made by several threads and handed on one at a time, in order.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "engine/base/stopping.h"

namespace stampede {

struct Crew {
  int workers = 1;
  const std::atomic<bool>* stop = nullptr;  // set: all of them end early. None: this thread's, and then it throws
};

// For i = 0 … count-1: take(i, make(worker, i)), take in this order and one at a time, make in as many threads as the
// crew has workers, each with one of its own that start() made there. Who is ahead waits, so at most one result a
// thread is kept. When the crew is stopped, what was being made is taken no more. Throws what the first i of these
// threw, whoever was quicker.
template <typename Start, typename Make, typename Take>
void in_order(std::size_t count, const Crew& crew, const Start& start, const Make& make, const Take& take) {
  std::mutex mutex;
  std::condition_variable moved;
  std::size_t next = 0, turn = 0;
  std::exception_ptr first;
  const std::atomic<bool>* const stop = crew.stop ? crew.stop : stop_of_this_thread();
  const auto over = [&] { return first || (crew.stop && crew.stop->load()); };
  const auto work = [&] {
    auto worker = start();
    while (true) {
      std::size_t i = 0;
      {
        const std::lock_guard lock(mutex);
        if (over() || next >= count) return;
        i = next++;
      }
      std::optional<decltype(make(worker, i))> result;
      std::exception_ptr fault;  // waits for its turn: of two, the first in this order comes out
      try {
        result.emplace(make(worker, i));
      } catch (const Interrupted&) {
        if (over()) return;
        fault = std::current_exception();
      } catch (const std::exception&) {
        fault = std::current_exception();
      }
      std::unique_lock lock(mutex);
      moved.wait(lock, [&] { return turn == i || over(); });
      if (over()) return;
      if (fault) {
        first = fault;
        return;
      }
      take(i, std::move(*result));
      ++turn;
      moved.notify_all();
    }
  };
  const auto loop = [&] {
    const StopScope scope(stop);
    try {
      work();
    } catch (const std::exception&) {
      const std::lock_guard lock(mutex);
      if (!first) first = std::current_exception();
    }
    moved.notify_all();  // who waits for this thread's turn sees that it is over
  };
  std::vector<std::thread> threads;
  const auto wanted = std::min(count, static_cast<std::size_t>(std::max(1, crew.workers)));
  for (std::size_t t = 1; t < wanted; ++t) threads.emplace_back(loop);
  loop();
  for (std::thread& thread : threads) thread.join();
  if (first) std::rethrow_exception(first);
  if (!crew.stop && turn < count) heed_stop();  // the caller counts on all of them
}

}  // namespace stampede
