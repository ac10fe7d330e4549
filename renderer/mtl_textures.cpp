// mtl_textures.h.
#include "renderer/mtl_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include "core/bsdf_adapters.h"
#include "core/file_io.h"
#include "core/hash.h"
#include "core/image_io.h"
#include "renderer/find_file.h"

namespace octolux {
namespace {

constexpr const char* kReadKeys[] = {"map_Kd", "map_Ks",   "map_Ke",   "map_d",
                                     "bump",   "map_bump", "map_Bump", "norm"};

const MtlMap* find_map(const MtlMaterial& m, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    for (const MtlMap& map : m.maps) {
      if (map.key == key) return &map;
    }
  }
  return nullptr;
}

void warn(const MtlMaterial& m, const MtlMap& map, const char* what, Scene& scene) {
  scene.warnings.push_back(
      fmt::format("{}: material '{}': {}: {} {}", m.place, m.name, what, map.key, map.file));
}

/// -o and -s count from the lower left corner, as the file's v does; our v from the top.
Affine to_uv(const MtlMap& map) {
  return translation(map.offset.x, 1 - map.scale.y - map.offset.y, 0) *
         scaling(map.scale.x, map.scale.y, 1);
}

const Texture* load(const MtlMaterial& m, const MtlMap& map, MtlMapUse use, Scene& scene) {
  const std::string mtl = m.place.substr(0, m.place.rfind(':'));
  const std::string folder = std::filesystem::path(mtl).parent_path().string();
  const std::optional<FoundFile> path = find_file({folder}, map.file);
  if (!path) {
    warn(m, map, "texture file not found", scene);
    return nullptr;
  }
  scene.hash = hash_bytes(scene.hash, read_file(path->path));
  Image image =
      read_image(path->path, use == MtlMapUse::colour ? Encoding::automatic : Encoding::linear);
  for (Rgb& c : image.pixels) c = {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
  const TextureWrap wrap = map.clamp ? TextureWrap::clamp : TextureWrap::repeat;
  scene.textures.push_back(
      make_bitmap_texture(std::move(image), {.to_uv = to_uv(map), .wrap_u = wrap, .wrap_v = wrap}));
  return scene.textures.back().get();
}

/// Normals in the frame of the surface are about (0.5, 0.5, 1) when written as a colour.
bool holds_normals(const Texture& texture) {
  const Rgb c = texture.mean();
  return c.b > 0.75f && c.r < 0.8f * c.b && c.g < 0.8f * c.b;
}

}  // namespace

const Texture* load_map(const MtlMaterial& material, std::initializer_list<const char*> keys,
                        MtlMapUse use, Scene& scene) {
  const MtlMap* map = find_map(material, keys);
  return map ? load(material, *map, use, scene) : nullptr;
}

int add_relief(const MtlMaterial& material, int index, Scene& scene) {
  const MtlMap* map = find_map(material, {"norm", "bump", "map_bump", "map_Bump"});
  const Texture* texture = map ? load(material, *map, MtlMapUse::data, scene) : nullptr;
  if (!texture) return index;
  const Bsdf& inner = *scene.bsdfs[static_cast<std::size_t>(index)];
  if (map->key == "norm" || holds_normals(*texture)) {
    scene.bsdfs.push_back(make_normal_map(inner, Color(*texture)));
  } else {
    scene.bsdfs.push_back(make_bump_map(inner, Scalar(*texture), map->bump));
  }
  return static_cast<int>(scene.bsdfs.size()) - 1;
}

void warn_of_other_maps(const MtlMaterial& material, Scene& scene) {
  for (const MtlMap& map : material.maps) {
    const bool read = std::any_of(std::begin(kReadKeys), std::end(kReadKeys),
                                  [&](const char* key) { return map.key == key; });
    if (!read) warn(material, map, "texture map ignored", scene);
  }
}

}  // namespace octolux
