#include "engine/sim/command_log.h"

#include <utility>

namespace stampede {

CommandLog::Part::Part(std::shared_ptr<Part> earlier, std::vector<Command> own)
    : before(std::move(earlier)), commands(std::move(own)), size((before ? before->size : 0) + commands.size()) {}

CommandLog::Part::~Part() {
  std::shared_ptr<Part> next = std::move(before);
  while (next && next.use_count() == 1) {
    std::shared_ptr<Part> further = std::move(next->before);
    next = std::move(further);
  }
}

void CommandLog::mark() {
  if (recent_.empty()) return;
  marked_ = std::make_shared<Part>(std::move(marked_), std::exchange(recent_, {}));
}

std::vector<Command> CommandLog::commands() const {
  std::vector<const Part*> parts;
  for (const Part* part = marked_.get(); part != nullptr; part = part->before.get()) parts.push_back(part);
  std::vector<Command> all;
  all.reserve(size());
  for (auto part = parts.rbegin(); part != parts.rend(); ++part)
    all.insert(all.end(), (*part)->commands.begin(), (*part)->commands.end());
  all.insert(all.end(), recent_.begin(), recent_.end());
  return all;
}

}  // namespace stampede
