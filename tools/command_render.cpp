// `octolux render`: everything that can be refused is refused before the scene is read; then the
// passes (session.h), and what there is to say about the result.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "core/error.h"
#include "core/parallel.h"
#include "renderer/picture.h"
#include "renderer/render.h"
#include "tools/commands.h"
#include "tools/display_arguments.h"
#include "tools/picture_writer.h"
#include "tools/progress.h"
#include "tools/scene_arguments.h"
#include "tools/session.h"
#include "tools/settings.h"

namespace octolux {
namespace {

constexpr int kNotFinite = 1;
constexpr int kInterrupted = 130;

/// The largest film side, and the most pixels.
constexpr int kMaxSide = 1 << 16;
constexpr double kMaxPixels = 1 << 28;

struct FilmExtent {
  int width = 0, height = 0;
};

FilmExtent parse_size(const std::string& text) {
  const std::string source = "--size " + text;
  const auto x = text.find('x');
  if (x == std::string::npos) throw Error(source + ": expected WIDTHxHEIGHT, such as 640x480");
  const FilmExtent size{parse_int(source, text.substr(0, x), 1, kMaxSide),
                        parse_int(source, text.substr(x + 1), 1, kMaxSide)};
  if (static_cast<double>(size.width) * size.height > kMaxPixels) {
    throw Error(source + ": expected at most 2^28 pixels");
  }
  return size;
}

/// Gives the film another size; a crop window keeps its share of it.
void resize(Scene& scene, FilmExtent size) {
  FilmSize& film = scene.film;
  const double sx = static_cast<double>(size.width) / film.width;
  const double sy = static_cast<double>(size.height) / film.height;
  const auto scaled = [](int value, double scale) {
    return static_cast<int>(std::lround(value * scale));
  };
  const int right = scaled(film.crop_x + film.crop_width, sx);
  const int bottom = scaled(film.crop_y + film.crop_height, sy);
  film.crop_x = std::min(scaled(film.crop_x, sx), size.width - 1);
  film.crop_y = std::min(scaled(film.crop_y, sy), size.height - 1);
  film.crop_width = std::max(1, right - film.crop_x);
  film.crop_height = std::max(1, bottom - film.crop_y);
  film.width = size.width;
  film.height = size.height;
  scene.camera = Camera(scene.camera_config, film);
}

class RenderCommand final : public Command {
 public:
  RenderCommand(CLI::App& app, std::string command_line);
  bool chosen() const override { return verb_->parsed(); }
  int run() override;

 private:
  /// A setting the user typed, as an option or with --set.
  struct Assignment {
    std::string source;  // e.g. "--passes 12"
    std::string key;
    std::string text;
  };

  void add_setting_options();
  void add_picture_options();
  RenderConfig config() const;
  PictureWriter::Options picture() const;
  std::string describe(const Scene& scene, const RenderConfig& config) const;
  int report(const RenderResult& result, const RenderConfig& config, ProgressPrinter& printer,
             const std::string& names) const;

