// Files as a whole. Writing is done so that whoever looks at a file never sees half of it: bytes go
// to a temporary file in the same folder, are flushed to disk, and the file is renamed over its
// target. Thread-safe for different paths.
#pragma once

#include <span>
#include <string>

namespace octolux {

/// The bytes of the file `path`. Throws Error, "path: cannot be read: reason".
std::string read_file(const std::string& path);

/// Replaces the file `path` by `bytes`, or leaves it as it was. Throws Error naming the path.
void write_file(const std::string& path, std::span<const char> bytes);

/// Throws the Error that write_file(path, ...) would throw now for want of a folder or of the right
/// to write there. Long work starts with this.
void check_writable(const std::string& path);

}  // namespace octolux
