// <texture>: bitmap, checkerboard and mesh attributes, in both dialects (0.5/0.6: uscale, voffset
// ..., gamma).
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

/// Textures are reflectances and opacities: [0, 1].
void clamp_pixels(Image& image, const Properties& p, SceneBuilder& b) {
  const auto clamped = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; };
  bool changed = false;
  for (Rgb& c : image.pixels) {
    const Rgb inside{clamped(c.r), clamped(c.g), clamped(c.b)};
    changed = changed || !(inside == c);
    c = inside;
  }
  if (changed) b.warn(p.where("filename"), "the image has values outside [0, 1]; clamped");
}

TextureFilter read_filter(Properties& p, SceneBuilder& b) {
  const std::string name = p.choice("filter_type", {"bilinear", "nearest", "trilinear", "ewa"});
  if (name == "trilinear" || name == "ewa") {
    b.warn(p.where("filter_type"), "the texture filter '" + name + "' is replaced by 'bilinear'");
  }
  return name == "nearest" ? TextureFilter::nearest : TextureFilter::bilinear;
}

TextureWrap read_wrap(Properties& p) {
  const std::string name = p.choice("wrap_mode", {"repeat", "mirror", "clamp"});
  return name == "repeat"   ? TextureWrap::repeat
         : name == "mirror" ? TextureWrap::mirror
                            : TextureWrap::clamp;
}

Made bitmap(Properties& p, SceneBuilder& b) {
  p.ignore({"format", "accel", "cache", "max_anisotropy"});
  Image image = read_pixels(p, b.file(p, "filename"));
  clamp_pixels(image, p, b);
  return make_bitmap_texture(
      std::move(image),
      {.to_uv = read_uv_map(p), .filter = read_filter(p, b), .wrap = read_wrap(p)});
}

Made checkerboard(Properties& p, SceneBuilder& b) {
  const Rgb color0 = b.constant_color(p, "color0", 0.4f);
  const Rgb color1 = b.constant_color(p, "color1", 0.2f);
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
