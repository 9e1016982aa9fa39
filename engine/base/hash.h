// Content hashes: stable across runs, machines and releases, because catalogues store them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

namespace stampede {

// 128-bit XXH3 of the bytes, as 32 lower-case hexadecimal digits. Not for secrets.
std::string content_hash(std::string_view bytes);

// 64-bit XXH3, for keys of random streams.
std::uint64_t hash64(std::string_view bytes, std::uint64_t seed = 0);

// Hashes values piece by piece; the same pieces give the same digest.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(Hasher&&) noexcept;
  Hasher& operator=(Hasher&&) noexcept;

  Hasher& bytes(const void* data, std::size_t size);
  Hasher& text(std::string_view text);  // its length is hashed too, so ("ab","c") differs from ("a","bc")
  template <typename Number>
  requires std::is_arithmetic_v<Number> Hasher& number(Number value) { return bytes(&value, sizeof value); }
  std::string digest() const;  // as content_hash; more may be added afterwards

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stampede
