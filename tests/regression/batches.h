// Renders of one scene with many seeds, each a batch of a few passes. All that is tested is a mean
// over batches, whose variance their spread gives: it knows what pixels share (photons, and the
// place of the samples within the pixels, which is one and the same for all pixels of a pass and
// drawn from the seed), as the variance layer of one picture does not. So lamps' edges and
// silhouettes, where that common place makes pixels err together, need no mask here.
#pragma once

#include <vector>

#include "tests/regression/cases.h"

namespace octolux::test {

/// Enough degrees of freedom for Student's t to be near normal even far out.
inline constexpr int kBatches = 32;
inline constexpr int kPassesPerBatch = 2;

struct Batches {
  std::vector<Image> radiance;  // of each batch
  Image through_maps;           // mean of what was read from photon maps
  Image caustic;                // mean of what was read from the caustic map
  double caustic_photons = 0;   // stored in a pass
};

/// Settings of a case for a kernel; `kernel` "path" is the path tracer.
inline RenderConfig regression_config(const RegressionCase& c, const std::string& kernel,
                                      bool gather) {
  if (kernel == "path") return path_config(8 * kPassesPerBatch);
  RenderConfig config = photon_config(kPassesPerBatch, gather ? c.photons : c.shown_photons);
  config.estimator.kernel = kernel;
  config.eye.gather = gather;
  return config;
}

inline void add_share(Image& sum, const Image& image, float share) {
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += image.pixels[i] * share;
}

inline Batches render_batches(const Scene& scene, RenderConfig config) {
  const int width = scene.film.crop_width, height = scene.film.crop_height;
  Batches batches{{}, Image(width, height), Image(width, height), 0};
  constexpr float kShare = 1.0f / kBatches;
  for (int i = 0; i < kBatches; ++i) {
    config.seed = 1000 + static_cast<std::uint64_t>(i);
    Watch watch;
    const RenderResult result = render(scene, config, watch);
    batches.radiance.push_back(result.film.radiance());
    add_share(batches.through_maps, result.film.indirect(), kShare);
    add_share(batches.through_maps, result.film.caustic(), kShare);
    add_share(batches.caustic, result.film.caustic(), kShare);
    batches.caustic_photons = static_cast<double>(result.progress.caustic_photons);
  }
  return batches;
}

/// Mean picture, and the variance of the mean.
inline Image mean_image(const Batches& batches) {
  Image mean(batches.caustic.width, batches.caustic.height);
  for (const Image& image : batches.radiance) add_share(mean, image, 1.0f / kBatches);
  return mean;
}
inline Image variance_image(const Batches& batches) {
  Image out(batches.caustic.width, batches.caustic.height);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    float v[3];
    for (int c = 0; c < 3; ++c) {
      Running values;
      for (const Image& image : batches.radiance) values.add(image.pixels[i][c]);
      v[c] = static_cast<float>(values.variance_of_mean());
    }
    out.pixels[i] = Rgb(v[0], v[1], v[2]);
  }
  return out;
}

}  // namespace octolux::test
