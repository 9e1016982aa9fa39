// A fresh Lua state and what its scripts may see at this moment. An episode makes several, so that nothing that a
// script keeps in its variables outlives what it was made for: each draw of a scene, each run of a skill and each
// sample has its own, and the tests (holds, also, fails, reward) get a new one at every skill boundary.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "scripting/library/definitions.h"
#include "scripting/runtime/robot_binding.h"
#include "scripting/runtime/view_binding.h"

struct lua_State;

namespace stampede {

class ScriptState {
 public:
  // `hand` is the name of the hand, `panda.hand`.
  ScriptState(std::shared_ptr<const Library> library, std::string hand);
  ~ScriptState();
  ScriptState(const ScriptState&) = delete;
  ScriptState& operator=(const ScriptState&) = delete;

  const Library& library() const { return *library_; }
  DefinitionState& definitions() { return definitions_; }
  Sandbox& sandbox() { return definitions_.sandbox(); }
  lua_State* lua() { return definitions_.state(); }
  int view_reference() const { return view_reference_; }
  int robot_reference() const { return robot_reference_; }

  // Runs `work` inside a protected call with a budget, so that Lua's errors in it become Error. The stack is as
  // before afterwards.
  void protect(const std::function<void(lua_State*)>& work);
  // Pops the value on top of the stack into the registry.
  int keep();
  void push_kept(int reference);
  void drop(int reference);
  // A field of a definition that is a function, kept; 0 where it has none.
  int function_of(DefinitionKind kind, std::string_view name, const char* field);

  ViewContext view;
  RobotContext robot;

 private:
  std::shared_ptr<const Library> library_;
  DefinitionState definitions_;
  int view_reference_ = 0, robot_reference_ = 0;
};

// The state of the tests: made when it is asked for, dropped at skill boundaries.
class TestState {
 public:
  explicit TestState(std::shared_ptr<const Library> library) : library_(std::move(library)) {}
  void set_hand(std::string hand) { hand_ = std::move(hand); }
  const std::string& hand() const { return hand_; }
  const std::shared_ptr<const Library>& library() const { return library_; }

  ScriptState& get() {
    if (!state_) state_ = std::make_unique<ScriptState>(library_, hand_);
    return *state_;
  }
  void drop() {
    state_.reset();
    ++generation_;
  }
  int generation() const { return generation_; }  // registry references of another generation are void

 private:
  std::shared_ptr<const Library> library_;
  std::string hand_;
  std::unique_ptr<ScriptState> state_;
  int generation_ = 0;
};

}  // namespace stampede
