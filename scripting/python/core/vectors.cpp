// Several environments at once, each in a thread that stays its own.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>
#include <stampede/session.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "environments.h"

namespace stampede::python {
namespace {

using namespace nb::literals;

// What one environment does next: nothing, an action, or a new start.
using Command = std::variant<std::monostate, AgentAction, ResetRequest>;

struct Answer {
  StepResult result;  // of a reset only the observation
  std::exception_ptr failure;
};

// Lifetime: one caller at a time.
class EnvironmentGroup {
 public:
  EnvironmentGroup(std::vector<Environment> environments, int threads)
      : environments_(std::move(environments)), answers_(environments_.size()) {
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

  // Throws what the first environment threw; the others have done what they were told all the same.
  std::vector<Answer>& run(std::vector<Command> commands) {
    {
      std::unique_lock lock(mutex_);
      commands_ = std::move(commands);
      running_ = workers_.size();
      ++round_;
      begin_.notify_all();
      end_.wait(lock, [&] { return running_ == 0; });
    }
    for (const Answer& answer : answers_)
      if (answer.failure) std::rethrow_exception(answer.failure);
    return answers_;
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
      for (std::size_t i = first; i < environments_.size(); i += stride) obey(i);
      const std::lock_guard lock(mutex_);
      if (--running_ == 0) end_.notify_one();
    }
  }

  void obey(std::size_t i) {
    Answer& answer = answers_[i];
    answer = {};
    try {
      if (const auto* action = std::get_if<AgentAction>(&commands_[i])) answer.result = environments_[i].step(*action);
      if (const auto* request = std::get_if<ResetRequest>(&commands_[i]))
        answer.result.observation = environments_[i].reset(*request);
    } catch (const std::exception&) {
      answer.failure = std::current_exception();
    }
  }

  std::vector<Environment> environments_;
  std::vector<Command> commands_;
  std::vector<Answer> answers_;
  std::mutex mutex_;
  std::condition_variable begin_, end_;
  std::uint64_t round_ = 0;
  std::size_t running_ = 0;
  bool over_ = false;
  std::vector<std::jthread> workers_;
};

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
  std::vector<bool> told;
  for (const Command& command : commands) told.push_back(!std::holds_alternative<std::monostate>(command));
  std::vector<Answer>* answers = nullptr;
  {
    const nb::gil_scoped_release free;
    answers = &group.run(std::move(commands));
  }
  nb::list results;
  for (std::size_t i = 0; i < told.size(); ++i)
    results.append(told[i] ? nb::cast(to_step(std::move((*answers)[i].result))) : nb::none());
  return results;
}

}  // namespace

void bind_vectors(nb::module_& module) {
  nb::class_<EnvironmentGroup>(module, "EnvironmentGroup",
                               "Environments that act at once, each in a thread that stays its own.")
      .def("run", &run_group, "commands"_a, R"(Tells each environment an Action, a Reset or None (nothing), all at once.

Gives a Step for each that was told something; of a reset, only `observation` counts. The GIL is released.)")
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
