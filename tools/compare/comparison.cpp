// comparison.h.
#include "tools/compare/comparison.h"

#include <fmt/format.h>

#include <cmath>

#include "core/parallel.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 1 << 14;  // pixels

using Value = std::optional<double>;

template <double Metrics::*member>
Value metric(const LayerComparison& c) {
  return c.metrics.*member;
}

Value mean_error(const LayerComparison& c) { return std::abs(c.metrics.mean_ratio - 1); }

Value bias2(const LayerComparison& c) {
  const auto& noise = c.metrics.noise;
  return noise ? Value(noise->bias2) : std::nullopt;
}

Value variance_of_image(const LayerComparison& c) {
  const auto& noise = c.metrics.noise;
  return noise && noise->image_known ? Value(noise->variance_image) : std::nullopt;
}

Value variance_of_reference(const LayerComparison& c) {
  const auto& noise = c.metrics.noise;
  return noise && noise->reference_known ? Value(noise->variance_reference) : std::nullopt;
}

Value flip_hdr(const LayerComparison& c) { return c.flip ? Value(c.flip->hdr) : std::nullopt; }
Value flip_ldr(const LayerComparison& c) { return c.flip ? Value(c.flip->ldr) : std::nullopt; }

constexpr Figure kFigures[] = {
    {"relmse", "relMSE", "mean (x-y)^2/(y^2+0.01)", Better::smaller, metric<&Metrics::rel_mse>},
    {"relmse-trimmed", "relMSE, trimmed", "relMSE without the worst 0.1 % of pixels",
     Better::smaller, metric<&Metrics::trimmed_rel_mse>},
    {"mrse", "MRSE", "mean (x-y)^2/(y+0.01)^2", Better::smaller, metric<&Metrics::mrse>},
    {"mse", "MSE", "mean (x-y)^2", Better::smaller, metric<&Metrics::mse>},
    {"rmse", "RMSE", "sqrt(MSE)", Better::smaller, metric<&Metrics::rmse>},
    {"mae", "MAE", "mean |x-y|", Better::smaller, metric<&Metrics::mae>},
    {"smape", "SMAPE", "mean 2|x-y|/(|x|+|y|+0.01)", Better::smaller, metric<&Metrics::smape>},
    {"psnr", "PSNR [dB]", "10 log10(1/mean (x'-y')^2), ' = clamped to [0, 1]", Better::larger,
     metric<&Metrics::psnr>},
    {"mean-image", "mean x", "mean x", Better::neither, metric<&Metrics::mean_image>},
    {"mean-reference", "mean y", "mean y", Better::neither, metric<&Metrics::mean_reference>},
    {"mean-ratio", "mean ratio", "mean x / mean y", Better::neither, metric<&Metrics::mean_ratio>},
    {"mean-error", "mean error", "|mean x / mean y - 1|", Better::smaller, mean_error},
    {"light-leak", "light leak", "mean max(0, x-y) / mean y", Better::smaller,
     metric<&Metrics::light_leak>},
    {"shadow-leak", "shadow leak", "mean max(0, y-x) / mean y", Better::smaller,
     metric<&Metrics::shadow_leak>},
    {"bias2", "bias^2", "max(0, MSE - variance of x - variance of y)", Better::smaller, bias2},
    {"variance-image", "variance of x", "mean of x's variance layer", Better::smaller,
     variance_of_image},
    {"variance-reference", "variance of y", "mean of y's variance layer", Better::neither,
     variance_of_reference},
    {"flip", "HDR-FLIP", "mean; Andersson et al. 2021, 67.0 pixels per degree", Better::smaller,
     flip_hdr},
    {"ldr-flip", "LDR-FLIP", "mean, of what the view shows; Andersson et al. 2020", Better::smaller,
     flip_ldr},
};

FlipScores score_flip(const LayerView& reference, const LayerView& image, const Mask& mask,
                      const DisplayOptions& display) {
  const Image y = image_of(reference), x = image_of(image);
  FlipScores scores;
  scores.exposures = flip_exposures(y);
  scores.map = hdr_flip(y, x, scores.exposures, kFlipPixelsPerDegree);
  scores.hdr = scores.map.mean(mask);
  scores.ldr = ldr_flip(to_display(y, display), to_display(x, display)).mean(mask);
  return scores;
}

}  // namespace

LayerComparison compare_layers(const LayerView& reference, const LayerView& image, const Mask& mask,
                               const CompareOptions& options) {
  LayerComparison c;
  c.layer = reference.layer;
  c.channels = reference.channels;
  c.metrics = measure_error(reference, image, mask);
  if (c.metrics.noise) c.noise = test_noise(reference, image, mask, options.alpha);
  if (options.flip && c.channels.front() == "R") {
    c.flip = score_flip(reference, image, mask, options.display);
  }
  return c;
}

Comparison compare_pictures(const NamedPicture& reference, std::span<const NamedPicture> images,
                            const std::vector<std::string>& layers, const Mask& mask,
                            const CompareOptions& options) {
  Comparison all;
  all.reference = reference.name;
  all.width = reference.file.width;
  all.height = reference.file.height;
  all.mask_pixels = count_pixels(mask, std::size_t(all.width) * std::size_t(all.height));
  for (const NamedPicture& image : images) {
    ImageComparison result{image.name, {}};
    for (const std::string& layer : layers) {
      result.layers.push_back(
          compare_layers(view_layer(reference, layer), view_layer(image, layer), mask, options));
    }
    all.images.push_back(std::move(result));
  }
  return all;
}

Image image_of(const LayerView& view) {
  Image image(view.width, view.height);
  parallel_for_chunks(
      static_cast<std::int64_t>(image.pixels.size()), kChunk,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          image.pixels[i] = {view.planes[0][i], view.planes[1][i], view.planes[2][i]};
        }
      });
  return image;
}

std::string number_text(double value, int digits) {
  return std::isnan(value) ? "nan" : fmt::format("{:.{}g}", value, digits);
}

std::span<const Figure> figures() { return kFigures; }

}  // namespace octolux
