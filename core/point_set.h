// The points of the unit square that one estimate uses, spread more evenly than chance would.
//
// Where an estimate is made again in every pass, its points are the next ones of the pixel's own
// sequence, so that all passes together are spread evenly too: Sobol's first two dimensions, a
// (0, 2)-sequence, with Owen's scrambling done by hashing (Burley, "Practical Hash-based Owen
// Scrambling", JCGT 9(4), 2020). Its order is scrambled as well, which makes the sequences of
// different uses independent: the points of each may be paired by number with those of another.
//
// Each point alone is uniform, whatever the kind.
#pragma once

#include <cstdint>

#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/// Owen's scrambling of a binary fraction given with its digits reversed: each digit is flipped or
/// not by a hash of those before it. The hash is Laine & Karras's (2011) with Vegdahl's multipliers
/// (psychopath.io, 2021).
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t key) {
  x ^= x * 0x3d20adeau;
  x += key;
  x *= (key >> 16) | 1;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Sobol's second dimension with its digits reversed, its first dimension being `index` itself:
/// Pascal's triangle modulo 2 times the index's digits, a block of the matrix at a time.
constexpr std::uint32_t sobol_reversed(std::uint32_t index) {
  index ^= (index >> 16) & 0x0000ffffu;
  index ^= (index >> 8) & 0x00ff00ffu;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 2) & 0x33333333u;
  return index ^ ((index >> 1) & 0x55555555u);
}

/// Point `index` of the sequence that `key` scrambles.
inline Vec2 scrambled_sobol(std::uint32_t index, std::uint64_t key) {
  const auto key_x = static_cast<std::uint32_t>(key);
  const auto key_y = static_cast<std::uint32_t>(key >> 32);
  const std::uint32_t i =
      reverse_bits(scramble_reversed(reverse_bits(index), key_x ^ (key_y * 0x9e3779b9u)));
  const std::uint32_t x = reverse_bits(scramble_reversed(i, key_x));
  const std::uint32_t y = reverse_bits(scramble_reversed(sobol_reversed(i), key_y));
  return {static_cast<float>(x >> 8) * 0x1p-24f, static_cast<float>(y >> 8) * 0x1p-24f};
}

class PointSet {
 public:
  /// `n` points that nothing goes before or comes after: Hammersley's, shifted by chance.
  PointSet(int n, Rng& rng) : n_(static_cast<std::uint32_t>(n)), shift_(rng.uniform2()) {}
  /// Those from `first` on of a scrambled sequence.
  PointSet(std::uint64_t key, std::uint32_t first) : key_(key), first_(first) {}

  Vec2 operator[](int i) const {
    const auto number = static_cast<std::uint32_t>(i);
    return n_ > 0 ? shifted_hammersley(number, n_, shift_) : scrambled_sobol(first_ + number, key_);
  }

 private:
  std::uint32_t n_ = 0;
  Vec2 shift_{};
  std::uint64_t key_ = 0;
  std::uint32_t first_ = 0;
};

/// What an eye sample needs points for, at each surface on its way.
enum class PixelUse : std::uint64_t {
  lights,          // places on lights
  light_choice,    // which lights
  gather,          // directions of gather rays that all follow the BSDF
  gather_by_bsdf,  // the same of those beside others that follow guides: as many in every sample
  gather_by_guide,
  glossy_lights,  // as above, for lobes that reflect or refract like a mirror, but not quite
  glossy_light_choice,
  specular_lobe,  // which of such lobes the path follows
  specular_direction,
  lens,           // where the path leaves the camera's
  narrow_lights,  // places on narrow lights
  glossy_narrow_lights
};

/// Where a pixel's eye sample stands in the pixel's sequences.
class PixelSequence {
 public:
  PixelSequence() = default;
  /// `number` counts the pixel's eye samples through all passes.
  PixelSequence(std::uint64_t seed, std::uint64_t pixel, std::uint64_t number)
      : key_(hash64(hash64(hash64(seed) ^ static_cast<std::uint64_t>(Stream::sequence)) ^ pixel)),
        number_(static_cast<std::uint32_t>(number)) {}

  /// The next `n` points for one of its uses, as many in every sample, at the path's surface that
  /// is `segments` away from the eye.
  PointSet points(PixelUse use, int segments, int n) const {
    const std::uint64_t at = static_cast<std::uint64_t>(segments) << 8;
    return {hash64(key_ ^ (at | static_cast<std::uint64_t>(use))),
            number_ * static_cast<std::uint32_t>(n)};
  }
  /// For what path `i` of the `n` that a sample was split into meets.
  PixelSequence part(int i, int n) const {
    PixelSequence part = *this;
    part.number_ = number_ * static_cast<std::uint32_t>(n) + static_cast<std::uint32_t>(i);
    return part;
  }

 private:
  std::uint64_t key_ = 0;
  std::uint32_t number_ = 0;
};

}  // namespace octolux
