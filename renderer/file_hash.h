// A 64-bit fingerprint of everything a scene was loaded from, kept in the pictures made of it.
// FNV-1a (Fowler, Noll, Vo; IETF draft-eastlake-fnv): order matters, cryptographic strength does
// not.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace octolux {

inline constexpr std::uint64_t kHashSeed = 0xcbf29ce484222325;

constexpr std::uint64_t hash_bytes(std::string_view bytes, std::uint64_t hash = kHashSeed) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

/// The whole file. Throws Error if it cannot be read.
std::string read_whole_file(const std::string& path);

}  // namespace octolux
