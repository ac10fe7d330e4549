// <texture>: bitmap, checkerboard, scale, rawconstant and mesh attributes, in both dialects
// (0.5/0.6: uscale, voffset ..., gamma).
#include <algorithm>
#include <cmath>

#include "core/image_io.h"
#include "core/texture.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

using Made = std::unique_ptr<Texture>;

/// to_uv, or Mitsuba 0.6's scale and offset.
Affine read_uv_map(Properties& p) {
  const float both = p.number("uvscale").value_or(1);
  const float u = p.number("uscale").value_or(both), v = p.number("vscale").value_or(both);
  const float du = p.number("uoffset").value_or(0), dv = p.number("voffset").value_or(0);
  return p.transform("to_uv") * translation(du, dv, 0) * scaling(u, v, 1);
}

/// Undoes the file's encoding, as `raw` and `gamma` say.
Image read_pixels(Properties& p, const std::string& path) {
  const bool raw = p.boolean("raw").value_or(false);
  const float gamma = p.number("gamma").value_or(-1);  // negative: by file format
  if (gamma == 0) p.fail("gamma", "'gamma' must not be 0");
  if (!raw && gamma < 0) return read_image(path, Encoding::automatic);
  Image image = read_image(path, Encoding::linear);
  if (raw || gamma == 1) return image;
  for (Rgb& c : image.pixels) {
    c = {std::pow(c.r, gamma), std::pow(c.g, gamma), std::pow(c.b, gamma)};
  }
  return image;
}

/// Negative values and NaN mean nothing; what is above 1 the user of the texture must cut.
void clamp_pixels(Image& image, const Properties& p, SceneBuilder& b) {
  const auto clamped = [](float x) { return x > 0 ? x : 0.0f; };
  bool changed = false;
  for (Rgb& c : image.pixels) {
    const Rgb inside{clamped(c.r), clamped(c.g), clamped(c.b)};
    changed = changed || !(inside == c);
    c = inside;
  }
  if (changed) b.warn(p.where("filename"), "the image has negative values; clamped");
}

TextureFilter read_filter(Properties& p, SceneBuilder& b) {
  const std::string name = p.choice("filter_type", {"bilinear", "nearest", "trilinear", "ewa"});
  if (name == "trilinear" || name == "ewa") {
    b.warn(p.where("filter_type"), "the texture filter '" + name + "' is replaced by 'bilinear'");
  }
  return name == "nearest" ? TextureFilter::nearest : TextureFilter::bilinear;
}

TextureWrap read_wrap(Properties& p, const std::string& name, TextureWrap fallback) {
  const std::vector<std::string> names{"repeat", "mirror", "clamp", "zero", "one"};
  const std::string text = p.text(name).value_or(names[static_cast<std::size_t>(fallback)]);
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) p.fail(name, unknown_name(name, text, names));
  return static_cast<TextureWrap>(found - names.begin());
}

Made bitmap(Properties& p, SceneBuilder& b) {
  p.ignore({"format", "accel", "cache", "max_anisotropy"});
  const TextureWrap wrap = read_wrap(p, "wrap_mode", TextureWrap::repeat);
  Image image = read_pixels(p, b.file(p, "filename"));
  clamp_pixels(image, p, b);
  return make_bitmap_texture(std::move(image), {.to_uv = read_uv_map(p),
                                                .filter = read_filter(p, b),
                                                .wrap_u = read_wrap(p, "wrap_mode_u", wrap),
                                                .wrap_v = read_wrap(p, "wrap_mode_v", wrap)});
}

Made scale(Properties& p, SceneBuilder& b) {
  const std::vector<const XmlNode*> inner = p.objects("texture");
  if (inner.size() != 1) fail(p.node().where, "a scale texture needs one nested <texture>");
  return make_scale_texture(b.texture(*inner.front()),
                            p.color("scale", ColorRole::ior).value_or(Rgb(1)));
}

/// The same everywhere, as it stands: <vector>, <point> or a colour.
Made raw_constant(Properties& p, SceneBuilder&) {
  const XmlNode* value = p.find("value");
  if (!value) fail(p.node().where, "a rawconstant texture needs 'value'");
  Image image(1, 1);
  if (value->tag == "vector" || value->tag == "point") {
    const Vec3 v = parse_vector(*value);
    image.at(0, 0) = {v.x, v.y, v.z};
  } else {
    image.at(0, 0) = *p.color("value", ColorRole::ior);
  }
  return make_bitmap_texture(std::move(image), {});
}

/// Colours may be above 1: a lamp's are; where they may not be, SceneBuilder::color cuts them.
Made checkerboard(Properties& p, SceneBuilder&) {
  const Rgb color0 = p.color("color0", ColorRole::reflectance).value_or(Rgb(0.4f));
  const Rgb color1 = p.color("color1", ColorRole::reflectance).value_or(Rgb(0.2f));
  return make_checkerboard_texture(color0, color1, read_uv_map(p));
}

/// "vertex_..." or "face_..." of the mesh; 0.6's `vertexcolors` is one of them.
Made mesh_attribute(Properties& p, SceneBuilder&) {
  p.ignore({"name"});
  return make_mesh_attribute_texture(*mesh_attribute_name(p.node()));
}

constexpr Plugin<Made (*)(Properties&, SceneBuilder&)> kPlugins[] = {
    {"bitmap", bitmap},
    {"checkerboard", checkerboard},
    {"scale", scale},
    {"rawconstant", raw_constant},
    {"mesh_attribute", mesh_attribute},
    {"vertexcolors", mesh_attribute},
};

}  // namespace

std::optional<std::string> mesh_attribute_name(const XmlNode& texture) {
  if (texture.required("type") == "vertexcolors") return "vertex_color";
  if (texture.required("type") != "mesh_attribute") return std::nullopt;
  Properties properties(texture);
  const std::optional<std::string> name = properties.text("name");
  if (!name) fail(texture.where, "the parameter 'name' is missing");
  if (!name->starts_with("vertex_") && !name->starts_with("face_")) {
    properties.fail("name", "'name' must begin with 'vertex_' or 'face_'");
  }
  return name;
}

std::unique_ptr<Texture> make_texture(Properties& properties, SceneBuilder& builder) {
  return find_plugin(kPlugins, properties)(properties, builder);
}

}  // namespace octolux
