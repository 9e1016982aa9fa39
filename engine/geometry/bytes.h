// Values as bytes and back, for what one process hands to another of the same program; inside this folder.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/base/error.h"

namespace stampede {

class ByteWriter {
 public:
  template <typename Value>
  requires std::is_trivially_copyable_v<Value>
  void put(const Value& value) { bytes_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void put(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }
  template <typename Item>
  void put_all(const std::vector<Item>& items) {
    static_assert(std::is_standard_layout_v<Item>);
    put(static_cast<std::uint64_t>(items.size()));
    bytes_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(Item));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Throws Error when the bytes end too early.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <typename Value>
  Value get() {
    Value value{};
    std::memcpy(&value, some(sizeof value), sizeof value);
    return value;
  }
  std::string text() {
    const auto size = get<std::uint64_t>();
    return {some(size), static_cast<std::size_t>(size)};
  }
  template <typename Item>
  std::vector<Item> all() {
    const auto count = get<std::uint64_t>();
    if (count > rest_.size() / sizeof(Item)) short_of();
    std::vector<Item> items(count);
    const char* const from = some(count * sizeof(Item));
    if (count > 0) std::memcpy(static_cast<void*>(items.data()), from, count * sizeof(Item));
    return items;
  }

 private:
  [[noreturn]] static void short_of() { throw Error("mesh", "what its reader says is cut off", "try again"); }
  const char* some(std::uint64_t size) {
    if (size > rest_.size()) short_of();
    const char* const at = rest_.data();
    rest_.remove_prefix(static_cast<std::size_t>(size));
    return at;
  }
  std::string_view rest_;
};

}  // namespace stampede
