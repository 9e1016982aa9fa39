// Python's threads and the engine: one call of an object at a time, the GIL, and how the interpreter ends.
//
// When it ends, Python kills the daemon threads that come back for the GIL, through whatever C++ they are in the midst
// of: the process would abort. So the end waits for the calls that threads are in (`end_of_python`), for some seconds;
// a thread that comes back later, or calls anew, sleeps until the process is gone.
#pragma once

#include <nanobind/nanobind.h>
#include <stampede/environment.h>
#include <unistd.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>

namespace stampede::python {

namespace nb = nanobind;

// Without the GIL, for work that needs no Python.
class Released {
 public:
  Released() : state_(PyEval_SaveThread()) {}
  ~Released();
  Released(const Released&) = delete;
  Released& operator=(const Released&) = delete;

 private:
  PyThreadState* state_;
};

// With the GIL, in any thread.
class Acquired {
 public:
  Acquired();
  ~Acquired();
  Acquired(const Acquired&) = delete;
  Acquired& operator=(const Acquired&) = delete;

 private:
  PyGILState_STATE state_;
};

// While Python asks a question of its own code in an engine's run: see `ask_python`.
class Asking {
 public:
  Asking();
  ~Asking();
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

 private:
  bool before_;
};

bool is_ending();  // the interpreter, and this is not the thread that ends it

// Whose turn it is to use an object. `name`: of its class.
class Turn {
 public:
  enum class Others { wait, fail };
  Turn(const char* name, Others others) : name_(name), others_(others) {}

  // The object has threads or files that a forked process does not get.
  void stay_in_this_process() { stays_ = true; }
  bool was_left_behind() const { return stays_ && process_ != getpid(); }

 private:
  friend class Using;
  friend class Lent;
  bool try_take();
  void take(const char* use);
  void give();
  [[noreturn]] void refuse(const char* use) const;

  const char* name_;
  Others others_;
  bool stays_ = false;
  pid_t process_ = getpid();
  std::mutex mutex_;
  std::condition_variable given_;
  bool taken_ = false;
};

// One call of an object. Throws Error where the object cannot be used now: by another thread's call, by a function that
// it calls itself, or in a process that was forked.
class Using {
 public:
  Using(Turn& turn, const char* use);
  ~Using();
  Using(const Using&) = delete;
  Using& operator=(const Using&) = delete;

 private:
  Turn& turn_;
};

// In a call: lets others use the object while a function of the program's looks at what was done so far.
class Lent {
 public:
  explicit Lent(Turn& turn) : turn_(turn) { turn_.give(); }
  ~Lent();
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;

 private:
  Turn& turn_;
};

// A call of what is no object.
class Calling {
 public:
  Calling();
  ~Calling();
  Calling(const Calling&) = delete;
  Calling& operator=(const Calling&) = delete;
};

// An object of the engine's as Python has it. A forked process leaves it alone: its threads are not there.
template <typename T>
class Owned {
 public:
  template <typename... Arguments>
  Owned(const char* name, Turn::Others others, Arguments&&... arguments)
      : turn(name, others), object_(std::make_unique<T>(std::forward<Arguments>(arguments)...)) {}
  ~Owned() {
    if (turn.was_left_behind()) static_cast<void>(object_.release());
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;

  T* operator->() const { return object_.get(); }
  T& operator*() const { return *object_; }

  mutable Turn turn;

 private:
  std::unique_ptr<T> object_;
};

// Holds a Python object, and lets go of it under the GIL, whichever thread does.
class Kept {
 public:
  explicit Kept(nb::object object) : object_(std::move(object)) {}
  Kept(const Kept&) = delete;
  Kept& operator=(const Kept&) = delete;
  ~Kept();
  const nb::object& operator*() const { return object_; }
  void let_go() { object_.reset(); }  // under the GIL

 private:
  nb::object object_;
};

void bind_threads(nb::module_& module);

}  // namespace stampede::python
