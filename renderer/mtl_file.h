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

namespace octolux {

/// One `newmtl`. Colours are linear, as written; not negative, perhaps above 1.
struct MtlMaterial {
  std::string name;
  std::string place;            // "path:line" of its newmtl
  std::set<std::string> given;  // keys that occur
  Rgb kd, ks, ke;
  Rgb tf;                                                 // 0 if not given
  float ns = 1;                                           // at least 0
  float ni = 1;                                           // above 0
  float opacity = 1;                                      // d, or 1 - Tr; in [0, 1]
  int illum = -1;                                         // -1: not given
  std::vector<std::pair<std::string, std::string>> maps;  // key and file name of texture maps
};

struct MtlFile {
  std::vector<MtlMaterial> materials;  // in the file's order
  std::vector<std::string> warnings;   // keys we do not know, once each
  std::uint64_t hash = 0;              // of the file's bytes
};

/// Throws Error, "path:line: what is wrong".
MtlFile read_mtl_file(const std::string& path);

}  // namespace octolux
