// Eight floats at once, by the vector types that GCC and Clang share; compilers turn them into
// whatever the processor has. Only what OctoBoxes need.
#pragma once

#include <cmath>
#include <cstring>

// Inlined always: how vectors are passed between functions depends on the processor's vectors.
#define OCTOLUX_INLINE __attribute__((always_inline)) inline

namespace octolux {

using Float8 __attribute__((vector_size(32))) = float;
using Mask8 __attribute__((vector_size(32))) = int;  // all bits set, or none

OCTOLUX_INLINE Float8 load8(const float* p) {
  Float8 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
OCTOLUX_INLINE void store8(float* p, Float8 v) { std::memcpy(p, &v, sizeof(v)); }
OCTOLUX_INLINE Float8 splat8(float x) { return Float8{x, x, x, x, x, x, x, x}; }

OCTOLUX_INLINE Float8 max8(Float8 a, Float8 b) { return a > b ? a : b; }
OCTOLUX_INLINE Float8 min8(Float8 a, Float8 b) { return a < b ? a : b; }
OCTOLUX_INLINE Float8 abs8(Float8 a) { return a < 0 ? -a : a; }
OCTOLUX_INLINE Float8 sqrt8(Float8 a) {
  Float8 r;
  for (int j = 0; j < 8; ++j) r[j] = std::sqrt(a[j]);
  return r;
}
/// 1 where the mask is set, else 0.
OCTOLUX_INLINE Float8 ones8(Mask8 m) { return m ? splat8(1) : splat8(0); }

OCTOLUX_INLINE float sum8(Float8 v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

struct Add8 {
  __attribute__((always_inline)) Float8 operator()(Float8 a, Float8 b) const { return a + b; }
};
struct Max8 {
  __attribute__((always_inline)) Float8 operator()(Float8 a, Float8 b) const { return max8(a, b); }
};

/// [sum of v0, ..., sum of v7] with `combine` for the sum (Add8 or Max8), in a fixed order.
template <class Combine>
OCTOLUX_INLINE Float8 reduce8(const Float8 (&v)[8], Combine combine) {
  Float8 pairs[4], quads[2];
  for (int i = 0; i < 4; ++i) {
    const Float8 a = v[2 * i], b = v[2 * i + 1];
    pairs[i] = combine(__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
                       __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15));
  }
  for (int i = 0; i < 2; ++i) {
    const Float8 a = pairs[2 * i], b = pairs[2 * i + 1];
    quads[i] = combine(__builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13),
                       __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15));
  }
  return combine(__builtin_shufflevector(quads[0], quads[1], 0, 1, 2, 3, 8, 9, 10, 11),
                 __builtin_shufflevector(quads[0], quads[1], 4, 5, 6, 7, 12, 13, 14, 15));
}

#undef OCTOLUX_INLINE
}  // namespace octolux
