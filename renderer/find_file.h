// Files that a scene names, found on a file system that tells upper from lower case although the
// machine that wrote the scene did not.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace octolux {

struct FoundFile {
  std::string path;
  bool differs = false;  // from the name asked for, in case or separators
};

/// The regular file `name` in the first of `folders` that has it; in none, the first whose name is
/// the same but for case and the direction of slashes (of several, the first in sorted order).
std::optional<FoundFile> find_file(const std::vector<std::string>& folders,
                                   const std::string& name);

}  // namespace octolux
