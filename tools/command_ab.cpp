// `octolux ab`: one scene by several kernels, against a reference; what leaks where. Every render
// is kept as it grows, so the same command goes on after an interruption, and whatever is already
// there is not rendered again.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "core/error.h"
#include "core/file_io.h"
#include "core/parallel.h"
#include "renderer/picture.h"
#include "tools/ab/pictures.h"
#include "tools/ab/render_store.h"
#include "tools/ab/report.h"
#include "tools/ab/result_folder.h"
#include "tools/commands.h"
#include "tools/display_arguments.h"
#include "tools/picture_writer.h"
#include "tools/reference/reference.h"
#include "tools/scene_arguments.h"
#include "tools/session.h"
#include "tools/setting_arguments.h"
#include "tools/settings.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;

constexpr int kNotFinite = 1;
constexpr int kInterrupted = 130;

/// Renders that need more than this are announced.
constexpr double kMuchMemory = 1e9;  // bytes

/// Without --passes and --time.
constexpr int kDefaultPasses = 32;

/// Settings that --kernel, --gather and the two stop rules decide.
const std::vector<std::string> kTaken = {"estimator.kernel", "estimator.correction", "eye.gather",
                                         "stop.samples", "stop.error"};

double positive(const std::string& option, const std::string& text) {
  const double value = parse_number(option + " " + text, text);
  if (!(value > 0)) throw Error(option + " " + text + ": expected a number above 0");
  return value;
}

std::string help_footer() {
  return fmt::format(
      "Kernels are those of octolux render, with options: octobox, octobox:published (correction\n"
      "off), octobox:eight, feeler:published, ... All renders have equal photons (--passes; {} if\n"
      "nothing is said) or equal time (--time), and everything else the same.\n\n"
      "Writes into the folder: for each kernel and gathering an EXR and a PNG, ab.png (the "
      "pictures\n"
      "side by side), leaks.png (heat maps of too bright and too dark), index.html (a page to "
      "wipe,\n"
      "blink, zoom and read values, with the table), ab.json (every number), table.md, one PNG "
      "for\n"
      "each mask, and renders/: what is needed to go on. Interrupted, the same command goes on "
      "where\n"
      "it was; more --passes or --time continue the renders that are there.\n\n"
      "Leaks are in units of the reference's mean over the image. They are given for all pixels, "
      "and\n"
      "for surfaces near walls and edges, in the open, and sealed ones, where the reference is "
      "black.\n\n"
      "Settings of --set, with their defaults:\n{}\n"
      "Exit codes: 0 done, 1 samples that are not finite or a fault of the program, 2 bad input,\n"
      "130 interrupted (nothing is lost).",
      kDefaultPasses, list_settings(RenderConfig{}, kTaken));
}

class AbCommand final : public Command {
 public:
  AbCommand(CLI::App& app, std::string command_line);
  bool chosen() const override { return verb_->parsed(); }
  int run() override;

 private:
  void add_reference_options();
  std::vector<AbRender> plan() const;
  ReferenceOptions reference() const;
  std::string folder() const;
  std::string file(const std::string& name) const { return (fs::path(folder()) / name).string(); }
  void check_outputs(const std::vector<AbRender>& renders) const;
  PictureWriter writer(const AbRender& render) const;
  void announce_memory(const Scene& scene, std::size_t renders) const;
  bool render_one(const Scene& scene, const AbRender& render, const std::string& count);
  bool render_all(const Scene& scene, const std::vector<AbRender>& renders);
  bool render_reference(const Scene& scene);

  CLI::App* verb_;
  SceneArguments scene_;
  SettingArguments settings_;
  std::vector<std::string> kernels_{"cone", "octobox", "feeler"}, gatherings_{"off"};
  std::string folder_, reach_ = "2", range_, threads_ = "0";
  std::string reference_error_ = "0.005", reference_time_ = "600";
  ReferenceOptions reference_;
  DisplayArguments display_;
  bool quiet_ = false, finite_ = true;
  AbResult result_;
};

