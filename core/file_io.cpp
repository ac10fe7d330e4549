// file_io.h; writing over POSIX calls, because streams do not report all of what can go wrong (a
// full disk shows when the file is flushed or closed) and cannot flush to disk.
#include "core/file_io.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error_number) {
  throw Error(path + ": cannot be written: " + std::strerror(error_number));
}

/// Renaming over a device or a pipe would put a plain file in its place.
void check_target(const std::string& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) fail(path, EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw Error(path + ": cannot be written: expected a regular file or a new one");
  }
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, code)) {
    throw Error(path + ": cannot be written: there is no folder '" + folder.string() + "'");
  }
}

/// A new file beside its target, removed again unless it has taken the target's place.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& target)
      : target_(target), path_(target + "." + std::to_string(::getpid()) + ".tmp") {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(target_, errno);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!renamed_) ::unlink(path_.c_str());
  }

  void write(std::span<const char> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, errno);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void replace_target() {
    if (::fsync(descriptor_) != 0) fail(target_, errno);
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(target_, errno);
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    renamed_ = true;
  }

 private:
  std::string target_;
  std::string path_;
  int descriptor_ = -1;
  bool renamed_ = false;
};

[[noreturn]] void fail_to_read(const std::string& path, int error_number) {
  throw Error(path + ": cannot be read: " + std::strerror(error_number));
}

}  // namespace

std::string read_file(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) fail_to_read(path, EISDIR);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) fail_to_read(path, errno);
  std::string bytes;
  const auto size = fs::file_size(path, error);
  if (!error) bytes.resize(size);  // a guess: pipes and files of the system have no size
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  if (in) bytes.append(std::istreambuf_iterator<char>(in), {});
  if (in.bad()) fail_to_read(path, errno);
  return bytes;
}

void write_file(const std::string& path, std::span<const char> bytes) {
  check_target(path);
  TemporaryFile file(path);
  file.write(bytes);
  file.replace_target();
}

void check_writable(const std::string& path) {
  check_target(path);
  const TemporaryFile probe(path);
}

}  // namespace octolux
