#include "threads.h"

#include <pthread.h>
#include <stampede/error.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

namespace stampede::python {
namespace {

using namespace std::chrono_literals;

constexpr auto kPatience = 10s;  // at the end, for calls that threads are in
constexpr auto kLook = 100ms;    // for signals, while a thread waits its turn

enum class Phase { alive, ending, over };

// Of the process.
std::atomic<Phase> phase = Phase::alive;
std::atomic<std::thread::id> ender;  // the thread that ends the interpreter: it may still call
std::atomic<int> calls = 0;          // that threads are in
std::atomic<int> coming = 0;         // threads that come for the GIL

thread_local bool in_question = false;  // that the engine asks of Python

bool may_go_on(Phase until) { return phase < until || ender.load() == std::this_thread::get_id(); }

[[noreturn]] void sleep_for_good() {
  while (true) std::this_thread::sleep_for(1h);
}

// `get` comes back with the GIL. A thread that is counted in `coming` gets it before the end goes on.
template <typename Get>
auto come_for_gil(const Get& get) {
  ++coming;
  if (!may_go_on(Phase::over)) {
    --coming;
    sleep_for_good();
  }
  if constexpr (std::is_void_v<decltype(get())>) {
    get();
    --coming;
  } else {
    const auto state = get();
    --coming;
    return state;
  }
}

void begin_call() {
  if (!may_go_on(Phase::ending)) {
    PyEval_SaveThread();
    sleep_for_good();
  }
  ++calls;
}

void end_call() { --calls; }

// At the end, in the thread that ends the interpreter.
void end_of_python() {
  ender = std::this_thread::get_id();
  phase = Phase::ending;
  const nb::gil_scoped_release free;
  const auto latest = std::chrono::steady_clock::now() + kPatience;
  while (calls > 0 && std::chrono::steady_clock::now() < latest) std::this_thread::sleep_for(1ms);
  phase = Phase::over;
  while (coming > 0) std::this_thread::sleep_for(1ms);
}

// A forked process has one thread: the calls of the others are not in it.
void begin_fork() {
  calls = in_question ? 1 : 0;
  coming = 0;
}

}  // namespace

Released::~Released() {
  come_for_gil([this] { PyEval_RestoreThread(state_); });
}

Acquired::Acquired() : state_(come_for_gil([] { return PyGILState_Ensure(); })) {}
Acquired::~Acquired() { PyGILState_Release(state_); }

Asking::Asking() : before_(in_question) { in_question = true; }
Asking::~Asking() { in_question = before_; }

bool is_ending() { return !may_go_on(Phase::ending); }

bool Turn::try_take() {
  const std::lock_guard lock(mutex_);
  return !std::exchange(taken_, true);
}

void Turn::take(const char* use) {
  if (was_left_behind())
    throw Error(use, "this process was forked from the one that made the " + std::string(name_),
                "make another one in this process");
  if (try_take()) return;
  if (others_ == Others::fail || in_question || process_ != getpid()) refuse(use);
  while (true) {
    {
      const Released free;
      std::unique_lock lock(mutex_);
      if (given_.wait_for(lock, kLook, [this] { return !taken_; })) {
        taken_ = true;
        return;
      }
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
}

void Turn::give() {
  {
    const std::lock_guard lock(mutex_);
    taken_ = false;
  }
  given_.notify_one();
}

void Turn::refuse(const char* use) const {
  const std::string name = name_;
  if (process_ != getpid())
    throw Error(use, "the " + name + " was in use when this process was forked", "make another one in this process");
  if (in_question)
    throw Error(use, "the " + name + " is in the midst of a call, which asks this very function",
                "use another one there, or what the function is given");
  throw Error(use, "another thread is using the " + name,
              "one thread at a time: make one for each thread, or put a lock around it");
}

Using::Using(Turn& turn, const char* use) : turn_(turn) {
  begin_call();
  struct Begun {
    bool taken = false;
    ~Begun() {
      if (!taken) end_call();
    }
  } begun;
  turn_.take(use);
  begun.taken = true;
}
// Under the GIL. What the call gave is of no use to a thread that may not go on.
Using::~Using() {
  turn_.give();
  end_call();
  if (is_ending()) {
    PyEval_SaveThread();
    sleep_for_good();
  }
}

Lent::~Lent() {
  std::unique_lock lock(turn_.mutex_);
  turn_.given_.wait(lock, [this] { return !turn_.taken_; });
  turn_.taken_ = true;
}

Calling::Calling() { begin_call(); }
Calling::~Calling() { end_call(); }

Kept::~Kept() {
  if (!nb::is_alive() || !may_go_on(Phase::over)) {
    object_.release();
    return;
  }
  const Acquired gil;
  object_.reset();
}

void bind_threads(nb::module_& module) {
  pthread_atfork(nullptr, nullptr, &begin_fork);
  module.def("_end_of_python", &end_of_python);
  nb::module_::import_("atexit").attr("register")(module.attr("_end_of_python"));
}

}  // namespace stampede::python
