// xml_bsdfs.h: names, parameters and defaults of Mitsuba's BSDF adapters.
#include <string>
#include <vector>

#include "core/bsdf_adapters.h"
#include "renderer/xml_bsdfs.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

/// The nested <bsdf>s, `least` to `most` of them.
std::vector<const XmlNode*> read_nested(Properties& p, std::size_t least, std::size_t most) {
  std::vector<const XmlNode*> nested = p.objects("bsdf");
  if (nested.size() >= least && nested.size() <= most) return nested;
  const std::string range = least == most ? (most == 1 ? "one" : "two")
                            : most == 2   ? "one or two"
                                          : "one or more";
  fail(p.node().where, "bsdf '" + p.type() + "' needs " + range + " nested <bsdf>; there are " +
                           std::to_string(nested.size()));
}

const Bsdf& read_inner(Properties& p, SceneBuilder& b) {
  const int inner = b.bsdf(*read_nested(p, 1, 1).front());
  return *b.scene().bsdfs[static_cast<std::size_t>(inner)];
}

/// The only nested <texture>, whatever its name.
const Texture& read_texture(Properties& p, SceneBuilder& b) {
  const std::vector<const XmlNode*> textures = p.objects("texture");
  if (textures.size() == 1) return b.texture(*textures.front());
  fail(p.node().where, "bsdf '" + p.type() + "' needs one nested <texture>; there are " +
                           std::to_string(textures.size()));
}

/// The type of a BSDF below `object` that lets light through, or "".
std::string transmitting_type(const XmlNode& object) {
  const std::string& type = object.required("type");
  if (type.find("dielectric") != std::string::npos) return type;
  if (type == "mask" || type == "null" || type == "difftrans") return type;
  for (const XmlNode& child : object.children) {
    const std::string* name = child.attribute("name");
    const std::string parameter = name ? parameter_name(*name) : "";
    if (parameter == "spec_trans" || parameter == "diff_trans") return type;
  }
  for (const XmlNode& child : object.children) {
    if (child.object().tag != "bsdf") continue;
    const std::string found = transmitting_type(child.object());
    if (!found.empty()) return found;
  }
  return "";
}

/// A tilt inside a tilt would be lost: the inner one looks at the untilted surface.
void refuse_tilt_inside(const Properties& p) {
  for (const XmlNode& child : p.node().children) {
    if (child.object().tag != "bsdf") continue;
    const std::string& type = child.object().required("type");
    if (type == "bump" || type == "bumpmap" || type == "normalmap") {
      fail(child.where, "a " + p.type() + " cannot hold a " + type);
    }
  }
}

TiltRepairs read_repairs(Properties& p, const SceneBuilder& b) {
  const bool fallback = !b.old_dialect();
  return {.mirror = p.boolean("flip_invalid_normals").value_or(fallback),
          .fade = p.boolean("use_shadowing_function").value_or(fallback)};
}

}  // namespace

std::unique_ptr<Bsdf> make_two_sided_bsdf(Properties& p, SceneBuilder& b) {
  const std::vector<const XmlNode*> nested = read_nested(p, 1, 2);
  for (const XmlNode* object : nested) {
    const std::string type = transmitting_type(*object);
    if (!type.empty()) {
      fail(object->where, "a twosided bsdf cannot hold a '" + type + "', which lets light through");
    }
  }
  const auto front = static_cast<std::size_t>(b.bsdf(*nested.front()));
  const auto back = static_cast<std::size_t>(b.bsdf(*nested.back()));
  return make_two_sided(*b.scene().bsdfs[front], *b.scene().bsdfs[back]);
}

std::unique_ptr<Bsdf> make_mask_bsdf(Properties& p, SceneBuilder& b) {
  const Bsdf& inner = read_inner(p, b);
  return make_mask(inner, b.color(p, "opacity", 0.5f));
}

std::unique_ptr<Bsdf> make_coating_bsdf(Properties& p, SceneBuilder& b) {
  const Bsdf& inner = read_inner(p, b);
  CoatingConfig config{.eta = read_eta(p, "bk7"),
                       .thickness = p.number("thickness").value_or(1),
                       .specular_reflectance = b.constant_color(p, "specular_reflectance", 1)};
  if (!(config.thickness >= 0)) p.fail("thickness", "'thickness' must not be negative");
  const XmlNode* sigma = p.find("sigma_a");
  if (sigma && sigma->object().tag == "texture") {
    config.sigma_a = Color(b.texture(sigma->object()));
  } else {
    config.sigma_a = p.color("sigma_a", ColorRole::ior).value_or(Rgb(0));
  }
  return make_coating(inner, config);
}

std::unique_ptr<Bsdf> make_bump_map_bsdf(Properties& p, SceneBuilder& b) {
  refuse_tilt_inside(p);
  const Bsdf& inner = read_inner(p, b);
  const Scalar height(read_texture(p, b));
  return make_bump_map(inner, height, p.number("scale").value_or(1), read_repairs(p, b));
}

std::unique_ptr<Bsdf> make_normal_map_bsdf(Properties& p, SceneBuilder& b) {
  refuse_tilt_inside(p);
  const Bsdf& inner = read_inner(p, b);
  return make_normal_map(inner, Color(read_texture(p, b)), read_repairs(p, b));
}

std::unique_ptr<Bsdf> make_blend_bsdf(Properties& p, SceneBuilder& b) {
  const std::vector<const XmlNode*> nested = read_nested(p, 2, 2);
  const auto first = static_cast<std::size_t>(b.bsdf(*nested.front()));
  const auto second = static_cast<std::size_t>(b.bsdf(*nested.back()));
  const Scalar weight = b.scalar(p, "weight", 0.5f);
  return make_blend(*b.scene().bsdfs[first], *b.scene().bsdfs[second], weight);
}

std::unique_ptr<Bsdf> make_mixture_bsdf(Properties& p, SceneBuilder& b) {
  const std::vector<const XmlNode*> nested = read_nested(p, 1, 1000);
  const std::vector<double> weights =
      parse_numbers(p.text("weights").value_or(""), p.where("weights"));
  if (weights.size() != nested.size()) {
    p.fail("weights", "'weights' needs a number for each of the " + std::to_string(nested.size()) +
                          " nested <bsdf>s");
  }
  double total = 0;
  for (const double w : weights) {
    if (!(w >= 0)) p.fail("weights", "'weights' must not be negative");
    total += w;
  }
  if (total > 1) b.warn(p.where("weights"), "'weights' add up to more than 1; scaled to 1");
  std::vector<WeightedBsdf> parts;
  for (std::size_t i = 0; i < nested.size(); ++i) {
    const auto index = static_cast<std::size_t>(b.bsdf(*nested[i]));
    parts.push_back(
        {b.scene().bsdfs[index].get(), static_cast<float>(weights[i] / std::max(1.0, total))});
  }
  return make_mixture(parts);
}

}  // namespace octolux
