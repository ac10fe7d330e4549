// Discrete distributions: choose one of n things with probability proportional to its weight, by
// inverting the cumulative sum (inversion keeps strata of u together). A table says where to start
// looking in the sum (Chen & Asau, "On generating random variates from an empirical distribution",
// AIIE Transactions 6(2), 1974), so a draw costs the same however many things there are. The random
// number is given back, stretched to [0, 1) again, so that one draw may both choose a thing and a
// place in it.
//
// Sums are kept in double: with 10^6 weights a float sum would lose the small ones. A weight of
// zero is never chosen. Immutable after construction, so thread-safe.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.h"

namespace octolux {

class Distribution1D {
 public:
  Distribution1D() = default;
  /// Weights must be finite and not negative; all may be zero, or there may be none.
  explicit Distribution1D(std::span<const double> weights);

  struct Sample {
    int index = 0;
    float pmf = 0;  // 0 only if all weights are 0: nothing was chosen
    float u = 0;    // uniform in [0, 1), given the index
  };
  /// `u` uniform in [0, 1). O(1) in the mean.
  Sample sample(float u) const;

  float pmf(int index) const;
  int size() const { return cdf_.empty() ? 0 : static_cast<int>(cdf_.size()) - 1; }
  /// Sum of the weights.
  double total() const { return total_; }

 private:
  std::vector<double> cdf_;           // n + 1 values from 0 to 1; all 0 if every weight is 0
  std::vector<std::uint32_t> start_;  // where u in [k / n, (k + 1) / n) starts looking
  double total_ = 0;
};

/// On a grid: the row by the rows' sums, then the column by the weights in that row.
class Distribution2D {
 public:
  Distribution2D() = default;
  /// `weights` row by row, width * height of them.
  Distribution2D(std::span<const double> weights, int width, int height);

  struct Sample {
    int x = 0, y = 0;
    float pmf = 0;
    Vec2 u;  // uniform in [0, 1)^2, given the cell
  };
  /// u.y chooses the row, u.x the column.
  Sample sample(Vec2 u) const;

  float pmf(int x, int y) const { return rows_.pmf(y) * columns_[y].pmf(x); }
  double total() const { return rows_.total(); }

 private:
  Distribution1D rows_;
  std::vector<Distribution1D> columns_;  // per row
};

}  // namespace octolux
