// Renders kept in a folder as checkpoints (renderer/checkpoint.h), each under the fingerprint of
// its provenance and its number of passes, so that a render which was interrupted, or which is now
// wanted longer, goes on and is not made anew.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "renderer/checkpoint.h"

namespace octolux {

/// One render's place in the folder.
class StoredRender {
 public:
  /// `folder` must be there.
  StoredRender(std::string folder, const Scene& scene, const RenderConfig& config);

  /// The longest of its checkpoints that has not gone beyond the config's stop rules.
  std::optional<RenderResult> load();
  /// Replaces what was loaded or saved before, which it goes on from. Throws Error.
  void save(const Progress& progress, const Film& film);

 private:
  std::string path_of(int passes) const;

  std::string folder_;
  FilmSize film_;
  RenderConfig config_;
  std::string provenance_;
  std::string name_;     // of its files, but for the passes
  std::string current_;  // the file that has what we go on from; "": none
};

}  // namespace octolux
