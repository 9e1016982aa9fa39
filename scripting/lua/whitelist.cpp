#include "scripting/lua/whitelist.h"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/nearest.h"
#include "scripting/lua/binding.h"

namespace stampede {
namespace {

constexpr std::size_t kLongestRep = kLongestString - 64;  // room for the header of a string
constexpr std::size_t kLongestNeedle = 256;               // find is quadratic at worst: this and the charge bound it
constexpr lua_Integer kMostUnpacked = 10'000;
constexpr std::size_t kLongestNumber = 200;  // bytes; Lua's own limit for what it writes
constexpr const char* kArithmetic[] = {"__add", "__sub", "__mul", "__mod", "__pow", "__div", "__idiv", "__unm"};

int plain_tostring(lua_State* state) {
  luaL_checkany(state, 1);
  push_plain_text(state, 1);
  return 1;
}

// Upvalue 1: the stock format.
int plain_format(lua_State* state) {
  const std::string_view format = check_text(state, 1);
  std::int64_t cost = static_cast<std::int64_t>(format.size());
  for (std::size_t i = 0; i + 1 < format.size(); ++i) {
    if (format[i] != '%') continue;
    const std::size_t kind = format.find_first_not_of("0123456789.-+# ", i + 1);
    if (kind == std::string_view::npos) break;
    if (format[kind] == 'c') return luaL_error(state, "format has no %%c: write string.char");
    if (format[kind] == 'p') return luaL_error(state, "format has no %%p: addresses differ from run to run");
    i = kind;
  }
  const int count = lua_gettop(state);
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  for (int i = 3; i <= count + 1; ++i) {
    const int type = lua_type(state, i);
    if (type == LUA_TSTRING) cost += static_cast<std::int64_t>(lua_rawlen(state, i));
    if (type == LUA_TNUMBER || type == LUA_TSTRING) continue;
    push_plain_text(state, i);
    lua_replace(state, i);
  }
  charge(state, cost / 4);
  lua_call(state, count, 1);
  return 1;
}

int bounded_rep(lua_State* state) {
  const std::string_view text = check_text(state, 1);
  const lua_Integer times = std::max<lua_Integer>(0, luaL_checkinteger(state, 2));
  const std::string_view between = lua_isnoneornil(state, 3) ? std::string_view() : check_text(state, 3);
  const std::size_t each = text.size() + between.size();
  if (times > 0 &&
      (static_cast<std::uint64_t>(times) > kLongestRep || each * static_cast<std::size_t>(times) > kLongestRep)) {
    return luaL_error(state, "string.rep makes at most %d bytes", static_cast<int>(kLongestRep));
  }
  charge(state, static_cast<std::int64_t>(each) * times / 16 + times);
  std::string result;
  for (lua_Integer i = 0; i < times; ++i) {
    if (i > 0) result += between;
    result += text;
  }
  lua_pushlstring(state, result.data(), result.size());
  return 1;
}

int plain_find(lua_State* state) {
  const std::string_view text = check_text(state, 1), needle = check_text(state, 2);
  lua_Integer from = luaL_optinteger(state, 3, 1);
  const lua_Integer length = static_cast<lua_Integer>(text.size());
  if (from < 0) from = std::max<lua_Integer>(1, from + length + 1);
  if (from == 0) from = 1;
  if (needle.size() > kLongestNeedle) return luaL_error(state, "string.find looks for at most 256 bytes");
  charge(state, length / 4 + 1);
  const std::size_t at =
      from > length + 1 ? std::string_view::npos : text.find(needle, static_cast<std::size_t>(from - 1));
  if (at == std::string_view::npos) {
    lua_pushnil(state);
    return 1;
  }
  lua_pushinteger(state, static_cast<lua_Integer>(at) + 1);
  lua_pushinteger(state, static_cast<lua_Integer>(at + needle.size()));
  return 2;
}

// Reading a number takes time for each digit, and an operator asks nobody: so long ones are none.
bool too_long_for_number(lua_State* state, int index) {
  if (lua_type(state, index) != LUA_TSTRING) return false;
  charge(state, static_cast<std::int64_t>(std::min(kLongestNumber, std::size_t{lua_rawlen(state, index)})));
  return lua_rawlen(state, index) > kLongestNumber;
}

void refuse_long_numbers(lua_State* state) {
  for (int i = 1; i <= lua_gettop(state); ++i)
    if (too_long_for_number(state, i))
      luaL_error(state, "a text of more than %d bytes is no number", static_cast<int>(kLongestNumber));
}

// A stock function of any number of numbers. Upvalue 1: the function.
int of_short_numbers(lua_State* state) {
  charge(state, lua_gettop(state));
  refuse_long_numbers(state);
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, 1);
  return 1;
}

// Upvalue 1: the stock tonumber.
int plain_tonumber(lua_State* state) {
  if (too_long_for_number(state, 1)) {
    lua_pushnil(state);
    return 1;
  }
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, 1);
  return 1;
}

