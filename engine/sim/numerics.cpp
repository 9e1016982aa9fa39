#include "engine/sim/numerics.h"

#include <cmath>

#include "engine/base/hash.h"
#include "engine/base/random.h"

namespace stampede {

std::string numerics_probe() {
  Hasher hasher;
  Random random(RandomKey("numerics"));
  for (int i = 0; i < 2000; ++i) {
    // libm chooses its variants (fused or not) by processor, and these are the functions that episodes call.
    volatile double x = random.between(-3, 3), y = random.between(0.1, 3);
    for (const double value :
         {std::sin(x), std::cos(x), std::tan(x), std::atan2(x, y), std::acos(x / 3), std::asin(x / 3), std::exp(x),
          std::log(y), std::pow(y, x), std::sqrt(y), std::hypot(x, y)}) {
      hasher.number(value);
    }
  }
  return hasher.digest();
}

}  // namespace stampede
