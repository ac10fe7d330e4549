// Files named by scene files from other systems: backslashes, and letters in the wrong case.
#pragma once

#include <optional>
#include <string>

namespace octolux {

/// The file `name` (a path, perhaps absolute) in `folder`: as it stands, with slashes for
/// backslashes, or with its letters' case ignored (the first match in the order of bytes). Empty if
/// there is none.
std::optional<std::string> find_in_folder(const std::string& folder, const std::string& name);

}  // namespace octolux