// `"1" + 2`. Upvalue 1: the stock operator.
int text_arithmetic(lua_State* state) {
  refuse_long_numbers(state);
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, 1);
  return 1;
}

// Upvalue 1: the stock byte.
int bounded_byte(lua_State* state) {
  const auto length = static_cast<lua_Integer>(check_text(state, 1).size());
  lua_Integer first = luaL_optinteger(state, 2, 1);
  if (first < 0) first = std::max<lua_Integer>(1, first + length + 1);
  lua_Integer last = luaL_optinteger(state, 3, first);
  if (last < 0) last += length + 1;
  last = std::min(last, length);
  if (last >= first && last - first >= kMostUnpacked)
    return luaL_error(state, "string.byte gives at most 10000 values");
  charge(state, std::max<lua_Integer>(1, last - first));
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
  return lua_gettop(state);
}

// Upvalue 1: the stock char.
int char_without_zero(lua_State* state) {
  const int count = lua_gettop(state);
  refuse_long_numbers(state);
  for (int i = 1; i <= count; ++i)
    luaL_argcheck(state, luaL_checkinteger(state, i) != 0, i, "texts hold no zero bytes");
  charge(state, count);
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, count, 1);
  return 1;
}

// A stock function of one string whose cost is its length. Upvalue 1: the function.
int charged_text(lua_State* state) {
  charge(state, static_cast<std::int64_t>(check_text(state, 1).size()) / 8);
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
  return lua_gettop(state);
}

lua_Integer raw_length(lua_State* state, int index) {
  luaL_checktype(state, index, LUA_TTABLE);
  return static_cast<lua_Integer>(lua_rawlen(state, index));
}

int raw_insert(lua_State* state) {
  const lua_Integer length = raw_length(state, 1);
  lua_Integer at = length + 1;
  if (lua_gettop(state) == 3) {
    at = luaL_checkinteger(state, 2);
    luaL_argcheck(state, at >= 1 && at <= length + 1, 2, "position out of bounds");
  } else if (lua_gettop(state) != 2) {
    return luaL_error(state, "table.insert takes (list, value) or (list, position, value)");
  }
  charge(state, length - at + 1);
  for (lua_Integer i = length; i >= at; --i) {
    lua_rawgeti(state, 1, i);
    lua_rawseti(state, 1, i + 1);
  }
  lua_rawseti(state, 1, at);
  return 0;
}

int raw_remove(lua_State* state) {
  const lua_Integer length = raw_length(state, 1);
  const lua_Integer at = luaL_optinteger(state, 2, length);
  if (length == 0) return 0;
  luaL_argcheck(state, at >= 1 && at <= length, 2, "position out of bounds");
  charge(state, length - at + 1);
  lua_rawgeti(state, 1, at);
  for (lua_Integer i = at; i < length; ++i) {
    lua_rawgeti(state, 1, i + 1);
    lua_rawseti(state, 1, i);
  }
  lua_pushnil(state);
  lua_rawseti(state, 1, length);
  return 1;
}

