// Several environments at once, each in a thread that stays its own.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>
#include <stampede/session.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "environments.h"

namespace stampede::python {
namespace {

using namespace nb::literals;

// Lifetime: one caller at a time.
class EnvironmentGroup {
 public:
  EnvironmentGroup(std::vector<Environment> environments, int threads)
      : environments_(std::move(environments)), failures_(environments_.size()) {
    const std::size_t count = std::min(environments_.size(), static_cast<std::size_t>(std::max(1, threads)));
    for (std::size_t i = 0; i < count; ++i) workers_.emplace_back([this, i, count] { work(i, count); });
  }
  ~EnvironmentGroup() {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    begin_.notify_all();
  }

  // Does a job with each environment, in its thread. Throws what the first one threw; the others have done theirs.
  void each(const std::function<void(std::size_t, Environment&)>& job) {
    {
      std::unique_lock lock(mutex_);
      job_ = &job;
      running_ = workers_.size();
      ++round_;
      begin_.notify_all();
      end_.wait(lock, [&] { return running_ == 0; });
    }
    for (const std::exception_ptr& failure : failures_)
      if (failure) std::rethrow_exception(failure);
  }

  Environment& at(std::size_t i) { return environments_.at(i); }
  std::size_t size() const { return environments_.size(); }

 private:
  void work(std::size_t first, std::size_t stride) {
    for (std::uint64_t done = 0;;) {
      {
        std::unique_lock lock(mutex_);
        begin_.wait(lock, [&] { return over_ || round_ != done; });
        if (over_) return;
        done = round_;
      }
      for (std::size_t i = first; i < environments_.size(); i += stride) attempt(i);
      const std::lock_guard lock(mutex_);
      if (--running_ == 0) end_.notify_one();
    }
  }

  void attempt(std::size_t i) {
    failures_[i] = nullptr;
    try {
      (*job_)(i, environments_[i]);
    } catch (const std::exception&) {
      failures_[i] = std::current_exception();
    }
  }

  std::vector<Environment> environments_;
  const std::function<void(std::size_t, Environment&)>* job_ = nullptr;
  std::vector<std::exception_ptr> failures_;
  std::mutex mutex_;
  std::condition_variable begin_, end_;
  std::uint64_t round_ = 0;
  std::size_t running_ = 0;
  bool over_ = false;
  std::vector<std::jthread> workers_;
};

// What one environment does next: nothing, an action, or a new start.
using Command = std::variant<std::monostate, AgentAction, ResetRequest>;

Command command_from(nb::handle asked) {
  if (asked.is_none()) return std::monostate{};
  if (nb::isinstance<ResetRequest>(asked)) return nb::cast<ResetRequest>(asked);
  if (nb::isinstance<AgentAction>(asked)) return nb::cast<AgentAction>(asked);
  throw nb::type_error("each environment is told a stampede.Action, a stampede.Reset, or None");
}

nb::list run_group(EnvironmentGroup& group, const nb::sequence& asked) {
  std::vector<Command> commands;
  for (const nb::handle one : asked) commands.push_back(command_from(one));
  if (commands.size() != group.size())
    throw Error("EnvironmentGroup.run",
                "there are " + std::to_string(group.size()) + " environments and " + std::to_string(commands.size()) +
                    " commands",
                "give each one, None to leave it as it is");
  std::vector<StepResult> answers(group.size());
  {
    const nb::gil_scoped_release free;
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

nb::list pictures_of(EnvironmentGroup& group, const std::string& camera, std::size_t count) {
  if (count > group.size()) throw nb::index_error();
  std::vector<ChannelValue> seen(count);
  {
    const nb::gil_scoped_release free;
    group.each([&](std::size_t i, const Environment& environment) {
      if (i < count) seen[i] = environment.picture(camera);
    });
  }
  nb::list pictures;
  for (ChannelValue& one : seen) pictures.append(to_python(std::move(one)));
  return pictures;
}

std::optional<Episode> episode_of(EnvironmentGroup& group, std::size_t index) {
  if (index >= group.size()) throw nb::index_error();
  const nb::gil_scoped_release free;
  std::optional<Episode> episode;
  group.each([&](std::size_t i, Environment& environment) {
    if (i == index) episode = environment.episode();
  });
  return episode;
}

}  // namespace

void bind_vectors(nb::module_& module) {
  nb::class_<EnvironmentGroup>(module, "EnvironmentGroup",
                               "Environments that act at once, each in a thread that stays its own.")
      .def("run", &run_group, "commands"_a, R"(Tells each environment an Action, a Reset or None (nothing), all at once.

Gives a Step for each that was told something; of a reset, only `observation` counts. The GIL is released.)")
      .def("pictures", &pictures_of, "camera"_a, "count"_a,
           "What the camera of each of the first `count` sees now, drawn at once: height x width x 3, uint8.")
      .def("episode", &episode_of, "index"_a, "Ends that environment's episode and keeps it; needs `record`.")
      .def(
          "skills", [](EnvironmentGroup& self, std::size_t i) { return self.at(i).skills(); }, "index"_a)
      .def(
          "atoms", [](EnvironmentGroup& self, std::size_t i) { return self.at(i).atoms(); }, "index"_a)
      .def(
          "spaces", [](EnvironmentGroup& self, std::size_t i) { return self.at(i).spaces(); }, "index"_a)
      .def(
          "instructions", [](EnvironmentGroup& self, std::size_t i) { return self.at(i).instructions(); }, "index"_a)
      .def(
          "frame_hz", [](EnvironmentGroup& self, std::size_t i) { return self.at(i).frame_hz(); }, "index"_a)
      .def(
          "horizon_s", [](EnvironmentGroup& self, std::size_t i) { return self.at(i).horizon_s(); }, "index"_a)
      .def("__len__", &EnvironmentGroup::size);
  module.def(
      "environment_group",
      [](const Session& session, const std::string& task, int count, int threads, const nb::kwargs& words) {
        const EnvironmentSettings settings = settings_from(words, "environment_group");
        std::vector<Environment> all;
        for (int i = 0; i < count; ++i) all.push_back(session.environment(task, settings));
        return std::make_unique<EnvironmentGroup>(std::move(all), threads);
      },
      "session"_a, "task"_a, "count"_a, "threads"_a, "settings"_a,
      "Several environments of a task that act at once; further arguments as of Session.environment.");
}

}  // namespace stampede::python
