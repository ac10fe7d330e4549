// Disney's principled material (Burley 2012 and 2015) in the form of Mitsuba 3's `principled`:
// diffuse with retro-reflection, sheen, an anisotropic GGX lobe that is metal, dielectric or glass,
// and a clear coat (GTR1). Lobes are added up, so unlike the other kinds a white one may reflect
// somewhat more than it receives; scenes are tuned to these sums.
//
// The diffuse lobe and sheen are smooth, the coat near-specular, the main lobe what its roughness
// makes it. Glass needs both sides; everything else is on the front.
#include <cmath>

#include "core/bsdf_makers.h"
#include "core/bsdf_principled_parts.h"
#include "core/constants.h"
#include "core/fresnel.h"
#include "core/sampling.h"

namespace octolux {
namespace {

Lobes main_lobe(const PrincipledConfig& c) {
  const Vec2 a = alphas(c.roughness.mean(), c.anisotropic.mean());
  return microfacet_lobe(std::min(a.x, a.y));
}

/// The clear coat's distribution: GTR with exponent 1.
struct Gtr1 {
  float alpha2;

  float d(Vec3 m) const {
    return (alpha2 - 1) / (kPi * std::log(alpha2) * (1 + (alpha2 - 1) * m.z * m.z));
  }
  Vec3 sample(Vec2 u) const {
    const float z2 = std::clamp((1 - std::pow(alpha2, 1 - u.y)) / (1 - alpha2), 0.0f, 1.0f);
    const float r = std::sqrt(1 - z2), phi = 2 * kPi * u.x;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(z2)};
  }
};

class Principled final : public Bsdf {
 public:
  explicit Principled(const PrincipledConfig& c)
      : Bsdf(Lobes::smooth | main_lobe(c) |
                 (present(c.clearcoat) ? Lobes::near_specular : Lobes::none),
             present(c.spec_trans) && main_lobe(c) == Lobes::smooth, false, present(c.anisotropic)),
        c_(c),
        main_(main_lobe(c)) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked, Carried carried) const override {
    if (wo.z == 0 || wi.z == 0) return Rgb(0);
    const Material m = material(at);
    const Half h = half(wo, wi);
    if (!h.visible) return Rgb(0);
    Rgb sum(0);
    if (any(asked & main_))
      sum += h.reflects ? reflected(m, wo, wi, h) : refracted(m, wo, wi, h, carried);
    if (wo.z < 0 || wi.z < 0) return sum;
    if (any(asked & Lobes::near_specular)) sum += coat(m, wo, wi, h);
    if (any(asked & Lobes::smooth)) sum += diffuse(m, wo, wi, h);
    return sum;
  }

  float pdf_w(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes asked) const override {
    if (wo.z == 0 || wi.z == 0) return 0;
    const Material m = material(at);
    return pdf_w(m, choice(m, wo, asked), wo, wi);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float u_lobe, Vec2 u,
                                   Lobes asked, Carried carried) const override {
    if (wo.z == 0) return std::nullopt;
    const Material m = material(at);
    const Choice p = choice(m, wo, asked);
    BsdfSample s;
    if (u_lobe < p.diffuse) {
      s.wi = sample_cosine_hemisphere(u);
      s.lobe = Lobes::smooth;
    } else if (u_lobe < p.diffuse + p.coat) {
      s.wi = reflect(wo, m.coat.sample(u));
      s.lobe = Lobes::near_specular;
    } else if (p.main > 0) {
      const float rest = std::min(kOneMinusEpsilon, (u_lobe - p.diffuse - p.coat) / p.main);
      s.wi = sample_main(m, wo, rest, u);
      s.lobe = main_;
    } else {
      return std::nullopt;
    }
    if (s.wi.z == 0 || (s.lobe != main_ && s.wi.z < 0)) return std::nullopt;
    s.pdf_w = pdf_w(m, p, wo, s.wi);
    if (!(s.pdf_w > 0)) return std::nullopt;
    s.eta = wo.z * s.wi.z > 0 ? 1 : wo.z > 0 ? c_.eta : 1 / c_.eta;
    s.weight = f(at, wo, s.wi, asked, carried) * (std::abs(s.wi.z) / s.pdf_w);
    return is_black(s.weight) ? std::nullopt : std::optional(s);
  }

