#include "engine/base/stopping.h"

#include <utility>

namespace stampede {
namespace {

thread_local const std::atomic<bool>* the_stop = nullptr;

}  // namespace

StopScope::StopScope(const std::atomic<bool>* stop) : before_(std::exchange(the_stop, stop)) {}
StopScope::~StopScope() { the_stop = before_; }

const std::atomic<bool>* stop_of_this_thread() { return the_stop; }
bool stop_asked() { return the_stop != nullptr && the_stop->load(std::memory_order_relaxed); }
void heed_stop() {
  if (stop_asked()) throw Interrupted();
}

}  // namespace stampede
