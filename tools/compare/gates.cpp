// gates.h.
#include "tools/compare/gates.h"

#include <fmt/format.h>

#include "core/error.h"

namespace octolux {
namespace {

constexpr char kWithinNoise[] = "--within-noise";

std::string place_of(const ImageComparison& image, const LayerComparison& layer) {
  return layer.layer.empty() ? image.image : image.image + ", " + layer_title(layer.layer);
}

GateResult check_noise(const ImageComparison& image, const LayerComparison& layer) {
  if (!layer.noise) {
    throw Error(fmt::format("{}: {} needs a layer 'variance' in {} or in the reference",
                            kWithinNoise, kWithinNoise, image.image));
  }
  const NoiseTest& test = *layer.noise;
  return {
      image.image, layer.layer, kWithinNoise, !test.differ(),
      fmt::format("{}: {} of {} values differ by more than their noise{}", place_of(image, layer),
                  test.rejected, test.tested, test.differ() ? ": FAILED" : "")};
}

GateResult check_figure(const ImageComparison& image, const LayerComparison& layer,
                        const Gate& gate) {
  const Figure& figure = *gate.figure;
  const std::string option = gate_option(figure);
  const std::optional<double> value = figure.value(layer);
  if (!value) {
    throw Error(fmt::format("{}: is not known of {}; {}", option, place_of(image, layer),
                            std::string(figure.key).find("flip") != std::string::npos
                                ? "FLIP needs channels R, G and B"
                                : "it needs a layer 'variance' beside the root layer"));
  }
  const bool smaller = figure.better == Better::smaller;
  const bool passed = smaller ? *value <= gate.limit : *value >= gate.limit;  // NaN fails
  return {image.image, layer.layer, option, passed,
          fmt::format("{}: {} {}, {} {:.6g} {}", place_of(image, layer), figure.title,
                      number_text(*value, 6), smaller ? "at most" : "at least", gate.limit,
                      passed ? "wanted" : "wanted: FAILED")};
}

void check_finite(const ImageComparison& image, const LayerComparison& layer,
                  std::vector<GateResult>& results) {
  const std::int64_t bad = layer.metrics.image.non_finite() + layer.metrics.reference.non_finite();
  if (bad == 0) return;
  results.push_back({image.image, layer.layer, "finite", false,
                     fmt::format("{}: {} pixels are NaN or infinite in it or in the reference: "
                                 "FAILED",
                                 place_of(image, layer), bad)});
}

}  // namespace

std::string gate_option(const Figure& figure) {
  if (figure.better == Better::neither) return "";
  return std::string(figure.better == Better::smaller ? "--max-" : "--min-") + figure.key;
}

std::vector<GateResult> check_gates(const Comparison& comparison, const std::vector<Gate>& gates) {
  std::vector<GateResult> results;
  for (const ImageComparison& image : comparison.images) {
    for (const LayerComparison& layer : image.layers) {
      for (const Gate& gate : gates) {
        results.push_back(gate.figure ? check_figure(image, layer, gate)
                                      : check_noise(image, layer));
      }
      if (!gates.empty()) check_finite(image, layer, results);
    }
  }
  return results;
}

}  // namespace octolux
