#include "engine/render/picture_deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace stampede {
namespace {

constexpr std::size_t kLeast = 3, kMost = 258;  // bytes of a repeat
constexpr std::size_t kWorthwhile = 4;          // bytes; three may take more bits than they are
constexpr std::size_t kFurthest = 32768;        // bytes back
constexpr std::size_t kBlock = 32768;           // tokens
constexpr int kMostBits = 15, kMostBitsOfLengths = 7;
constexpr std::uint32_t kRepeat = 1U << 31;  // of a token: then length - 3 from bit 16, distance - 1 from bit 0
constexpr std::uint32_t kEnd = 256;          // of a block

struct Class {  // of lengths or distances: its number, and how many bits follow
  std::uint8_t code, extra;
  std::uint16_t base;
};

template <std::size_t count>
constexpr std::array<Class, count> classes_of(std::size_t classes, std::size_t doubling, std::size_t first) {
  // From the fifth or third class on, every `doubling` classes have one bit more.
  std::array<Class, count> table{};
  std::size_t value = 0;
  for (std::size_t code = 0; code < classes && value < count; ++code) {
    const std::size_t extra = code < 2 * doubling ? 0 : code / doubling - 1;
    for (std::size_t i = 0, base = value; i < (std::size_t{1} << extra) && value < count; ++i, ++value)
      table[value] = {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>(extra),
                      static_cast<std::uint16_t>(base + first)};
  }
  return table;
}

// By length - 3. The longest has a class of its own.
constexpr std::array<Class, 256> kLengthClasses = [] {
  auto table = classes_of<256>(28, 4, 3);
  table[255] = {28, 0, 258};
  return table;
}();
constexpr std::array<Class, kFurthest> kDistanceClasses = classes_of<kFurthest>(30, 2, 1);

std::uint64_t eight(const std::uint8_t* at) {
  std::uint64_t bytes;
  std::memcpy(&bytes, at, sizeof(bytes));
  return bytes;
}

std::size_t agreeing_bytes(std::uint64_t differing) {
  return differing == 0 ? 8 : static_cast<std::size_t>(std::countr_zero(differing)) / 8;
}

std::size_t slot_of(std::uint64_t bytes, int bits) {
  return static_cast<std::uint32_t>(bytes) * 2654435761U >> (32 - bits);
}

// How many bytes agree, at most `most`. The lowest byte comes first in a word, as on every processor that this runs on.
std::size_t agreeing(const std::uint8_t* a, const std::uint8_t* b, std::size_t most) {
  std::size_t count = 0;
  for (; count + 8 <= most; count += 8) {
    const std::uint64_t differing = eight(a + count) ^ eight(b + count);
    if (differing != 0) return count + static_cast<std::size_t>(std::countr_zero(differing)) / 8;
  }
  while (count < most && a[count] == b[count]) ++count;
  return count;
}

std::uint16_t reversed(std::uint32_t word, int length) {
  std::uint32_t turned = 0;
  for (int i = 0; i < length; ++i) turned |= (word >> i & 1) << (length - 1 - i);
  return static_cast<std::uint16_t>(turned);
}

// Lengths of a best prefix code (Moffat and Katajainen's way in place), then cut to `most_bits`. `counts` ascend.
void find_lengths(std::span<std::uint32_t> counts, int most_bits) {
  const std::size_t n = counts.size();
  if (n == 1) {
    counts[0] = 1;
    return;
  }
  std::size_t leaf = 0, root = 0;
  for (std::size_t next = 0; next + 1 < n; ++next) {  // counts become sums, then the places of parents
    const auto take = [&] {
      if (leaf >= n || (root < next && counts[root] < counts[leaf])) {
        const std::uint32_t count = counts[root];
        counts[root++] = static_cast<std::uint32_t>(next);
        return count;
      }
      return counts[leaf++];
    };
    const std::uint32_t first = take();
    counts[next] = first + take();
  }
  counts[n - 2] = 0;
  for (std::size_t i = n - 2; i-- > 0;) counts[i] = counts[counts[i]] + 1;  // depths of inner nodes
  std::size_t at_depth = 1, inner = n - 1, out = n;
  for (std::uint32_t depth = 0; at_depth > 0; ++depth) {
    std::size_t used = 0;
    while (inner > 0 && counts[inner - 1] == depth) {
      ++used;
      --inner;
    }
    for (std::size_t leaves = at_depth - used; leaves > 0; --leaves) counts[--out] = depth;
    at_depth = 2 * used;
  }
  // Rarest first, so lengths descend. Too long ones are cut, which takes room that others give back.
  std::array<std::size_t, 64> with_length{};
  std::uint64_t taken = 0;
  for (const std::uint32_t length : counts) ++with_length[std::min(length, static_cast<std::uint32_t>(most_bits))];
  const auto most = static_cast<std::size_t>(most_bits);
  for (std::size_t length = 1; length <= most; ++length)
    taken += static_cast<std::uint64_t>(with_length[length]) << (most - length);
  for (; taken > std::uint64_t{1} << most; --taken) {
    std::size_t shorter = most - 1;
    while (with_length[shorter] == 0) --shorter;
    --with_length[most];
    --with_length[shorter];
    with_length[shorter + 1] += 2;
  }
  for (std::size_t length = most, i = 0; length > 0; --length)
    for (std::size_t left = with_length[length]; left > 0; --left) counts[i++] = static_cast<std::uint32_t>(length);
}

constexpr std::array<std::uint8_t, 19> kLengthOrder{16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

struct Run {  // of code lengths, as RFC 1951 3.2.7 writes them
  std::uint8_t symbol, extra_bits;
  std::uint8_t extra;
};

std::vector<Run> runs_of(std::span<const std::uint8_t> lengths) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t same = 1;
    while (i + same < lengths.size() && lengths[i + same] == lengths[i]) ++same;
    i += same;
    const std::uint8_t length = lengths[i - 1];
    if (length != 0) {
      runs.push_back({length, 0, 0});
      --same;
    }
    while (same >= 3) {
      const std::size_t most = length != 0 ? 6 : same <= 10 ? 10 : 138, part = std::min(same, most);
      const std::size_t least = most == 138 ? 11 : 3;
      const std::uint8_t symbol = length != 0 ? 16 : most == 10 ? 17 : 18;
      runs.push_back({symbol,
                      static_cast<std::uint8_t>(symbol == 16   ? 2
                                                : symbol == 17 ? 3
                                                               : 7),
                      static_cast<std::uint8_t>(part - least)});
      same -= part;
    }
    for (; same > 0; --same) runs.push_back({length, 0, 0});
  }
  return runs;
}

}  // namespace

