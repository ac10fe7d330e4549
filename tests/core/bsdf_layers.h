// One of each kind of BSDF that holds or adds up others, for the tests that loop over all kinds.
#pragma once

#include <utility>

#include "tests/core/bsdf_testing.h"

namespace octolux::test {

/// A height field that is an inclined plane.
class SlopeTexture final : public Texture {
 public:
  explicit SlopeTexture(Vec2 slope) : slope_(slope) {}
  Rgb eval(const TexturePoint& uv) const override { return Rgb(0.5f + dot(slope_, uv)); }
  Rgb mean() const override { return Rgb(0.5f); }
  Vec2 gradient(const TexturePoint&) const override { return slope_; }
  float maximum() const override { return 1; }

 private:
  Vec2 slope_;
};

/// `wrap` of a BSDF that is kept beside it.
template <class Wrap>
Built around(std::unique_ptr<Bsdf> inner, const Wrap& wrap) {
  Built built;
  built.bsdf = wrap(std::as_const(*inner));
  built.parts.push_back(std::move(inner));
  return built;
}

inline Built bumped(std::unique_ptr<Bsdf> inner, Vec2 slope, TiltRepairs repairs) {
  Built built;
  built.textures.push_back(std::make_unique<SlopeTexture>(slope));
  built.bsdf = make_bump_map(*inner, Scalar(*built.textures[0]), 1, repairs);
  built.parts.push_back(std::move(inner));
  return built;
}

/// Coats lose what they reflect inside; a tilted surface what goes below the horizon. Tilted kinds
/// are left out where nothing may be gained either: the adjoint of a tilt has no such bound.
inline std::vector<BsdfCase> layered_cases(bool white) {
  const Rgb colour = white ? Rgb(1) : Rgb(0.2f, 0.5f, 0.8f);
  const Rgb tint = white ? Rgb(1) : Rgb(0.9f, 0.8f, 0.6f);
  const Rgb sigma = white ? Rgb(0) : Rgb(0.1f, 0.2f, 0.4f);
  const ConductorConfig metal{Rgb(0), Rgb(1), tint};
  const CoatingConfig coat{.eta = 1.3f, .sigma_a = sigma, .specular_reflectance = tint};
  const Roughness rough{MicrofacetKind::ggx, 0.3f, 0.3f};
  std::vector<BsdfCase> cases{
      {"coated_diffuse",
       [=] {
         return around(make_diffuse(colour), [&](const Bsdf& b) { return make_coating(b, coat); });
       },
       !white, 1, true},
      {"coated_metal",
       [=] {
         return around(make_rough_conductor({metal, rough}),
                       [&](const Bsdf& b) { return make_coating(b, coat); });
       },
       !white, 0.3f, true},
      {"blend",
       [=] {
         Built built;
         built.parts.push_back(make_diffuse(colour));
         built.parts.push_back(make_rough_conductor({metal, rough}));
         built.bsdf = make_blend(*built.parts[0], *built.parts[1], 0.3f);
         return built;
       },
       false, 0.3f},
      {"mixture",
       [=] {
         Built built;
         built.parts.push_back(make_diffuse(colour));
         built.parts.push_back(make_conductor(metal));
         const WeightedBsdf parts[] = {{built.parts[0].get(), 0.6f}, {built.parts[1].get(), 0.4f}};
         built.bsdf = make_mixture(parts);
         return built;
       }},
  };
  if (white) return cases;
  cases.push_back({"bumped_diffuse",
                   [=] {
                     return bumped(make_diffuse(colour), {0.8f, -0.3f}, {false, false});
                   },
                   false, 1, true});
  cases.push_back(
      {"bumped_metal",
       [=] {
         return bumped(make_rough_conductor({metal, rough}), {0.4f, 0.9f}, {false, false});
       },
       false, 0.3f, true});
  cases.push_back({"normal_mapped",
                   [=] {
                     return around(make_diffuse(colour), [&](const Bsdf& b) {
                       return make_normal_map(b, Rgb(0.6f, 0.45f, 0.9f), {false, false});
                     });
                   },
                   false, 1, true});
  cases.push_back({"principled_thin_all",
                   [=] {
                     return single(make_principled_thin({.base_color = colour,
                                                         .eta = 1.5f,
                                                         .roughness = 0.7f,
                                                         .anisotropic = 0.4f,
                                                         .spec_trans = 0.4f,
                                                         .spec_tint = 0.5f,
                                                         .sheen = 0.5f,
                                                         .sheen_tint = 0.5f,
                                                         .flatness = 0.4f,
                                                         .diff_trans = 0.7f}));
                   },
                   true, 0.15f});
  cases.push_back({"principled_all",
                   [=] {
                     return single(make_principled({.base_color = colour,
                                                    .roughness = 0.5f,
                                                    .anisotropic = 0.3f,
                                                    .metallic = 0.3f,
                                                    .spec_trans = 0.4f,
                                                    .spec_tint = 0.5f,
                                                    .clearcoat = 0.8f,
                                                    .sheen = 0.5f,
                                                    .sheen_tint = 0.5f,
                                                    .flatness = 0.4f}));
                   },
                   true, 0.1f});
  return cases;
}

}  // namespace octolux::test
