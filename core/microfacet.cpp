// Beckmann and GGX: density, Smith's masking, and sampling of visible normals; see microfacet.h.
#include "core/microfacet.h"

#include <cmath>

#include "core/constants.h"
#include "core/sampling.h"

namespace octolux {
namespace {

constexpr float kInvSqrtPi = 0.564189584f;

/// Inverse of the error function for x in (-1, 1): Giles, "Approximating the erfinv function", GPU
/// Computing Gems 2, 2011, single precision.
float erf_inverse(float x) {
  const float w = -std::log((1 - x) * (1 + x));
  if (w < 5) {
    const float t = w - 2.5f;
    float p = 2.81022636e-08f;
    for (const float c : {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f, 0.00021858087f,
                          -0.00125372503f, -0.00417768164f, 0.246640727f, 1.50140941f}) {
      p = c + p * t;
    }
    return p * x;
  }
  const float t = std::sqrt(w) - 3;
  float p = -0.000200214257f;
  for (const float c : {0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f,
                        -0.0076224613f, 0.00943887047f, 1.00167406f, 2.83297682f}) {
    p = c + p * t;
  }
  return p * x;
}

/// Argument of erf_inverse that keeps its result finite: |slope| < 3.9, a tail of 3e-8.
float inside_unit(float x) { return std::clamp(x, -0x1.fffffcp-1f, 0x1.fffffcp-1f); }

/// Slopes seen from a direction of cosine `c` in the x-z plane, alpha = 1. With x = erf(slope), the
/// CDF along x is (1 + x + tan / sqrt(pi) exp(-slope^2)) / its value at the largest visible slope,
/// cot: increasing and concave, so Newton's iteration closes in on the root from below.
Vec2 sample_beckmann_slopes(float c, Vec2 u) {
  const float s = std::sqrt(std::max(0.0f, 1 - c * c));
  const float slope_y = erf_inverse(inside_unit(2 * u.y - 1));
  const float t = kInvSqrtPi * s / c;
  const float cot = s > 0 ? c / s : kInfinity;
  const float x_max = std::erf(cot);
  const float target = u.x * (1 + x_max + t * std::exp(-cot * cot));
  // Exact for grazing view (Jakob 2014).
  float x = x_max - (1 + x_max) * std::erf(std::sqrt(-std::log(std::max(u.x, 0x1p-25f))));
  float slope = 0;
  for (int i = 0; i < 6; ++i) {
    x = std::min(inside_unit(x), x_max);
    slope = erf_inverse(inside_unit(x));
    const float error = 1 + x + t * std::exp(-slope * slope) - target;
    const float rate = 1 - slope * (s / c);
    if (!(rate > 0) || std::abs(error) <= 4 * 0x1p-23f * (1 + target)) break;  // rounding
    x -= error / rate;
  }
  return {slope, slope_y};
}

/// Normal seen from `w`, alpha = 1: a point of the projected unit hemisphere (Heitz 2018).
Vec3 sample_ggx_hemisphere(Vec3 w, Vec2 u) {
  const float s = std::sqrt(w.x * w.x + w.y * w.y);
  const Vec3 t1 = s > 0 ? Vec3{-w.y / s, w.x / s, 0} : Vec3{0, 1, 0};
  const Vec3 t2 = cross(w, t1);
  Vec2 p = sample_disk(u);
  const float blend = 0.5f * (1 + w.z);
  p.y = (1 - blend) * std::sqrt(std::max(0.0f, 1 - p.x * p.x)) + blend * p.y;
  const float z = std::sqrt(std::max(0.0f, 1 - p.x * p.x - p.y * p.y));
  return t1 * p.x + t2 * p.y + w * z;
}

}  // namespace

float Microfacet::d(Vec3 m) const {
  if (m.z <= 0) return 0;
  const float x = m.x / alpha_u_;
  const float y = m.y / alpha_v_;
  const float area = kPi * alpha_u_ * alpha_v_;
  const float c2 = m.z * m.z;
  if (kind_ == MicrofacetKind::ggx) {
    const float r = x * x + y * y + c2;
    return 1 / (area * r * r);
  }
  const float slope2 = (x * x + y * y) / c2;
  return slope2 < 80 ? std::exp(-slope2) / (area * c2 * c2) : 0;  // e^-80: nothing in float
}

float Microfacet::g1(Vec3 v, Vec3 m) const {
  if (dot(v, m) * v.z <= 0) return 0;  // a front seen from behind, or the reverse
  const float x = alpha_u_ * v.x;
  const float y = alpha_v_ * v.y;
  const float t2 = (x * x + y * y) / (v.z * v.z);
  if (kind_ == MicrofacetKind::ggx) return 2 / (1 + std::sqrt(1 + t2));
  if (t2 < 1.0f / 16) return 1;  // differs by less than 1e-9
  const float a = 1 / std::sqrt(t2);
  return 2 / (1 + std::erf(a) + kInvSqrtPi * std::exp(-a * a) / a);
}

float Microfacet::visible_pdf_w(Vec3 wo, Vec3 m) const {
  return d(m) * g1(wo, m) * std::abs(dot(wo, m)) / wo.z;
}

Vec3 Microfacet::sample_visible(Vec3 wo, Vec2 u) const {
  const Vec3 w = normalize({alpha_u_ * wo.x, alpha_v_ * wo.y, wo.z});
  if (kind_ == MicrofacetKind::ggx) {
    const Vec3 m = sample_ggx_hemisphere(w, u);
    return normalize({alpha_u_ * m.x, alpha_v_ * m.y, std::max(0.0f, m.z)});
  }
  const Vec2 slope = sample_beckmann_slopes(w.z, u);
  const float s = std::sqrt(w.x * w.x + w.y * w.y);
  const Vec2 phi = s > 0 ? Vec2{w.x / s, w.y / s} : Vec2{1, 0};
  const float slope_u = alpha_u_ * (phi.x * slope.x - phi.y * slope.y);
  const float slope_v = alpha_v_ * (phi.y * slope.x + phi.x * slope.y);
  return normalize({-slope_u, -slope_v, 1});
}

Microfacet::Reflection Microfacet::reflection(Vec3 wo, Vec3 wi) const {
  const Vec3 m = normalize(wo + wi);
  const float pdf_w = reflected_pdf_w(wo, m);
  return {pdf_w * g1(wi, m) / wi.z, pdf_w, dot(wo, m)};
}

}  // namespace octolux