int raw_concat(lua_State* state) {
  const lua_Integer length = raw_length(state, 1);
  const std::string_view between = lua_isnoneornil(state, 2) ? std::string_view() : check_text(state, 2);
  const lua_Integer first = std::max<lua_Integer>(1, luaL_optinteger(state, 3, 1));
  const lua_Integer last = std::min(length, luaL_optinteger(state, 4, length));
  std::string result;
  for (lua_Integer i = first; i <= last; ++i) {
    lua_rawgeti(state, 1, i);
    const int type = lua_type(state, -1);
    if (type != LUA_TSTRING && type != LUA_TNUMBER) {
      return luaL_error(state, "table.concat: value %d is a %s", static_cast<int>(i), luaL_typename(state, -1));
    }
    if (i > first) result += between;
    result += check_text(state, -1);
    lua_pop(state, 1);
    charge(state, 1);
    if (result.size() > kLongestRep) return luaL_error(state, "table.concat makes at most 64 KiB");
  }
  charge(state, static_cast<std::int64_t>(result.size()) / 16);
  lua_pushlstring(state, result.data(), result.size());
  return 1;
}

int raw_unpack(lua_State* state) {
  const lua_Integer first = luaL_optinteger(state, 2, 1);
  const lua_Integer last = luaL_optinteger(state, 3, raw_length(state, 1));
  if (first > last) return 0;
  const lua_Unsigned count = static_cast<lua_Unsigned>(last) - static_cast<lua_Unsigned>(first) + 1;
  if (count == 0 || count > static_cast<lua_Unsigned>(kMostUnpacked)) {
    return luaL_error(state, "table.unpack gives at most 10000 values");
  }
  charge(state, static_cast<std::int64_t>(count));
  luaL_checkstack(state, static_cast<int>(count), "too many values to unpack");
  for (lua_Unsigned i = 0; i < count; ++i) lua_rawgeti(state, 1, first + static_cast<lua_Integer>(i));
  return static_cast<int>(count);
}

struct Key {
  bool is_text = false;
  lua_Integer number = 0;
  std::string_view text;  // kept alive by its table
  bool operator<(const Key& other) const {
    if (is_text != other.is_text) return other.is_text;  // whole numbers first
    return is_text ? text < other.text : number < other.number;
  }
};

std::vector<Key> sorted_keys(lua_State* state, int index) {
  std::vector<Key> keys;
  lua_pushnil(state);
  while (lua_next(state, index) != 0) {
    lua_pop(state, 1);
    charge(state, 4);
    if (lua_type(state, -1) == LUA_TSTRING) {
      keys.push_back({true, 0, check_text(state, -1)});
    } else if (lua_isinteger(state, -1)) {
      keys.push_back({false, lua_tointeger(state, -1), {}});
    } else {
      luaL_error(state, "pairs: keys are names and whole numbers, this table has a %s", luaL_typename(state, -1));
    }
  }
  std::int64_t bytes = 0;
  for (const Key& key : keys) bytes += static_cast<std::int64_t>(key.text.size());
  charge(state, bytes);  // compared a few times each
  std::sort(keys.begin(), keys.end());
  return keys;
}

// Upvalues: sorted keys, position.
int next_pair(lua_State* state) {
  lua_Integer position = lua_tointeger(state, lua_upvalueindex(2));
  for (;;) {
    ++position;
    lua_pushinteger(state, position);
    lua_replace(state, lua_upvalueindex(2));
    if (lua_rawgeti(state, lua_upvalueindex(1), position) == LUA_TNIL) return 1;
    lua_pushvalue(state, -1);
    if (lua_rawget(state, 1) != LUA_TNIL) return 2;  // removed meanwhile: passed over
    lua_pop(state, 2);
    charge(state, 1);
  }
}

int sorted_pairs(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const std::vector<Key> keys = sorted_keys(state, 1);
  lua_createtable(state, static_cast<int>(keys.size()), 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].is_text) {
      lua_pushlstring(state, keys[i].text.data(), keys[i].text.size());
    } else {
      lua_pushinteger(state, keys[i].number);
    }
    lua_rawseti(state, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_pushinteger(state, 0);
  lua_pushcclosure(state, lua_function<next_pair>, 2);
  lua_pushvalue(state, 1);
  lua_pushnil(state);
  return 3;
}

int read_only(lua_State* state) {
  push_plain_text(state, 2);
  return luaL_error(state, "'%s' cannot be changed", lua_tostring(state, -1));
}

