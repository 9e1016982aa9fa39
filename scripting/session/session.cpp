#include "stampede/session.h"

#include <charconv>

#include "scripting/session/session_core.h"

namespace stampede {
namespace {

struct ValueText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    char buffer[32];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
  }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const SqlBlob& value) const { return value.bytes; }
};

}  // namespace

struct Session::Impl {
  SessionCore core;
};

Session::Session(SessionOptions options)
    : impl_(new Impl{SessionCore(options.root, options.paths, std::move(options.catalogue))}) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

std::vector<std::string> Session::tasks() const { return impl_->core.tasks(); }

std::vector<std::string> Session::variations(const std::string& task) const { return impl_->core.variations(task); }

Episode Session::run(const std::string& task, const EpisodeRequest& request) { return impl_->core.run(task, request); }

TaskPlan Session::plan(const std::string& task, const EpisodeRequest& request) const {
  return impl_->core.plan(task, request);
}

CameraPicture Session::picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->core.picture(episode, frame, request);
}

CameraPoints Session::points(std::int64_t episode, std::int64_t frame, const PictureRequest& request) const {
  return impl_->core.points(episode, frame, request);
}

WorldState Session::state(std::int64_t episode, std::int64_t frame) const { return impl_->core.state(episode, frame); }

Rows Session::query(std::string_view question) const {
  const QueryResult result = impl_->core.query(question);
  Rows rows{result.columns, {}};
  for (const auto& row : result.rows) {
    std::vector<std::string>& texts = rows.values.emplace_back();
    for (const SqlValue& value : row) texts.push_back(std::visit(ValueText{}, value));
  }
  return rows;
}

TaskPlan plan_pddl(const std::string& domain, const std::string& problem) { return plan_of_texts(domain, problem); }

}  // namespace stampede
