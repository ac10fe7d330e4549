// The correction table: simulated again, and what is between its entries.
#include "estimators/octobox_table.h"

#include <gtest/gtest.h>

#include "tests/estimators/lookups.h"
#include "tests/stats.h"

namespace octolux {
namespace {

constexpr OctantUse kUses[] = {OctantUse::one, OctantUse::eight, OctantUse::automatic};

test::Running simulate(int photons, OctantUse use, int runs) {
  test::Running ratio;
  PlanePoints points;
  for (int run = 0; run < runs; ++run) {
    Rng rng(99, Stream::test, static_cast<std::uint64_t>(photons), static_cast<std::uint64_t>(run));
    points.resize(photons);
    for (int i = 0; i < photons;) {
      const float radius = std::sqrt(rng.uniform());
      const float angle = 2 * kPi * rng.uniform();
      points.set(i++, {radius * std::cos(angle), radius * std::sin(angle)}, true);
    }
    const Fit fit = fit_octobox(points, 1, use);
    ratio.add(fit.area > 0 ? fit.count / fit.area * kPi / static_cast<float>(photons) : 0);
  }
  return ratio;
}

const OctoBoxTableEntry& entry(int photons) {
  for (const OctoBoxTableEntry& e : octobox_table()) {
    if (e.photons == photons) return e;
  }
  throw std::out_of_range("no such entry");
}

TEST(OctoBoxTable, EntriesCanBeSimulatedAgain) {
  for (const int photons : {10, 20, 35, 50, 100, 320}) {
    for (const OctantUse use : kUses) {
      const test::Running ratio = simulate(photons, use, 1000000 / (photons * photons) + 4000);
      const auto column = static_cast<std::size_t>(octobox_column(use));
      const double error =
          std::hypot(entry(photons).standard_error[column], ratio.standard_error());
      const double z = (ratio.mean() - entry(photons).ratio[column]) / error;
      EXPECT_GT(test::z_test_p(z), test::sidak(test::kAlpha, 18))
          << photons << " column " << column << ": " << ratio.mean();
    }
  }
}

TEST(OctoBoxTable, IsSmoothAndTendsToOne) {
  for (const OctantUse use : kUses) {
    const auto column = static_cast<std::size_t>(octobox_column(use));
    for (const OctoBoxTableEntry& e : octobox_table()) {
      EXPECT_EQ(octobox_ratio(use, e.photons), e.ratio[column]);
    }
    for (int n = 10; n < 3000; ++n) {
      EXPECT_NEAR(octobox_ratio(use, n), octobox_ratio(use, n + 1), 2e-3) << n;
    }
    EXPECT_NEAR(octobox_ratio(use, 1000000), 1, 1e-6);
  }
}

TEST(OctoBoxTable, FewPhotonsAreTheDiscs) {
  for (const OctantUse use : kUses) {
    const std::vector<OctoBoxCorrection> table = make_octobox_corrections(use, 200);
    EXPECT_EQ(table[0].share, 0);
    EXPECT_EQ(table[3].share, 0);
    EXPECT_EQ(table[200].share, 1);
    EXPECT_EQ(table[3].cut_share, 0);
    EXPECT_EQ(table[18].cut_share, 1);
    for (std::size_t n = 1; n < table.size(); ++n) {
      EXPECT_GE(table[n].share, table[n - 1].share);
      EXPECT_GE(table[n].cut_share, table[n].share);
    }
  }
}

}  // namespace
}  // namespace octolux
