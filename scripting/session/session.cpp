#include "stampede/session.h"

#include "scripting/session/session_core.h"

namespace stampede {

struct Session::Impl {
  std::shared_ptr<SessionCore> core;
};

Session::Session(SessionOptions options)
    : impl_(std::unique_ptr<Impl>(
          new Impl{std::make_shared<SessionCore>(options.root, options.paths, std::move(options.catalogue))})) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

std::vector<std::string> Session::tasks() const { return impl_->core->tasks(); }

std::vector<std::string> Session::variations(const std::string& task) const { return impl_->core->variations(task); }

Episode Session::run(const std::string& task, const EpisodeRequest& request) { return impl_->core->run(task, request); }

RunTally Session::run_all(const RunRequest& request) { return impl_->core->run_all(request); }

void Session::add_policy(const std::string& name, PolicyEntry entry) {
  impl_->core->add_policy(name, std::move(entry));
}

Evaluation Session::evaluate(const std::vector<std::string>& tasks, const EvaluationRequest& request) {
  return impl_->core->evaluate(tasks, request);
}

void Session::add_sensor(const std::string& name, SensorEntry entry) {
  impl_->core->add_sensor(name, std::move(entry));
}

Environment Session::environment(const std::string& task, const EnvironmentSettings& settings) const {
  return impl_->core->environment(task, settings);
}

TaskPlan Session::plan(const std::string& task, const EpisodeRequest& request) const {
  return impl_->core->plan(task, request);
}

CameraPicture Session::picture(const Episode& episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->core->picture(episode, frame, request);
}

CameraPicture Session::picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->core->picture({.id = episode}, frame, request);
}

CameraPoints Session::points(const Episode& episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->core->points(episode, frame, request);
}

CameraPoints Session::points(std::int64_t episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->core->points({.id = episode}, frame, request);
}

WorldState Session::state(const Episode& episode, std::int64_t frame) const {
  return impl_->core->state(episode, frame);
}

WorldState Session::state(std::int64_t episode, std::int64_t frame) const {
  return impl_->core->state({.id = episode}, frame);
}

EpisodeArrays Session::arrays(const Episode& episode, const ArrayRequest& request) const {
  return impl_->core->arrays(episode, request);
}

EpisodeArrays Session::arrays(std::int64_t episode, const ArrayRequest& request) const {
  return impl_->core->arrays({.id = episode}, request);
}

Rows Session::query(std::string_view question, const std::vector<SqlValue>& parameters) const {
  return impl_->core->query(question, parameters);
}

TaskPlan plan_pddl(const std::string& domain, const std::string& problem) { return plan_of_texts(domain, problem); }

}  // namespace stampede
