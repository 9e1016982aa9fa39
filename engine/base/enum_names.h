// Enumerations and their names, as files, catalogues and command lines say them.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace stampede {

// Names in the order of the values, which count from 0.
template <typename Enumeration, std::size_t N>
constexpr std::string_view enum_name(const std::array<std::string_view, N>& names, Enumeration value) {
  return names.at(static_cast<std::size_t>(value));
}

// Nothing for a word that is none of them.
template <typename Enumeration, std::size_t N>
constexpr std::optional<Enumeration> enum_from(const std::array<std::string_view, N>& names, std::string_view name) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == name) return static_cast<Enumeration>(i);
  return std::nullopt;
}

}  // namespace stampede
