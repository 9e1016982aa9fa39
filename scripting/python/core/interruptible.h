// Long work that Ctrl-C ends.
#pragma once

#include <stampede/basics.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <type_traits>

#include "threads.h"

namespace stampede::python {

// Does long work in another thread, so that Ctrl-C and other signals reach Python meanwhile: `stop` is set then, at
// which all of the engine looks, and what the signal's handler raised is raised when the work has ended. Called with
// the GIL; the work has none.
template <typename Work>
auto interruptible(const Work& work) {
  constexpr std::chrono::milliseconds kGlance{20};
  std::atomic<bool> stop = false;
  auto answer = std::async(std::launch::async, [&] {
    const StopScope scope(&stop);
    if constexpr (std::is_invocable_v<const Work&, const std::atomic<bool>&>)
      return work(stop);
    else
      return work();
  });
  std::exception_ptr raised;
  {
    const Released free;
    while (answer.wait_for(kGlance) != std::future_status::ready) {
      if (is_ending()) stop = true;
      if (stop) continue;
      const Acquired gil;
      if (PyErr_CheckSignals() == 0) continue;
      try {
        throw nb::python_error();
      } catch (nb::python_error&) {
        raised = std::current_exception();
      }
      stop = true;
    }
  }
  if (!raised) return answer.get();
  answer.wait();
  std::rethrow_exception(raised);
}

}  // namespace stampede::python