  Rgb albedo(const SurfacePoint& at) const override { return c_.base_color(at.uv); }

 private:
  /// The parameters at one point.
  struct Material {
    Rgb base;
    Microfacet microfacet;
    Gtr1 coat;
    float roughness, metallic, spec_tint, clearcoat, sheen, sheen_tint, flatness;
    float opaque;  // share of the diffuse base
    float glass;   // share of glass
  };
  Material material(const SurfacePoint& at) const {
    const TexturePoint& uv = at.uv;
    const float metallic = c_.metallic(uv), spec_trans = c_.spec_trans(uv);
    const float roughness = c_.roughness(uv);
    const Vec2 alpha = alphas(roughness, c_.anisotropic(uv));
    const float coat_alpha = mix(c_.clearcoat_gloss(uv), 0.1f, 0.001f);
    return {c_.base_color(uv),
            {MicrofacetKind::ggx, alpha.x, alpha.y},
            {coat_alpha * coat_alpha},
            roughness,
            metallic,
            c_.spec_tint(uv),
            c_.clearcoat(uv),
            c_.sheen(uv),
            c_.sheen_tint(uv),
            c_.flatness(uv),
            (1 - metallic) * (1 - spec_trans),
            (1 - metallic) * spec_trans};
  }

  /// The microfacet between two directions, on the outside.
  struct Half {
    Vec3 m;
    float wo_m = 0, wi_m = 0;  // signed cosines
    float eta = 1;             // index on wi's side over that on wo's, if refracted
    float fresnel = 0;         // of a dielectric
    bool reflects = false, visible = false;
  };
  Half half(Vec3 wo, Vec3 wi) const {
    Half h;
    h.reflects = wo.z * wi.z > 0;
    h.eta = wo.z > 0 ? c_.eta : 1 / c_.eta;
    h.m = normalize(h.reflects ? wo + wi : wo + wi * h.eta);
    if (h.m.z < 0) h.m = -h.m;
    h.wo_m = dot(wo, h.m);
    h.wi_m = dot(wi, h.m);
    h.fresnel = fresnel_dielectric(h.wo_m, c_.eta).reflectance;
    h.visible = h.wo_m * wo.z > 0 && h.wi_m * wi.z > 0;
    return h;
  }

  /// Schlick's Fresnel; inside the denser medium by the cosine of the refracted ray.
  Rgb schlick(Rgb f0, float cosine) const {
    const DielectricFresnel fresnel = fresnel_dielectric(cosine, c_.eta);
    const float c = fresnel.eta > 1 ? std::abs(cosine) : std::abs(fresnel.cos_refracted);
    return f0 + (Rgb(1) - f0) * schlick_weight(c);
  }

  static float d_g(const Material& m, Vec3 wo, Vec3 wi, const Half& h) {
    return m.microfacet.d(h.m) * m.microfacet.g1(wo, h.m) * m.microfacet.g1(wi, h.m) /
           std::abs(wo.z * wi.z);
  }

  Rgb reflected(const Material& m, Vec3 wo, Vec3 wi, const Half& h) const {
    Rgb fresnel(m.glass * h.fresnel);
    if (wo.z > 0) {
      const float plain = (c_.eta - 1) / (c_.eta + 1);
      fresnel = Rgb((1 - m.metallic) * (1 - m.spec_tint) * h.fresnel) +
                schlick(m.base, h.wo_m) * m.metallic;
      if (m.spec_tint > 0) {
        fresnel +=
            schlick(tint_of(m.base) * (plain * plain), h.wo_m) * ((1 - m.metallic) * m.spec_tint);
      }
    }
    return fresnel * (0.25f * d_g(m, wo, wi, h));
  }

  static Rgb refracted(const Material& m, Vec3 wo, Vec3 wi, const Half& h, Carried carried) {
    if (!(m.glass > 0)) return Rgb(0);
    const float sum = h.wo_m + h.eta * h.wi_m;
    const float flux = carried == Carried::flux ? h.eta * h.eta : 1.0f;
    const Rgb colour{std::sqrt(m.base.r), std::sqrt(m.base.g), std::sqrt(m.base.b)};
    return colour * (m.glass * flux * (1 - h.fresnel) * d_g(m, wo, wi, h) *
                     std::abs(h.wo_m * h.wi_m) / (sum * sum));
  }

