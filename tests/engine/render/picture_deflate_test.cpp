// Our own compression, against a reader that knows nothing of it.
#include "engine/render/picture_deflate.h"

#include <libdeflate.h>

#include <catch2/catch.hpp>

#include "engine/base/random.h"

using namespace stampede;

namespace {

using Bytes = std::vector<std::uint8_t>;

std::size_t below(Random& random, std::size_t n) {
  return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(n)));
}

Bytes compressed(const Bytes& rows, std::size_t row_size, std::size_t pixel_size) {
  PictureDeflate deflate;
  Bytes stream;
  deflate.add_stream(rows, row_size, pixel_size, stream);
  return stream;
}

// The reader refuses codes that are not complete, sums that do not agree, and bytes that are left over.
bool comes_back(const Bytes& rows, const Bytes& stream) {
  libdeflate_decompressor* reader = libdeflate_alloc_decompressor();
  Bytes back(rows.size());
  std::size_t read = 0;
  const auto result =
      libdeflate_zlib_decompress_ex(reader, stream.data(), stream.size(), back.data(), back.size(), &read, nullptr);
  libdeflate_free_decompressor(reader);
  return result == LIBDEFLATE_SUCCESS && read == stream.size() && back == rows;
}

}  // namespace

TEST_CASE("A stream is read back, whatever the rows hold") {
  Random random(RandomKey("streams"));
  for (int turn = 0; turn < 300; ++turn) {
    const auto pixel_size = static_cast<std::size_t>(turn % 2 == 0 ? 2 : 3);
    const std::size_t row_size = 1 + pixel_size * (1 + below(random, turn % 10 == 0 ? 4096 : 150));
    Bytes rows(row_size * (1 + below(random, 60)));
    const auto values = 1 + below(random, turn % 3 == 0 ? 256 : 4);
    const auto runs = 1 + below(random, 300);
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = i > 0 && below(random, runs) != 0 ? rows[i - 1] : static_cast<std::uint8_t>(below(random, values));
    const Bytes stream = compressed(rows, row_size, pixel_size);
    REQUIRE(comes_back(rows, stream));
    CHECK(stream == compressed(rows, row_size, pixel_size));
  }
}

TEST_CASE("Codes that would need more bits than the format has are cut and stay complete") {
  Bytes rows;
  std::size_t count = 1, next = 1;  // Fibonacci's numbers make the longest words
  for (int value = 0; value < 24; ++value) {
    for (std::size_t i = 0; i < count; ++i) rows.push_back(static_cast<std::uint8_t>(10 * value));
    count = std::exchange(next, count + next);
  }
  Random random(RandomKey("longest words"));
  for (std::size_t i = rows.size(); i > 1; --i) std::swap(rows[i - 1], rows[below(random, i)]);
  rows.resize(40000);
  CHECK(comes_back(rows, compressed(rows, 400, 3)));
}

TEST_CASE("Rows that repeat cost next to nothing, and many blocks hold together") {
  Bytes flat(385 * 128);
  CHECK(compressed(flat, 385, 3).size() < 100);
  Random random(RandomKey("blocks"));
  Bytes noise(500000);
  for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(below(random, 256));
  const Bytes stream = compressed(noise, 1001, 2);
  CHECK(comes_back(noise, stream));
  CHECK(stream.size() < noise.size() + noise.size() / 100);
}