AbCommand::AbCommand(CLI::App& app, std::string command_line)
    : verb_(app.add_subcommand("ab", "Render a scene by several kernels; show and measure leaks")) {
  result_.command = std::move(command_line);
  scene_.add_to(*verb_);
  verb_->add_option("-o,--output", folder_, "Folder to write; default: SCENE-ab, here")
      ->type_name("FOLDER");
  verb_->add_option("--kernel", kernels_, "Kernels with their options")
      ->type_name("NAME")
      ->capture_default_str();
  verb_->add_option("--gather", gatherings_, "Final gathering: off, on, or both one after another")
      ->type_name("off|on")
      ->capture_default_str();
  verb_->add_option("--reach", reach_, "How near a wall or an edge is near, in bandwidths")
      ->type_name("B")
      ->capture_default_str();
  verb_->add_option("--range", range_, "Largest leak a heat map tells apart, in units of mean y")
      ->type_name("R");
  add_reference_options();
  settings_.add_to(*verb_, kTaken);
  scene_.add_size_to(*verb_);
  display_.add_to(*verb_, "pictures");
  verb_->add_option("--threads", threads_, "Threads; 0: all processors. Never changes the picture")
      ->type_name("N")
      ->capture_default_str();
  verb_->add_flag("--quiet", quiet_, "Say nothing but errors and the table");
  verb_->footer(help_footer());
}

void AbCommand::add_reference_options() {
  verb_->add_option("--reference", reference_.file, "Reference; default: path traced, and kept")
      ->type_name("FILE.exr");
  verb_->add_option("--references", reference_.folder, "Where path traced references are kept")
      ->type_name("FOLDER")
      ->capture_default_str();
  verb_
      ->add_option("--reference-error", reference_error_,
                   "Path trace it to this mean relative standard error")
      ->type_name("E")
      ->capture_default_str();
  verb_->add_option("--reference-time", reference_time_, "Or for so long, all runs together")
      ->type_name("SECONDS")
      ->capture_default_str();
}

std::vector<AbRender> AbCommand::plan() const {
  RenderConfig config = settings_.apply(RenderConfig{});
  if (config.stop.passes == 0 && config.stop.seconds == 0) config.stop.passes = kDefaultPasses;
  if (config.stop.passes > 0 && config.stop.seconds > 0) {
    throw Error("--passes and --time: expected one of them, for equal photons or for equal time");
  }
  return plan_renders(config, kernels_, gatherings_);
}

ReferenceOptions AbCommand::reference() const {
  ReferenceOptions options = reference_;
  options.error = positive("--reference-error", reference_error_);
  options.seconds = positive("--reference-time", reference_time_);
  return options;
}

std::string AbCommand::folder() const {
  return folder_.empty() ? fs::path(scene_.path).stem().string() + "-ab" : folder_;
}

PictureWriter AbCommand::writer(const AbRender& render) const {
  return PictureWriter({file(render.stem + ".exr"), true, display_.options()});
}

/// Makes the folders, too.
void AbCommand::check_outputs(const std::vector<AbRender>& renders) const {
  check_display(display_.options());
  std::error_code code;
  fs::create_directories(file("renders"), code);
  if (code) throw Error(folder() + ": cannot be made: " + code.message());
  for (const std::string& name : result_files()) check_writable(file(name));
  check_writable(file("renders/new.render"));
  for (const AbRender& render : renders) writer(render);
}

void AbCommand::announce_memory(const Scene& scene, std::size_t renders) const {
  // Per pixel: sums and passes of the render at work; mean and variance of all pictures, their
  // fields and the page.
  const double bytes = (300.0 + 100.0 * static_cast<double>(renders + 1)) * scene.film.crop_width *
                       scene.film.crop_height;
  if (bytes > kMuchMemory) {
    fmt::print(stderr, "octolux: the pictures take {:.1f} GB of memory\n", 1e-9 * bytes);
  }
}

