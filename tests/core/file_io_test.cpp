// Writing whole files: whatever goes wrong, the target is the old file or the new one, and nothing
// else is left behind. A limit on file size stands in for a full disk.
#include "core/file_io.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "tests/temporary_folder.h"

namespace octolux {
namespace {

using test::TemporaryFolder;

std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// No file may grow beyond `bytes` while this lives.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
};

TEST(WriteFile, ReplacesTheTargetAndLeavesNothingElse) {
  const TemporaryFolder folder;
  write_file(folder / "a", std::string(100000, 'x'));
  write_file(folder / "a", std::string("new"));
  EXPECT_EQ(contents(folder / "a"), "new");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteFile, LeavesTheOldFileWhenTheDiskIsFull) {
  const TemporaryFolder folder;
  write_file(folder / "a", std::string("old"));
  {
    const FileSizeLimit limit(4096);
    EXPECT_THROW(write_file(folder / "a", std::string(10000, 'x')), Error);
  }
  EXPECT_EQ(contents(folder / "a"), "old");
  EXPECT_EQ(folder.count(), 1u);
}

TEST(WriteFile, NamesThePathItCannotWrite) {
  const TemporaryFolder folder;
  write_file(folder / "plain", std::string("x"));
  for (const std::string& path :
       {folder / "missing/a", folder / "plain/a", folder.path(), std::string("/dev/null")}) {
    for (const bool probe : {false, true}) {
      try {
        if (probe) {
          check_writable(path);
        } else {
          write_file(path, std::string("x"));
        }
        ADD_FAILURE() << path;
      } catch (const Error& e) {
        EXPECT_EQ(std::string(e.what()).rfind(path + ": cannot be written: ", 0), 0u) << e.what();
      }
    }
  }
}

TEST(WriteFile, ProbingChangesNothing) {
  const TemporaryFolder folder;
  check_writable(folder / "a");
  EXPECT_EQ(folder.count(), 0u);
  write_file(folder / "a", std::string("old"));
  check_writable(folder / "a");
  EXPECT_EQ(contents(folder / "a"), "old");
}

}  // namespace
}  // namespace octolux
