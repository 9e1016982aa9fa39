#include "engine/base/processor.h"

#include <cstdlib>

namespace stampede {

bool may_use_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && std::getenv("STAMPEDE_NO_AVX2") == nullptr;
#else
  return false;
#endif
}

}  // namespace stampede
