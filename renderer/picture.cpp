// picture.h.
#include "renderer/picture.h"

#include <fmt/format.h>

#include <type_traits>

namespace octolux {

ExrFile make_exr(const Scene& scene, const RenderConfig& wanted, const Progress& progress,
                 const Film& film, bool split) {
  const RenderConfig config =
      resolved(wanted, static_cast<std::int64_t>(film.width()) * film.height());
  ExrFile file;
  file.width = film.width();
  file.height = film.height();
  file.layers.push_back(rgb_layer("", film.radiance()));
  file.layers.push_back(rgb_layer("albedo", film.albedo()));
  Layer normal = rgb_layer("normal", film.normal());
  normal.channels = {"X", "Y", "Z"};
  file.layers.push_back(std::move(normal));
  file.layers.push_back({"depth", {"Z"}, {film.depth()}});
  file.layers.push_back(rgb_layer("variance", film.variance()));
  if (split) {
    file.layers.push_back(rgb_layer("direct", film.direct()));
    file.layers.push_back(rgb_layer("caustic", film.caustic()));
    file.layers.push_back(rgb_layer("indirect", film.indirect()));
  }

  auto& text = file.attributes.text;
  auto& number = file.attributes.number;
  text["octolux.version"] = OCTOLUX_VERSION;
  text["octolux.sceneHash"] = fmt::format("{:016x}", scene.hash);
  text["octolux.integrator"] = config.integrator == Integrator::photon ? "photon" : "path";
  visit(config, [&](const std::string& name, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::string>) {
      text["octolux." + name] = value;
    } else {
      number["octolux." + name] = static_cast<double>(value);
    }
  });
  number["octolux.photons.caustic"] = static_cast<double>(progress.caustic_paths);
  number["octolux.directSamples"] = static_cast<double>(progress.direct_samples);
  number["octolux.passes"] = progress.passes;
  number["octolux.photonsGlobal"] = static_cast<double>(progress.global_photons);
  number["octolux.photonsCaustic"] = static_cast<double>(progress.caustic_photons);
  number["samplesPerPixel"] = static_cast<double>(progress.passes) * config.eye.samples_per_pass;
  number["renderTimeSeconds"] = progress.seconds;
  return file;
}

}  // namespace octolux