template <std::size_t size>
void PictureDeflate::Code<size>::settle(int most_bits) {
  constexpr int kSymbolBits = 16;
  std::array<std::uint64_t, size> order{};  // how often, then which
  std::size_t used = 0;
  for (std::size_t i = 0; i < size; ++i)
    if (counts[i] != 0) order[used++] = static_cast<std::uint64_t>(counts[i]) << kSymbolBits | i;
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(used));
  std::array<std::uint32_t, size> sorted{};
  for (std::size_t i = 0; i < used; ++i) sorted[i] = static_cast<std::uint32_t>(order[i] >> kSymbolBits);
  if (used > 0) find_lengths({sorted.data(), used}, most_bits);
  lengths = {};
  for (std::size_t i = 0; i < used; ++i) lengths[order[i] & 0xffff] = static_cast<std::uint8_t>(sorted[i]);
  std::array<std::uint32_t, kMostBits + 2> first{};  // word of each length
  for (const std::uint8_t length : lengths)
    if (length != 0) ++first[length + 1U];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] = (first[i] + first[i - 1]) << (i > 1 ? 1 : 0);
  for (std::size_t i = 0; i < size; ++i)
    if (lengths[i] != 0) words[i] = reversed(first[lengths[i]]++, lengths[i]);
  counts = {};
}

void PictureDeflate::Bits::put(std::uint64_t bits, int more) {
  waiting |= bits << count;
  count += more;
  std::memcpy(at, &waiting, sizeof(waiting));
  at += count >> 3;
  waiting = count >= 64 ? 0 : waiting >> (count & ~7);
  count &= 7;
}

void PictureDeflate::put_tokens(Bits& to) const {
  Bits bits = to;  // in registers: a byte that is written might be anything's
  for (const std::uint32_t token : tokens_) {
    if ((token & kRepeat) == 0) {
      bits.put(literals_.words[token], literals_.lengths[token]);
      continue;
    }
    const std::uint32_t length = token >> 16 & 255, distance = token & 0x7fff;
    const Class &length_class = kLengthClasses[length], &distance_class = kDistanceClasses[distance];
    const std::size_t symbol = 257U + length_class.code;
    std::uint64_t word = literals_.words[symbol];
    int count = literals_.lengths[symbol];
    word |= static_cast<std::uint64_t>(length + kLeast - length_class.base) << count;
    count += length_class.extra;
    word |= static_cast<std::uint64_t>(distances_.words[distance_class.code]) << count;
    count += distances_.lengths[distance_class.code];
    word |= static_cast<std::uint64_t>(distance + 1 - distance_class.base) << count;
    bits.put(word, count + distance_class.extra);  // at most 15 + 5 + 15 + 13
  }
  to = bits;
}

