// Fresnel's equations against closed forms and complex arithmetic in double.
#include <gtest/gtest.h>

#include <complex>
#include <limits>

#include "core/fresnel.h"

namespace octolux {
namespace {

constexpr double kUlp = std::numeric_limits<float>::epsilon();

TEST(FresnelDielectric, NormalIncidence) {
  for (const float eta : {1.1f, 1.5f, 2.4f, 1 / 1.5f}) {
    const double r = std::pow((double(eta) - 1) / (double(eta) + 1), 2);
    EXPECT_NEAR(fresnel_dielectric(1, eta).reflectance, r, 8 * kUlp);
    EXPECT_NEAR(fresnel_dielectric(-1, eta).reflectance, r, 8 * kUlp);
  }
}

TEST(FresnelDielectric, BrewsterAngleReflectsOnePolarisation) {
  for (const double eta : {1.33, 1.5, 2.4}) {
    const double c = 1 / std::sqrt(1 + eta * eta);
    const double rs = (eta * eta - 1) / (eta * eta + 1);
    EXPECT_NEAR(fresnel_dielectric(float(c), float(eta)).reflectance, rs * rs / 2, 16 * kUlp);
  }
}

TEST(FresnelDielectric, TotalReflectionBeyondTheCriticalAngle) {
  const float eta = 1.5f;
  const double critical = std::sqrt(1 - 1 / (1.5 * 1.5));
  EXPECT_EQ(fresnel_dielectric(float(-critical * 0.999), eta).reflectance, 1);
  EXPECT_LT(fresnel_dielectric(float(-critical * 1.001), eta).reflectance, 1);
  EXPECT_NEAR(fresnel_dielectric(0, eta).reflectance, 1, 8 * kUlp);
}

TEST(FresnelDielectric, IsTheSameAlongTheRefractedPath) {
  for (const float eta : {1.2f, 1.5f, 0.6f}) {
    for (float c = 0.05f; c < 1; c += 0.05f) {
      const DielectricFresnel forth = fresnel_dielectric(c, eta);
      if (forth.reflectance == 1) continue;
      EXPECT_LT(forth.cos_refracted, 0);
      const DielectricFresnel back = fresnel_dielectric(forth.cos_refracted, eta);
      // cos_refracted is a square root: its error grows as it shrinks.
      const double tolerance = 32 * kUlp / (forth.cos_refracted * forth.cos_refracted * c);
      EXPECT_NEAR(forth.reflectance, back.reflectance, tolerance);
      EXPECT_NEAR(-back.cos_refracted, -c, tolerance);
      EXPECT_FLOAT_EQ(forth.eta * back.eta, 1);
    }
  }
}

TEST(FresnelDielectric, EqualIndicesDoNothing) {
  for (const float c : {1.0f, 0.5f, 0.01f, -0.3f}) {
    const DielectricFresnel f = fresnel_dielectric(c, 1);
    EXPECT_NEAR(f.reflectance, 0, 1e-6);
    EXPECT_NEAR(f.cos_refracted, -c, 1e-5);
  }
}

TEST(FresnelDielectric, RefractionObeysSnell) {
  const Vec3 w = normalize({0.3f, -0.5f, 0.4f});
  const Vec3 m = normalize({0.1f, 0.2f, 0.9f});
  const DielectricFresnel f = fresnel_dielectric(dot(w, m), 1.5f);
  const Vec3 t = refract(w, m, f);
  EXPECT_NEAR(length(t), 1, 8 * kUlp);
  EXPECT_NEAR(length(cross(w, m)), 1.5f * length(cross(t, m)), 8 * kUlp);
  EXPECT_NEAR(dot(t, cross(w, m)), 0, 8 * kUlp);
  EXPECT_LT(dot(t, m) * dot(w, m), 0);
}

/// The textbook formula with a complex index.
double conductor(double c, std::complex<double> index) {
  const std::complex<double> ct = std::sqrt(1.0 - (1 - c * c) / (index * index));
  const std::complex<double> s = (c - index * ct) / (c + index * ct);
  const std::complex<double> p = (ct - index * c) / (ct + index * c);
  return 0.5 * (std::norm(s) + std::norm(p));
}

TEST(FresnelConductor, EqualsTheComplexFormula) {
  for (const double eta : {0.05, 0.2, 1.0, 4.4, 7.4}) {
    for (const double k : {0.1, 1.0, 3.9, 9.2}) {
      // a^2 is a difference of terms of size eta^2 + k^2 + 1; R changes by about 2 da / a_scale.
      const double size = eta * eta + k * k + 1;
      const double tolerance = 16 * kUlp * (1 + size / (eta * k));
      for (double c = 0.01; c <= 1; c += 0.03) {
        EXPECT_NEAR(fresnel_conductor(float(c), float(eta), float(k)), conductor(c, {eta, k}),
                    tolerance)
            << eta << " " << k << " " << c;
      }
    }
  }
}

TEST(FresnelConductor, WithoutExtinctionIsADielectric) {
  for (float c = 0.05f; c < 1; c += 0.05f) {
    EXPECT_NEAR(fresnel_conductor(c, 1.5f, 0), fresnel_dielectric(c, 1.5f).reflectance, 64 * kUlp);
  }
}

TEST(FresnelConductor, NoneIsAPerfectMirror) {
  for (float c = 0; c <= 1; c += 0.125f) EXPECT_EQ(fresnel_conductor(c, 0, 1), 1);
}

TEST(FresnelDiffuse, FitsTheIntegral) {
  for (const float eta : {1.1f, 1.33f, 1.49f, 1.9f}) {
    for (const bool inside : {false, true}) {
      constexpr int kSteps = 200000;
      double sum = 0;
      for (int i = 0; i < kSteps; ++i) {
        const double c = (i + 0.5) / kSteps;
        sum += 2 * c * fresnel_dielectric(float(inside ? -c : c), eta).reflectance / kSteps;
      }
      // Errors the authors of the fits state.
      EXPECT_NEAR(fresnel_diffuse_reflectance(inside ? 1 / eta : eta) / sum, 1, 0.006) << eta;
    }
  }
}

TEST(FresnelSchlick, Limits) {
  EXPECT_EQ(schlick_weight(1), 0);
  EXPECT_EQ(schlick_weight(0), 1);
  EXPECT_FLOAT_EQ(schlick_weight(0.5f), 1.0f / 32);
}

}  // namespace
}  // namespace octolux