  CLI::App* verb_;
  std::string command_line_;
  SceneArguments scene_;
  std::string integrator_ = "photon";
  std::vector<Assignment> options_;
  std::vector<std::string> sets_;
  std::string size_, threads_ = "0", output_;
  DisplayArguments display_;
  bool quiet_ = false, no_png_ = false, split_ = false;
};

std::string help_footer() {
  const StopConfig photon = default_stop(Integrator::photon);
  const StopConfig path = default_stop(Integrator::path);
  return fmt::format(
      "The first of --passes, --spp, --time and --error that is reached ends the render. Without\n"
      "any of them: {} passes (path: {}) or an error of {} (path: {}).\n\n"
      "The PNG is shown through the display and view of an OpenColorIO configuration: --ocio, or\n"
      "the one $OCIO names, or our own (display sRGB; views Standard, the plain sRGB curve,\n"
      "'ACES 1.0 SDR' and Raw). The EXR is scene-linear and never changed by them.\n\n"
      "Settings of --set, with their defaults:\n{}\n"
      "Exit codes: 0 done, 1 samples that are not finite or a fault of the program, 2 bad input,\n"
      "130 interrupted (after the picture was written).",
      photon.passes, path.passes, photon.error, path.error, list_settings(RenderConfig{}));
}

RenderCommand::RenderCommand(CLI::App& app, std::string command_line)
    : verb_(app.add_subcommand("render", "Render a scene to an EXR, and a PNG beside it")),
      command_line_(std::move(command_line)) {
  scene_.add_to(*verb_);
  verb_->add_option("-o,--output", output_, "Picture to write; default: the scene's name, here")
      ->type_name("FILE.exr");
  verb_->add_option("--integrator", integrator_, "photon: photon mapping; path: unbiased reference")
      ->type_name("photon|path")
      ->capture_default_str();
  add_setting_options();
  add_picture_options();
  verb_->footer(help_footer());
}

void RenderCommand::add_setting_options() {
  for (const Shortcut& shortcut : shortcuts()) {
    const auto store = [this, &shortcut](const std::string& text) {
      options_.push_back({std::string(shortcut.option) + " " + text, shortcut.key, text});
      if (shortcut.positive && parse_number(options_.back().source, text) <= 0) {
        throw Error(options_.back().source + ": expected a number above 0");
      }
    };
    CLI::Option* option =
        verb_->add_option_function<std::string>(shortcut.option, store, shortcut.help);
    option->type_name(shortcut.value);
    if (!shortcut.positive) option->default_str(get_setting(RenderConfig{}, shortcut.key));
  }
  verb_->add_option("--set", sets_, "Any setting listed below; repeatable; options win over it")
      ->type_name("key=value")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb_->add_option("--threads", threads_, "Threads; 0: all processors. Never changes the picture")
      ->type_name("N")
      ->capture_default_str();
}

void RenderCommand::add_picture_options() {
  verb_->add_option("--size", size_, "Film size in pixels, instead of the scene's")
      ->type_name("WxH");
  verb_->add_flag("--split", split_, "Add the layers direct, caustic and indirect to the EXR");
  verb_->add_flag("--no-png", no_png_, "Write the EXR only");
  display_.add_to(*verb_, "the PNG");
  verb_->add_flag("--quiet", quiet_, "Say nothing but errors");
}

RenderConfig RenderCommand::config() const {
  RenderConfig config;
  config.integrator = parse_integrator(integrator_);
  for (const std::string& set : sets_) {
    const auto equals = set.find('=');
    if (equals == std::string::npos) throw Error("--set " + set + ": expected key=value");
    set_setting(config, "--set " + set, set.substr(0, equals), set.substr(equals + 1));
  }
  for (const Assignment& option : options_) {
    set_setting(config, option.source, option.key, option.text);
  }
  check(config);
  if (split_ && config.integrator == Integrator::path) {
    throw Error("--split: a path tracer does not tell the layers apart; expected photon");
  }
  return config;
}

PictureWriter::Options RenderCommand::picture() const {
  PictureWriter::Options options{output_, !no_png_, display_.options()};
  if (output_.empty()) {
    options.exr_path = std::filesystem::path(scene_.path).stem().string() + ".exr";
  }
  return options;
}

std::string RenderCommand::describe(const Scene& scene, const RenderConfig& config) const {
  std::size_t primitives = 0;
  for (const Shape& shape : scene.shapes) primitives += primitive_count(shape);
  const std::string method =
      config.integrator == Integrator::path
          ? "path tracing"
          : fmt::format("photon mapping ({}, {} neighbours{})", config.estimator.kernel,
                        config.estimator.neighbours, config.eye.gather ? "" : ", no final gather");
  return fmt::format("{}: primitives {}, emitters {}, pixels {}x{}, {}, threads {}", scene_.path,
                     primitives, scene.lights.size(), scene.film.crop_width, scene.film.crop_height,
                     method, thread_count());
}

/// The last words, and the exit code.
int RenderCommand::report(const RenderResult& result, const RenderConfig& config,
                          ProgressPrinter& printer, const std::string& names) const {
  const Progress& p = result.progress;
  printer.say(fmt::format("{} passes in {:.1f} s, error {:.3g} %; wrote {}", p.passes, p.seconds,
                          100 * p.error, names));
  if (result.film.non_finite() > 0 || p.rejected_photons > 0) {
    const Film::Place place = result.film.first_non_finite();
    fmt::print(stderr,
               "octolux: left out {} samples (first: pixel {},{} of pass {}, seed {}) and {} "
               "photons that were not finite: please report this\n",
               result.film.non_finite(), place.x, place.y, place.pass, config.seed,
               p.rejected_photons);
    return kNotFinite;
  }
  return result.interrupted ? kInterrupted : 0;
}

int RenderCommand::run() {
  const RenderConfig settings = config();
  std::optional<FilmExtent> size;
  if (!size_.empty()) size = parse_size(size_);
  const ThreadLimit threads(parse_int("--threads " + threads_, threads_, 0, 4096));
  const PictureWriter writer(picture());
  ProgressPrinter printer(quiet_ ? Verbosity::quiet : default_verbosity());

  const std::unique_ptr<Scene> scene = scene_.load(printer);
  if (size) resize(*scene, *size);
  for (const std::string& warning : scene->warnings) printer.say("warning: " + warning);
  printer.say(describe(*scene, settings));

  Session session(printer, [&](const Progress& progress, const Film& film) {
    ExrFile file = make_exr(*scene, settings, progress, film, split_);
    file.attributes.text["octolux.command"] = command_line_;
    writer.write(file);
  });
  const RenderResult result = render(*scene, settings, session);
  session.finish(result);
  return report(result, settings, printer, writer.names());
}

}  // namespace

std::unique_ptr<Command> make_render_command(CLI::App& app, const std::string& command_line) {
  return std::make_unique<RenderCommand>(app, command_line);
}

}  // namespace octolux
