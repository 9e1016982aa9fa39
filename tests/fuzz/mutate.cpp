#include "tests/fuzz/mutate.h"

namespace stampede::fuzz {
namespace {

constexpr std::size_t kLongest = 1 << 18;

std::size_t below(Random& random, std::size_t n) {
  return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(std::max<std::size_t>(n, 1))));
}

// A piece of a text: where it begins and how long it is, short ones more often.
std::pair<std::size_t, std::size_t> piece(const std::string& bytes, Random& random) {
  const std::size_t at = below(random, bytes.size());
  const std::size_t most = std::min(bytes.size() - at, std::size_t{1} << below(random, 12));
  return {at, below(random, most + 1)};
}

void change(std::string& bytes, const std::string& other, const std::vector<std::string>& words, Random& random) {
  static const std::vector<std::string> kNumbers = {"0",   "-1", "1e309", "4294967296", "9223372036854775807",
                                                    "0.0", "nan"};
  const std::size_t at = below(random, bytes.size() + 1);
  switch (random.below(9)) {
    case 0:
      if (!bytes.empty()) bytes[below(random, bytes.size())] ^= static_cast<char>(1 << random.below(8));
      break;
    case 1:
      if (!bytes.empty()) bytes[below(random, bytes.size())] = static_cast<char>(random.below(256));
      break;
    case 2: {
      const auto [from, length] = piece(bytes, random);
      bytes.erase(from, length);
      break;
    }
    case 3: {
      const auto [from, length] = piece(bytes, random);
      const std::string copy = bytes.substr(from, length);
      for (auto count = random.below(random.below(20) == 0 ? 500 : 4); count >= 0; --count) bytes.insert(at, copy);
      break;
    }
    case 4: {
      const auto [from, length] = piece(other, random);
      bytes.insert(at, other, from, length);
      break;
    }
    case 5:
      if (!words.empty()) bytes.insert(at, words[below(random, words.size())]);
      break;
    case 6: {  // a number becomes another
      const std::size_t digit = bytes.find_first_of("0123456789", at);
      if (digit == std::string::npos) break;
      const std::size_t end = bytes.find_first_not_of("0123456789.", digit);
      bytes.replace(digit, std::min(end, bytes.size()) - digit, kNumbers[below(random, kNumbers.size())]);
      break;
    }
    case 7:
      bytes.resize(at);
      break;
    default:
      bytes.insert(at, 1, static_cast<char>(random.below(256)));
  }
}

}  // namespace

std::string mutated(std::string bytes, const std::string& other, const std::vector<std::string>& words,
                    Random& random) {
  for (auto count = random.below(6); count >= 0; --count) change(bytes, other, words, random);
  if (bytes.size() > kLongest) bytes.resize(kLongest);
  return bytes;
}

}  // namespace stampede::fuzz
