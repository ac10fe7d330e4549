// A 64-bit fingerprint of bytes, so that a picture can name exactly what it was rendered from. Not
// cryptographic; the same on every machine.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/rng.h"

namespace octolux {

/// `seed` combined with the length and the content of `bytes`, eight bytes (little-endian) at a
/// time. Chaining calls fingerprints a list: hash_bytes(hash_bytes(0, a), b).
constexpr std::uint64_t hash_bytes(std::uint64_t seed, std::string_view bytes) {
  std::uint64_t h = hash64(seed ^ hash64(bytes.size()));
  std::size_t i = 0;
  while (i < bytes.size()) {
    std::uint64_t word = 0;
    for (int shift = 0; shift < 64 && i < bytes.size(); shift += 8, ++i) {
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << shift;
    }
    h = hash64(h ^ word);
  }
  return h;
}

}  // namespace octolux
