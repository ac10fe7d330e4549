// Reading a file in one piece, with a reason when it fails.
#include "renderer/file_hash.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace octolux {

std::string read_whole_file(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(path + ": is a folder, expected a file");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(path + ": cannot be read: " + std::strerror(errno));
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace octolux
