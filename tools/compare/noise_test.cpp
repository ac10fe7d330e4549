// noise_test.h. Student's tails are wider than the normal ones, so only deviates that a z-test
// rejects, or that are the largest of their chunk so far, need Student's p.
#include "tools/compare/noise_test.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.h"
#include "core/statistics.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 1 << 14;  // pixels

/// The deviate whose p in a z-test is `alpha`, from below, by bisection.
double z_limit(double alpha) {
  double low = 0, high = 40;  // erfc(40 / sqrt(2)) is 0 in double
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (z_test_p(middle) > alpha ? low : high) = middle;
  }
  return low;
}

class Tester {
 public:
  Tester(const LayerView& reference, const LayerView& image, const Mask& mask)
      : reference_(reference), image_(image), mask_(mask) {}

  /// Calls visit(pixel, difference, variance of image, variance of reference) for each value of
  /// pixels [begin, end) that counts.
  template <class Visit>
  void for_each(std::int64_t begin, std::int64_t end, const Visit& visit) const {
    for (std::int64_t i = begin; i < end; ++i) {
      if (!counts(mask_, static_cast<std::size_t>(i)) || !is_finite(i)) continue;
      for (std::size_t c = 0; c < reference_.planes.size(); ++c) {
        visit(i, static_cast<double>(image_.planes[c][i]) - reference_.planes[c][i],
              variance(image_, c, i), variance(reference_, c, i));
      }
    }
  }

  NoiseTest count(std::int64_t begin, std::int64_t end) const {
    NoiseTest part;
    for_each(begin, end, [&](std::int64_t, double difference, double va, double vb) {
      const bool testable = va + vb > 0;
      part.tested += testable;
      part.untested += !testable && difference != 0;
    });
    return part;
  }

  NoiseTest test(std::int64_t begin, std::int64_t end, double sidak_alpha) const {
    NoiseTest part;
    double enough = 0;  // smaller deviates are neither rejected nor the largest
    const double limit = z_limit(sidak_alpha);
    for_each(begin, end, [&](std::int64_t pixel, double difference, double va, double vb) {
      if (!(va + vb > 0)) return;
      const double t = difference / std::sqrt(va + vb);
      if (std::abs(t) <= enough) return;
      const double p = student_t_p(t, welch_dof(va, image_.passes, vb, reference_.passes));
      enough = std::min(limit, std::max(enough, std::abs(t)));
      part.rejected += p < sidak_alpha;
      if (part.largest_at >= 0 && p >= part.smallest_p) return;
      part.smallest_p = p;
      part.largest = t;
      part.largest_at = pixel;
    });
    return part;
  }

 private:
  static double variance(const LayerView& view, std::size_t channel, std::int64_t pixel) {
    return view.variance.empty() ? 0 : static_cast<double>(view.variance[channel][pixel]);
  }

  bool is_finite(std::int64_t i) const {
    for (const LayerView* view : {&reference_, &image_}) {
      for (const auto& plane : view->planes) {
        if (!std::isfinite(plane[i])) return false;
      }
    }
    return true;
  }

  const LayerView& reference_;
  const LayerView& image_;
  const Mask& mask_;
};

}  // namespace

NoiseTest test_noise(const LayerView& reference, const LayerView& image, const Mask& mask,
                     double alpha) {
  check_comparable(reference, image);
  const Tester tester(reference, image, mask);
  const auto pixels = static_cast<std::int64_t>(reference.pixels());
  std::vector<NoiseTest> parts(static_cast<std::size_t>((pixels + kChunk - 1) / kChunk));
  NoiseTest sum;
  sum.alpha = alpha;
  parallel_for_chunks(pixels, kChunk,
                      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
                        parts[chunk] = tester.count(begin, end);
                      });
  for (const NoiseTest& part : parts) {
    sum.tested += part.tested;
    sum.untested += part.untested;
  }
  if (sum.tested == 0) return sum;
  sum.sidak_alpha = sidak(alpha, static_cast<double>(sum.tested));
  parallel_for_chunks(pixels, kChunk,
                      [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
                        parts[chunk] = tester.test(begin, end, sum.sidak_alpha);
                      });
  for (const NoiseTest& part : parts) {
    sum.rejected += part.rejected;
    if (part.largest_at < 0 || (sum.largest_at >= 0 && part.smallest_p >= sum.smallest_p)) continue;
    sum.smallest_p = part.smallest_p;
    sum.largest = part.largest;
    sum.largest_at = part.largest_at;
  }
  return sum;
}

}  // namespace octolux
