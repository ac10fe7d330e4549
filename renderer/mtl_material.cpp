// The rules of mtl_material.h.
#include "renderer/mtl_material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bsdf_adapters.h"
#include "core/bsdf_makers.h"
#include "renderer/mtl_textures.h"

namespace octolux {
namespace {

constexpr float kDefaultGrey = 0.5f;
constexpr float kMirrorShininess = 1000;    // the largest Ns in use
constexpr float kOpaque = 254.5f / 255.0f;  // what an 8-bit exporter rounds to 1

bool opaque(const MtlMaterial& m) { return m.opacity >= kOpaque; }

/// Does it say how it looks at all?
bool says_nothing(const MtlMaterial& m) {
  return std::none_of(m.given.begin(), m.given.end(), [](const std::string& key) {
    return key == "Kd" || key == "Ks" || key == "Ke" || key == "Tf" || key == "Kt";
  });
}

int add(std::unique_ptr<Bsdf> bsdf, Scene& scene) {
  scene.bsdfs.push_back(std::move(bsdf));
  return static_cast<int>(scene.bsdfs.size()) - 1;
}

int add_two_sided(std::unique_ptr<Bsdf> bsdf, Scene& scene) {
  const Bsdf& side = *scene.bsdfs.emplace_back(std::move(bsdf));
  return add(make_two_sided(side, side), scene);
}

Rgb reflectance(Rgb c, const char* key, const MtlMaterial& m, Scene& scene) {
  if (max_component(c) <= 1) return c;
  scene.warnings.push_back(fmt::format(
      "{}: material '{}': {} above 1 would create light; taken as 1", m.place, m.name, key));
  return {std::min(c.r, 1.0f), std::min(c.g, 1.0f), std::min(c.b, 1.0f)};
}

Rgb square_root(Rgb c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }

int add_glass(const MtlMaterial& m, Scene& scene) {
  DielectricConfig config;
  config.eta = m.ni;
  if (!is_black(m.tf)) {
    config.specular_transmittance = square_root(reflectance(m.tf, "Tf", m, scene));
  }
  return add(make_dielectric(config), scene);
}

/// The map of that key, where it is above 1 cut to 1; nullptr if there is none.
const Texture* reflectance_map(const MtlMaterial& m, const char* key, Scene& scene) {
  const Texture* map = load_map(m, {key}, MtlMapUse::colour, scene);
  if (!map || map->maximum() <= 1) return map;
  scene.textures.push_back(make_clamped_texture(*map));
  return scene.textures.back().get();
}

/// Kd times map_Kd. A black Kd beside a map is an exporter's way of leaving it out.
Color diffuse_colour(const MtlMaterial& m, Scene& scene) {
  if (const Texture* map = reflectance_map(m, "map_Kd", scene)) {
    return Color(*map, is_black(m.kd) ? Rgb(1) : reflectance(m.kd, "Kd", m, scene));
  }
  if (m.given.contains("map_Kd") && !m.given.contains("Kd")) return Rgb(kDefaultGrey);
  if (!says_nothing(m)) return reflectance(m.kd, "Kd", m, scene);
  scene.warnings.push_back(
      fmt::format("{}: material '{}' gives no colour; taken as grey", m.place, m.name));
  return Rgb(kDefaultGrey);
}

/// Ks times map_Ks, likewise; a map that is not there changes nothing.
Color specular_colour(const MtlMaterial& m, Scene& scene) {
  const Rgb ks = reflectance(m.ks, "Ks", m, scene);
  const Texture* map = reflectance_map(m, "map_Ks", scene);
  return map ? Color(*map, is_black(ks) ? Rgb(1) : ks) : Color(ks);
}

int add_opaque(const MtlMaterial& m, Scene& scene) {
  switch (kind(m)) {
    case MtlKind::mirror: {
      ConductorConfig config;  // eta = 0, k = 1: reflects all
      config.specular_reflectance = specular_colour(m, scene);
      return add_two_sided(make_conductor(config), scene);
    }
    case MtlKind::glossy: {
      GlossyConfig config;
      config.diffuse = diffuse_colour(m, scene);
      config.specular = specular_colour(m, scene);
      config.alpha =
          std::sqrt(2 / (m.ns + 2));  // Walter et al. 2007, between Phong and microfacets
      return add_two_sided(make_glossy(config), scene);
    }
    default:
      return add_two_sided(make_diffuse(diffuse_colour(m, scene)), scene);
  }
}

}  // namespace

MtlKind kind(const MtlMaterial& m) {
  const bool no_model = m.illum <= 0;  // 0 is written by exporters that have nothing to say
  const bool transparent = m.illum == 4 || m.illum == 6 || m.illum == 7 || m.illum == 9;
  if (m.ni != 1 && (transparent || !opaque(m) || (no_model && !is_black(m.tf)))) {
    return MtlKind::glass;
  }
  const bool reflects =
      m.illum == 3 || m.illum == 5 || (no_model && m.ns >= kMirrorShininess && is_black(m.kd));
  if (reflects && max_component(m.ks) > max_component(m.kd)) return MtlKind::mirror;
  const bool dull = is_black(m.ks) && !m.given.contains("map_Ks");
  return dull || m.illum == 1 ? MtlKind::diffuse : MtlKind::glossy;
}

int add_bsdf(const MtlMaterial& m, Scene& scene) {
  warn_of_other_maps(m, scene);
  if (kind(m) == MtlKind::glass) return add_relief(m, add_glass(m, scene), scene);
  const int surface = add_relief(m, add_opaque(m, scene), scene);
  const Texture* map = load_map(m, {"map_d"}, MtlMapUse::data, scene);
  if (opaque(m) && !map) return surface;
  const Rgb opacity(m.opacity);
  return add(make_mask(*scene.bsdfs[static_cast<std::size_t>(surface)],
                       map ? Color(*map, opacity) : Color(opacity)),
             scene);
}

Color emission(const MtlMaterial& m, Scene& scene) {
  const Texture* map = load_map(m, {"map_Ke"}, MtlMapUse::colour, scene);
  if (!map) return m.ke;
  return Color(*map, is_black(m.ke) ? Rgb(1) : m.ke);
}

int add_default_bsdf(Scene& scene) { return add_two_sided(make_diffuse(Rgb(kDefaultGrey)), scene); }

}  // namespace octolux
