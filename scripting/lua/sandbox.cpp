#include "scripting/lua/sandbox.h"

#include <time.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/stopping.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/whitelist.h"

namespace stampede {

struct Sandbox::Impl {
  SandboxLimits limits;
  FindModule find_module;
  lua_State* state = nullptr;
  std::size_t memory = 0;
  std::int64_t used = 0;
  int depth = 0;  // nested calls share the outermost one's budget
  bool limited = false;
  bool spent = false;                             // for good
  std::map<const void*, std::size_t> long_texts;  // alive
  std::size_t longest = 0;                        // of them
  long tick = -1;                                 // of the cheap clock, when the other was read
  std::optional<double> started_s;                // of this thread's processor

  void begin() {
    heed_stop();
    if (spent) throw Error({}, "this script's instruction budget is spent", "it ran before and did not end");
    if (depth++ > 0) return;
    used = 0;
    tick = -1;
    started_s.reset();
  }
  void end() { --depth; }
};

namespace {

constexpr int kHookEvery = 1000;  // instructions; the cost of the hook does not depend on it
constexpr std::int64_t kBytesPerInstruction = 64;
// One instruction compares whole texts. As long as there is a long one, all instructions are charged as if they did.
constexpr std::size_t kLongText = 2048;
constexpr const char kSpent[] = "the script ran for too long: its instruction budget is spent";
constexpr const char kEnvironmentKey[] = "stampede.environment";
constexpr const char kModulesKey[] = "stampede.modules";

Sandbox::Impl& impl_of(lua_State* state) {
  return **static_cast<Sandbox::Impl**>(lua_getextraspace(state));  // new threads copy the main thread's
}

void forget_text(Sandbox::Impl& impl, const void* block) {
  const auto found = impl.long_texts.find(block);
  if (found == impl.long_texts.end()) return;  // a table, perhaps
  const bool was_longest = found->second == impl.longest;
  impl.long_texts.erase(found);
  if (!was_longest) return;
  impl.longest = 0;
  for (const auto& [text, size] : impl.long_texts) impl.longest = std::max(impl.longest, size);
}

// When no block is given, `old_size` is the kind of value: so strings alone are bounded in length. What is allocated
// is charged, because one instruction can copy a whole string.
void* allocate(void* user, void* block, std::size_t old_size, std::size_t new_size) {
  auto& impl = *static_cast<Sandbox::Impl*>(user);
  const bool fresh = block == nullptr;
  const std::size_t held = fresh ? 0 : old_size;
  if (new_size == 0) {
    impl.memory -= held;
    if (held > kLongText) forget_text(impl, block);
    std::free(block);
    return nullptr;
  }
  if (impl.limited && new_size > held) {
    if (fresh && old_size == LUA_TSTRING && new_size > kLongestString) return nullptr;
    if (impl.memory - held + new_size > impl.limits.memory_bytes) return nullptr;
    impl.used += static_cast<std::int64_t>(new_size) / kBytesPerInstruction;
    if (impl.depth > 0 && impl.used > impl.limits.instructions && !impl.spent) {  // once spent, the message needs room
      impl.spent = true;
      return nullptr;
    }
  }
  void* result = std::realloc(block, new_size);
  if (result != nullptr) impl.memory += new_size - held;
  if (result != nullptr && fresh && old_size == LUA_TSTRING && new_size > kLongText) {
    impl.long_texts[result] = new_size;
    impl.longest = std::max(impl.longest, new_size);
  }
  return result;
}

// An error outside every protected call (a push that found no memory): leave by an exception before Lua aborts.
int on_panic(lua_State*) { throw Error({}, "the script uses too much memory"); }

// A function of C++ may take milliseconds for one instruction, so it is asked often: the clock of the processor, which
// is slow to read, only where some milliseconds have gone by. Most calls take microseconds, and never read it.
bool out_of_time(Sandbox::Impl& impl) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC_COARSE, &now);
  if (const long last = std::exchange(impl.tick, now.tv_nsec); last < 0 || last == now.tv_nsec) return false;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  const double seconds = static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  if (!impl.started_s) impl.started_s = seconds;
  return seconds - *impl.started_s > impl.limits.seconds;
}

bool must_end(Sandbox::Impl& impl) {
  impl.spent = impl.spent || impl.used >= impl.limits.instructions || out_of_time(impl) || stop_asked();
  return impl.spent;
}

