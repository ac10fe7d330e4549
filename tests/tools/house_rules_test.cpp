// The rules of the house that a compiler does not hold: who may include whom, which library is used
// where, sizes, opening paragraphs, format.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace octolux {
namespace {

namespace fs = std::filesystem;

struct SourceFile {
  std::string path;  // from the root, with slashes
  std::vector<std::string> lines;

  std::string folder() const { return path.substr(0, path.find('/')); }
  bool is_header() const { return path.ends_with(".h"); }
};

std::vector<SourceFile> read_sources() {
  const fs::path root = OCTOLUX_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const char* folder : {"core", "accel", "estimators", "renderer", "tools", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      SourceFile file{fs::relative(entry.path(), root).generic_string(), {}};
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) file.lines.push_back(line);
      files.push_back(std::move(file));
    }
  }
  return files;
}

class HouseRules : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { files_ = new std::vector<SourceFile>(read_sources()); }
  static void TearDownTestSuite() { delete files_; }
  static const std::vector<SourceFile>& files() { return *files_; }

 private:
  static inline std::vector<SourceFile>* files_ = nullptr;
};

/// What stands between the quotes or brackets of an #include; "" if the line is none.
std::string included(const std::string& line, char open, char close) {
  if (!line.starts_with("#include")) return "";
  const auto begin = line.find(open), end = line.rfind(close);
  return begin == std::string::npos || end <= begin ? "" : line.substr(begin + 1, end - begin - 1);
}

TEST_F(HouseRules, ThereAreSources) { EXPECT_GT(files().size(), 30u); }

TEST_F(HouseRules, IncludesGoDownwardOnly) {
  const std::map<std::string, int> height = {{"core", 0},     {"accel", 1}, {"estimators", 2},
                                             {"renderer", 3}, {"tools", 4}, {"tests", 5}};
  for (const SourceFile& file : files()) {
    for (const std::string& line : file.lines) {
      const std::string header = included(line, '"', '"');
      if (header.empty()) continue;
      const std::string folder = header.substr(0, header.find('/'));
      ASSERT_TRUE(height.contains(folder)) << file.path << ": " << line;
      const bool downward = height.at(folder) < height.at(file.folder());
      EXPECT_TRUE(downward || folder == file.folder()) << file.path << ": " << line;
    }
  }
}

/// How the #include of a library begins, and the files (or, ending in a slash, folders) that may
/// have it. Tests and benchmarks may use anything.
struct Owner {
  std::string library;
  std::vector<std::string> places;
};

const std::vector<Owner> kOwners = {
    {"embree", {"accel/embree_scene.h", "accel/ray_caster.cpp"}},
    {"Imf", {"core/exr_io.cpp"}},
    {"stb_image", {"core/stb_io.cpp"}},
    {"stb_easy_font", {"tools/compare/text.cpp"}},
    {"zlib", {"renderer/serialized_file.cpp", "tools/compare/page_pixels.cpp"}},
    {"OpenColorIO", {"core/display.cpp"}},
    {"tbb/", {"core/parallel.cpp"}},
    {"pugixml", {"renderer/"}},
    {"tiny_obj", {"renderer/"}},
    {"CLI/", {"tools/"}},
};

bool may_have(const Owner& owner, const std::string& path) {
  return std::any_of(owner.places.begin(), owner.places.end(),
                     [&](const std::string& place) { return path.starts_with(place); });
}

TEST_F(HouseRules, EachLibraryIsUsedInOnePlace) {
  for (const SourceFile& file : files()) {
    if (file.folder() == "tests" || file.path.starts_with("tools/bench/")) continue;
    for (const std::string& line : file.lines) {
      const std::string header = included(line, '<', '>');
      for (const Owner& owner : kOwners) {
        if (!header.starts_with(owner.library)) continue;
        EXPECT_TRUE(may_have(owner, file.path)) << file.path << ": " << line;
      }
    }
  }
}

TEST_F(HouseRules, OnlyTheDisplayReadsTheEnvironment) {
  for (const SourceFile& file : files()) {
    if (file.folder() == "tests" || file.path == "core/display.cpp") continue;
    for (const std::string& line : file.lines) {
      EXPECT_EQ(line.find("getenv("), std::string::npos) << file.path << ": " << line;
    }
  }
}

/// A header is an interface, and to be read at one go; one of the tests is source that they share.
TEST_F(HouseRules, FilesAreShort) {
  for (const SourceFile& file : files()) {
    const bool is_interface = file.is_header() && file.folder() != "tests";
    EXPECT_LE(file.lines.size(), is_interface ? 150u : 300u) << file.path;
  }
}

TEST_F(HouseRules, FilesOpenWithWhatTheyAre) {
  for (const SourceFile& file : files()) {
    ASSERT_FALSE(file.lines.empty()) << file.path;
    EXPECT_EQ(file.lines.front().rfind("// ", 0), 0u) << file.path;
  }
}

TEST_F(HouseRules, HeadersAreGuarded) {
  for (const SourceFile& file : files()) {
    if (!file.is_header()) continue;
    const auto found = std::find(file.lines.begin(), file.lines.end(), "#pragma once");
    EXPECT_NE(found, file.lines.end()) << file.path;
  }
}

TEST_F(HouseRules, NothingIsLeftHalfDone) {
  // Cut in two, so that this file passes its own test.
  const std::string marks[] = {std::string("TO") + "DO", std::string("FIX") + "ME",
                               std::string("#if") + " 0", std::string("DISABLED") + "_"};
  for (const SourceFile& file : files()) {
    for (const std::string& line : file.lines) {
      for (const std::string& mark : marks) {
        EXPECT_EQ(line.find(mark), std::string::npos) << file.path << ": " << line;
      }
    }
  }
}

TEST_F(HouseRules, FormatIsClangFormats) {
  std::string command = "cd '" OCTOLUX_SOURCE_DIR "' && clang-format --dry-run -Werror";
  for (const SourceFile& file : files()) command += " '" + file.path + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << "clang-format -i mends what is listed above";
}

}  // namespace
}  // namespace octolux
