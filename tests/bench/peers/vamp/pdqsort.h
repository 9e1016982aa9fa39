// The sorting that VAMP asks pdqsort for, where that cannot be fetched. Only for the build of tests/bench/peers.
#pragma once

#include <algorithm>

template <typename... T>
void pdqsort(T... arguments) {
  std::sort(arguments...);
}

template <typename... T>
void pdqsort_branchless(T... arguments) {
  std::sort(arguments...);
}
