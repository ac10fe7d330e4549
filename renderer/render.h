// The progressive loop (Knaus & Zwicker 2011): independent passes, whose mean is the picture.
#pragma once

#include <optional>

#include "renderer/config.h"
#include "renderer/film.h"
#include "renderer/scene.h"

namespace octolux {

/// Seconds spent in each part of the passes so far.
struct Timing {
  double photons = 0;  // emitting and following photons
  double maps = 0;     // building the trees
  double eye = 0;      // eye paths, gathering included
};

/// How far a render is.
struct Progress {
  int passes = 0;
  int total_passes = 0;           // 0: decided by time or error
  double seconds = 0;             // spent by render(), interruptions left out
  double pass_seconds = 0;        // of them, in the last pass
  double remaining_seconds = -1;  // below 0: unknown
  double error = 1;               // Film::relative_error()
  double rays_per_second = 0;
  std::int64_t global_photons = 0;  // stored in the last pass
  std::int64_t caustic_photons = 0;
  std::int64_t rejected_photons = 0;  // not finite; of all passes
  std::int64_t photon_bytes = 0;      // both maps of the last pass
  std::int64_t rays = 0;              // of all passes
  Timing timing;
};

class RenderObserver {
 public:
  virtual ~RenderObserver() = default;
  /// Called after every pass; false stops the render.
  virtual bool pass_done(const Progress& progress, const Film& film) = 0;
};

struct RenderResult {
  Film film;
  Progress progress;
  bool interrupted = false;  // the observer stopped it
};

/// Renders until the first stop rule is reached; with none set, until the defaults
/// (default_stop). Throws Error for settings out of range, before any work. Goes on from `start`,
/// if given, the result of the same scene and settings (stop rules may differ): the picture is bit
/// by bit that of one render without a break.
RenderResult render(const Scene& scene, const RenderConfig& config, RenderObserver& observer,
                    std::optional<RenderResult> start = std::nullopt);

/// Do the config's stop rules, none of which need be set, end a render that has come this far, at
/// least one pass?
bool finished(const RenderConfig& config, const Progress& progress);

/// Stop rules of a render that was given none.
StopConfig default_stop(Integrator integrator);

}  // namespace octolux