// What people reach for and a sandbox does not have, and what there is in its place.
std::string in_place_of(std::string_view name) {
  static const std::string kDraws =
      "between(low, high), one_of { … } and sample_of(list, n) draw in the fields of a file, rng in samplers: so an "
      "episode can be made again";
  static const std::string kPatterns =
      "there are no patterns: find looks for plain text; sub, byte and format do the rest";
  static const std::map<std::string, std::string, std::less<>> kInstead = {
      {"math.pow", "write x ^ y"},
      {"math.random", kDraws},
      {"math.randomseed", kDraws},
      {"math.round", "write math.floor(x + 0.5)"},
      {"string.gmatch", kPatterns},
      {"string.gsub", kPatterns},
      {"string.match", kPatterns},
      {"table.getn", "write #list"},
      {"table.pack", "write { … }"},
      {"io", "a script reads no files: tables of data stand in a module, which require finds"},
      {"next", "pairs goes through a table"},
      {"os", "a script knows no clock and no files: w:time() is the episode's"},
      {"pcall", "a mistake ends the script; robot:fail(\"why\") gives a skill up"},
      {"random", kDraws},
      {"print", "a script prints nothing: error(\"what\") says it with its line"},
      {"unpack", "write table.unpack"},
  };
  const auto found = kInstead.find(name);
  return found == kInstead.end() ? "" : found->second;
}

// Names of the table at `index`.
std::vector<std::string> names_in(lua_State* state, int index) {
  std::vector<std::string> names;
  for (lua_pushnil(state); lua_next(state, index) != 0; lua_pop(state, 1))
    if (lua_type(state, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(state, -2));
  return names;
}

[[noreturn]] void say_unknown(lua_State* state, const std::string& before, const std::string& what) {
  push_plain_text(state, 2);
  const std::string name = lua_tostring(state, -1);
  std::string cure = in_place_of(before + name);
  if (cure.empty()) cure = did_you_mean(name, names_in(state, 1));
  throw std::runtime_error(what + " '" + before + name + "'" + (cure.empty() ? "" : ": " + cure));
}

int unknown_word(lua_State* state) { say_unknown(state, "", "unknown name"); }

// Upvalue: the library's name.
int unknown_function(lua_State* state) {
  say_unknown(state, std::string(lua_tostring(state, lua_upvalueindex(1))) + ".", "there is no");
}

// Copies a field of the table on top to the table at `to`, through `wrapper` when there is one.
void copy_function(lua_State* state, int to, const char* name, lua_CFunction wrapper = nullptr) {
  lua_getfield(state, -1, name);
  if (wrapper != nullptr) lua_pushcclosure(state, wrapper, 1);
  lua_setfield(state, to, name);
}

// Puts a read-only view of the table on top in its place: no file can change what another one calls. What it does not
// have is a mistake that says so.
void protect(lua_State* state, const char* library) {
  lua_newtable(state);
  lua_pushstring(state, library);
  lua_pushcclosure(state, lua_function<unknown_function>, 1);
  lua_setfield(state, -2, "__index");
  lua_setmetatable(state, -2);
  lua_newtable(state);
  lua_newtable(state);
  lua_pushvalue(state, -3);
  lua_setfield(state, -2, "__index");
  lua_pushcfunction(state, lua_function<read_only>);
  lua_setfield(state, -2, "__newindex");
  lua_setmetatable(state, -2);
  lua_remove(state, -2);
}

void install_string(lua_State* state, int globals) {
  lua_newtable(state);
  const int text = lua_gettop(state);
  luaL_requiref(state, "string", luaopen_string, 0);
  for (const char* name : {"len", "sub"}) copy_function(state, text, name);
  copy_function(state, text, "byte", lua_function<bounded_byte>);
  copy_function(state, text, "char", lua_function<char_without_zero>);
  for (const char* name : {"lower", "upper", "reverse"}) copy_function(state, text, name, lua_function<charged_text>);
  copy_function(state, text, "format", lua_function<plain_format>);
  lua_pop(state, 1);
  const LuaFunction own[] = {{"rep", lua_function<bounded_rep>}, {"find", lua_function<plain_find>}};
  set_functions(state, own);
  protect(state, "string");
  lua_pushliteral(state, "");
  lua_getmetatable(state, -1);
  lua_pushvalue(state, -3);
  lua_setfield(state, -2, "__index");  // ("x"):rep(3) finds ours too
  for (const char* name : kArithmetic) copy_function(state, lua_gettop(state), name, lua_function<text_arithmetic>);
  lua_pop(state, 2);
  lua_setfield(state, globals, "string");
}

void install_table(lua_State* state, int globals) {
  lua_newtable(state);
  const LuaFunction own[] = {{"insert", lua_function<raw_insert>},
                             {"remove", lua_function<raw_remove>},
                             {"concat", lua_function<raw_concat>},
                             {"unpack", lua_function<raw_unpack>}};
  set_functions(state, own);  // sort: whitelist.lua, in Lua, so that the hook counts its comparisons
  lua_setfield(state, globals, "table");
}

void install_math(lua_State* state, int globals) {
  lua_newtable(state);
  const int own = lua_gettop(state);
  luaL_requiref(state, "math", luaopen_math, 0);
  for (const char* name :
       {"abs", "acos", "asin", "atan", "ceil",      "cos",  "deg", "exp", "floor", "fmod",       "log",       "modf",
        "rad", "sin",  "sqrt", "tan",  "tointeger", "type", "ult", "pi",  "huge",  "maxinteger", "mininteger"}) {
    copy_function(state, own, name);
  }
  for (const char* name : {"max", "min"}) copy_function(state, own, name, lua_function<of_short_numbers>);
  lua_pop(state, 1);
  protect(state, "math");
  lua_setfield(state, globals, "math");
}

// In Lua: its comparisons are counted, any comparator ends, equal values keep their order.
constexpr const char kSort[] = R"lua(
local table, type, error = ...
function table.sort(list, before)
  if type(list) ~= "table" then error("table.sort takes a table", 2) end
  before = before or function(a, b) return a < b end
  local from, to, count, width = list, {}, #list, 1
  while width < count do
    for low = 1, count, 2 * width do
      local middle, high = low + width, low + 2 * width
      if middle > count + 1 then middle = count + 1 end
      if high > count + 1 then high = count + 1 end
      local left, right = low, middle
      for i = low, high - 1 do
        if left < middle and (right >= high or not before(from[right], from[left])) then
          to[i] = from[left]; left = left + 1
        else
          to[i] = from[right]; right = right + 1
        end
      end
    end
    from, to = to, from == list and {} or from
    width = 2 * width
  end
  if from ~= list then for i = 1, count do list[i] = from[i] end end
end
)lua";

}  // namespace

