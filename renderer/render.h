// The progressive loop (Knaus & Zwicker 2011): independent passes, whose mean is the picture.
#pragma once

#include <optional>

#include "renderer/config.h"
#include "renderer/film.h"
#include "renderer/photon_memory.h"
#include "renderer/progress.h"
#include "renderer/scene.h"
#include "renderer/stop_rules.h"

namespace octolux {

class RenderObserver {
 public:
  virtual ~RenderObserver() = default;
  /// Called once, before the first pass of photon mapping.
  virtual void photons_foreseen(const PhotonMemory& /*memory*/) {}
  /// Called after every pass; false stops the render.
  virtual bool pass_done(const Progress& progress, const Film& film) = 0;
};

struct RenderResult {
  Film film;
  Progress progress;
  bool interrupted = false;  // the observer stopped it
};

/// Renders until the first stop rule is reached; with none set, until the defaults
/// (default_stop). Throws Error for settings out of range and for more photons than fit into
/// memory, before the first pass. Goes on from `start`, if given, the result of the same scene and
/// settings (stop rules may differ): the picture is bit by bit that of one render without a break.
RenderResult render(const Scene& scene, const RenderConfig& config, RenderObserver& observer,
                    std::optional<RenderResult> start = std::nullopt);

}  // namespace octolux
