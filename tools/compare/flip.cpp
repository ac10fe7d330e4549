// flip.h: the paper's colour pipeline and feature pipeline (its sections 4.1 and 4.2), joined, and
// the exposures of HDR-FLIP.
#include "tools/compare/flip.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/parallel.h"
#include "tools/compare/flip_colour.h"
#include "tools/compare/flip_filter.h"

namespace octolux {
namespace {

using flip::Plane;
using flip::Triple;

constexpr std::int64_t kChunk = 1 << 14;  // pixels

/// Calls body(i) for every pixel.
template <class Body>
void for_pixels(std::size_t count, const Body& body) {
  parallel_for_chunks(static_cast<std::int64_t>(count), kChunk,
                      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                        for (std::int64_t i = begin; i < end; ++i)
                          body(static_cast<std::size_t>(i));
                      });
}

/// The three planes of the opponent space.
struct Opponent {
  Plane y, cx, cz;

  Opponent(int width, int height) : y(width, height), cx(width, height), cz(width, height) {}
  Triple at(std::size_t i) const { return {y.v[i], cx.v[i], cz.v[i]}; }
};

float clamp01(float v) { return v > 0 ? std::min(v, 1.0f) : 0.0f; }
Triple clamp01(Triple c) { return {clamp01(c.a), clamp01(c.b), clamp01(c.c)}; }

Opponent to_opponent(const Image& linear) {
  Opponent planes(linear.width, linear.height);
  for_pixels(linear.pixels.size(), [&](std::size_t i) {
    const Rgb p = linear.pixels[i];
    const Triple o = flip::linear_to_opponent({p.r, p.g, p.b});
    planes.y.v[i] = o.a;
    planes.cx.v[i] = o.b;
    planes.cz.v[i] = o.c;
  });
  return planes;
}

Opponent contrast_filtered(const Opponent& o, double ppd) {
  Opponent result(0, 0);
  result.y = flip::contrast_filter(flip::Opponent::achromatic, ppd)(o.y);
  result.cx = flip::contrast_filter(flip::Opponent::red_green, ppd)(o.cx);
  result.cz = flip::contrast_filter(flip::Opponent::blue_yellow, ppd)(o.cz);
  return result;
}

Triple seen_colour(const Opponent& filtered, std::size_t i) {
  return flip::linear_to_hunt_lab(clamp01(flip::opponent_to_linear(filtered.at(i))));
}

/// How much of an edge and of a point there is at each pixel.
struct Features {
  Plane edge, point;
};

Plane magnitude(Plane x, const Plane& y) {
  for_pixels(x.v.size(), [&](std::size_t i) { x.v[i] = std::hypot(x.v[i], y.v[i]); });
  return x;
}

Features find_features(const Plane& opponent_y, double ppd) {
  Plane y = opponent_y;
  for_pixels(y.v.size(), [&](std::size_t i) { y.v[i] = (y.v[i] + 16) / 116; });
  const flip::FeatureKernels k = flip::feature_kernels(ppd);
  const Plane smooth = filter_rows(y, k.smooth);
  return {magnitude(filter(y, k.edge, k.smooth), filter_columns(smooth, k.edge)),
          magnitude(filter(y, k.point, k.smooth), filter_columns(smooth, k.point))};
}

/// Of two pictures in linear light, within [0, 1].
FlipMap flip_of_linear(const Image& reference, const Image& image, double ppd) {
  const Opponent r = to_opponent(reference), x = to_opponent(image);
  const Opponent seen_r = contrast_filtered(r, ppd), seen_x = contrast_filtered(x, ppd);
  const Features features_r = find_features(r.y, ppd), features_x = find_features(x.y, ppd);
  FlipMap map{reference.width, reference.height, {}};
  map.error.resize(reference.pixels.size());
  for_pixels(map.error.size(), [&](std::size_t i) {
    const float colour =
        flip::colour_error(flip::hyab(seen_colour(seen_r, i), seen_colour(seen_x, i)));
    const float feature = std::max(std::abs(features_x.edge.v[i] - features_r.edge.v[i]),
                                   std::abs(features_x.point.v[i] - features_r.point.v[i]));
    map.error[i] = std::pow(colour, 1 - std::sqrt(feature / std::sqrt(2.0f)));
  });
  return map;
}

/// Narkowicz's fit of the ACES curve (2016), (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5), with the
/// exposure it has built in, 0.6, taken out.
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03;
constexpr double k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;

/// The curve is flat long before this; beyond, infinity would divide infinity.
constexpr float kBrightest = 1e6f;

float tone_map(float v) {
  const float x = v > 0 ? std::min(v, kBrightest) : 0.0f;
  constexpr auto f = [](double k) { return static_cast<float>(k); };
  return clamp01((f(k0) * x + f(k1)) * x / ((f(k3) * x + f(k4)) * x + f(k5)));
}

Image tone_mapped(const Image& linear, double exposure) {
  const auto scale = static_cast<float>(std::exp2(exposure));
  Image image(linear.width, linear.height);
  for_pixels(image.pixels.size(), [&](std::size_t i) {
    const Rgb p = linear.pixels[i] * scale;
    image.pixels[i] = {tone_map(p.r), tone_map(p.g), tone_map(p.b)};
  });
  return image;
}

/// Where the tone curve reaches 0.85.
double tone_map_inverse() {
  constexpr double t = 0.85;
  const double p = (k1 - k4 * t) / (k0 - k3 * t), q = -k5 * t / (k0 - k3 * t);
  return -0.5 * p + std::sqrt(0.25 * p * p - q);
}

void check_sizes(const Image& reference, const Image& image) {
  OCTOLUX_CHECK(reference.width == image.width && reference.height == image.height);
  OCTOLUX_CHECK(!reference.pixels.empty());
}

}  // namespace

