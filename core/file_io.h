// Writing files so that whoever looks at one never sees half of it: bytes go to a temporary file in
// the same folder, are flushed to disk, and the file is renamed over its target. Thread-safe for
// different paths.
#pragma once

#include <span>
#include <string>

namespace octolux {

/// Replaces the file `path` by `bytes`, or leaves it as it was. Throws Error naming the path.
void write_file(const std::string& path, std::span<const char> bytes);

/// Throws the Error that write_file(path, ...) would throw now for want of a folder or of the right
/// to write there. Long work starts with this.
void check_writable(const std::string& path);

}  // namespace octolux