void push_plain_text(lua_State* state, int index) {
  const int type = lua_type(state, index);
  const bool plain = type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING;
  if (plain || luaL_getmetafield(state, index, "__tostring") != LUA_TNIL) {
    if (!plain) lua_pop(state, 1);
    luaL_tolstring(state, index, nullptr);
  } else {
    lua_pushstring(state, luaL_typename(state, index));
  }
}

void install_whitelist(lua_State* state) {
  lua_newtable(state);
  const int globals = lua_gettop(state);
  luaL_requiref(state, "_G", luaopen_base, 0);
  for (const char* name : {"ipairs", "select", "type", "error", "assert"}) copy_function(state, globals, name);
  copy_function(state, globals, "tonumber", lua_function<plain_tonumber>);
  lua_pop(state, 1);
  lua_pushcfunction(state, lua_function<sorted_pairs>);
  lua_setfield(state, globals, "pairs");
  lua_pushcfunction(state, lua_function<plain_tostring>);
  lua_setfield(state, globals, "tostring");
  install_string(state, globals);
  install_table(state, globals);
  install_math(state, globals);
  if (luaL_loadbufferx(state, kSort, sizeof kSort - 1, "=table.sort", "t") != LUA_OK) lua_error(state);
  lua_getfield(state, globals, "table");
  lua_getfield(state, globals, "type");
  lua_getfield(state, globals, "error");
  lua_call(state, 3, 0);
  lua_getfield(state, globals, "table");
  protect(state, "table");
  lua_setfield(state, globals, "table");
  lua_newtable(state);
  lua_pushcfunction(state, lua_function<unknown_word>);
  lua_setfield(state, -2, "__index");
  lua_setmetatable(state, globals);
  lua_rawseti(state, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
}

}  // namespace stampede