void on_count(lua_State* state, lua_Debug* where) {
  Sandbox::Impl& impl = impl_of(state);
  impl.used += lua_gethookcount(state) * static_cast<std::int64_t>(1 + impl.longest / kLongText);
  if (!must_end(impl)) return;
  lua_sethook(state, on_count, LUA_MASKCOUNT, 1);
  lua_getinfo(state, "Sl", where);  // luaL_error would name the caller
  lua_pushfstring(state, "%s:%d: %s", where->short_src, where->currentline, kSpent);
  lua_error(state);
}

// `tasks/stack.lua:4: message` → place and message.
Error error_from(std::string text, std::string trace) {
  const std::size_t mark = text.find(".lua:");
  if (mark == std::string::npos) return Error({}, std::move(text), std::move(trace));
  std::size_t end = mark + 5;
  while (end < text.size() && text[end] >= '0' && text[end] <= '9') ++end;
  const bool place = end > mark + 5 && text.compare(end, 2, ": ") == 0 && text.find(' ') > mark;
  if (!place) return Error({}, std::move(text), std::move(trace));
  return Error(text.substr(0, end), text.substr(end + 2), std::move(trace));
}

// The lines of a traceback that a person can act on.
std::string readable_trace(const char* trace) {
  std::string result;
  std::string_view rest = trace;
  bool first = true;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    while (!line.empty() && (line.front() == '\t' || line.front() == ' ')) line.remove_prefix(1);
    if (line.empty() || line.starts_with("[C]") || line.starts_with("stack traceback") ||
        line.starts_with("prelude:") || line.starts_with("(...tail calls...)"))
      continue;
    if (!first) result += "\n    ";
    result += first ? "in " : "from ";
    result += line;
    first = false;
  }
  return result;
}

int add_trace(lua_State* state) {
  const char* message = lua_tostring(state, 1);
  if (message == nullptr) {
    lua_pushfstring(state, "an error value that is a %s", luaL_typename(state, 1));
    message = lua_tostring(state, -1);
  }
  lua_settop(state, 2);
  luaL_traceback(state, state, nullptr, 1);
  lua_pushfstring(state, "%s\n\x01%s", message, lua_tostring(state, -1));
  return 1;
}

int trace_of(lua_State* state) {
  luaL_traceback(state, static_cast<lua_State*>(lua_touserdata(state, 1)), nullptr, 0);
  return 1;
}

[[noreturn]] void raise(lua_State* state, lua_State* thrower, int status, const Sandbox::Impl& impl) {
  std::string message, trace;
  if (impl.spent) {
    message = kSpent;
  }
  const char* text = status == LUA_ERRMEM ? nullptr : lua_tostring(thrower, -1);
  if (text != nullptr) {
    const std::string whole = text;
    const std::size_t cut = whole.find("\n\x01");
    const std::string said = whole.substr(0, cut);
    if (!impl.spent || said.find(kSpent) != std::string::npos) message = said;
    if (cut != std::string::npos) trace = readable_trace(whole.c_str() + cut + 2);
  } else if (message.empty()) {
    message = status == LUA_ERRMEM ? "the script uses too much memory (or a string longer than 64 KiB)"
                                   : "the script threw an error whose value is not text";
  }
  lua_settop(thrower, thrower == state ? lua_gettop(thrower) - 1 : 0);
  heed_stop();
  throw error_from(std::move(message), std::move(trace));
}

int protected_call(lua_State* state, Sandbox::Impl& impl, int arguments, int results) {
  const int handler = lua_gettop(state) - arguments;
  lua_pushcfunction(state, lua_function<add_trace>);
  lua_insert(state, handler);
  const int status = lua_pcall(state, arguments, results, handler);
  lua_remove(state, handler);
  impl.end();
  return status;
}

// Globals can be read and not written: a file that forgets `local` would change the next one.
int refuse_global(lua_State* state) {
  push_plain_text(state, 2);
  const char* name = lua_tostring(state, -1);
  return luaL_error(state, "'%s' is assigned without local: write local %s = …", name, name);
}

