// Lists of names, as complaints show them. Room-internal.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/names.h"    // names_of, keys_of
#include "engine/base/nearest.h"  // did_you_mean
#include "engine/geometry/value.h"

namespace stampede {

inline bool listed(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// What a list names; what is no text leaves an empty name.
inline std::vector<std::string> texts_of(const Value& list) {
  std::vector<std::string> texts;
  for (const Value& item : list.items) texts.push_back(item.text);
  return texts;
}

}  // namespace stampede
