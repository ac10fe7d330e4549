// One tiny render per kernel, as a hash of its pixels' bits; and the file where the hashes stand
// that were once right, by compiler and instruction set, on which last bits depend.
#pragma once

#include <gnu/libc-version.h>

#include <cstdio>
#include <cstring>
#include <map>
#include <sstream>
#include <string>

#include "core/file_io.h"
#include "core/hash.h"
#include "estimators/estimator.h"
#include "tests/renderer/renders.h"

namespace octolux::test {

inline constexpr char kHashFile[] = OCTOLUX_SOURCE_DIR "/tests/regression/hashes.txt";

/// What the last bits depend on: compiler, C library, what the code was compiled for, and what
/// Embree finds in the processor. No blanks.
inline std::string platform() {
#if defined(__clang__)
  const std::string compiler = "clang-" + std::to_string(__clang_major__);
#else
  const std::string compiler = "gcc-" + std::to_string(__GNUC__);
#endif
#if defined(__AVX512F__)
  const std::string target = "avx512";
#elif defined(__AVX2__)
  const std::string target = "avx2";
#elif defined(__AVX__)
  const std::string target = "avx";
#else
  const std::string target = "baseline";
#endif
  const char* processor = __builtin_cpu_supports("avx512f") ? "avx512"
                          : __builtin_cpu_supports("avx2")  ? "avx2"
                          : __builtin_cpu_supports("avx")   ? "avx"
                                                            : "sse";
  return compiler + "/glibc-" + gnu_get_libc_version() + "/" + target + "/on-" + processor;
}

inline std::string hash_of(const Film& film) {
  const Image image = film.radiance();
  const auto bytes = reinterpret_cast<const char*>(image.pixels.data());
  char text[17];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(
                    hash_bytes(0, {bytes, image.pixels.size() * sizeof(image.pixels[0])})));
  return text;
}

/// By what was rendered: each kernel with and without gathering, and the path tracer.
inline std::map<std::string, std::string> render_hashes() {
  const auto scene = shipped_scene("cornell/cornell.xml");
  resize_film(*scene, 12, 12);
  std::map<std::string, std::string> hashes;
  hashes["path"] = hash_of(render_film(*scene, path_config(2)));
  for (const std::string& kernel : kernel_names()) {
    RenderConfig config = photon_config(2, 4000);
    config.estimator.kernel = kernel;
    hashes[kernel] = hash_of(render_film(*scene, config));
    config.eye.gather = false;
    hashes[kernel + "-shown"] = hash_of(render_film(*scene, config));
  }
  return hashes;
}

/// Lines of "PLATFORM RENDER HASH".
using StoredHashes = std::map<std::string, std::map<std::string, std::string>>;

inline StoredHashes read_hashes(const std::string& text) {
  StoredHashes stored;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string platform_name, render_name, hash;
    if (line.rfind('#', 0) != 0 && words >> platform_name >> render_name >> hash) {
      stored[platform_name][render_name] = hash;
    }
  }
  return stored;
}

inline std::string hash_lines(const std::string& platform_name,
                              const std::map<std::string, std::string>& hashes) {
  std::string text;
  for (const auto& [render_name, hash] : hashes) {
    text += platform_name + " " + render_name + " " + hash + "\n";
  }
  return text;
}

/// Replaces this platform's hashes in the file. Where they are not what they were, or nobody knows,
/// those of other platforms are old, too, and go.
inline void store_hashes() {
  StoredHashes stored = read_hashes(read_file(kHashFile));
  const std::map<std::string, std::string> now = render_hashes();
  if (stored[platform()] != now) stored = {{platform(), now}};
  std::string text =
      "# Bits of tiny renders by platform; written by tools/update-references --hashes, read by\n"
      "# tests/regression/bits_test.cpp. They say that something changed, not that it got worse.\n";
  for (const auto& [platform_name, hashes] : stored) text += hash_lines(platform_name, hashes);
  write_file(kHashFile, text);
}

}  // namespace octolux::test
