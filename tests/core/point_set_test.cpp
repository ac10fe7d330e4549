// core/point_set.h: sequences are evenly spread at every length, whatever their scrambling; each
// point is uniform over scramblings; and two sequences are paired as if by chance.
#include "core/point_set.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/stats.h"

namespace octolux::test {
namespace {

constexpr int kKeys = 40000;
constexpr std::size_t kSide = 8;  // cells of a grid, per axis

std::size_t cell(float u) { return static_cast<std::size_t>(u * kSide); }
std::size_t cell(Vec2 u) { return cell(u.y) * kSide + cell(u.x); }

/// Are `counts` uniform?
double uniform_p(const std::vector<double>& counts, double total) {
  return chi2_test_p(
      counts, std::vector<double>(counts.size(), total / static_cast<double>(counts.size())));
}

TEST(PixelSequence, EveryAlignedBlockHasOnePointInEachElementaryInterval) {
  for (std::uint64_t key = 0; key < 20; ++key) {
    for (int digits = 0; digits <= 8; ++digits) {
      const int size = 1 << digits;
      for (int block = 0; block < 4; ++block) {
        const PixelSequence sequence(key, 3, static_cast<std::uint64_t>(block));
        const PointSet points = sequence.points(PixelUse::gather, 1, size);
        for (int across = 0; across <= digits; ++across) {
          const int columns = 1 << across;
          const int rows = size / columns;
          std::vector<bool> met(static_cast<std::size_t>(size));
          for (int i = 0; i < size; ++i) {
            const int column = static_cast<int>(points[i].x * static_cast<float>(columns));
            const int row = static_cast<int>(points[i].y * static_cast<float>(rows));
            met[static_cast<std::size_t>(row * columns + column)] = true;
          }
          EXPECT_EQ(std::count(met.begin(), met.end(), true), size)
              << size << " points in " << columns << " columns, key " << key;
        }
      }
    }
  }
}

TEST(PixelSequence, PartsShareOutTheSequence) {
  constexpr int kParts = 4, kNumbers = 8, kPoints = 2;
  const PointSet all =
      PixelSequence(1, 3, 0).points(PixelUse::gather, 2, kParts * kNumbers * kPoints);
  for (int number = 0; number < kNumbers; ++number) {
    const PixelSequence whole(1, 3, static_cast<std::uint64_t>(number));
    for (int part = 0; part < kParts; ++part) {
      const PointSet points = whole.part(part, kParts).points(PixelUse::gather, 2, kPoints);
      for (int i = 0; i < kPoints; ++i) {
        const Vec2 expected = all[(number * kParts + part) * kPoints + i];
        EXPECT_EQ(points[i].x, expected.x);
        EXPECT_EQ(points[i].y, expected.y);
      }
    }
  }
}

TEST(PixelSequence, EachPointIsUniform) {
  for (const int i : {0, 1, 5, 1000}) {
    std::vector<double> counts(kSide * kSide);
    for (std::uint64_t pixel = 0; pixel < kKeys; ++pixel) {
      ++counts[cell(PixelSequence(1, pixel, 0).points(PixelUse::gather, 2, 8)[i])];
    }
    EXPECT_GT(uniform_p(counts, kKeys), sidak(kAlpha, 4)) << "point " << i;
  }
}

TEST(PixelSequence, UsesAndPixelsArePairedAsIfByChance) {
  for (int pair = 0; pair < 4; ++pair) {
    std::vector<double> uses(kSide * kSide), pixels(kSide * kSide);
    for (std::uint64_t pixel = 0; pixel < kKeys; ++pixel) {
      const PixelSequence here(1, pixel, 3);
      const Vec2 a = here.points(PixelUse::gather, 0, 1)[0];
      const Vec2 b = here.points(PixelUse::specular_lobe, 0, 1)[0];
      const Vec2 c = PixelSequence(1, pixel + 1, 3).points(PixelUse::gather, 0, 1)[0];
      const float first = pair / 2 == 0 ? a.x : a.y;
      ++uses[cell(first) * kSide + cell(pair % 2 == 0 ? b.x : b.y)];
      ++pixels[cell(first) * kSide + cell(pair % 2 == 0 ? c.x : c.y)];
    }
    EXPECT_GT(uniform_p(uses, kKeys), sidak(kAlpha, 8)) << "pair " << pair;
    EXPECT_GT(uniform_p(pixels, kKeys), sidak(kAlpha, 8)) << "pair " << pair;
  }
}

TEST(PixelSequence, OneSequenceIsNotAFunctionOfAnother) {
  // Of one pixel, the points of two uses fill the square of their x in the long run: scrambled in
  // digits but not in order, each strip of one would always meet the same strips of the other.
  std::vector<double> counts(kSide * kSide);
  for (std::uint64_t number = 0; number < kKeys; ++number) {
    const PixelSequence sequence(1, 9, number);
    const Vec2 a = sequence.points(PixelUse::gather, 0, 1)[0];
    const Vec2 b = sequence.points(PixelUse::gather, 1, 1)[0];
    ++counts[cell(a.x) * kSide + cell(b.x)];
  }
  for (const double count : counts) EXPECT_NEAR(count, kKeys / 64.0, kKeys / 64.0 / 2);
}

TEST(PointSet, GoesOnWhereTheSampleBeforeEnded) {
  const PointSet both = PixelSequence(4, 2, 0).points(PixelUse::gather, 5, 16);
  for (int sample = 0; sample < 2; ++sample) {
    const PointSet own =
        PixelSequence(4, 2, static_cast<std::uint64_t>(sample)).points(PixelUse::gather, 5, 8);
    for (int i = 0; i < 8; ++i) {
      EXPECT_EQ(own[i].x, both[8 * sample + i].x);
      EXPECT_EQ(own[i].y, both[8 * sample + i].y);
    }
  }
}

}  // namespace
}  // namespace octolux::test
