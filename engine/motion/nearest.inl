// Included by nearest_plain.cpp and nearest_avx2.cpp, each in a namespace of its own. Includes nothing itself.

typedef float Lanes __attribute__((vector_size(32)));
typedef int Mask __attribute__((vector_size(32)));

inline bool any(const Mask& mask) {
#ifdef STAMPEDE_NEAREST_AVX2
  return __builtin_ia32_movmskps256((Lanes)mask) != 0;
#else
  typedef long long Halves __attribute__((vector_size(32)));
  const Halves halves = (Halves)mask;
  return ((halves[0] | halves[1]) | (halves[2] | halves[3])) != 0;
#endif
}

inline std::size_t nearest_of(const EightFloats* blocks, std::size_t count, int joints, const float* wanted) {
  constexpr int kLook = 4;  // joints after which most blocks are known to be too far away
  Lanes least = Lanes{} + 3e38F;
  Mask where{};
  for (std::size_t block = 0; block < count; ++block, blocks += joints) {
    Lanes sum{};
    int joint = 0;
    const int ends[2] = {joints < kLook ? joints : kLook, joints};
    for (const int end : ends) {
      for (; joint < end; ++joint) {
        Lanes gap;
        __builtin_memcpy(&gap, blocks[joint].v, sizeof gap);
        gap -= wanted[joint];
        sum += gap * gap;
      }
      if (!any(sum < least)) break;
    }
    if (joint < joints) continue;
    const Mask closer = sum < least;
    where = closer ? Mask{} + static_cast<int>(block) : where;
    least = closer ? sum : least;
  }
  int best = 0;
  for (int lane = 1; lane < kNearestLanes; ++lane)
    if (least[lane] < least[best] || (least[lane] == least[best] && where[lane] < where[best])) best = lane;
  return static_cast<std::size_t>(where[best]) * kNearestLanes + static_cast<std::size_t>(best);
}
