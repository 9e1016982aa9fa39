// What many things are called, for complaints and tables.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

namespace stampede {

// Of things that have a name each, or of pointers to such.
template <typename Things>
std::vector<std::string> names_of(const Things& things) {
  std::vector<std::string> names;
  for (const auto& thing : things) {
    if constexpr (std::is_pointer_v<std::remove_cvref_t<decltype(thing)>>)
      names.push_back(thing->name);
    else
      names.push_back(thing.name);
  }
  return names;
}

// Of a map's entries.
template <typename Map>
std::vector<std::string> keys_of(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

}  // namespace stampede
