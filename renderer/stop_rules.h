// When a render ends: after so many passes, samples or seconds, or below an error (StopConfig).
#pragma once

#include "renderer/config.h"
#include "renderer/progress.h"

namespace octolux {

/// Do the config's stop rules, none of which need be set, end a render that has come this far, at
/// least one pass?
bool finished(const RenderConfig& config, const Progress& progress);

/// Stop rules of a render that was given none.
StopConfig default_stop(Integrator integrator);

/// Is any rule set?
bool has_rule(const StopConfig& stop);

/// Passes allowed by the rules that count them; 0: no such rule.
int pass_limit(const RenderConfig& config);

/// Time [s] still needed by the rule that will be reached first, as far as can be foreseen;
/// negative if nothing can.
double remaining_seconds(const StopConfig& stop, const Progress& progress);

}  // namespace octolux
