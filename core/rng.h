// Random numbers: one PCG32 generator (O'Neill 2014, pcg-random.org) per path, keyed by what the
// path is, never by the thread that happens to trace it. The key is hashed first, because
// neighbouring PCG streams are correlated. The same key gives the same numbers everywhere.
#pragma once

#include <cstdint>

#include "core/vec.h"

namespace octolux {

/// What a sequence is used for; part of its key, so that two uses never share numbers.
enum class Stream : std::uint64_t {
  eye = 1,
  global_photon = 2,
  caustic_photon = 3,
  test = 4,
  record = 5,
  learning = 6,
  sequence = 7,
  guide = 8,
  lights = 9,
  look = 10,
  trial = 11,
  sharing = 12,
  direct = 13
};

/// splitmix64 finaliser (Steele, Lea & Flood 2014): a bijection of 64 bits with full avalanche.
constexpr std::uint64_t hash64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

class Rng {
 public:
  /// `pass` and `index` are global numbers (pass of the render; photon, or pixel and sample).
  Rng(std::uint64_t seed, Stream stream, std::uint64_t pass, std::uint64_t index) {
    const std::uint64_t key =
        hash64(hash64(hash64(seed) ^ static_cast<std::uint64_t>(stream)) ^ pass);
    state_ = hash64(key ^ index);
    increment_ = hash64(state_ ^ key) | 1;
    next();
  }

  /// 32 uniform bits.
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<std::uint32_t>(old >> 59);
    return (shifted >> rotation) | (shifted << ((32 - rotation) & 31));
  }

  /// Uniform in [0, 1): multiples of 2^-24, never 1.
  float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }

  Vec2 uniform2() {
    const float x = uniform();
    const float y = uniform();
    return {x, y};
  }

 private:
  std::uint64_t state_;
  std::uint64_t increment_;
};

}  // namespace octolux
