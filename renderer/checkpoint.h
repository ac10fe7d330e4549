// A render as bytes, from which render() goes on as if it had never stopped: the film's sums and
// the progress. Of this machine and this build, so not a format to exchange (that is the EXR); a
// checkpoint names what it is of, its provenance, and is used for nothing else.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "renderer/render.h"

namespace octolux {

/// What fixes the pixels of each pass: the program, the scene, its film, and every setting that
/// matters, the stop rules left out. Text, one item a line.
std::string provenance(const Scene& scene, const RenderConfig& config);

std::string to_checkpoint(const std::string& provenance, const Progress& progress,
                          const Film& film);

/// Empty if `bytes` are no checkpoint, damaged, or of another provenance or film size.
std::optional<RenderResult> from_checkpoint(std::string_view bytes, const std::string& provenance,
                                            const FilmSize& film);

}  // namespace octolux