/// Goes on from what is kept; false if interrupted.
bool AbCommand::render_one(const Scene& scene, const AbRender& render, const std::string& count) {
  ProgressPrinter printer(quiet_ ? Verbosity::quiet : default_verbosity());
  StoredRender store(file("renders"), scene, render.config);
  std::optional<RenderResult> kept = store.load();
  const int kept_passes = kept ? kept->film.passes() : 0;
  std::string line = fmt::format("{} {}, gather {}", count, render.config.estimator.kernel,
                                 render.config.eye.gather ? "on" : "off");
  if (!render.config.estimator.correction) line += ", published";
  if (kept_passes > 0) line += fmt::format(": {} passes are there", kept_passes);
  printer.say(line);
  Session session(printer, [&](const Progress& p, const Film& film) { store.save(p, film); });
  const RenderResult done = octolux::render(scene, render.config, session, std::move(kept));
  if (done.film.passes() != kept_passes) session.finish(done);
  if (done.interrupted) return false;

  finite_ = report_non_finite(done, render.config.seed) && finite_;
  ExrFile exr = make_exr(scene, render.config, done.progress, done.film, false);
  exr.attributes.text["octolux.command"] = result_.command;
  writer(render).write(exr);
  std::erase_if(exr.layers, [](const Layer& l) { return !l.name.empty() && l.name != "variance"; });
  result_.pictures.push_back({render, done.progress, {render.name, std::move(exr)}, {}});
  return true;
}

bool AbCommand::render_all(const Scene& scene, const std::vector<AbRender>& renders) {
  for (std::size_t i = 0; i < renders.size(); ++i) {
    const std::string count = fmt::format("[{}/{}]", i + 1, renders.size() + 1);
    if (!render_one(scene, renders[i], count)) return false;
  }
  return true;
}

bool AbCommand::render_reference(const Scene& scene) {
  ProgressPrinter printer(quiet_ ? Verbosity::quiet : default_verbosity());
  const std::size_t last = result_.pictures.size() + 1;
  printer.say(fmt::format("[{}/{}] reference", last, last));
  Session session(printer, [](const Progress&, const Film&) {});  // it saves itself
  Reference got = obtain_reference(reference(), scene, session);
  if (got.interrupted) return false;
  result_.reference = std::move(got.picture);
  result_.reference_origin = got.origin;
  return true;
}

int AbCommand::run() {
  std::vector<AbRender> renders = plan();
  const ReferenceOptions reference_options = reference();
  scene_.check();
  const double reach = positive("--reach", reach_);
  if (!range_.empty()) positive("--range", range_);
  const ThreadLimit threads(parse_int("--threads " + threads_, threads_, 0, 4096));

  ProgressPrinter printer(quiet_ ? Verbosity::quiet : default_verbosity());
  const std::unique_ptr<Scene> scene = scene_.load(printer);
  const FilmSize& film = scene->film;
  for (AbRender& r : renders) {
    r.config = resolved(r.config, std::int64_t{film.crop_width} * film.crop_height);
  }
  check_outputs(renders);
  check_reference(reference_options, *scene);
  announce_memory(*scene, renders.size());
  for (const std::string& warning : scene->warnings) printer.say("warning: " + warning);
  if (!render_all(*scene, renders) || !render_reference(*scene)) {
    printer.say("interrupted; the same command goes on from here");
    return kInterrupted;
  }
  result_.scene = scene_.path;
  result_.scene_hash = scene->hash;
  result_.seen = see_surfaces(*scene, renders.front().config, reach);
  measure(result_);
  const double range = range_.empty() ? leak_range(result_) : positive("--range", range_);
  write_results(result_, folder(), display_.options(), range);
  fmt::print("{}", to_markdown(result_));
  printer.say("wrote " + file("index.html") + ", ab.png, leaks.png, ab.json and more beside it");
  return finite_ ? 0 : kNotFinite;
}

}  // namespace

std::unique_ptr<Command> make_ab_command(CLI::App& app, const std::string& command_line) {
  return std::make_unique<AbCommand>(app, command_line);
}

}  // namespace octolux
