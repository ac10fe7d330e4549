// Disney's principled material for sheets without thickness (Burley 2015, 5.3) in the form of
// Mitsuba 3's `principledthin`: light is reflected or passes through, diffusely or in a GGX lobe,
// and is not bent. Both sides are alike. The transmitted lobe is the reflected one thrown to the
// other side, with a roughness by the index of refraction.
//
// Reciprocal, also where Mitsuba's is not: it has no transmission through microfacets that the
// straight ray would see from behind, a condition that is not symmetric and of no account.
#include <cmath>

#include "core/bsdf_makers.h"
#include "core/bsdf_principled_parts.h"
#include "core/sampling.h"

namespace octolux {
namespace {

/// Roughness of what passes: a denser sheet blurs more (Burley 2015, figure 15).
float scaled(float roughness, float eta) { return std::max(0.0f, 0.65f * eta - 0.35f) * roughness; }

Lobes kind_of(float roughness, float anisotropic) {
  const Vec2 a = alphas(roughness, anisotropic);
  return microfacet_lobe(std::min(a.x, a.y));
}
Lobes reflected_kind(const PrincipledThinConfig& c) {
  return present(c.spec_trans) ? kind_of(c.roughness.mean(), c.anisotropic.mean()) : Lobes::none;
}
Lobes transmitted_kind(const PrincipledThinConfig& c) {
  return present(c.spec_trans)
             ? kind_of(scaled(c.roughness.mean(), c.eta.mean()), c.anisotropic.mean())
             : Lobes::none;
}

Vec3 mirrored(Vec3 w) { return {w.x, w.y, -w.z}; }

class PrincipledThin final : public Bsdf {
 public:
  explicit PrincipledThin(const PrincipledThinConfig& c)
      : Bsdf(Lobes::smooth | reflected_kind(c) | transmitted_kind(c),
             present(c.diff_trans) || transmitted_kind(c) == Lobes::smooth, false,
             present(c.anisotropic)),
        c_(c),
        reflected_(reflected_kind(c)),
        transmitted_(transmitted_kind(c)) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried) const override {
    if (wo.z == 0 || wi.z == 0) return Rgb(0);
    const Material m = material(at);
    const Pair p(wo, wi);
    const float diffuse = 1 - m.spec_trans;
    Rgb sum(0);
    if (p.through) {
      if (any(asked & transmitted_)) {
        const float fresnel = fresnel_dielectric(p.cos_m, m.eta).reflectance;
        sum += m.base * (m.spec_trans * (1 - fresnel) * d_g(m.transmitted, p));
      }
      if (any(asked & Lobes::smooth)) sum += m.base * (diffuse * m.diff_trans * kInvPi);
      return sum;
    }
    if (any(asked & reflected_)) {
      sum += fresnel(m, p.cos_m) * (m.spec_trans * d_g(m.reflected, p));
    }
    if (any(asked & Lobes::smooth)) {
      const Rgb sheen = Rgb(1 - m.sheen_tint) + tint_of(m.base) * m.sheen_tint;
      sum += (m.base * disney_diffuse(m.roughness, m.flatness, p.wo.z, p.wi.z, p.cos_m) +
              sheen * (m.sheen * schlick_weight(p.cos_m))) *
             (diffuse * (1 - m.diff_trans));
    }
    return sum;
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z == 0 || wi.z == 0) return 0;
    const Material m = material(at);
    return pdf_w(m, choice(m, asked), Pair(wo, wi));
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z == 0) return std::nullopt;
    const Material m = material(at);
    const Choice c = choice(m, asked);
    if (!(c.total() > 0)) return std::nullopt;
    const Vec3 front = wo.z > 0 ? wo : -wo;
    Vec3 wi;  // on the side of wo
    bool through;
    Lobes kind = Lobes::smooth;
    if (u_lobe < c.reflected + c.transmitted) {
      through = u_lobe >= c.reflected;
      kind = through ? transmitted_ : reflected_;
      wi = reflect(front, (through ? m.transmitted : m.reflected).sample_visible(front, u));
    } else {
      through = u_lobe >= c.reflected + c.transmitted + c.diffuse;
      wi = sample_cosine_hemisphere(u);
    }
    if (!(wi.z > 0)) return std::nullopt;
    if (through) wi = mirrored(wi);
    if (wo.z < 0) wi = -wi;
    const float pdf = pdf_w(m, c, Pair(wo, wi));
    if (!(pdf > 0)) return std::nullopt;
    const Rgb weight = f(at, wo, wi, asked, carried) * (std::abs(wi.z) / pdf);
    if (is_black(weight)) return std::nullopt;
    return BsdfSample{wi, weight, pdf, kind, 1};
  }

  Rgb albedo(const SurfacePoint& at) const override { return c_.base_color(at.uv); }

 private:
  /// The parameters at one point.
  struct Material {
    Rgb base;
    Microfacet reflected, transmitted;
    float eta, roughness, spec_trans, spec_tint, sheen, sheen_tint, flatness;
    float diff_trans;  // share of the diffuse light that goes through
  };
  Material material(const SurfacePoint& at) const {
    const TexturePoint& uv = at.uv;
    const float eta = c_.eta(uv), roughness = c_.roughness(uv), aspect = c_.anisotropic(uv);
    const Vec2 a = alphas(roughness, aspect), b = alphas(scaled(roughness, eta), aspect);
    return {c_.base_color(uv),
            {MicrofacetKind::ggx, a.x, a.y},
            {MicrofacetKind::ggx, b.x, b.y},
            eta,
            roughness,
            c_.spec_trans(uv),
            c_.spec_tint(uv),
            c_.sheen(uv),
            c_.sheen_tint(uv),
            c_.flatness(uv),
            c_.diff_trans(uv) / 2};
  }

  /// Two directions, turned so that wo is in front; wi is brought to the same side.
  struct Pair {
    Pair(Vec3 o, Vec3 i) : wo(o.z > 0 ? o : -o), wi(o.z > 0 ? i : -i), through(wi.z < 0) {
      if (through) wi = mirrored(wi);
      m = normalize(wo + wi);
      cos_m = dot(wo, m);
    }
    Vec3 wo, wi, m;
    bool through;
    float cos_m;
  };

  /// D G / (4 cos cos).
  static float d_g(const Microfacet& microfacet, const Pair& p) {
    return microfacet.reflection(p.wo, p.wi).f;
  }

  static Rgb fresnel(const Material& m, float cos_m) {
    const DielectricFresnel plain = fresnel_dielectric(cos_m, m.eta);
    if (!(m.spec_tint > 0)) return Rgb(plain.reflectance);
    const float r = (m.eta - 1) / (m.eta + 1);
    const float c = plain.eta > 1 ? std::abs(cos_m) : std::abs(plain.cos_refracted);
    const Rgb f0 = tint_of(m.base) * (r * r);
    const Rgb tinted = f0 + (Rgb(1) - f0) * schlick_weight(c);
    return Rgb(plain.reflectance * (1 - m.spec_tint)) + tinted * m.spec_tint;
  }

  /// Probabilities of the lobes; what is left goes through diffusely.
  struct Choice {
    float reflected = 0, transmitted = 0, diffuse = 0, through = 0;
    float total() const { return reflected + transmitted + diffuse + through; }
  };
  Choice choice(const Material& m, Lobes asked) const {
    Choice c;
    if (any(asked & reflected_)) c.reflected = m.spec_trans / 2;
    if (any(asked & transmitted_)) c.transmitted = m.spec_trans / 2;
    if (any(asked & Lobes::smooth)) {
      c.diffuse = (1 - m.spec_trans) * (1 - m.diff_trans);
      c.through = (1 - m.spec_trans) * m.diff_trans;
    }
    const float total = c.total();
    if (!(total > 0)) return {};
    return {c.reflected / total, c.transmitted / total, c.diffuse / total, c.through / total};
  }

  static float pdf_w(const Material& m, const Choice& c, const Pair& p) {
    const Microfacet& microfacet = p.through ? m.transmitted : m.reflected;
    const float lobe = p.through ? c.transmitted : c.reflected;
    const float pdf = (p.through ? c.through : c.diffuse) * p.wi.z * kInvPi;
    return lobe > 0 ? pdf + lobe * microfacet.reflected_pdf_w(p.wo, p.m) : pdf;
  }

  PrincipledThinConfig c_;
  Lobes reflected_, transmitted_;
};

}  // namespace

std::unique_ptr<Bsdf> make_principled_thin(const PrincipledThinConfig& config) {
  return std::make_unique<PrincipledThin>(config);
}

}  // namespace octolux