// Upvalues: bytecode, name. Runs inside a protected call because loading allocates.
int load_chunk(lua_State* state) {
  const auto* bytecode = static_cast<const std::string_view*>(lua_touserdata(state, 1));
  const auto* name = static_cast<const std::string_view*>(lua_touserdata(state, 2));
  lua_settop(state, 0);
  if (luaL_loadbufferx(state, bytecode->data(), bytecode->size(), std::string(*name).c_str(), "b") != LUA_OK) {
    return lua_error(state);
  }
  lua_getfield(state, LUA_REGISTRYINDEX, kEnvironmentKey);
  lua_setupvalue(state, 1, 1);
  lua_call(state, 0, LUA_MULTRET);
  return lua_gettop(state);
}

int require_module(lua_State* state) {
  const char* name = luaL_checkstring(state, 1);
  lua_getfield(state, LUA_REGISTRYINDEX, kModulesKey);
  const int modules = lua_gettop(state);
  if (lua_getfield(state, modules, name) != LUA_TNIL) {
    if (lua_islightuserdata(state, -1)) return luaL_error(state, "'%s' requires itself", name);
    return 1;
  }
  Sandbox::Impl& impl = impl_of(state);
  std::string_view bytecode = impl.find_module ? impl.find_module(name) : std::string_view();
  if (bytecode.empty()) return luaL_error(state, "require finds no '%s' inside the roots", name);
  lua_pushlightuserdata(state, &impl);
  lua_setfield(state, modules, name);
  std::string_view chunk = name;
  lua_pushcfunction(state, lua_function<load_chunk>);
  lua_pushlightuserdata(state, &bytecode);
  lua_pushlightuserdata(state, &chunk);
  lua_call(state, 2, 1);
  if (lua_isnil(state, -1)) return luaL_error(state, "the module '%s' returns nothing", name);
  lua_pushvalue(state, -1);
  lua_setfield(state, modules, name);
  return 1;
}

int forget_modules(lua_State* state) {
  lua_newtable(state);
  lua_setfield(state, LUA_REGISTRYINDEX, kModulesKey);
  return 0;
}

int set_up(lua_State* state) {
  install_whitelist(state);
  forget_modules(state);
  lua_pushglobaltable(state);
  lua_pushcfunction(state, lua_function<require_module>);
  lua_setfield(state, -2, "require");
  lua_newtable(state);  // the environment of all chunks: reads globals, refuses writes
  lua_newtable(state);
  lua_pushvalue(state, -3);
  lua_setfield(state, -2, "__index");
  lua_pushcfunction(state, lua_function<refuse_global>);
  lua_setfield(state, -2, "__newindex");
  lua_setmetatable(state, -2);
  lua_setfield(state, LUA_REGISTRYINDEX, kEnvironmentKey);
  return 0;
}

int append_bytes(lua_State*, const void* bytes, std::size_t size, void* user) {
  static_cast<std::string*>(user)->append(static_cast<const char*>(bytes), size);
  return 0;
}

}  // namespace

void charge(lua_State* state, std::int64_t cost) {
  Sandbox::Impl& impl = impl_of(state);
  impl.used += cost;
  if (impl.depth == 0 || !must_end(impl)) return;
  lua_sethook(state, on_count, LUA_MASKCOUNT, 1);
  luaL_error(state, "%s", kSpent);
}

Sandbox::Sandbox(const SandboxLimits& limits, FindModule find_module) : impl_(std::make_unique<Impl>()) {
  impl_->limits = limits;
  impl_->find_module = std::move(find_module);
  impl_->state = lua_newstate(allocate, impl_.get());
  if (impl_->state == nullptr) throw Error({}, "no memory for a Lua state");
  *static_cast<Impl**>(lua_getextraspace(impl_->state)) = impl_.get();
  lua_atpanic(impl_->state, on_panic);
  lua_pushcfunction(impl_->state, lua_function<set_up>);
  if (lua_pcall(impl_->state, 0, 0, 0) != LUA_OK) {
    const std::string message = lua_tostring(impl_->state, -1);
    lua_close(impl_->state);
    throw Error({}, "setting up Lua: " + message);
  }
  impl_->limited = true;
  lua_sethook(impl_->state, on_count, LUA_MASKCOUNT, kHookEvery);
}

Sandbox::~Sandbox() {
  impl_->limited = false;
  lua_close(impl_->state);
}

lua_State* Sandbox::state() const { return impl_->state; }

