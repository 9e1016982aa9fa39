// Several environments at once, shared out among threads.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>
#include <stampede/session.h>

#include <atomic>
#include <functional>
#include <thread>

#include "environments.h"

namespace stampede::python {
namespace {

using namespace nb::literals;

// Waits until the value is another. It looks for a while before it sleeps: to be woken takes as long as a tenth of a
// step. Whoever has work gets the processor meanwhile.
template <class Value>
void await_other(const std::atomic<Value>& value, Value than) {
  for (int look = 0; look < 2000; ++look) {
    if (value.load(std::memory_order_acquire) != than) return;
    std::this_thread::yield();
  }
  value.wait(than, std::memory_order_acquire);
}

// Lifetime: one caller at a time, whose thread takes the first share of the environments.
class EnvironmentGroup {
 public:
  EnvironmentGroup(std::vector<Environment> environments, int threads)
      : environments_(std::move(environments)),
        failures_(environments_.size()),
        shares_(std::min(environments_.size(), static_cast<std::size_t>(std::max(1, threads)))) {
    for (std::size_t share = 1; share < shares_; ++share) workers_.emplace_back([this, share] { work(share); });
  }
  ~EnvironmentGroup() {
    over_ = true;
    begin_round();
  }

  // Does a job with each environment. Throws what the first one threw; the others have done theirs.
  void each(const std::function<void(std::size_t, Environment&)>& job) {
    job_ = &job;
    running_.store(workers_.size(), std::memory_order_relaxed);
    begin_round();
    do_share(0);
    for (std::size_t left = running_; left != 0; left = running_) await_other(running_, left);
    for (const std::exception_ptr& failure : failures_)
      if (failure) std::rethrow_exception(failure);
  }

  Environment& at(std::size_t i) { return environments_.at(i); }
  std::size_t size() const { return environments_.size(); }
  bool has_threads() const { return !workers_.empty(); }

 private:
  void begin_round() {
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
  }

  void work(std::size_t share) {
    for (std::uint64_t done = 0;; ++done) {
      await_other(round_, done);
      if (over_) return;
      do_share(share);
      running_.fetch_sub(1, std::memory_order_release);
      running_.notify_one();
    }
  }

  void do_share(std::size_t first) {
    for (std::size_t i = first; i < environments_.size(); i += shares_) {
      failures_[i] = nullptr;
      try {
        (*job_)(i, environments_[i]);
      } catch (const std::exception&) {
        failures_[i] = std::current_exception();
      }
    }
  }

