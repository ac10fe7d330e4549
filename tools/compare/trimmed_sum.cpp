// sum_without_largest of metrics.h: finds where the largest begin by radix selection (floats that
// are not negative sort like their bits), 16 bits at a time, then sums what lies below.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>

#include "core/parallel.h"
#include "tools/compare/metrics.h"

namespace octolux {
namespace {

constexpr std::int64_t kChunk = 1 << 20;
constexpr std::uint32_t kHalf = 1 << 16;  // values of 16 bits

/// Runs body(chunk, its errors) over all chunks; returns what the bodies returned.
template <class Result, class Body>
std::vector<Result> map_chunks(std::span<const float> errors, const Body& body) {
  const auto count = static_cast<std::int64_t>(errors.size());
  std::vector<Result> results(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  parallel_for_chunks(count, kChunk, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
    results[chunk] = body(errors.subspan(begin, end - begin));
  });
  return results;
}

using Histogram = std::vector<std::int64_t>;

/// Counts by half(bits), a number below 2^16; larger numbers are left out.
template <class Half>
Histogram histogram(std::span<const float> errors, const Half& half) {
  const auto parts = map_chunks<Histogram>(errors, [&](std::span<const float> part) {
    Histogram h(kHalf);
    for (const float e : part) {
      const std::uint32_t bin = half(std::bit_cast<std::uint32_t>(e));
      if (bin < kHalf) ++h[bin];
    }
    return h;
  });
  Histogram sum(kHalf);
  for (const Histogram& part : parts) {
    std::transform(sum.begin(), sum.end(), part.begin(), sum.begin(), std::plus<>());
  }
  return sum;
}

/// The bin that holds the `rank`-th largest, rank from 1; `rank` becomes its place within the bin.
std::uint32_t find_bin(const Histogram& histogram, std::int64_t& rank) {
  std::uint32_t bin = kHalf - 1;
  while (histogram[bin] < rank) rank -= histogram[bin--];
  return bin;
}

/// The `rank`-th largest of errors; `rank` becomes the number of those equal to it, up to it.
float nth_largest(std::span<const float> errors, std::int64_t& rank) {
  const std::uint32_t high =
      find_bin(histogram(errors, [](std::uint32_t bits) { return bits >> 16; }), rank);
  const std::uint32_t low = find_bin(
      histogram(errors,
                [&](std::uint32_t bits) { return bits >> 16 == high ? bits & 0xffff : kHalf; }),
      rank);
  return std::bit_cast<float>(high << 16 | low);
}

}  // namespace

double sum_without_largest(std::span<const float> errors, std::int64_t dropped) {
  float limit = 0;
  std::int64_t dropped_at_limit = dropped;
  if (dropped > 0) limit = nth_largest(errors, dropped_at_limit);
  struct Part {
    double below = 0;
    std::int64_t at_limit = 0;
  };
  const auto parts = map_chunks<Part>(errors, [&](std::span<const float> part) {
    Part p;
    for (const float e : part) {
      p.below += dropped == 0 || e < limit ? static_cast<double>(e) : 0.0;
      p.at_limit += e == limit;
    }
    return p;
  });
  double sum = 0;
  std::int64_t kept_at_limit = -dropped_at_limit;
  for (const Part& p : parts) {
    sum += p.below;
    kept_at_limit += p.at_limit;
  }
  if (dropped == 0) return sum;
  return sum + static_cast<double>(kept_at_limit) * static_cast<double>(limit);
}

}  // namespace octolux
