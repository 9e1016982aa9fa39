// A Lua state that only our whitelist reaches, with budgets on instructions and memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

struct lua_State;

namespace stampede {

struct SandboxLimits {
  std::int64_t instructions = 50'000'000;  // per call into Lua, all its coroutines together; a spent budget stays spent
  std::size_t memory_bytes = 64u << 20;
  // Of processor time per call: a net under the budgets, for what they do not foresee. No honest script gets there.
  double seconds = 8;
};

// One fresh state. Globals: the whitelist of design (arithmetic, bounded string/table/math, sorted pairs, ipairs,
// select, type, tonumber, tostring of plain values, error, assert, require inside the roots). No io, os, debug, load,
// pcall, coroutine, metatables with __gc. Lifetime: values of a state die with it.
class Sandbox {
 public:
  // `find_module` maps a require name to bytecode (empty: not found).
  using FindModule = std::function<std::string_view(std::string_view name)>;
  Sandbox(const SandboxLimits& limits, FindModule find_module);
  ~Sandbox();
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  lua_State* state() const;
  // Loads a chunk (bytecode from compile()) and runs it with the usual budget; its results are left on the stack.
  // Throws Error with place, message and traceback. Budgets and memory end in such an Error too, never in a hang.
  void run(std::string_view bytecode, std::string_view chunk_name, int results);
  // Calls the function below its `arguments` on the stack of `state()`, with a fresh budget. Throws Error.
  void call(int arguments, int results);
  // Resumes a coroutine (made by lua_newthread on this state) with a fresh budget: true when it yielded, false when it
  // returned. Throws Error when it raised one.
  bool resume(lua_State* coroutine, int arguments, int& results);

  // Forgets the modules that were required, and the stack: the next script finds the state as a fresh one would be.
  // Not after an Error: a budget may be spent for good.
  void start_afresh();

  static std::string compile(std::string_view source, std::string_view chunk_name);  // throws Error: file:line: message

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

// Is the value at `index` the environment of all chunks, which refuses writes?
bool is_environment(lua_State* state, int index);

}  // namespace stampede
