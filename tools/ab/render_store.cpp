// render_store.h. Files "FINGERPRINT-PASSES.render".
#include "tools/ab/render_store.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/file_io.h"
#include "core/hash.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;

/// Would a render by these rules have come here? Only if they did not end it a pass before.
bool within(const RenderConfig& config, Progress p) {
  p.seconds -= p.pass_seconds;
  --p.passes;
  return p.passes < 1 || !finished(config, p);
}

}  // namespace

StoredRender::StoredRender(std::string folder, const Scene& scene, const RenderConfig& config)
    : folder_(std::move(folder)),
      film_(scene.film),
      config_(config),
      provenance_(provenance(scene, config)),
      name_(fmt::format("{:016x}-", hash_bytes(0, provenance_))) {}

std::string StoredRender::path_of(int passes) const {
  return (fs::path(folder_) / fmt::format("{}{:07}.render", name_, passes)).string();
}

std::optional<RenderResult> StoredRender::load() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    const std::string file = entry.path().filename().string();
    if (file.starts_with(name_) && file.ends_with(".render")) files.push_back(entry.path());
  }
  std::sort(files.rbegin(), files.rend());
  for (const std::string& file : files) {
    std::optional<RenderResult> kept = from_checkpoint(read_file(file), provenance_, film_);
    if (!kept || !within(config_, kept->progress)) continue;
    current_ = file;
    return kept;
  }
  return std::nullopt;
}

void StoredRender::save(const Progress& progress, const Film& film) {
  const std::string path = path_of(progress.passes);
  if (path == current_) return;
  write_file(path, to_checkpoint(provenance_, progress, film));
  if (!current_.empty()) fs::remove(current_);
  current_ = path;
}

}  // namespace octolux
