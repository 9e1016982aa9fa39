// What the processor can do beyond what every one can, and how much of it is ours.
#pragma once

namespace stampede {

// Inner loops are compiled twice and give the same bytes either way. The environment variable STAMPEDE_NO_AVX2, set to
// anything, has the plain ones used: for tests, and to see what AVX2 is worth.
bool may_use_avx2();

// Cores that this process may use: those it is bound to, and no more than the time that a container is allowed.
int usable_cores();

}  // namespace stampede
