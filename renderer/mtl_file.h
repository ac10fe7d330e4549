// MTL files: tinyobjloader reads the values; we note what it does not tell, namely which keys a
// material really gives (an absent `illum` means something else than `illum 0`), and refuse what it
// would silently read as black (`Kd spectral x.rfl`, words in place of numbers).
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/rgb.h"
#include "core/vec.h"

namespace octolux {

/// A texture map: its statement's key and file, and those of its options that we know.
struct MtlMap {
  std::string key, file;
  Vec2 scale{1, 1}, offset{0, 0};  // -s, -o: applied to texture coordinates in this order
  bool clamp = false;              // -clamp on
  float bump = 1;                  // -bm
};

/// One `newmtl`. Colours are linear, as written; not negative, perhaps above 1.
struct MtlMaterial {
  std::string name;
  std::string place;            // "path:line" of its newmtl
  std::set<std::string> given;  // keys that occur
  Rgb kd, ks, ke;
  Rgb tf;             // 0 if not given
  float ns = 1;       // at least 0
  float ni = 1;       // above 0
  float opacity = 1;  // d, or 1 - Tr; in [0, 1]
  int illum = -1;     // -1: not given
  std::vector<MtlMap> maps;
};

struct MtlFile {
  std::vector<MtlMaterial> materials;  // in the file's order
  std::vector<std::string> warnings;   // keys we do not know, once each
  std::uint64_t hash = 0;              // of the file's bytes
};

/// Throws Error, "path:line: what is wrong".
MtlFile read_mtl_file(const std::string& path);

}  // namespace octolux
