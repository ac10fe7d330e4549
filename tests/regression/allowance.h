// What a kernel's picture may be, given the reference: derived from what the kernel states about
// itself (bias.h) and from what a density estimate is, an average over its disc.
//
// Photon map shown: an estimate at x averages the irradiance within h of x on the same surface,
// times a factor that is stated. So its mean lies between the least and the greatest reference
// radiance / albedo there, times that factor; near an edge (something else within h) it is the one
// stated for edges. h is measured: the distance of the (n+1)th photon in a first pass. Pixels at
// discontinuities of surface or albedo are left out: they mix surfaces, whose estimates differ.
//
// Final gather: what is read from maps may be wrong by the factor stated for edges, and a caustic
// by what an average over its disc can change; the rest is unbiased.
#pragma once

#include <algorithm>

#include "core/image_io.h"
#include "tests/regression/bias.h"
#include "tests/regression/footing.h"
#include "tests/regression/gate.h"

namespace octolux::test {

/// Least and greatest of some values.
struct Extremes {
  Rgb low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

  void add(Rgb v) {
    low = {std::min(low.r, v.r), std::min(low.g, v.g), std::min(low.b, v.b)};
    high = {std::max(high.r, v.r), std::max(high.g, v.g), std::max(high.b, v.b)};
  }
};

/// Calls see(pixel) for all pixels that look-ups at pixel i may reach, by their distance in the
/// picture, where the reach looks largest.
template <class See>
void for_each_in_reach(const Footing& at, std::size_t i, const Image& image, See&& see) {
  const int window = static_cast<int>(std::ceil((at.bandwidth + at.pixel) / at.pixel));
  const int w = image.width, x0 = static_cast<int>(i) % w, y0 = static_cast<int>(i) / w;
  const int y1 = std::min(image.height - 1, y0 + window), x1 = std::min(w - 1, x0 + window);
  for (int y = std::max(0, y0 - window); y <= y1; ++y) {
    for (int x = std::max(0, x0 - window); x <= x1; ++x) {
      see(static_cast<std::size_t>(y) * w + x);
    }
  }
}

/// For renders without final gather.
inline Allowed allow_shown(const Scene& scene, const RenderConfig& config,
                           const ExrFile& reference) {
  const std::string& kernel = config.estimator.kernel;
  const Image radiance = reference.image(), albedo = reference.image("albedo");
  const Footings feet = footings(scene, config, PhotonKind::global);
  const Discontinuities marks(feet, albedo);
  Allowed out{radiance, radiance, reference.image("variance"), {}};
  for (std::size_t i = 0; i < feet.size(); ++i) {
    out.counts.push_back(!marks.at(i));
    if (marks.at(i)) continue;
    Extremes range;
    bool edge = false;
    const Footing& at = *feet[i];
    for_each_in_reach(at, i, radiance, [&](std::size_t j) {
      edge = edge || marks.at(j);
      const bool same = !marks.at(j) && dot(feet[j]->normal, at.normal) > kSameNormal &&
                        length(feet[j]->position - at.position) <= at.bandwidth + at.extent;
      if (same) range.add(radiance.pixels[j] / albedo.pixels[j]);
    });
    const StatedBias bias = edge ? stated_bias_near_edges(kernel) : stated_bias_in_the_open();
    out.low.pixels[i] = albedo.pixels[i] * range.low * static_cast<float>(1 + bias.low);
    out.high.pixels[i] = albedo.pixels[i] * range.high * static_cast<float>(1 + bias.high);
  }
  return out;
}

/// For renders with final gather.
inline Allowed allow_gathered(const Scene& scene, const RenderConfig& config,
                              const ExrFile& reference, const Batches& batches) {
  const StatedBias bias = stated_bias_near_edges(config.estimator.kernel);
  const Image radiance = reference.image();
  const Footings feet = footings(scene, config, PhotonKind::caustic);
  Allowed out{radiance, radiance, reference.image("variance"), {}};
  for (std::size_t i = 0; i < feet.size(); ++i) {
    out.counts.push_back(1);
    const Rgb read = batches.through_maps.pixels[i], caustic = batches.caustic.pixels[i];
    Extremes blur;
    blur.add(caustic);
    if (feet[i]) {
      for_each_in_reach(*feet[i], i, radiance,
                        [&](std::size_t j) { blur.add(batches.caustic.pixels[j]); });
    }
    out.low.pixels[i] += read * static_cast<float>(bias.low) + (blur.low - caustic);
    out.high.pixels[i] += read * static_cast<float>(bias.high) + (blur.high - caustic);
  }
  return out;
}

/// For the path tracer: no bias at all.
inline Allowed allow_nothing(const ExrFile& reference) {
  const Image radiance = reference.image();
  return {radiance, radiance, reference.image("variance"),
          std::vector<char>(radiance.pixels.size(), 1)};
}

/// For any of them; `kernel` as in regression_config.
inline Allowed allowed_for(const Scene& scene, const RenderConfig& config, const ExrFile& reference,
                           const Batches& batches) {
  if (config.integrator == Integrator::path) return allow_nothing(reference);
  return config.eye.gather ? allow_gathered(scene, config, reference, batches)
                           : allow_shown(scene, config, reference);
}

}  // namespace octolux::test
