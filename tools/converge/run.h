// One variant rendered with one seed, and what of it stays on disk: a picture after 1, 2, 4, 8 ...
// passes with the time it took, and the state to go on from. A run that was interrupted goes on
// where it stopped; one that is asked to go further does. The folder's name holds a hash of what
// was rendered by which program, so nothing is mistaken for something else and nothing overwritten.
//
// Pictures at pass counts, not at times: those of all seeds can be averaged, and the same command
// gives the same pictures on any machine.
#pragma once

#include <string>
#include <vector>

#include "renderer/render.h"
#include "tools/converge/variant.h"

namespace octolux {

struct Snapshot {
  int passes = 0;
  double seconds = 0;      // of wall-clock time spent rendering so far
  double cpu_seconds = 0;  // of all threads
  std::string file;        // EXR
};

struct Run {
  std::uint64_t seed = 1;
  std::vector<Snapshot> snapshots;
  bool interrupted = false;
  std::int64_t non_finite = 0;  // samples and photons left out
};

enum class Clock { wall, cpu };

/// How far a run goes: as long as the next doubling is expected to end within `seconds`, and
/// through `passes` of passes. The first seed decides for all.
struct RunLimit {
  double seconds = 10;
  int passes = 1 << 20;
  Clock clock = Clock::wall;
};

double time_of(const Snapshot& snapshot, Clock clock);

/// Would a run with these snapshots go on?
bool goes_on(const std::vector<Snapshot>& snapshots, const RunLimit& limit);

/// The run's folder under `folder`, unique to what is rendered.
std::string run_folder(const std::string& folder, const Scene& scene, const Variant& variant,
                       std::uint64_t seed);

/// Renders what is missing; `observer` may stop it. Throws Error if the folder cannot be written.
Run continue_run(const std::string& run_folder, const Scene& scene, RenderConfig config,
                 const RunLimit& limit, RenderObserver& observer);

}  // namespace octolux
