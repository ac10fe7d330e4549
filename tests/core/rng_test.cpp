// Random numbers: uniform, and independent between neighbouring keys, because photons and pixels
// are neighbours.
#include "core/rng.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

double uniformity_p(const std::vector<double>& counts) {
  double n = 0;
  for (const double c : counts) n += c;
  return chi2_test_p(counts, std::vector<double>(counts.size(), n / counts.size()));
}

/// Deviate of the correlation of pairs of uniforms: (x - 1/2)(y - 1/2) has variance 1/144.
class Correlation {
 public:
  void add(double x, double y) { sum_ += (x - 0.5) * (y - 0.5), ++n_; }
  double p() const { return z_test_p(sum_ * 12 / std::sqrt(n_)); }

 private:
  double sum_ = 0, n_ = 0;
};

TEST(Rng, SameKeySameNumbersOtherKeyOthers) {
  Rng a(7, Stream::test, 3, 5), b(7, Stream::test, 3, 5);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(a.next(), b.next());
  std::set<std::uint32_t> first;
  first.insert(Rng(7, Stream::test, 3, 5).next());
  first.insert(Rng(8, Stream::test, 3, 5).next());
  first.insert(Rng(7, Stream::eye, 3, 5).next());
  first.insert(Rng(7, Stream::test, 5, 3).next());
  first.insert(Rng(7, Stream::test, 3, 6).next());
  EXPECT_EQ(first.size(), 5u);
}

TEST(Rng, UniformIsInHalfOpenUnitInterval) {
  // The largest 32 bits would give the largest float below 1; no draw can be more.
  static_assert(static_cast<float>(0xffffffffu >> 8) * 0x1p-24f < 1);
  Rng rng(1, Stream::test, 0, 0);
  for (int i = 0; i < 1000000; ++i) {
    const float u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
  }
}

TEST(Rng, EveryByteIsUniformWithinAndAcrossSequences) {
  constexpr int kDraws = 100000;
  const double alpha = sidak(kAlpha, 8);
  for (int byte = 0; byte < 4; ++byte) {
    std::vector<double> within(256, 0.0), across(256, 0.0);
    Rng rng(2, Stream::test, 0, 0);
    for (int i = 0; i < kDraws; ++i) {
      ++within[(rng.next() >> (8 * byte)) & 255];
      ++across[(Rng(2, Stream::test, 0, i).next() >> (8 * byte)) & 255];
    }
    EXPECT_GT(uniformity_p(within), alpha) << byte;
    EXPECT_GT(uniformity_p(across), alpha) << byte;
  }
}

TEST(Rng, PairsFillTheSquareEvenly) {
  constexpr int kDraws = 200000, kGrid = 32;
  std::vector<double> serial(kGrid * kGrid, 0.0), first_draws(kGrid * kGrid, 0.0);
  Rng rng(3, Stream::test, 0, 0);
  const auto cell = [](Vec2 u) { return int(u.y * kGrid) * kGrid + int(u.x * kGrid); };
  for (int i = 0; i < kDraws; ++i) {
    ++serial[cell(rng.uniform2())];
    ++first_draws[cell(Rng(3, Stream::test, 1, i).uniform2())];
  }
  EXPECT_GT(uniformity_p(serial), sidak(kAlpha, 2));
  EXPECT_GT(uniformity_p(first_draws), sidak(kAlpha, 2));
}

TEST(Rng, NeighbouringKeysAreUncorrelated) {
  constexpr int kKeys = 20000, kDepth = 8;
  const double alpha = sidak(kAlpha, 3 * kDepth);
  std::vector<Correlation> index(kDepth), pass(kDepth), seed(kDepth);
  for (int i = 0; i < kKeys; ++i) {
    Rng here(i, Stream::test, 2 * i, 4 * i);
    Rng next_index(i, Stream::test, 2 * i, 4 * i + 1);
    Rng next_pass(i, Stream::test, 2 * i + 1, 4 * i);
    Rng next_seed(i + 1000000, Stream::test, 2 * i, 4 * i);
    for (int d = 0; d < kDepth; ++d) {
      const float u = here.uniform();
      index[d].add(u, next_index.uniform());
      pass[d].add(u, next_pass.uniform());
      seed[d].add(u, next_seed.uniform());
    }
  }
  for (int d = 0; d < kDepth; ++d) {
    EXPECT_GT(index[d].p(), alpha) << d;
    EXPECT_GT(pass[d].p(), alpha) << d;
    EXPECT_GT(seed[d].p(), alpha) << d;
  }
}

TEST(Rng, NeighbouringKeysAreJointlyUniform) {
  // Dependence that no correlation shows: PCG sequences whose states differ by a constant, as keys
  // without a hash would make them, fill this grid unevenly.
  constexpr int kKeys = 200000, kDepth = 4, kGrid = 64;
  std::vector<std::vector<double>> cells(kDepth, std::vector<double>(kGrid * kGrid, 0.0));
  for (int i = 0; i < kKeys; ++i) {
    Rng here(6, Stream::test, 0, 2 * i), next(6, Stream::test, 0, 2 * i + 1);
    for (int d = 0; d < kDepth; ++d) {
      const int row = static_cast<int>(here.uniform() * kGrid);
      ++cells[d][row * kGrid + static_cast<int>(next.uniform() * kGrid)];
    }
  }
  for (int d = 0; d < kDepth; ++d) EXPECT_GT(uniformity_p(cells[d]), sidak(kAlpha, kDepth)) << d;
}

TEST(Rng, CorrelationTestSeesRelatedSequences) {
  Correlation related;  // one part in ten in common
  for (int i = 0; i < 20000; ++i) {
    Rng a(4, Stream::test, 0, i), b(4, Stream::test, 1, i);
    const float common = a.uniform();
    related.add(common, 0.1f * common + 0.9f * b.uniform());
  }
  EXPECT_LT(related.p(), 1e-9);
}

TEST(Rng, SequencesOfNeighbouringKeysDoNotOverlap) {
  std::vector<std::uint64_t> windows;  // 64 consecutive bits, at any lag
  for (int i = 0; i < 1000; ++i) {
    Rng rng(5, Stream::test, 0, i);
    std::uint64_t last = rng.next();
    for (int d = 0; d < 64; ++d) {
      const std::uint64_t now = rng.next();
      windows.push_back(last << 32 | now);
      last = now;
    }
  }
  // 64 000 windows of 64 random bits coincide with probability 1e-10.
  std::sort(windows.begin(), windows.end());
  EXPECT_EQ(std::adjacent_find(windows.begin(), windows.end()), windows.end());
}

}  // namespace
}  // namespace octolux
