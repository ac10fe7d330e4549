// find_file.h: one component of the path after the other.
#include "renderer/find_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace octolux {
namespace {

namespace fs = std::filesystem;

bool same_but_for_case(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// The entry of `folder` with this name, the very same if there is one.
std::optional<fs::path> find_entry(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  std::vector<fs::path> similar;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string other = entry.path().filename().string();
    if (same_but_for_case(other, name)) similar.push_back(folder / other);
  }
  if (similar.empty()) return std::nullopt;
  return *std::min_element(similar.begin(), similar.end());
}

}  // namespace

std::optional<FoundFile> find_file(const std::vector<std::string>& folders,
                                   const std::string& name) {
  std::error_code error;
  for (const std::string& folder : folders) {
    const fs::path candidate = fs::path(folder) / name;
    if (fs::is_regular_file(candidate, error)) return FoundFile{candidate.string(), false};
  }
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const fs::path wanted(slashes);
  for (const std::string& folder : folders) {
    std::optional<fs::path> at = wanted.is_absolute() ? wanted.root_path() : fs::path(folder);
    for (const fs::path& part : wanted.relative_path()) {
      if (at) at = find_entry(*at, part.string());
    }
    if (at && fs::is_regular_file(*at, error)) return FoundFile{at->string(), true};
  }
  return std::nullopt;
}

}  // namespace octolux