void Sandbox::call(int arguments, int results) {
  impl_->begin();
  const int status = protected_call(impl_->state, *impl_, arguments, results);
  if (status != LUA_OK) raise(impl_->state, impl_->state, status, *impl_);
}

void Sandbox::run(std::string_view bytecode, std::string_view chunk_name, int results) {
  lua_State* state = impl_->state;
  luaL_checkstack(state, 8, "too many values");
  lua_pushcfunction(state, lua_function<load_chunk>);
  lua_pushlightuserdata(state, &bytecode);
  lua_pushlightuserdata(state, &chunk_name);
  call(2, results);
}

void Sandbox::start_afresh() {
  lua_settop(impl_->state, 0);
  lua_pushcfunction(impl_->state, lua_function<forget_modules>);
  call(0, 0);
  if (impl_->longest > 0) lua_gc(impl_->state, LUA_GCCOLLECT);  // or the next script pays for the last one's long texts
}

bool Sandbox::resume(lua_State* coroutine, int arguments, int& results) {
  impl_->begin();
  const int status = lua_resume(coroutine, impl_->state, arguments, &results);
  impl_->end();
  if (status == LUA_OK) return false;
  if (status == LUA_YIELD) return true;
  // The coroutine's stack is as it was at the error: the trace is made in a protected call of the main state.
  lua_State* state = impl_->state;
  std::string trace;
  if (status != LUA_ERRMEM && !impl_->spent) {
    lua_pushcfunction(state, lua_function<trace_of>);
    lua_pushlightuserdata(state, coroutine);
    if (lua_pcall(state, 1, 1, 0) == LUA_OK) trace = readable_trace(lua_tostring(state, -1));
    lua_pop(state, 1);
  }
  const char* text = status == LUA_ERRMEM ? nullptr : lua_tostring(coroutine, -1);
  std::string message = text != nullptr        ? text
                        : status == LUA_ERRMEM ? "the script uses too much memory (or a string longer than 64 KiB)"
                                               : "the script threw an error whose value is not text";
  heed_stop();
  if (impl_->spent && message.find(kSpent) == std::string::npos) message = kSpent;
  throw error_from(std::move(message), std::move(trace));
}

// Where a source has a zero byte in a text, or an escape that makes one: the first line that does, or 0.
namespace {

int line_of_zero(std::string_view source) {
  int line = 1;
  for (std::size_t i = 0; i < source.size(); ++i) {
    if (source[i] == '\n') ++line;
    if (source[i] == '\0') return line;
    if (source[i] != '\\' || i + 1 >= source.size()) continue;
    const std::string_view after = source.substr(++i);
    std::size_t digits = 0;
    while (digits < 3 && digits < after.size() && after[digits] >= '0' && after[digits] <= '9') ++digits;
    const bool decimal = digits > 0 && after.substr(0, digits).find_first_not_of('0') == std::string_view::npos;
    const bool unicode = after.starts_with("u{0") && after.find_first_not_of('0', 2) == after.find('}');
    if (decimal || after.starts_with("x00") || unicode) return line;
    if (source[i] == '\n') ++line;
  }
  return 0;
}

}  // namespace

std::string Sandbox::compile(std::string_view source, std::string_view chunk_name) {
  // Comparing texts with zero bytes takes a call for each of them: nothing here needs one.
  if (const int line = line_of_zero(source); line > 0)
    throw Error(std::string(chunk_name) + ":" + std::to_string(line), "a text with a zero byte",
                "leave out \\0: texts are for people");
  const std::unique_ptr<lua_State, void (*)(lua_State*)> state(luaL_newstate(), lua_close);
  if (!state) throw Error(std::string(chunk_name), "no memory for a Lua state");
  const std::string name = "@" + std::string(chunk_name);
  if (luaL_loadbufferx(state.get(), source.data(), source.size(), name.c_str(), "t") != LUA_OK) {
    throw error_from(lua_tostring(state.get(), -1), {});
  }
  std::string bytecode;
  lua_dump(state.get(), append_bytes, &bytecode, 0);
  return bytecode;
}

bool is_environment(lua_State* state, int index) {
  index = lua_absindex(state, index);
  lua_getfield(state, LUA_REGISTRYINDEX, kEnvironmentKey);
  const bool same = lua_rawequal(state, index, -1) != 0;
  lua_pop(state, 1);
  return same;
}

}  // namespace stampede
