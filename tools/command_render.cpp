// `octolux render`: everything that can be refused is refused before the scene is read; then the
// passes (session.h), and what there is to say about the result.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

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
#include "tools/setting_arguments.h"
#include "tools/settings.h"

namespace octolux {
namespace {

constexpr int kNotFinite = 1;
constexpr int kInterrupted = 130;

class RenderCommand final : public Command {
 public:
  RenderCommand(CLI::App& app, std::string command_line);
  bool chosen() const override { return verb_->parsed(); }
  int run() override;

 private:
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
  SettingArguments settings_;
  std::string threads_ = "0", output_;
  DisplayArguments display_;
  bool quiet_ = false, no_png_ = false, split_ = false;
};

std::string help_footer() {
  const StopConfig photon = default_stop(Integrator::photon);
  const StopConfig path = default_stop(Integrator::path);
  return fmt::format(
      "The first of --passes, --spp, --time and --error that is reached ends the render. Without\n"
      "any of them: {} samples per pixel (path: {}) or an error of {} (path: {}).\n\n"
      "The PNG is shown through the display and view of an OpenColorIO configuration: --ocio, or\n"
      "the one $OCIO names, or our own (display sRGB; views Standard, the plain sRGB curve,\n"
      "'ACES 1.0 SDR' and Raw). The EXR is scene-linear and never changed by them.\n\n"
      "Settings of --set, with their defaults:\n{}\n"
      "Exit codes: 0 done, 1 samples that are not finite or a fault of the program, 2 bad input,\n"
      "130 interrupted (after the picture was written).",
      photon.samples, path.samples, photon.error, path.error, list_settings(RenderConfig{}));
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
  settings_.add_to(*verb_);
  verb_->add_option("--threads", threads_, "Threads; 0: all processors. Never changes the picture")
      ->type_name("N")
      ->capture_default_str();
  add_picture_options();
  verb_->footer(help_footer());
}

void RenderCommand::add_picture_options() {
  scene_.add_size_to(*verb_);
  verb_->add_flag("--split", split_, "Add the layers direct, caustic and indirect to the EXR");
  verb_->add_flag("--no-png", no_png_, "Write the EXR only");
  display_.add_to(*verb_, "the PNG");
  verb_->add_flag("--quiet", quiet_, "Say nothing but errors");
}

RenderConfig RenderCommand::config() const {
  RenderConfig config;
  config.integrator = parse_integrator(integrator_);
  config = settings_.apply(config);
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
  if (!report_non_finite(result, config.seed)) return kNotFinite;
  return result.interrupted ? kInterrupted : 0;
}

int RenderCommand::run() {
  const RenderConfig settings = config();
  scene_.check();
  const ThreadLimit threads(parse_int("--threads " + threads_, threads_, 0, 4096));
  const PictureWriter writer(picture());
  ProgressPrinter printer(quiet_ ? Verbosity::quiet : default_verbosity());

  const std::unique_ptr<Scene> scene = scene_.load(printer);
  for (const std::string& warning : scene->warnings) printer.say("warning: " + warning);
  for (const std::string& note : scene->notes) printer.say(note);
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
