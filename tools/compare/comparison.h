// A reference against images, layer by layer: everything `octolux compare` knows, in one structure
// from which text, JSON, gates, pictures and pages are made, so that all show the same numbers.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/display.h"
#include "tools/compare/flip.h"
#include "tools/compare/layer_view.h"
#include "tools/compare/mask.h"
#include "tools/compare/metrics.h"
#include "tools/compare/noise_test.h"

namespace octolux {

struct CompareOptions {
  bool flip = false;       // takes seconds, where all else takes a fraction of one
  DisplayOptions display;  // LDR-FLIP compares what it shows
  double alpha = kNoiseAlpha;
};

struct FlipScores {
  double ldr = 0, hdr = 0;  // means over the mask
  FlipExposures exposures;  // of HDR-FLIP
  FlipMap map;              // HDR-FLIP per pixel
};

struct LayerComparison {
  std::string layer;  // "": the root
  std::vector<std::string> channels;
  Metrics metrics;
  std::optional<NoiseTest> noise;  // if a variance is known
  std::optional<FlipScores> flip;  // if asked for, of R G B layers
};

struct ImageComparison {
  std::string image;  // its name
  std::vector<LayerComparison> layers;
};

struct Comparison {
  std::string reference;
  int width = 0, height = 0;
  std::string mask;  // what it is, in words; "": every pixel
  std::int64_t mask_pixels = 0;
  std::vector<ImageComparison> images;
};

/// Throws Error as check_comparable.
LayerComparison compare_layers(const LayerView& reference, const LayerView& image, const Mask& mask,
                               const CompareOptions& options);

/// All `images` by the layers named. Throws Error as view_layer and check_comparable.
Comparison compare_pictures(const NamedPicture& reference, std::span<const NamedPicture> images,
                            const std::vector<std::string>& layers, const Mask& mask,
                            const CompareOptions& options);

/// R G B of the view as an image.
Image image_of(const LayerView& view);

/// Which way a figure may move before a gate closes.
enum class Better { smaller, larger, neither };

/// A figure as reports show it.
struct Figure {
  const char* key;  // in JSON, and in --max-KEY
  const char* title;
  const char* formula;
  Better better;
  std::optional<double> (*value)(const LayerComparison&);  // empty: not known
};

/// `value` with so many digits; NaN, whose sign means nothing, without one.
std::string number_text(double value, int digits);

/// Every figure of a comparison, in the order of reports.
std::span<const Figure> figures();

}  // namespace octolux