// The two codes: how many lengths, a code for lengths, and the lengths in it.
void PictureDeflate::put_lengths(Bits& to) const {
  std::size_t literals = kLiterals, distances = kDistances;
  while (literals > 257 && literals_.lengths[literals - 1] == 0) --literals;
  while (distances > 1 && distances_.lengths[distances - 1] == 0) --distances;
  std::vector<std::uint8_t> lengths(literals_.lengths.begin(),
                                    literals_.lengths.begin() + static_cast<std::ptrdiff_t>(literals));
  lengths.insert(lengths.end(), distances_.lengths.begin(),
                 distances_.lengths.begin() + static_cast<std::ptrdiff_t>(distances));
  const std::vector<Run> runs = runs_of(lengths);
  Code<kLengthOrder.size()> code;
  for (const Run& run : runs) ++code.counts[run.symbol];
  code.settle(kMostBitsOfLengths);
  std::size_t written = kLengthOrder.size();
  while (written > 4 && code.lengths[kLengthOrder[written - 1]] == 0) --written;
  to.put(literals - 257, 5);
  to.put(distances - 1, 5);
  to.put(written - 4, 4);
  for (std::size_t i = 0; i < written; ++i) to.put(code.lengths[kLengthOrder[i]], 3);
  for (const Run& run : runs) {
    to.put(code.words[run.symbol], code.lengths[run.symbol]);
    to.put(run.extra, run.extra_bits);
  }
}

void PictureDeflate::put_block(bool last) {
  ++literals_.counts[kEnd];
  literals_.settle(kMostBits);
  distances_.settle(kMostBits);
  stream_.resize(written_ + 8 * tokens_.size() + 1024);
  bits_.at = stream_.data() + written_;
  bits_.put(last ? 1 : 0, 1);
  bits_.put(2, 2);  // with codes of its own
  put_lengths(bits_);
  put_tokens(bits_);
  bits_.put(literals_.words[kEnd], literals_.lengths[kEnd]);
  written_ = static_cast<std::size_t>(bits_.at - stream_.data());
  tokens_.clear();
}

void PictureDeflate::add_literals(const std::uint8_t* at, std::size_t count) {
  for (; count > 0; --count, ++at) {
    tokens_.push_back(*at);
    ++literals_.counts[*at];
  }
}

void PictureDeflate::add_repeat(std::size_t length, std::size_t distance) {
  tokens_.push_back(kRepeat | static_cast<std::uint32_t>(length - kLeast) << 16 |
                    static_cast<std::uint32_t>(distance - 1));
  ++literals_.counts[257U + kLengthClasses[length - kLeast].code];
  ++distances_.counts[kDistanceClasses[distance - 1].code];
}

void PictureDeflate::add_stream(std::span<const std::uint8_t> rows, std::size_t row_size, std::size_t pixel_size,
                                std::vector<std::uint8_t>& out) {
  tokens_.clear();
  last_place_.fill(0);
  stream_.assign({0x78, 0x01});  // deflate with a window of 32 kB, the fastest way
  written_ = stream_.size();
  bits_ = {};
  const std::uint8_t* const begin = rows.data();
  const std::size_t size = rows.size();
  for (std::size_t at = 0; at < size;) {
    if (tokens_.size() >= kBlock) put_block(false);
    if (size - at < 8 || at < pixel_size) {
      add_literals(begin + at++, 1);
      continue;
    }
    const std::uint64_t here = eight(begin + at);
    std::uint32_t& last_place = last_place_[slot_of(here, kHashBits)];
    const std::size_t above = at >= row_size ? row_size : pixel_size, met = at - last_place;
    const std::size_t elsewhere = met <= kFurthest && met > 0 ? met : pixel_size;
    last_place = static_cast<std::uint32_t>(at);
    const auto agree = [&](std::size_t distance) { return agreeing_bytes(here ^ eight(begin + at - distance)); };
    std::size_t longest = agree(pixel_size), from = pixel_size;
    const auto consider = [&](std::size_t distance) {
      const std::size_t length = agree(distance);
      from = length > longest ? distance : from;
      longest = std::max(length, longest);
    };
    consider(above);
    consider(elsewhere);
    if (longest < kWorthwhile) {
      const std::size_t count = pixel_size - (at % row_size + pixel_size - 1) % pixel_size;
      add_literals(begin + at, count);
      at += count;
      continue;
    }
    if (longest == 8) {
      const std::size_t left = std::min(size - at, kMost);
      longest = agreeing(begin + at, begin + at - from, left);
      for (const std::size_t distance : {above, elsewhere}) {
        const std::size_t length = distance == from ? 0 : agreeing(begin + at, begin + at - distance, left);
        if (length > longest) longest = length, from = distance;
      }
    }
    add_repeat(longest, from);
    at += longest;
  }
  put_block(true);
  stream_.resize(written_ + 16);
  bits_.at = stream_.data() + written_;
  if (bits_.count > 0) bits_.put(0, 8 - bits_.count);
  const std::uint32_t sum = libdeflate_adler32(1, rows.data(), rows.size());
  for (int shift = 24; shift >= 0; shift -= 8) bits_.put(sum >> shift & 255, 8);
  out.insert(out.end(), stream_.data(), bits_.at);
}

}  // namespace stampede
