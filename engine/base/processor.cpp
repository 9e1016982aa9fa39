#include "engine/base/processor.h"

#include <sched.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace stampede {

bool may_use_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && std::getenv("STAMPEDE_NO_AVX2") == nullptr;
#else
  return false;
#endif
}

int usable_cores() {
  cpu_set_t bound;
  const int cores = sched_getaffinity(0, sizeof bound, &bound) == 0 ? CPU_COUNT(&bound) : 1;
  double quota_us = 0, period_us = 0;
  std::ifstream limit("/sys/fs/cgroup/cpu.max");  // as `200000 100000`, or `max 100000` where there is no limit
  if (!(limit >> quota_us >> period_us) || quota_us <= 0 || period_us <= 0) return cores;
  return std::clamp(static_cast<int>(std::ceil(quota_us / period_us)), 1, cores);
}

}  // namespace stampede
