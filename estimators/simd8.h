// Eight floats at once, by the vector types that GCC and Clang share; compilers turn them into
// whatever the processor has. Only what the program needs.
#pragma once

#include <cmath>
#include <cstring>
#ifdef __AVX2__
#include <immintrin.h>
#endif

// Inlined always: how vectors are passed between functions depends on the processor's vectors.
#define OCTOLUX_INLINE __attribute__((always_inline)) inline

namespace octolux {

using Float8 __attribute__((vector_size(32))) = float;
using Mask8 __attribute__((vector_size(32))) = int;  // all bits set, or none; or integers
using Unsigned8 __attribute__((vector_size(32))) = unsigned;
using Float4 __attribute__((vector_size(16))) = float;
using Int4 __attribute__((vector_size(16))) = int;
using Double4 __attribute__((vector_size(32))) = double;
using Long4 __attribute__((vector_size(32))) = unsigned long long;

OCTOLUX_INLINE Float8 load8(const void* p) {
  Float8 v;
  std::memcpy(&v, p, sizeof(v));
  return v;
}
/// The same bits as another type.
template <class To, class From>
OCTOLUX_INLINE To reinterpret_as(From v) {
  To r;
  static_assert(sizeof(r) == sizeof(v));
  std::memcpy(&r, &v, sizeof(r));
  return r;
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

OCTOLUX_INLINE bool any8(Mask8 m) {
  const auto w = reinterpret_as<Long4>(m);
  return ((w[0] | w[1]) | (w[2] | w[3])) != 0;
}
OCTOLUX_INLINE Float8 reverse8(Float8 a) {
  return __builtin_shufflevector(a, a, 7, 6, 5, 4, 3, 2, 1, 0);
}

template <class V>
OCTOLUX_INLINE auto sum8(V v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// table[index[j]] in lane j; indices are 0 to 7.
OCTOLUX_INLINE Float8 lookup8(Float8 table, Mask8 index) {
#ifdef __AVX2__
  return _mm256_permutevar8x32_ps(table, reinterpret_as<__m256i>(index));
#else
  Float8 r;
  for (int j = 0; j < 8; ++j) r[j] = table[index[j]];
  return r;
#endif
}

/// base[index[j]] in lane j. By loads of their own: gather instructions are slower on many
/// processors, more so where they were mended against leaks.
OCTOLUX_INLINE Float8 gather8(const float* base, Mask8 index) {
  int i[8];
  std::memcpy(i, &index, sizeof(i));
  return Float8{base[i[0]], base[i[1]], base[i[2]], base[i[3]],
                base[i[4]], base[i[5]], base[i[6]], base[i[7]]};
}
/// The same of 64 bits each.
OCTOLUX_INLINE Long4 gather4(const void* base, Int4 index) {
  int i[4];
  std::memcpy(i, &index, sizeof(i));
  const auto word = [base](int k) {
    unsigned long long w;
    std::memcpy(&w, static_cast<const char*>(base) + std::ptrdiff_t{8} * k, sizeof(w));
    return w;
  };
  return Long4{word(i[0]), word(i[1]), word(i[2]), word(i[3])};
}

/// out[j] = {a[j], b[j], c[j], d[j]}.
OCTOLUX_INLINE void transpose8(Float8 a, Float8 b, Float8 c, Float8 d, Float4 (&out)[8]) {
  const Float8 ab_low = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const Float8 ab_high = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Float8 cd_low = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const Float8 cd_high = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  const Float8 pairs[4] = {__builtin_shufflevector(ab_low, cd_low, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(ab_low, cd_low, 2, 3, 10, 11, 6, 7, 14, 15),
                           __builtin_shufflevector(ab_high, cd_high, 0, 1, 8, 9, 4, 5, 12, 13),
                           __builtin_shufflevector(ab_high, cd_high, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int j = 0; j < 4; ++j) {
    out[j] = __builtin_shufflevector(pairs[j], pairs[j], 0, 1, 2, 3);
    out[j + 4] = __builtin_shufflevector(pairs[j], pairs[j], 4, 5, 6, 7);
  }
}

struct Add8 {
  template <class V>
  __attribute__((always_inline)) V operator()(V a, V b) const {
    return a + b;
  }
};
struct Max8 {
  __attribute__((always_inline)) Float8 operator()(Float8 a, Float8 b) const { return max8(a, b); }
};

/// [sum of v0, ..., sum of v7] with `combine` for the sum (Add8 or Max8), in a fixed order.
template <class V, class Combine>
OCTOLUX_INLINE V reduce8(const V (&v)[8], Combine combine) {
  V pairs[4], quads[2];
  for (int i = 0; i < 4; ++i) {
    const V a = v[2 * i], b = v[2 * i + 1];
    pairs[i] = combine(__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14),
                       __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15));
  }
  for (int i = 0; i < 2; ++i) {
    const V a = pairs[2 * i], b = pairs[2 * i + 1];
    quads[i] = combine(__builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13),
                       __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15));
  }
  return combine(__builtin_shufflevector(quads[0], quads[1], 0, 1, 2, 3, 8, 9, 10, 11),
                 __builtin_shufflevector(quads[0], quads[1], 4, 5, 6, 7, 12, 13, 14, 15));
}

#undef OCTOLUX_INLINE
}  // namespace octolux
