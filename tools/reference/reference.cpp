// reference.h. A kept reference is a checkpoint, from which it goes on, and an EXR of the same name
// for people and other programs.
#include "tools/reference/reference.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/file_io.h"
#include "renderer/checkpoint.h"
#include "renderer/picture.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;

/// Far from any seed a user would choose, so that no image shares its random numbers.
constexpr std::uint64_t kReferenceSeed = 0x7265666572656e63;

/// Time between two savings of an unfinished reference.
constexpr std::chrono::seconds kSaveInterval(20);

RenderConfig reference_config(const ReferenceOptions& options) {
  RenderConfig config;
  config.integrator = Integrator::path;
  config.seed = kReferenceSeed;
  config.stop.error = options.error;
  config.stop.seconds = options.seconds;
  return config;
}

/// "FOLDER/HASH-WxH", to which ".exr" and ".state" are added; crop windows are named too.
std::string kept_path(const ReferenceOptions& options, const Scene& scene) {
  const FilmSize& film = scene.film;
  std::string name = fmt::format("{:016x}-{}x{}", scene.hash, film.crop_width, film.crop_height);
  if (film.crop_width != film.width || film.crop_height != film.height) {
    name += fmt::format("+{}+{}of{}x{}", film.crop_x, film.crop_y, film.width, film.height);
  }
  return (fs::path(options.folder) / name).string();
}

/// Saves now and then, and passes on what it hears.
class Keeper final : public RenderObserver {
 public:
  Keeper(std::string path, std::string of, RenderObserver& listener)
      : path_(std::move(path)), provenance_(std::move(of)), listener_(listener) {}

  bool pass_done(const Progress& progress, const Film& film) override {
    const auto now = std::chrono::steady_clock::now();
    if (now - last_save_ >= kSaveInterval) {
      save(progress, film);
      last_save_ = now;
    }
    return listener_.pass_done(progress, film);
  }
  void save(const Progress& progress, const Film& film) const {
    write_file(path_, to_checkpoint(provenance_, progress, film));
  }

 private:
  std::string path_, provenance_;
  RenderObserver& listener_;
  std::chrono::steady_clock::time_point last_save_ = std::chrono::steady_clock::now();
};

/// What there is already of a reference; nothing if it was made by another program.
std::optional<RenderResult> load_kept(const std::string& path, const std::string& provenance,
                                      const FilmSize& film) {
  if (!fs::exists(path)) return std::nullopt;
  return from_checkpoint(read_file(path), provenance, film);
}

/// The whole number of reference pixels along a pixel's side. Throws Error if there is none.
int multiple_of_film(const std::string& path, int width, int height, const FilmSize& film) {
  const int factor = std::max(1, width / film.crop_width);
  if (width != factor * film.crop_width || height != factor * film.crop_height) {
    throw Error(fmt::format("{}: is {}x{}; expected the film's size, {}x{}, or a multiple", path,
                            width, height, film.crop_width, film.crop_height));
  }
  return factor;
}

ExrFile given_header(const std::string& path) {
  std::optional<ExrFile> header = exr_header(path);
  if (!header) throw Error(path + ": expected an EXR as a reference");
  return *std::move(header);
}

Reference given_reference(const std::string& path, const FilmSize& film) {
  NamedPicture picture = load_picture(path, {""});
  const int factor = multiple_of_film(path, picture.file.width, picture.file.height, film);
  std::string origin = path;
  if (factor > 1) {
    picture = shrink_picture(picture, factor);
    origin += fmt::format(", averaged down by {}", factor);
  }
  return {std::move(picture), origin, false};
}

}  // namespace

void check_reference(const ReferenceOptions& options, const Scene& scene) {
  if (!options.file.empty()) {
    const ExrFile header = given_header(options.file);
    multiple_of_film(options.file, header.width, header.height, scene.film);
    check_layers(options.file, {""});
    return;
  }
  std::error_code code;
  fs::create_directories(options.folder, code);
  check_writable(kept_path(options, scene) + ".state");
}

Reference obtain_reference(const ReferenceOptions& options, const Scene& scene,
                           RenderObserver& observer) {
  check_reference(options, scene);
  if (!options.file.empty()) return given_reference(options.file, scene.film);
  const RenderConfig config = reference_config(options);
  const std::string path = kept_path(options, scene);
  const std::string of = provenance(scene, config);
  std::optional<RenderResult> kept = load_kept(path + ".state", of, scene.film);
  const int kept_passes = kept ? kept->film.passes() : 0;

  Keeper keeper(path + ".state", of, observer);
  const RenderResult result = render(scene, config, keeper, std::move(kept));
  ExrFile file = make_exr(scene, config, result.progress, result.film, false);
  if (result.film.passes() != kept_passes) {
    keeper.save(result.progress, result.film);
    write_exr(path + ".exr", file);
  }
  const std::string origin =
      fmt::format("path traced, {} samples per pixel, mean standard error {:.2g} %, {}.exr",
                  result.film.passes(), 100 * result.progress.error, path);
  return {{path + ".exr", std::move(file)}, origin, result.interrupted};
}

NamedPicture shrink_picture(const NamedPicture& picture, int factor) {
  const int width = picture.file.width / factor, height = picture.file.height / factor;
  NamedPicture small{picture.name, {width, height, {}, picture.file.attributes}};
  for (const Layer& layer : picture.file.layers) {
    const int independent = layer.name == "variance" ? factor * factor : 1;
    const double scale = 1.0 / (static_cast<double>(factor) * factor * independent);
    Layer& out = small.file.layers.emplace_back(Layer{layer.name, layer.channels, {}});
    for (const std::vector<float>& plane : layer.planes) {
      std::vector<double> sums(static_cast<std::size_t>(width) * height);
      for (std::size_t i = 0; i < plane.size(); ++i) {
        const std::size_t x = i % picture.file.width, y = i / picture.file.width;
        sums[y / factor * width + x / factor] += plane[i];
      }
      std::vector<float>& averages = out.planes.emplace_back();
      for (const double sum : sums) averages.push_back(static_cast<float>(sum * scale));
    }
  }
  return small;
}

}  // namespace octolux
