// What the BSDF tests share: one of each kind of BSDF with names, directions to try, and accurate
// integrals of a density over cells of the sphere.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/bsdf_adapters.h"
#include "core/bsdf_makers.h"
#include "core/rng.h"

namespace octolux::test {

/// A BSDF and those it refers to.
struct Built {
  std::vector<std::unique_ptr<Bsdf>> parts;
  std::unique_ptr<Bsdf> bsdf;
  std::vector<std::unique_ptr<Texture>> textures;
};

struct BsdfCase {
  std::string name;
  std::function<Built()> build;
  bool two_faced = false;  // does it scatter light that comes from behind?
  float alpha = 1;         // roughness of its sharpest microfacet lobe; 1 if there is none
  bool partial = false;    // may samples end below the surface although it has no microfacets?

  bool has_microfacets() const { return alpha < 1; }
  /// Relative change of D over change of the half vector: 2 slope / alpha^2, slope < 4 alpha.
  double d_sensitivity() const { return 1 + 8 / static_cast<double>(alpha); }
};

inline Built single(std::unique_ptr<Bsdf> bsdf) { return {{}, std::move(bsdf), {}}; }

inline Built two_sided(std::unique_ptr<Bsdf> front, std::unique_ptr<Bsdf> back) {
  Built built;
  built.bsdf = make_two_sided(*front, *back);
  built.parts.push_back(std::move(front));
  built.parts.push_back(std::move(back));
  return built;
}

inline Built masked(std::unique_ptr<Bsdf> inner, Color opacity) {
  Built built;
  built.bsdf = make_mask(*inner, opacity);
  built.parts.push_back(std::move(inner));
  return built;
}

/// Kinds that hold or add up others; see layered_cases in bsdf_layers.h.
inline std::vector<BsdfCase> layered_cases(bool white);

/// One of everything; reflectances are below one unless `white`, then nothing is absorbed on
/// purpose.
inline std::vector<BsdfCase> plain_cases(bool white) {
  const Rgb colour = white ? Rgb(1) : Rgb(0.2f, 0.5f, 0.8f);
  const Rgb tint = white ? Rgb(1) : Rgb(0.9f, 0.8f, 0.6f);
  const Rgb ks = white ? Rgb(1, 0.5f, 0.04f) : Rgb(0.04f, 0.2f, 0.4f);
  const DielectricConfig glass{1.5f, tint, tint};
  const DielectricConfig bubble{1 / 1.33f, tint, tint};
  const ConductorConfig metal{white ? Rgb(0) : Rgb(0.2f, 0.9f, 1.1f),
                              white ? Rgb(1) : Rgb(3.9f, 2.5f, 2.1f), tint};
  const PlasticConfig plastic{1.49f, colour, tint, false};
  const PlasticConfig nonlinear{1.9f, colour, tint, true};
  constexpr auto kBeckmann = MicrofacetKind::beckmann;
  constexpr auto kGgx = MicrofacetKind::ggx;
  using std::move;
  return {
      {"diffuse", [=] { return single(make_diffuse(colour)); }},
      {"rough_diffuse",
       [=] {
         return single(make_rough_diffuse({colour * 0.95f, 0.3f}));
       }},
      {"rough_diffuse_qualitative",
       [=] {
         return single(make_rough_diffuse({colour, 0.7f, true}));
       }},
      {"dielectric", [=] { return single(make_dielectric(glass)); }, true},
      {"dielectric_bubble", [=] { return single(make_dielectric(bubble)); }, true},
      {"thin_dielectric", [=] { return single(make_thin_dielectric(glass)); }, true},
      {"conductor", [=] { return single(make_conductor(metal)); }},
      {"rough_conductor_beckmann",
       [=] {
         return single(make_rough_conductor({metal, {kBeckmann, 0.1f, 0.1f}}));
       },
       false, 0.1f},
      {"rough_conductor_ggx",
       [=] {
         return single(make_rough_conductor({metal, {kGgx, 0.6f, 0.6f}}));
       },
       false, 0.6f},
      {"rough_conductor_brushed",
       [=] {
         return single(make_rough_conductor({metal, {kGgx, 0.1f, 0.5f}}));
       },
       false, 0.1f},
      {"rough_conductor_brushed_beckmann",
       [=] {
         return single(make_rough_conductor({metal, {kBeckmann, 0.7f, 0.25f}}));
       },
       false, 0.25f},
      {"rough_dielectric_beckmann",
       [=] {
         return single(make_rough_dielectric({glass, {kBeckmann, 0.3f, 0.3f}}));
       },
       true, 0.3f},
      {"rough_dielectric_ggx",
       [=] {
         return single(make_rough_dielectric({glass, {kGgx, 0.1f, 0.1f}}));
       },
       true, 0.1f},
      {"rough_dielectric_bubble",
       [=] {
         return single(make_rough_dielectric({bubble, {kGgx, 0.4f, 0.4f}}));
       },
       true, 0.4f},
      {"plastic", [=] { return single(make_plastic(plastic)); }},
      {"plastic_nonlinear", [=] { return single(make_plastic(nonlinear)); }},
      {"rough_plastic_beckmann",
       [=] {
         return single(make_rough_plastic({plastic, kBeckmann, 0.1f}));
       },
       false, 0.1f},
      {"rough_plastic_ggx",
       [=] {
         return single(make_rough_plastic({nonlinear, kGgx, 0.3f}));
       },
       false, 0.3f},
      {"glossy",
       [=] {
         return single(make_glossy({colour, ks, 0.15f}));
       },
       false, 0.15f},
      {"glossy_rough",
       [=] {
         return single(make_glossy({colour, ks, 0.5f}));
       },
       false, 0.5f},
      {"phong",
       [=] {
         return single(make_phong({colour * 0.6f, tint * 0.4f, 200}));
       },
       false, 0.1f},
      {"phong_wide",
       [=] {
         return single(make_phong({colour, tint, 5}));
       },
       false, 0.5f},
      {"rough_dielectric_brushed",
       [=] {
         return single(make_rough_dielectric({glass, {kGgx, 0.15f, 0.5f}}));
       },
       true, 0.15f},
      {"principled_metal",
       [=] {
         return single(make_principled(
             {.base_color = tint, .roughness = 0.6f, .anisotropic = 0.5f, .metallic = 1}));
       },
       false, 0.28f},
      {"principled_glass",
       [=] {
         return single(make_principled({.base_color = tint, .roughness = 0.5f, .spec_trans = 1}));
       },
       true, 0.25f},
      {"principled_thin",
       [=] {
         return single(make_principled_thin({.base_color = tint,
                                             .eta = 1.4f,
                                             .roughness = 0.6f,
                                             .anisotropic = 0.3f,
                                             .spec_trans = 1}));
       },
       true, 0.09f},
      {"principled_thin_transmitter",
       [=] { return single(make_principled_thin({.base_color = colour, .diff_trans = 2})); }, true},
      {"two_sided",
       [=] {
         return two_sided(make_diffuse(colour), make_glossy({colour, ks, 0.3f}));
       },
       true, 0.3f},
      {"mask", [=] { return masked(make_plastic(plastic), Rgb(0.3f, 0.6f, 1)); }},
      {"null", [=] { return single(make_null()); }, true},
  };
}

inline std::vector<BsdfCase> bsdf_cases(bool white = false) {
  std::vector<BsdfCase> all = plain_cases(white);
  for (BsdfCase& c : layered_cases(white)) all.push_back(std::move(c));
  return all;
}

/// An even surface, z up, with its tangents.
inline SurfacePoint flat_point() {
  SurfacePoint at;
  at.ng = at.ns = {0, 0, 1};
  at.dp_du = {2, 0, 0};
  at.dp_dv = {0, 3, 0};
  return at;
}

/// Unit vector of cosine z and azimuth phi.
inline Vec3 direction(double z, double phi) {
  const double s = std::sqrt(std::max(0.0, 1 - z * z));
  return {static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
          static_cast<float>(z)};
}

/// Directions to look from: steep, slanting, grazing; from behind too if asked.
inline std::vector<Vec3> views(bool behind) {
  std::vector<Vec3> all{direction(0.999, 0.3), direction(0.6, 2.1), direction(0.12, -1)};
  if (behind) {
    all.push_back(direction(-0.85, 1));
    all.push_back(direction(-0.3, -2));
  }
  return all;
}

/// How much a rounding error in wi is magnified in f and pdf, but for D: through the cosines,
/// through the half vector, and near total reflection through wi.m.
inline double condition(Vec3 wo, Vec3 wi, float eta) {
  const Vec3 half = wo + wi * eta;
  const float wi_m = std::abs(dot(wi, half)) / length(half);
  return (1 + 1 / length(half)) * (1 + 1 / (wi_m * wi_m)) *
         (1 + 1 / std::abs(wi.z) + 1 / std::abs(wo.z));
}

/// Part of the sphere between two polar angles and two azimuths.
struct Cell {
  double theta0 = 0, theta1 = std::numbers::pi, phi0 = 0, phi1 = 2 * std::numbers::pi;
};

/// Integral of `f` over solid angle by 3 x 3 Gauss points.
template <class F>
double gauss9(const F& f, const Cell& c) {
  constexpr double kNode[] = {-0.774596669241483, 0, 0.774596669241483};
  constexpr double kWeight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double theta = 0.5 * (c.theta0 + c.theta1 + kNode[i] * (c.theta1 - c.theta0));
    for (int j = 0; j < 3; ++j) {
      const double phi = 0.5 * (c.phi0 + c.phi1 + kNode[j] * (c.phi1 - c.phi0));
      const double value = static_cast<double>(f(direction(std::cos(theta), phi)));
      sum += kWeight[i] * kWeight[j] * std::sin(theta) * value;
    }
  }
  return sum * (c.theta1 - c.theta0) * (c.phi1 - c.phi0);
}

