#include <lua.hpp>
#include <new>

#include "scripting/lua/binding.h"
#include "scripting/runtime/view_binding.h"

namespace stampede {
namespace {

constexpr const char* kRandom = "stampede.random";
static_assert(std::is_trivially_destructible_v<Random> && alignof(Random) <= 8, "lives in a Lua userdata");

int uniform(lua_State* state) {
  lua_pushnumber(state, check_random(state, 1).uniform());
  return 1;
}

int between(lua_State* state) {
  const double low = luaL_checknumber(state, 2), high = luaL_checknumber(state, 3);
  lua_pushnumber(state, check_random(state, 1).between(low, high));
  return 1;
}

// Any range of whole numbers, the whole of them too: differences are taken without sign, where they cannot overflow.
int integer(lua_State* state) {
  const lua_Integer low = luaL_checkinteger(state, 2), high = luaL_checkinteger(state, 3);
  luaL_argcheck(state, low <= high, 3, "empty range");
  Random& random = check_random(state, 1);
  const std::uint64_t span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
  std::uint64_t above = 0;
  if (span < static_cast<std::uint64_t>(LUA_MAXINTEGER)) {
    above = static_cast<std::uint64_t>(random.below(static_cast<std::int64_t>(span) + 1));
  } else {
    do above = random.bits();  // at least every second is one of the range
    while (above > span);
  }
  lua_pushinteger(state, static_cast<lua_Integer>(static_cast<std::uint64_t>(low) + above));
  return 1;
}

int normal(lua_State* state) {
  lua_pushnumber(state, check_random(state, 1).normal());
  return 1;
}

int pick(lua_State* state) {
  luaL_checktype(state, 2, LUA_TTABLE);
  const auto count = static_cast<lua_Integer>(lua_rawlen(state, 2));
  luaL_argcheck(state, count > 0, 2, "nothing to pick from");
  lua_rawgeti(state, 2, 1 + check_random(state, 1).below(count));
  return 1;
}

}  // namespace

void push_random(lua_State* state, RandomKey key) {
  new (lua_newuserdatauv(state, sizeof(Random), 0)) Random(key);
  if (luaL_newmetatable(state, kRandom) != 0) {
    const luaL_Reg methods[] = {{"uniform", lua_function<uniform>}, {"between", lua_function<between>},
                                {"integer", lua_function<integer>}, {"normal", lua_function<normal>},
                                {"pick", lua_function<pick>},       {nullptr, nullptr}};
    luaL_newlib(state, methods);
    lua_setfield(state, -2, "__index");
    lua_pushboolean(state, 0);
    lua_setfield(state, -2, "__metatable");
  }
  lua_setmetatable(state, -2);
}

Random& check_random(lua_State* state, int index) {
  return *static_cast<Random*>(luaL_checkudata(state, index, kRandom));
}

}  // namespace stampede
