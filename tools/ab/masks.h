// Where leaks are to be looked for, found by rays and by the reference: the surfaces a picture
// shows fall into sealed ones, ones near a wall or an edge, and open ones.
#pragma once

#include <string>
#include <vector>

#include "renderer/config.h"
#include "renderer/scene.h"
#include "tools/compare/mask.h"

namespace octolux {

/// Per pixel (row-major), at its centre.
struct SeenSurfaces {
  // Something with smooth, not black lobes is seen, not by way of a mirror, and none of the eight
  // pixels around shows a lamp, whose share in a pixel at its rim is a matter of samples.
  Mask surface;
  Mask near_edge;            // of these: a wall or the surface's own edge is within reach
  std::vector<float> reach;  // [m]; 0 where there is no surface
  double bandwidths = 0;     // the same in bandwidths, anywhere
};

/// Traces one pass of photons, which gives the bandwidth at every pixel: that of the widest pass,
/// the first. Within `reach` bandwidths along the surface, 32 feelers (estimators/feelers.h) look
/// for walls and edges.
SeenSurfaces see_surfaces(const Scene& scene, const RenderConfig& config, double reach);

struct NamedMask {
  std::string key;      // in JSON
  std::string title;    // in tables
  std::string meaning;  // in a sentence
  Mask mask;            // empty: every pixel
  std::int64_t pixels = 0;
};

/// "image", and of "sealed", "walls" and "open" those that have pixels: each surface is in one.
/// Sealed: the reference has no light there, nor on any surface of the eight pixels around.
std::vector<NamedMask> leak_masks(const SeenSurfaces& seen, const LayerView& reference);

}  // namespace octolux
