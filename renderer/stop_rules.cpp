// stop_rules.h.
#include "renderer/stop_rules.h"

#include <algorithm>

#include "core/constants.h"

namespace octolux {

namespace {

/// The error is only trusted once this many passes have had their say.
constexpr int kPassesForError = 4;

}  // namespace

bool has_rule(const StopConfig& stop) {
  return stop.passes > 0 || stop.samples > 0 || stop.seconds > 0 || stop.error > 0;
}

int pass_limit(const RenderConfig& config) {
  const int passes = config.stop.passes;
  const int per_pass = config.eye.samples_per_pass;
  const int by_samples = (config.stop.samples + per_pass - 1) / per_pass;
  if (passes == 0 || by_samples == 0) return std::max(passes, by_samples);
  return std::min(passes, by_samples);
}

bool finished(const RenderConfig& config, const Progress& p) {
  const StopConfig& stop = config.stop;
  const int limit = pass_limit(config);
  if (limit > 0 && p.passes >= limit) return true;
  if (stop.seconds > 0 && p.seconds + 0.5 * p.seconds / p.passes >= stop.seconds) return true;
  return stop.error > 0 && p.passes >= kPassesForError && p.error <= stop.error;
}

StopConfig default_stop(Integrator integrator) {
  StopConfig stop;
  stop.samples = integrator == Integrator::photon ? 256 : 1024;
  stop.error = 0.02;
  return stop;
}

double remaining_seconds(const StopConfig& stop, const Progress& p) {
  const double per_pass = p.seconds / p.passes;
  double left = kInfinity;
  if (p.total_passes > 0) left = std::min(left, per_pass * (p.total_passes - p.passes));
  if (stop.seconds > 0) left = std::min(left, stop.seconds - p.seconds);
  if (stop.error > 0 && p.passes >= kPassesForError) {
    const double ratio = p.error / stop.error;
    left = std::min(left, p.seconds * (ratio * ratio - 1));
  }
  return left < kInfinity ? std::max(0.0, left) : -1;
}

}  // namespace octolux
