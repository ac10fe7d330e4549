// Which sources the renderer was built from: whoever keeps renders to go on with asks whether the
// program that made them is still the same. The value is made by tools/fingerprint.cmake.
#pragma once

namespace octolux {

/// SHA-256, in part, of all sources of core, accel, estimators and renderer.
const char* source_fingerprint();

}  // namespace octolux
