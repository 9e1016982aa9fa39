// Random numbers as pure functions of a key: nothing is shared, nothing needs restoring after an undo.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace stampede {

// Names one stream of draws. Every part that tells two draws apart goes into it:
// RandomKey("place").with(variation).with(seed).with(skill_index).with(attempt).
class RandomKey {
 public:
  explicit RandomKey(std::string_view purpose);
  RandomKey with(std::string_view part) const;
  RandomKey with(std::int64_t part) const;
  std::uint64_t value() const { return value_; }

 private:
  RandomKey() = default;
  std::uint64_t value_ = 0;
};

// Draw number n of a key is a hash of (key, n) (splitmix64 finaliser; Steele, Lea, Flood, OOPSLA 2014,
// doi:10.1145/2660193.2660195). Our own distributions: the standard library's differ between releases.
// Copy it to branch; two generators of one key give the same numbers.
class Random {
 public:
  explicit Random(RandomKey key) : key_(key.value()) {}
  std::uint64_t bits();                     // 64 independent bits
  double uniform();                         // [0, 1), 53 bits
  double between(double low, double high);  // [low, high)
  std::int64_t below(std::int64_t n);       // 0 … n-1 without bias; n >= 1
  double normal();                          // mean 0, deviation 1 (Box-Muller; two draws each)

  // Fisher and Yates: every order is as likely.
  template <typename T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[static_cast<std::size_t>(below(static_cast<std::int64_t>(i)))]);
  }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

}  // namespace stampede