  std::vector<Environment> environments_;
  const std::function<void(std::size_t, Environment&)>* job_ = nullptr;
  std::vector<std::exception_ptr> failures_;
  const std::size_t shares_;
  bool over_ = false;  // read after a new round has been seen
  std::atomic<std::uint64_t> round_ = 0;
  std::atomic<std::size_t> running_ = 0;
  std::vector<std::jthread> workers_;
};

// A group as Python has it.
struct PyGroup : Owned<EnvironmentGroup> {
  PyGroup(nb::object session_in, std::vector<Environment> environments, int threads)
      : Owned("VectorEnv", Turn::Others::fail, std::move(environments), threads), session(std::move(session_in)) {
    if ((*this)->has_threads() || nb::cast<const PySession&>(session).has_catalogue()) turn.stay_in_this_process();
  }
  nb::object session;
};

int traverse_group(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (nb::inst_ready(self)) Py_VISIT(nb::inst_ptr<PyGroup>(self)->session.ptr());
  return 0;
}
int clear_group(PyObject* self) {
  nb::inst_ptr<PyGroup>(self)->session.reset();
  return 0;
}
PyType_Slot kGroupSlots[] = {{Py_tp_traverse, reinterpret_cast<void*>(&traverse_group)},
                             {Py_tp_clear, reinterpret_cast<void*>(&clear_group)},
                             {0, nullptr}};

// What one of its environments says of itself.
template <typename Answer>
Answer asked(const PyGroup& self, const char* question, std::size_t index, Answer (Environment::*answer)() const) {
  const Using use(self.turn, ("VectorEnv." + std::string(question)).c_str());
  if (index >= self->size()) throw nb::index_error();
  const Released free;
  return (self->at(index).*answer)();
}

// What one environment does next: nothing, an action, or a new start.
using Command = std::variant<std::monostate, AgentAction, ResetRequest>;

Command command_from(nb::handle asked) {
  if (asked.is_none()) return std::monostate{};
  if (nb::isinstance<ResetRequest>(asked)) return nb::cast<ResetRequest>(asked);
  if (nb::isinstance<AgentAction>(asked)) return nb::cast<AgentAction>(asked);
  throw nb::type_error("each environment is told a stampede.Action, a stampede.Reset, or None");
}

nb::list run_group(PyGroup& self, const nb::sequence& asked) {
  const Using use(self.turn, "VectorEnv.step");
  EnvironmentGroup& group = *self;
  std::vector<Command> commands;
  for (const nb::handle one : asked) commands.push_back(command_from(one));
  if (commands.size() != group.size())
    throw Error("EnvironmentGroup.run",
                "there are " + std::to_string(group.size()) + " environments and " + std::to_string(commands.size()) +
                    " commands",
                "give each one, None to leave it as it is");
  std::vector<StepResult> answers(group.size());
  {
    const Released free;
    group.each([&](std::size_t i, Environment& environment) {
      if (const auto* action = std::get_if<AgentAction>(&commands[i])) answers[i] = environment.step(*action);
      if (const auto* request = std::get_if<ResetRequest>(&commands[i]))
        answers[i].observation = environment.reset(*request);
    });
  }
  nb::list results;
  for (std::size_t i = 0; i < commands.size(); ++i)
    results.append(std::holds_alternative<std::monostate>(commands[i]) ? nb::none()
                                                                       : nb::cast(to_step(std::move(answers[i]))));
  return results;
}

nb::list pictures_of(PyGroup& self, const std::string& camera, std::size_t count) {
  const Using use(self.turn, "VectorEnv.render");
  EnvironmentGroup& group = *self;
  if (count > group.size()) throw nb::index_error();
  std::vector<ChannelValue> seen(count);
  {
    const Released free;
    group.each([&](std::size_t i, const Environment& environment) {
      if (i < count) seen[i] = environment.picture(camera);
    });
  }
  nb::list pictures;
  for (ChannelValue& one : seen) pictures.append(to_python(std::move(one)));
  return pictures;
}

std::optional<Episode> episode_of(PyGroup& self, std::size_t index) {
  const Using use(self.turn, "VectorEnv.episode");
  EnvironmentGroup& group = *self;
  if (index >= group.size()) throw nb::index_error();
  const Released free;
  std::optional<Episode> episode;
  group.each([&](std::size_t i, Environment& environment) {
    if (i == index) episode = environment.episode();
  });
  return episode;
}

}  // namespace

void bind_vectors(nb::module_& module) {
  nb::class_<PyGroup>(module, "EnvironmentGroup", nb::type_slots(kGroupSlots),
                      "Environments that act at once in threads, the caller's among them.")
      .def("run", &run_group, "commands"_a, R"(Tells each environment an Action, a Reset or None (nothing), all at once.

Gives a Step for each that was told something; of a reset, only `observation` counts. The GIL is released.)")
      .def("pictures", &pictures_of, "camera"_a, "count"_a,
           "What the camera of each of the first `count` sees now, drawn at once: height x width x 3, uint8.")
      .def("episode", &episode_of, "index"_a, "Ends that environment's episode and keeps it; needs `record`.")
      .def(
          "skills", [](const PyGroup& self, std::size_t i) { return asked(self, "skills", i, &Environment::skills); },
          "index"_a)
      .def(
          "atoms", [](const PyGroup& self, std::size_t i) { return asked(self, "atoms", i, &Environment::atoms); },
          "index"_a)
      .def(
          "spaces", [](const PyGroup& self, std::size_t i) { return asked(self, "spaces", i, &Environment::spaces); },
          "index"_a)
      .def(
          "instructions",
          [](const PyGroup& self, std::size_t i) { return asked(self, "instructions", i, &Environment::instructions); },
          "index"_a)
      .def(
          "frame_hz",
          [](const PyGroup& self, std::size_t i) { return asked(self, "frame_hz", i, &Environment::frame_hz); },
          "index"_a)
      .def(
          "horizon_s",
          [](const PyGroup& self, std::size_t i) { return asked(self, "horizon_s", i, &Environment::horizon_s); },
          "index"_a)
      .def("__len__", [](const PyGroup& self) { return self->size(); });
  module.def(
      "environment_group",
      [](nb::handle_t<PySession> session, const std::string& task, int count, int threads, const nb::kwargs& words) {
        const EnvironmentSettings settings = settings_from(words, "environment_group");
        std::vector<Environment> all;
        for (int i = 0; i < count; ++i) all.push_back(nb::cast<PySession&>(session)->environment(task, settings));
        return std::make_unique<PyGroup>(nb::borrow(session), std::move(all), threads);
      },
      "session"_a, "task"_a, "count"_a, "threads"_a, "settings"_a,
      "Several environments of a task that act at once; further arguments as of Session.environment.");
}

}  // namespace stampede::python
