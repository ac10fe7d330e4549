// <bsdf>: names, parameters and defaults of Mitsuba's surface plug-ins that we model.
#include "renderer/xml_bsdfs.h"

#include <cmath>
#include <memory>
#include <string>

#include "core/bsdf_makers.h"
#include "core/ior.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

using Made = std::unique_ptr<Bsdf>;

/// An index of refraction: a number or the name of a material.
float read_ior(Properties& p, const std::string& name, const char* fallback) {
  const XmlNode* node = p.find(name);
  if (node && node->tag != "string") return p.positive(name, 1);
  const std::string material = p.text(name).value_or(fallback);
  const std::optional<float> ior = named_ior(material);
  if (!ior) p.fail(name, unknown_name("material", material, ior_names()));
  return *ior;
}

}  // namespace

float read_eta(Properties& p, const char* interior) {
  const float inside = read_ior(p, "int_ior", interior);
  return inside / read_ior(p, "ext_ior", "air");
}

namespace {

// ---- parameters several plug-ins share

float read_alpha(Properties& p, const std::string& name, float fallback) {
  const XmlNode* node = p.find(name);
  if (node && node->object().tag == "texture") {
    p.fail(name, "a texture cannot be used for '" + name + "'; give a number");
  }
  return p.positive(name, fallback);
}

Scalar read_alpha_or_texture(Properties& p, SceneBuilder& b, const std::string& name,
                             Scalar fallback) {
  const XmlNode* node = p.find(name);
  if (!node) return fallback;
  if (node->object().tag == "texture") return b.scalar(p, name, 0);
  return p.positive(name, 0);
}

MicrofacetKind read_distribution(Properties& p) {
  p.ignore({"sample_visible"});
  return p.choice("distribution", {"beckmann", "ggx"}) == "ggx" ? MicrofacetKind::ggx
                                                                : MicrofacetKind::beckmann;
}

/// 'alpha', or 'alpha_u' and 'alpha_v'.
Roughness read_roughness(Properties& p, SceneBuilder& b) {
  if ((p.find("alpha_u") || p.find("alpha_v")) && p.find("alpha")) {
    p.fail("alpha", "give either 'alpha' or 'alpha_u' and 'alpha_v'");
  }
  const Scalar alpha = read_alpha_or_texture(p, b, "alpha", 0.1f);
  return {.kind = read_distribution(p),
          .alpha_u = read_alpha_or_texture(p, b, "alpha_u", alpha),
          .alpha_v = read_alpha_or_texture(p, b, "alpha_v", alpha)};
}

DielectricConfig read_dielectric(Properties& p, SceneBuilder& b) {
  return {.eta = read_eta(p, "bk7"),
          .specular_reflectance = b.constant_color(p, "specular_reflectance", 1),
          .specular_transmittance = b.constant_color(p, "specular_transmittance", 1)};
}

ConductorIor read_named_conductor(Properties& p) {
  const std::string material = p.text("material").value_or("Cu");
  if (material == "none") return {Rgb(0), Rgb(1)};
  const std::optional<ConductorIor> ior = named_conductor(material);
  if (ior) return *ior;
  std::vector<std::string> names = conductor_names();
  names.push_back("none");
  p.fail("material", unknown_name("material", material, names));
}

/// eta and k, or a material's name; over the index outside (0.5/0.6: extEta).
ConductorConfig read_conductor(Properties& p, SceneBuilder& b) {
  const std::optional<Rgb> eta = p.color("eta", ColorRole::ior);
  const std::optional<Rgb> k = p.color("k", ColorRole::ior);
  if (eta.has_value() != k.has_value()) p.fail("eta", "'eta' and 'k' go together");
  ConductorIor ior = read_named_conductor(p);
  if (eta) {
    if (p.find("material")) p.fail("material", "give either 'material' or 'eta' and 'k'");
    ior = {*eta, *k};
    if (is_black(*eta) && is_black(*k)) p.fail("eta", "'eta' and 'k' must not both be 0");
  }
  const float outside = p.find("ext_eta") ? read_ior(p, "ext_eta", "air") : 1;
  return {.eta = ior.eta / outside,
          .k = ior.k / outside,
          .specular_reflectance = b.color(p, "specular_reflectance", 1)};
}

PlasticConfig read_plastic(Properties& p, SceneBuilder& b) {
  return {.eta = read_eta(p, "polypropylene"),
          .diffuse_reflectance = b.color(p, "diffuse_reflectance", 0.5f),
          .specular_reflectance = b.constant_color(p, "specular_reflectance", 1),
          .nonlinear = p.boolean("nonlinear").value_or(false)};
}

// ---- one maker per plug-in

Made diffuse(Properties& p, SceneBuilder& b) {
  return make_diffuse(b.color(p, "reflectance", 0.5f));
}

/// 0.6 calls the reflectance as its `plastic` does, too.
Made rough_diffuse(Properties& p, SceneBuilder& b) {
  const char* name = p.find("diffuse_reflectance") ? "diffuse_reflectance" : "reflectance";
  return make_rough_diffuse({.reflectance = b.color(p, name, 0.5f),
                             .alpha = b.scalar(p, "alpha", 0.2f),
                             .qualitative = p.boolean("use_fast_approx").value_or(false)});
}

/// A sheet of which all light that it scatters comes out on the other side.
Made diffuse_transmitter(Properties& p, SceneBuilder& b) {
  return make_principled_thin({.base_color = b.color(p, "transmittance", 0.5f), .diff_trans = 2});
}

Made null(Properties&, SceneBuilder&) { return make_null(); }

Made dielectric(Properties& p, SceneBuilder& b) { return make_dielectric(read_dielectric(p, b)); }

Made thin_dielectric(Properties& p, SceneBuilder& b) {
  return make_thin_dielectric(read_dielectric(p, b));
}

Made rough_dielectric(Properties& p, SceneBuilder& b) {
  const RoughDielectricConfig config{.dielectric = read_dielectric(p, b),
                                     .roughness = read_roughness(p, b)};
  if (config.dielectric.eta == 1) {
    p.fail("int_ior", "a roughdielectric needs different 'int_ior' and 'ext_ior'");
  }
  return make_rough_dielectric(config);
}

Made conductor(Properties& p, SceneBuilder& b) { return make_conductor(read_conductor(p, b)); }

Made rough_conductor(Properties& p, SceneBuilder& b) {
  return make_rough_conductor(
      {.conductor = read_conductor(p, b), .roughness = read_roughness(p, b)});
}

Made plastic(Properties& p, SceneBuilder& b) { return make_plastic(read_plastic(p, b)); }

Made rough_plastic(Properties& p, SceneBuilder& b) {
  return make_rough_plastic({.plastic = read_plastic(p, b),
                             .kind = read_distribution(p),
                             .alpha = read_alpha(p, "alpha", 0.1f)});
}

Made phong(Properties& p, SceneBuilder& b) {
  return make_phong({.diffuse_reflectance = b.color(p, "diffuse_reflectance", 0.5f),
                     .specular_reflectance = b.color(p, "specular_reflectance", 0.2f),
                     .exponent = b.scalar(p, "exponent", 30)});
}

/// 'eta', or 'specular', which stands for the reflectance at normal incidence over 0.08.
float read_principled_eta(Properties& p) {
  if (p.find("eta") && p.find("specular")) p.fail("eta", "give either 'eta' or 'specular'");
  const float specular = p.number("specular").value_or(0.5f);
  if (!(specular >= 0 && specular <= 1)) {
    p.fail("specular", "'specular' must lie between 0 and 1");
  }
  const float from_specular = 2 / (1 - std::sqrt(0.08f * std::max(specular, 1e-3f))) - 1;
  const float eta = p.find("eta") ? p.positive("eta", 1) : from_specular;
  return eta == 1 ? 1.001f : eta;  // as in Mitsuba: equal indices have no boundary
}

Made principled(Properties& p, SceneBuilder& b) {
  p.ignore({"main_specular_sampling_rate", "clearcoat_sampling_rate",
            "diffuse_reflectance_sampling_rate"});
  return make_principled({.base_color = b.color(p, "base_color", 0.5f),
                          .eta = read_principled_eta(p),
                          .roughness = b.scalar(p, "roughness", 0.5f),
                          .anisotropic = b.scalar(p, "anisotropic", 0),
                          .metallic = b.scalar(p, "metallic", 0),
                          .spec_trans = b.scalar(p, "spec_trans", 0),
                          .spec_tint = b.scalar(p, "spec_tint", 0),
                          .clearcoat = b.scalar(p, "clearcoat", 0),
                          .clearcoat_gloss = b.scalar(p, "clearcoat_gloss", 0),
                          .sheen = b.scalar(p, "sheen", 0),
                          .sheen_tint = b.scalar(p, "sheen_tint", 0),
                          .flatness = b.scalar(p, "flatness", 0)});
}

Made principled_thin(Properties& p, SceneBuilder& b) {
  p.ignore({"diffuse_reflectance_sampling_rate", "specular_reflectance_sampling_rate",
            "specular_transmittance_sampling_rate", "diffuse_transmittance_sampling_rate"});
  return make_principled_thin({.base_color = b.color(p, "base_color", 0.5f),
                               .eta = b.scalar(p, "eta", 1.5f),
                               .roughness = b.scalar(p, "roughness", 0.5f),
                               .anisotropic = b.scalar(p, "anisotropic", 0),
                               .spec_trans = b.scalar(p, "spec_trans", 0),
                               .spec_tint = b.scalar(p, "spec_tint", 0),
                               .sheen = b.scalar(p, "sheen", 0),
                               .sheen_tint = b.scalar(p, "sheen_tint", 0),
                               .flatness = b.scalar(p, "flatness", 0),
                               .diff_trans = b.scalar(p, "diff_trans", 0)});
}

constexpr Plugin<Made (*)(Properties&, SceneBuilder&)> kPlugins[] = {
    {"diffuse", diffuse},
    {"roughdiffuse", rough_diffuse},
    {"difftrans", diffuse_transmitter},
    {"dielectric", dielectric},
    {"thindielectric", thin_dielectric},
    {"roughdielectric", rough_dielectric},
    {"conductor", conductor},
    {"roughconductor", rough_conductor},
    {"plastic", plastic},
    {"roughplastic", rough_plastic},
    {"phong", phong},
    {"principled", principled},
    {"principledthin", principled_thin},
    {"twosided", make_two_sided_bsdf},
    {"mask", make_mask_bsdf},
    {"null", null},
    {"coating", make_coating_bsdf},
    {"bumpmap", make_bump_map_bsdf},
    {"bump", make_bump_map_bsdf},
    {"normalmap", make_normal_map_bsdf},
    {"blendbsdf", make_blend_bsdf},
    {"mixturebsdf", make_mixture_bsdf},
};

}  // namespace

std::unique_ptr<Bsdf> make_bsdf(Properties& properties, SceneBuilder& builder) {
  return find_plugin(kPlugins, properties)(properties, builder);
}

}  // namespace octolux