  Rgb coat(const Material& m, Vec3 wo, Vec3 wi, const Half& h) const {
    if (!(m.clearcoat > 0)) return Rgb(0);
    const Microfacet shadowing(MicrofacetKind::ggx, 0.25f, 0.25f);
    const float g = shadowing.g1(wo, h.m) * shadowing.g1(wi, h.m);
    return schlick(Rgb(0.04f), h.wo_m) * (0.25f * m.clearcoat * m.coat.d(h.m) * g);
  }

  static Rgb diffuse(const Material& m, Vec3 wo, Vec3 wi, const Half& h) {
    Rgb sum = m.base * (m.opaque * disney_diffuse(m.roughness, m.flatness, wo.z, wi.z, h.wi_m));
    if (m.sheen > 0) {
      const Rgb colour = Rgb(1 - m.sheen_tint) + tint_of(m.base) * m.sheen_tint;
      sum += colour * (m.sheen * (1 - m.metallic) * schlick_weight(h.wi_m));
    }
    return sum;
  }

  /// Probabilities of choosing a lobe; the main one reflects or refracts as its microfacet says.
  struct Choice {
    float diffuse = 0, coat = 0, main = 0;
  };
  Choice choice(const Material& m, Vec3 wo, Lobes asked) const {
    Choice c;
    const bool front = wo.z > 0;
    if (any(asked & main_) && (front || m.glass > 0)) c.main = 1;
    if (front && any(asked & Lobes::near_specular)) c.coat = 0.25f * m.clearcoat;
    if (front && any(asked & Lobes::smooth)) {
      c.diffuse = std::max(m.opaque, 0.25f * m.sheen * (1 - m.metallic));
    }
    const float total = c.diffuse + c.coat + c.main;
    if (!(total > 0)) return {};
    return {c.diffuse / total, c.coat / total, c.main / total};
  }

  static float reflection_probability(const Material& m, Vec3 wo, float fresnel) {
    return wo.z > 0 ? 1 - m.glass * (1 - fresnel) : fresnel;
  }

  float pdf_w(const Material& m, const Choice& p, Vec3 wo, Vec3 wi) const {
    const Half h = half(wo, wi);
    float pdf = wo.z > 0 && wi.z > 0 ? p.diffuse * wi.z * kInvPi : 0;
    if (!h.visible) return pdf;
    const float reflects = reflection_probability(m, wo, h.fresnel);
    const float pdf_m = p.main * m.microfacet.visible_pdf_w(wo.z > 0 ? wo : -wo, h.m);
    if (h.reflects) {
      if (wo.z > 0) pdf += p.coat * m.coat.d(h.m) * h.m.z / (4 * h.wi_m);
      return pdf + pdf_m * reflects / (4 * std::abs(h.wi_m));
    }
    const float sum = h.wo_m + h.eta * h.wi_m;
    return pdf + pdf_m * (1 - reflects) * h.eta * h.eta * std::abs(h.wi_m) / (sum * sum);
  }

  /// A direction by the main lobe; on the horizon if there is none.
  Vec3 sample_main(const Material& m, Vec3 wo, float u_choice, Vec2 u) const {
    const Vec3 n = m.microfacet.sample_visible(wo.z > 0 ? wo : -wo, u);
    const DielectricFresnel fresnel = fresnel_dielectric(dot(wo, n), c_.eta);
    const bool reflects = u_choice < reflection_probability(m, wo, fresnel.reflectance);
    const Vec3 wi = reflects ? reflect(wo, n) : refract(wo, n, fresnel);
    return (wo.z * wi.z > 0) == reflects ? wi : Vec3{1, 0, 0};
  }

  PrincipledConfig c_;
  Lobes main_;
};

}  // namespace

std::unique_ptr<Bsdf> make_principled(const PrincipledConfig& config) {
  return std::make_unique<Principled>(config);
}

}  // namespace octolux
