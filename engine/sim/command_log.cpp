#include "engine/sim/command_log.h"

#include <utility>

namespace stampede {

CommandLog::Part::Part(Mark earlier, std::vector<Command> own)
    : before(std::move(earlier)), commands(std::move(own)), size((before ? before->size : 0) + commands.size()) {}

CommandLog::Part::~Part() {
  Mark next = std::move(before);
  while (next && next.use_count() == 1) next = Mark(std::move(next->before));
}

std::size_t CommandLog::size() const { return (marked_ ? marked_->size : 0) + recent_.size(); }

std::vector<Command> CommandLog::commands() const {
  std::vector<const Part*> parts;
  for (const Part* part = marked_.get(); part != nullptr; part = part->before.get()) parts.push_back(part);
  std::vector<Command> all;
  all.reserve(size());
  const auto add = [&all](const std::vector<Command>& commands) {
    for (const Command& command : commands) all.push_back(command);
  };
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) add((*part)->commands);
  add(recent_);
  return all;
}

CommandLog::Mark CommandLog::mark() {
  if (!recent_.empty()) marked_ = std::make_shared<const Part>(std::move(marked_), std::exchange(recent_, {}));
  return marked_;
}

void CommandLog::back_to(Mark mark) {
  marked_ = std::move(mark);
  recent_.clear();
}

}  // namespace stampede
