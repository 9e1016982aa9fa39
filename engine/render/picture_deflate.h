// Compression of pictures (zlib streams, RFC 1950 and 1951): repeats are looked for where pictures have them, left of a
// pixel and in the row above, and nowhere else.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stampede {

// Lifetime: keeps room for the next picture; one thread.
class PictureDeflate {
 public:
  // Rows of `row_size` bytes (a PNG filter's number and pixels of `pixel_size` bytes); the stream is added to `out`.
  void add_stream(std::span<const std::uint8_t> rows, std::size_t row_size, std::size_t pixel_size,
                  std::vector<std::uint8_t>& out);

 private:
  static constexpr std::size_t kLiterals = 286, kDistances = 30;
  static constexpr int kHashBits = 12;
  template <std::size_t size>
  struct Code {
    std::array<std::uint32_t, size> counts{};
    std::array<std::uint16_t, size> words{};  // lowest bit first
    std::array<std::uint8_t, size> lengths{};
    void settle(int most_bits);
  };

  // Bits go out lowest first, and eight bytes at a time of which the next call overwrites what is not whole yet.
  struct Bits {
    std::uint8_t* at = nullptr;
    std::uint64_t waiting = 0;
    int count = 0;                           // below 8
    void put(std::uint64_t bits, int more);  // at most 56
  };

  void add_literals(const std::uint8_t* at, std::size_t count);
  void add_repeat(std::size_t length, std::size_t distance);
  void put_block(bool last);
  void put_lengths(Bits& to) const;
  void put_tokens(Bits& to) const;

  std::array<std::uint32_t, std::size_t{1} << kHashBits> last_place_{};  // of four bytes, by their hash
  std::vector<std::uint32_t> tokens_;                                    // of the block: a literal, or a repeat
  Code<kLiterals> literals_;
  Code<kDistances> distances_;
  std::vector<std::uint8_t> stream_;
  std::size_t written_ = 0;  // whole bytes of it
  Bits bits_;
};

}  // namespace stampede
