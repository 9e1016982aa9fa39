// What a script finds in its globals before any word of the authoring language: bounded, repeatable, without addresses.
#pragma once

#include <cstddef>
#include <cstdint>

struct lua_State;

namespace stampede {

// Comparing and copying strings is one instruction however long they are, so their length is bounded.
constexpr std::size_t kLongestString = 64u << 10;  // bytes

// Replaces the globals of a fresh state by the whitelist. C functions charge their cost, because the count hook does
// not fire inside them.
void install_whitelist(lua_State* state);

// Pushes what tostring says of a value: never an address, which differs from run to run.
void push_plain_text(lua_State* state, int index);

// Takes `cost` instructions from the budget of the sandbox that owns the state. Raises a Lua error when it is spent.
void charge(lua_State* state, std::int64_t cost);

}  // namespace stampede
