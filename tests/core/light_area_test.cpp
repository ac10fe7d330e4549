// Area lights: sample() against pdf_w(), against what rays see, and against closed forms.
#include <gtest/gtest.h>

#include "tests/core/light_cases.h"
#include "tests/stats.h"

namespace octolux {
namespace {

using namespace test;

constexpr int kDraws = 40000;

/// Mean over sample() of g(sample) / pdf_w.
template <typename G>
Running estimate(const Light& light, Vec3 x, int test, const G& g) {
  Running r;
  Rng rng(1, Stream::test, 60, test);
  for (int i = 0; i < kDraws; ++i) {
    const std::optional<LightSample> s = light.sample(x, rng.uniform2());
    r.add(s ? g(*s) / s->pdf_w : 0);
  }
  return r;
}

/// The same by rays in all directions.
template <typename G>
Running estimate_by_rays(const LitShape& lit, int test, const G& g) {
  Running r;
  Rng rng(1, Stream::test, 61, test);
  for (int i = 0; i < 4 * kDraws; ++i) {
    const Vec3 wi = sample_sphere(rng.uniform2());
    const std::optional<SurfacePoint> y = lit.seen(lit.x, wi);
    r.add(y ? g(wi, *y) / kUniformSpherePdfW : 0);
  }
  return r;
}

double difference_p(const Running& a, const Running& b) {
  return z_test_p((a.mean() - b.mean()) / std::sqrt(a.variance_of_mean() + b.variance_of_mean()));
}

TEST(AreaLight, SampleAgreesWithPdfAndRaysReachTheSamples) {
  for (const auto& lit : lit_shapes()) {
    Rng rng(1, Stream::test, 62, 0);
    int count = 0;
    for (int i = 0; i < 2000; ++i) {
      const std::optional<LightSample> s = lit->light->sample(lit->x, rng.uniform2());
      if (!s) continue;
      ++count;
      EXPECT_EQ(s->radiance, (Rgb{1, 2, 3}));
      EXPECT_NEAR(length(s->wi), 1, 4 * 0x1p-24f);
      EXPECT_FLOAT_EQ(lit->light->pdf_w(lit->x, s->at), s->pdf_w) << lit->name;
      const Vec3 to_y = s->at.position - lit->x;
      EXPECT_LE(length(cross(to_y, s->wi)), 2 * s->at.error) << lit->name;
      EXPECT_GT(dot(to_y, s->wi), 0);
      // A ray that way meets the light there: the error grows as it grazes.
      const std::optional<SurfacePoint> y = lit->seen(lit->x, s->wi);
      const float cosine = -dot(s->wi, s->at.ng);
      if (cosine < 0.01f) continue;
      ASSERT_TRUE(y) << lit->name;
      EXPECT_LE(length(y->position - s->at.position), 4 * s->at.error / cosine) << lit->name;
    }
    EXPECT_GT(count, 300) << lit->name;
  }
}

/// Cells of equal solid angle over all directions.
struct Cells {
  static constexpr int kRows = 8, kColumns = 16, kCount = kRows * kColumns;

