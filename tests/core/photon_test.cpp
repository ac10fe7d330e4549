// Packing photons: every error stays below the bound that follows from the bits spent.
#include "core/photon.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/rng.h"
#include "core/sampling.h"

namespace octolux {
namespace {

Rng rng_of(std::uint64_t index) { return Rng(20060131, Stream::test, 2, index); }

float error_of(Rgb a, Rgb b) {
  return std::max(std::abs(a.r - b.r), std::max(std::abs(a.g - b.g), std::abs(a.b - b.b)));
}

/// Channels spread over `octaves` octaves around 2^middle.
Rgb random_flux(Rng& rng, float middle, float octaves) {
  const float r = std::exp2(middle + octaves * (rng.uniform() - 0.5f));
  const float g = std::exp2(middle + octaves * (rng.uniform() - 0.5f));
  const float b = std::exp2(middle + octaves * (rng.uniform() - 0.5f));
  return {r, g, b};
}

// Half a step of an 18-bit mantissa whose top bit is set: 2^-18 of the largest channel at most.
TEST(PackFlux, ErrorIsHalfAStepOfTheLargestChannel) {
  for (int middle = -100; middle <= 100; ++middle) {
    Rng rng = rng_of(1000 + static_cast<std::uint64_t>(middle + 100));
    for (int i = 0; i < 1000; ++i) {
      const Rgb flux = random_flux(rng, static_cast<float>(middle), 6);
      const Rgb back = unpack_flux(pack_flux(flux));
      ASSERT_LE(error_of(flux, back), 0x1p-18f * max_component(flux)) << flux.r << " " << middle;
    }
  }
}

TEST(PackFlux, ScalesWithPowersOfTwo) {
  Rng rng = rng_of(1);
  for (int i = 0; i < 1000; ++i) {
    const Rgb flux = random_flux(rng, 0, 12);
    const Rgb back = unpack_flux(pack_flux(flux));
    for (const int power : {-80, -1, 1, 2, 60, 100}) {
      const float scale = std::ldexp(1.0f, power);
      ASSERT_EQ(unpack_flux(pack_flux(flux * scale)), back * scale);
    }
  }
}

TEST(PackFlux, PackingAgainChangesNothing) {
  Rng rng = rng_of(2);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t packed = pack_flux(random_flux(rng, 0, 30));
    ASSERT_EQ(pack_flux(unpack_flux(packed)), packed);
  }
}

TEST(PackFlux, ZeroAndExtremes) {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float denormal = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(unpack_flux(pack_flux(Rgb(0))), Rgb(0));
  EXPECT_EQ(unpack_flux(pack_flux(Rgb(denormal, 0, 5 * denormal))), Rgb(denormal, 0, 5 * denormal));
  EXPECT_EQ(unpack_flux(pack_flux(Rgb(0, 1, 0))), Rgb(0, 1, 0));
  const Rgb huge = unpack_flux(pack_flux(Rgb(largest, 1, 0)));
  EXPECT_TRUE(is_finite(huge));
  EXPECT_NEAR(huge.r / largest, 1, 0x1p-17);
  EXPECT_EQ(unpack_flux(pack_flux(Rgb(1e6f, 1e-6f, 0))), Rgb(1e6f, 0, 0));
}

// A grid step is 2 / (2^bits - 2); half of it in x and y moves the octahedron's point by at most
// sqrt(6) of that (z moves by both), seen from a distance of at least 1 / sqrt(3). Float adds a few
// units in the last place of 1.
float direction_bound(int bits) {
  return std::sqrt(18.0f) / (std::ldexp(1.0f, bits) - 2) + 8 * 0x1p-24f;
}

TEST(PackDirection, ErrorIsBelowTheGridsBound) {
  Rng rng = rng_of(3);
  for (int i = 0; i < 300000; ++i) {
    const Vec3 d = normalize(sample_sphere(rng.uniform2()));
    for (const int bits : {12, 16}) {
      const Vec3 back = unpack_direction(pack_direction(d, bits), bits);
      ASSERT_LE(length(back - d), direction_bound(bits)) << d.x << " " << d.y << " " << d.z;
      ASSERT_NEAR(length(back), 1, 4 * 0x1p-24);
    }
  }
}

TEST(PackDirection, AxesAreExactAndEdgesFinite) {
  for (const int bits : {12, 16}) {
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      EXPECT_EQ(unpack_direction(pack_direction(axis, bits), bits), axis);
      EXPECT_EQ(unpack_direction(pack_direction(-axis, bits), bits), -axis);
    }
    const float h = std::sqrt(0.5f);
    for (const Vec3 d : {Vec3{h, h, 0}, Vec3{-h, h, -0.0f}, Vec3{0, h, -h}, Vec3{-h, -0.0f, -h}}) {
      const Vec3 back = unpack_direction(pack_direction(d, bits), bits);
      EXPECT_LE(length(back - d), direction_bound(bits));
    }
    EXPECT_TRUE(is_finite(unpack_direction(pack_direction({0, 0, 0}, bits), bits)));
  }
}

TEST(PackPhoton, KeepsEachFieldApart) {
  Photon photon;
  photon.wi = {0, 1, 0};
  photon.normal = {-1, 0, 0};
  photon.flux = {4, 2, 1};
  for (const int n : {1, 2, kMaxSegments}) {
    photon.segments = n;
    const PhotonPayload p = pack(photon);
    EXPECT_EQ(segments(p), n);
    EXPECT_EQ(normal(p), photon.normal);
    EXPECT_EQ(wi(p), photon.wi);
    EXPECT_EQ(unpack_flux(p.flux), photon.flux);
  }
  photon.segments = 1000;
  EXPECT_EQ(segments(pack(photon)), kMaxSegments);
}

}  // namespace
}  // namespace octolux
