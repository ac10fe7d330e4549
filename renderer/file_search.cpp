// file_search.h: a path is followed component by component, an exact match wins.
#include "renderer/file_search.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace octolux {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The entry of `folder` called `name` but for case; empty if there is none.
fs::path entry_ignoring_case(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (fs::exists(folder / name, error)) return folder / name;
  const std::string wanted = lower(name);
  fs::path best;
  const fs::path place = folder.empty() ? fs::path(".") : folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
    const fs::path candidate = folder / entry.path().filename();
    if (lower(entry.path().filename().string()) != wanted) continue;
    if (best.empty() || candidate < best) best = candidate;
  }
  return best;
}

}  // namespace

std::optional<std::string> find_in_folder(const std::string& folder, const std::string& name) {
  std::error_code error;
  const fs::path exact = fs::path(folder) / name;
  if (fs::is_regular_file(exact, error)) return exact.string();
  std::string slashed = name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path wanted(slashed);
  fs::path path = wanted.is_absolute() ? wanted.root_path() : fs::path(folder);
  for (const fs::path& part : wanted.relative_path()) {
    path = entry_ignoring_case(path, part.string());
    if (path.empty()) return std::nullopt;
  }
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  return path.string();
}

}  // namespace octolux
