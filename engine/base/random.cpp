#include "engine/base/random.h"

#include <cmath>
#include <numbers>

#include "engine/base/hash.h"

namespace stampede {
namespace {

std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

}  // namespace

RandomKey::RandomKey(std::string_view purpose) : value_(hash64(purpose)) {}

RandomKey RandomKey::with(std::string_view part) const {
  RandomKey key;
  key.value_ = hash64(part, mix(value_ + 1));
  return key;
}

RandomKey RandomKey::with(std::int64_t part) const {
  RandomKey key;
  key.value_ = mix(mix(value_ + 2) + 0x9e3779b97f4a7c15ULL * (static_cast<std::uint64_t>(part) + 1));
  return key;
}

std::uint64_t Random::bits() { return mix(mix(key_) + 0x9e3779b97f4a7c15ULL * ++count_); }

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double Random::between(double low, double high) { return low + (high - low) * uniform(); }

std::int64_t Random::below(std::int64_t n) {
  const std::uint64_t range = static_cast<std::uint64_t>(n);
  const std::uint64_t limit = ~0ULL - ~0ULL % range;  // reject the last partial block
  std::uint64_t draw = bits();
  while (draw >= limit) draw = bits();
  return static_cast<std::int64_t>(draw % range);
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

}  // namespace stampede