double FlipMap::mean(const Mask& mask) const {
  double sum = 0;
  for (std::size_t i = 0; i < error.size(); ++i) {
    if (counts(mask, i)) sum += static_cast<double>(error[i]);
  }
  return sum / static_cast<double>(count_pixels(mask, error.size()));
}

FlipMap ldr_flip(const Image& reference, const Image& image, double ppd) {
  check_sizes(reference, image);
  const auto linear = [](Image shown) {
    for_pixels(shown.pixels.size(), [&](std::size_t i) {
      Rgb& p = shown.pixels[i];
      p = {flip::srgb_to_linear(clamp01(p.r)), flip::srgb_to_linear(clamp01(p.g)),
           flip::srgb_to_linear(clamp01(p.b))};
    });
    return shown;
  };
  return flip_of_linear(linear(reference), linear(image), ppd);
}

int flip_exposure_count(double start, double stop) {
  return std::max(2, static_cast<int>(std::ceil(stop - start)));
}

FlipExposures flip_exposures(const Image& reference) {
  std::vector<float> bright;
  for (const Rgb& p : reference.pixels) {
    const float y = luminance(p);
    if (std::isfinite(y)) bright.push_back(std::max(y, 0.0f));
  }
  const auto middle_of = [](std::vector<float>& v) {
    const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
  };
  if (bright.empty() || *std::max_element(bright.begin(), bright.end()) <= 0) return {};
  if (middle_of(bright) <= 0) std::erase(bright, 0.0f);
  const double most = *std::max_element(bright.begin(), bright.end());
  const double target = tone_map_inverse();
  FlipExposures e{std::log2(target / most),
                  std::log2(target / static_cast<double>(middle_of(bright))), 0};
  e.count = flip_exposure_count(e.start, e.stop);
  return e;
}

FlipMap hdr_flip(const Image& reference, const Image& image, double ppd) {
  return hdr_flip(reference, image, flip_exposures(reference), ppd);
}

FlipMap hdr_flip(const Image& reference, const Image& image, const FlipExposures& e, double ppd) {
  check_sizes(reference, image);
  FlipMap worst{reference.width, reference.height,
                std::vector<float>(reference.pixels.size(), 0.0f)};
  const double step = e.count > 1 ? (e.stop - e.start) / (e.count - 1) : 0;
  for (int i = 0; i < e.count; ++i) {
    const double exposure = e.start + i * step;
    const FlipMap map =
        flip_of_linear(tone_mapped(reference, exposure), tone_mapped(image, exposure), ppd);
    for_pixels(map.error.size(),
               [&](std::size_t p) { worst.error[p] = std::max(worst.error[p], map.error[p]); });
  }
  return worst;
}

}  // namespace octolux
