// A task file, evaluated for one variation.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/geometry/value.h"
#include "engine/start/task.h"
#include "scripting/runtime/assets.h"
#include "scripting/runtime/job.h"
#include "scripting/runtime/script_state.h"

namespace stampede {

// Makes the draws of one task, variation and seed. Lifetime: outlives the tasks it draws, whose functions ask it.
class LuaTask {
 public:
  // Throws Error for an unknown task or variation and for mistakes in its files. Sets the hand of `tests`.
  LuaTask(TestState& tests, EpisodeJob job, int further_things, std::shared_ptr<Assets> assets);
  LuaTask(const LuaTask&) = delete;
  LuaTask& operator=(const LuaTask&) = delete;

  const std::string& name() const { return job_.task; }
  Task draw(int number);
  std::vector<const ScriptFile*> files() const { return first_.files; }  // that took part, beside predicates and skills

  // A draw as its file is read.
  struct Drawn {
    Task task;  // without its functions
    std::string hand;
    std::map<std::string, std::vector<std::string>> groups;  // `block` -> block1 …
    std::vector<const ScriptFile*> files;
    bool also = false, fails = false, reward = false;  // does the file have these functions?
  };

 private:
  // Calls a function of the file, which it has, and leaves its result on the stack.
  void call_function(const char* field, const WorldView& view);
  bool ask(const char* field, const WorldView& view);
  double number(const char* field, const WorldView& view);
  Drawn make(int draw);
  Task with_functions(const Drawn& drawn);
  int keep_variation();

  TestState& tests_;
  EpisodeJob job_;
  int further_things_;
  std::map<std::string, std::string> axes_;
  std::shared_ptr<Assets> assets_;
  Drawn first_;                           // draw 0: it says which files take part
  std::map<std::string, int> functions_;  // registry references of the tests' state
  int v_ = 0;
  int generation_ = -1;
};

}  // namespace stampede