  static int of(Vec3 w) {
    const float turn = std::atan2(w.y, w.x) / (2 * kPi) + 0.5f;
    const int row = std::min(kRows - 1, static_cast<int>((w.z + 1) / 2 * kRows));
    return row * kColumns + std::min(kColumns - 1, static_cast<int>(turn * kColumns));
  }
  /// (s, t) in [0, 1]^2 of cell `cell`.
  static Vec3 direction(int cell, double s, double t) {
    const double z = 2 * (cell / kColumns + t) / kRows - 1, r = std::sqrt(1 - z * z);
    const double phi = ((cell % kColumns + s) / kColumns * 2 - 1) * std::acos(-1.0);
    return {float(r * std::cos(phi)), float(r * std::sin(phi)), float(z)};
  }
};

struct Integral {
  double value = 0;
  int seen = 0;
};
/// Integral of pdf_w over a cell: midpoint rule over n x n rays.
Integral integrate_pdf(const LitShape& lit, int cell, int n) {
  Integral result;
  for (int i = 0; i < n * n; ++i) {
    const Vec3 wi = Cells::direction(cell, (i % n + 0.5) / n, (i / n + 0.5) / n);
    const std::optional<SurfacePoint> y = lit.seen(lit.x, wi);
    if (!y) continue;
    ++result.seen;
    result.value += lit.light->pdf_w(lit.x, *y) * 4 * kPi / (Cells::kCount * n * n);
  }
  return result;
}

TEST(AreaLight, DirectionsFollowPdfW) {
  constexpr int kSamples = 20000, kCoarse = 16, kFine = 160;
  int test = 0;
  for (const auto& lit : lit_shapes()) {
    // The last count is of samples that found nothing.
    std::vector<double> counts(Cells::kCount + 1, 0.0), expected(Cells::kCount + 1, 0.0);
    Rng rng(1, Stream::test, 63, test++);
    for (int i = 0; i < kSamples; ++i) {
      const std::optional<LightSample> s = lit->light->sample(lit->x, rng.uniform2());
      ++counts[s ? Cells::of(s->wi) : Cells::kCount];
    }
    double sum = 0;
    for (int cell = 0; cell < Cells::kCount; ++cell) {
      Integral pdf = integrate_pdf(*lit, cell, kCoarse);
      const bool edge = pdf.seen < kCoarse * kCoarse && (pdf.seen > 0 || counts[cell] > 0);
      if (edge) pdf = integrate_pdf(*lit, cell, kFine);  // the density jumps, or grows without end
      expected[cell] = kSamples * pdf.value;
      sum += expected[cell];
    }
    expected.back() = std::max(0.0, kSamples - sum);
    EXPECT_GT(chi2_test_p(counts, expected), sidak(kAlpha, 9)) << lit->name;
  }
}

TEST(AreaLight, SolidAngleAndIrradianceAgreeWithRays) {
  int test = 0;
  const double alpha = sidak(kAlpha, 18);
  for (const auto& lit : lit_shapes()) {
    const Running omega = estimate(*lit->light, lit->x, test, [](const LightSample&) { return 1; });
    const Running rays = estimate_by_rays(*lit, test, [](Vec3, const SurfacePoint&) { return 1; });
    EXPECT_GT(difference_p(omega, rays), alpha) << lit->name;
    // A tilted receiver that sees much of the light but not all.
    const Vec3 n = normalize(normalize(lit->toward - lit->x) + Vec3{0.5f, -0.5f, 0.3f});
    const Running e = estimate(*lit->light, lit->x, test, [n](const LightSample& s) {
      return s.radiance.g * std::max(0.0f, dot(n, s.wi));
    });
    const Running e_rays = estimate_by_rays(*lit, test, [n, &lit](Vec3 wi, const SurfacePoint& y) {
      return lit->light->radiance(y, -wi).g * std::max(0.0f, dot(n, wi));
    });
    EXPECT_GT(difference_p(e, e_rays), alpha) << lit->name;
    ++test;
  }
}

TEST(AreaLight, SampledByAreaPdfIntegratesToOneWhereAllOfItIsSeen) {
  // Inside a closed light, and in front of a flat one, every sample counts.
  const double alpha = sidak(kAlpha, 5);
  int test = 0;
  for (const auto& lit : lit_shapes()) {
    ++test;
    if (lit->name.find("outside") != std::string::npos) continue;
    if (lit->name.find("cylinder") != std::string::npos) continue;
    const Running total = estimate_by_rays(
        *lit, 20 + test, [&](Vec3, const SurfacePoint& y) { return lit->light->pdf_w(lit->x, y); });
    EXPECT_GT(z_test_p(total.z(1)), alpha) << lit->name;
  }
}

TEST(AreaLight, RectangleMatchesFormFactorAndSolidAngle) {
  // Above the middle of |x| <= a, |y| <= b: four corner rectangles (Howell, Siegel & Menguec 2010,
  // configuration B-3) and the solid angle of a pyramid.
  const double a = 1, b = 0.5, h = 0.7;
  const LitShape lit("", rectangle(1, 0.5f), {0, 0, 0.7f});
  const double x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  const double pi = std::acos(-1.0);
  const double form_factor = 4 / (2 * pi) * (x / p * std::atan(y / p) + y / q * std::atan(x / q));
  const double omega = 4 * std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
  const Running e = estimate(*lit.light, lit.x, 30, [](const LightSample& s) {
    return s.radiance.b * std::max(0.0f, -s.wi.z);
  });
  const Running o = estimate(*lit.light, lit.x, 31, [](const LightSample&) { return 1; });
  EXPECT_GT(z_test_p(e.z(3 * pi * form_factor)), sidak(kAlpha, 2));
  EXPECT_GT(z_test_p(o.z(omega)), sidak(kAlpha, 2));
}

TEST(AreaLight, DiskOnItsAxisMatchesClosedForms) {
  const double pi = std::acos(-1.0), radius = 2, h = 1.3;
  const Affine scaled = affine({2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0});
  const LitShape lit("", quadric(Quadric::Kind::disk, scaled), {0, 0, 1.3f});
  const double d2 = radius * radius + h * h;
  const Running e = estimate(*lit.light, lit.x, 32, [](const LightSample& s) {
    return s.radiance.r * std::max(0.0f, -s.wi.z);
  });
  const Running o = estimate(*lit.light, lit.x, 33, [](const LightSample&) { return 1; });
  EXPECT_GT(z_test_p(e.z(pi * radius * radius / d2)), sidak(kAlpha, 2));
  EXPECT_GT(z_test_p(o.z(2 * pi * (1 - h / std::sqrt(d2)))), sidak(kAlpha, 2));
}

TEST(AreaLight, SphereFromOutsideHasTheExactSolidAngleAtEveryDistance) {
  const double pi = std::acos(-1.0);
  for (const double r : {1e-3, 1.0, 50.0}) {
    const LitShape lit(
        "", quadric(Quadric::Kind::sphere, affine({r, 0, 0, 0, 0, r, 0, 0, 0, 0, r, 0})), {});
    for (const double gap : {1e-5, 1e-3, 0.1, 1.0, 100.0, 1e4, 1e6}) {
      const Vec3 x{0, 0, static_cast<float>(r * (1 + gap))};
      const double height = x.z - r, d = x.z;  // as the float has it
      const double cosine = std::sqrt(height * (d + r)) / d;
      const double omega = 2 * pi * (r / d) * (r / d) / (1 + cosine);
      Rng rng(1, Stream::test, 64, 0);
      for (int i = 0; i < 100; ++i) {
        const std::optional<LightSample> s = lit.light->sample(x, rng.uniform2());
        ASSERT_TRUE(s);
        EXPECT_NEAR(s->pdf_w * omega, 1, 0x1p-22) << r << " " << gap;
        EXPECT_LE(-s->wi.z, 1);
        // Inside the cone, up to the rounding of a float cosine.
        EXPECT_GE(-s->wi.z, cosine - 0x1p-23);
      }
    }
    // Irradiance pi L (r / d)^2, facing the sphere.
    const Vec3 x{0, 0, static_cast<float>(3 * r)};
    const Running e = estimate(*lit.light, x, 34, [](const LightSample& s) { return -s.wi.z; });
    EXPECT_GT(z_test_p(e.z(pi / 9)), sidak(kAlpha, 3));
  }
}

TEST(AreaLight, ClosedLightSeenFromInsideGivesPiLEverywhere) {
  for (const auto& lit : lit_shapes()) {
    if (lit->name != "sphere from inside" && lit->name != "ellipsoid from inside") continue;
    const Vec3 n = normalize({1, 2, -1});
    const Running e = estimate(*lit->light, lit->x, 35, [n](const LightSample& s) {
      return s.radiance.r * std::max(0.0f, dot(n, s.wi));
    });
    EXPECT_GT(z_test_p(e.z(std::acos(-1.0))), sidak(kAlpha, 2)) << lit->name;
  }
}

TEST(AreaLight, BackSideIsDark) {
  const LitShape flat("", rectangle(1, 1), {});
  Rng rng(1, Stream::test, 65, 0);
  for (const Vec3 x : {Vec3{0, 0, -1}, Vec3{0.2f, 0.1f, 0}, Vec3{3, 0, 0}, Vec3{3, 0, -1e-6f}}) {
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(flat.light->sample(x, rng.uniform2()));
  }
  const LitShape ball("", quadric(Quadric::Kind::sphere, Affine{}), {});
  for (const Vec3 x : {Vec3{0, 0, 0}, Vec3{0.3f, -0.9f, 0.1f}}) {
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(ball.light->sample(x, rng.uniform2()));
  }
  SurfacePoint y;
  y.ng = {0, 0, 1};
  EXPECT_EQ(flat.light->radiance(y, {0, 0, -1}), Rgb(0));
  EXPECT_EQ(flat.light->radiance(y, {1, 0, 0}), Rgb(0));
  EXPECT_EQ(flat.light->pdf_w({0, 0, -1}, y), 0);
}

TEST(AreaLight, NothingIsEverNan) {
  Rng rng(1, Stream::test, 66, 0);
  for (const auto& lit : lit_shapes()) {
    const auto check = [&](Vec3 x, Vec2 u) {
      const std::optional<LightSample> s = lit->light->sample(x, u);
      if (!s) return;
      EXPECT_TRUE(s->pdf_w > 0 && std::isfinite(s->pdf_w)) << lit->name;
      EXPECT_NEAR(length(s->wi), 1, 4 * 0x1p-24f) << lit->name;
      EXPECT_TRUE(is_finite(s->at.position) && is_finite(s->at.ng)) << lit->name;
      EXPECT_FALSE(std::isnan(lit->light->pdf_w(x, s->at))) << lit->name;
    };
    for (double distance = 1e-6; distance < 2e6; distance *= 10) {
      for (int i = 0; i < 200; ++i) {
        const Vec2 u = rng.uniform2();
        const Vec3 direction = sample_sphere(rng.uniform2());
        const EmittedPhoton on_it = lit->light->emit(rng.uniform2(), {0.5f, 0.5f});
        check(on_it.ray.origin + direction * static_cast<float>(distance), u);
        check(on_it.ray.origin, u);
      }
    }
    for (const float u : {0.0f, kOneMinusEpsilon}) {
      for (const float v : {0.0f, kOneMinusEpsilon}) {
        check(lit->x, {u, v});
        const EmittedPhoton photon = lit->light->emit({u, v}, {v, u});
        EXPECT_TRUE(is_finite(photon.flux) && is_finite(photon.ray.origin));
        EXPECT_NEAR(length(photon.ray.direction), 1, 4 * 0x1p-24f);
      }
    }
  }
}

TEST(AreaLight, WithoutAreaOrRadianceNothingHappens) {
  Shape needle;
  needle.geometry = TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {}, {}, {{0, 1, 2}}};
  Shape empty;
  empty.geometry = TriangleMesh{};
  const Shape ball = quadric(Quadric::Kind::sphere, Affine{}), square = rectangle(1, 1);
  const std::pair<const Shape*, Rgb> dark[] = {
      {&needle, Rgb(1)}, {&empty, Rgb(1)}, {&ball, Rgb(0)}, {&square, Rgb(0)}};
  for (const auto& [shape, radiance] : dark) {
    const std::unique_ptr<AreaLight> light = make_area_light(*shape, radiance);
    EXPECT_FALSE(light->sample({0, 0, 3}, {0.3f, 0.6f}));
    EXPECT_EQ(light->power(), Rgb(0));
    const EmittedPhoton photon = light->emit({0.3f, 0.6f}, {0.1f, 0.2f});
    EXPECT_EQ(photon.flux, Rgb(0));
    EXPECT_NEAR(length(photon.ray.direction), 1, 0x1p-22f);
    EXPECT_EQ(light->pdf_w({0, 0, 3}, SurfacePoint{}), 0);
  }
}

}  // namespace
}  // namespace octolux
