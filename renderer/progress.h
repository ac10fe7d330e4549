// How far a render has come.
#pragma once

#include <cstdint>

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
  std::int64_t caustic_paths = 0;     // traced for them
  std::int64_t direct_samples = 0;    // of direct light alone, that the next pass adds to each
  std::int64_t direct_grids = 0;      // of them, per pixel, of all passes
  std::int64_t rejected_photons = 0;  // not finite; of all passes
  std::int64_t photon_bytes = 0;      // both maps of the last pass
  std::int64_t rays = 0;              // of all passes
  Timing timing;
};

}  // namespace octolux