/// The same, quartered adaptively until the quarters agree with the whole to within `tolerance`;
/// `sure` is the number of quarterings made in any case, `most` their bound.
template <class F>
double integrate(const F& f, const Cell& c, double tolerance, int sure = 2, int most = 9) {
  const double theta = 0.5 * (c.theta0 + c.theta1), phi = 0.5 * (c.phi0 + c.phi1);
  const Cell quarters[] = {{c.theta0, theta, c.phi0, phi},
                           {theta, c.theta1, c.phi0, phi},
                           {c.theta0, theta, phi, c.phi1},
                           {theta, c.theta1, phi, c.phi1}};
  double sum = 0;
  if (sure <= 0) {
    for (const Cell& q : quarters) sum += gauss9(f, q);
    if (most <= 0 || std::abs(sum - gauss9(f, c)) < tolerance) return sum;
    sum = 0;
  }
  for (const Cell& q : quarters) sum += integrate(f, q, tolerance / 4, sure - 1, most - 1);
  return sum;
}

/// Sphere cut into cells equidistant in angle; the horizon is a border.
struct SphereGrid {
  int rows = 20, columns = 24;

  int size() const { return rows * columns; }
  Cell cell(int index) const {
    const double step = std::numbers::pi / rows, turn = 2 * std::numbers::pi / columns;
    const int row = index / columns, column = index % columns;
    return {row * step, (row + 1) * step, column * turn, (column + 1) * turn};
  }
  int index(Vec3 w) const {
    const double theta = std::acos(std::clamp(static_cast<double>(w.z), -1.0, 1.0));
    const double phi = std::atan2(-static_cast<double>(w.y), -static_cast<double>(w.x));
    const int row = static_cast<int>(theta / std::numbers::pi * rows);
    const int column = static_cast<int>((phi / (2 * std::numbers::pi) + 0.5) * columns);
    return std::min(row, rows - 1) * columns + std::min(column, columns - 1);
  }
};

}  // namespace octolux::test

#include "tests/core/bsdf_layers.h"
