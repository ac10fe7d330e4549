// The gate by itself, on numbers whose distribution is known: it lets pass what only differs by
// noise, and what is within the allowance; it stops what is beyond.
#include "tests/regression/gate.h"

#include <gtest/gtest.h>

#include "core/rng.h"

namespace octolux::test {
namespace {

constexpr int kSide = 32;
constexpr float kNoise = 0.05f;  // of a pixel of a batch

/// Batches of pixels of mean `level`, with noise that half of a tile's pixels share.
Batches make_batches(float level, std::uint64_t seed) {
  Batches batches{{}, Image(kSide, kSide), Image(kSide, kSide), 0};
  for (int b = 0; b < kBatches; ++b) {
    Rng rng(seed, Stream::test, 0, static_cast<std::uint64_t>(b));
    Image& image = batches.radiance.emplace_back(kSide, kSide);
    for (std::size_t i = 0; i < image.pixels.size(); i += 2) {
      const float v = level + kNoise * (rng.uniform() - 0.5f);
      image.pixels[i] = image.pixels[i + 1] = Rgb(v);
    }
  }
  return batches;
}

Allowed allow(float low, float high) {
  Allowed allowed{Image(kSide, kSide), Image(kSide, kSide), Image(kSide, kSide), {}};
  for (std::size_t i = 0; i < allowed.low.pixels.size(); ++i) {
    allowed.low.pixels[i] = Rgb(low);
    allowed.high.pixels[i] = Rgb(high);
    allowed.counts.push_back(1);
  }
  return allowed;
}

/// Standard error of the whole picture's mean, seen over the batches.
float standard_error() {
  const float pairs = kSide * kSide / 2.0f;
  return kNoise / std::sqrt(12.0f * pairs * kBatches);
}

TEST(RegressionGate, PassesNoise) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const GateResult result = check_gate(make_batches(1, seed), allow(1, 1));
    EXPECT_TRUE(result.passed()) << seed << ": " << result.worst;
    EXPECT_EQ(result.tests, 6 * (16 + 1));
  }
}

TEST(RegressionGate, StopsWhatIsBeyondTheNoise) {
  const float step = 12 * standard_error();
  EXPECT_FALSE(check_gate(make_batches(1 + step, 1), allow(1, 1)).passed());
  EXPECT_FALSE(check_gate(make_batches(1 - step, 1), allow(1, 1)).passed());
}

TEST(RegressionGate, AllowsStatedBiasAndNoMore) {
  const float step = 12 * standard_error();
  EXPECT_TRUE(check_gate(make_batches(1.1f, 1), allow(0.8f, 1.2f)).passed());
  EXPECT_TRUE(check_gate(make_batches(1.2f, 1), allow(0.8f, 1.2f)).passed());
  EXPECT_FALSE(check_gate(make_batches(1.2f + step, 1), allow(0.8f, 1.2f)).passed());
}

TEST(RegressionGate, SeesOneTile) {
  Batches batches = make_batches(1, 1);
  for (Image& image : batches.radiance) {
    for (int y = 8; y < 16; ++y) {
      for (int x = 16; x < 24; ++x) image.at(x, y) = image.at(x, y) * 1.02f;
    }
  }
  const GateResult result = check_gate(batches, allow(1, 1));
  EXPECT_FALSE(result.passed());
  EXPECT_EQ(result.worst.rfind("tile at 16,8", 0), 0u) << result.worst;
}

TEST(RegressionGate, AReferencesNoiseCounts) {
  Allowed allowed = allow(1, 1);
  const float step = 12 * standard_error();
  for (Rgb& v : allowed.variance.pixels) v = Rgb(step * step * kSide * kSide);
  EXPECT_TRUE(check_gate(make_batches(1 + step, 1), allowed).passed());
}

TEST(RegressionGate, NothingToTestIsNoPass) {
  Allowed allowed = allow(1, 1);
  allowed.counts.assign(allowed.counts.size(), 0);
  EXPECT_FALSE(check_gate(make_batches(1, 1), allowed).passed());
}

}  // namespace
}  // namespace octolux::test
