// `octolux converge`: kernels, integrators and photon counts raced against time (tools/converge/).
// Everything rendered stays in the output folder, so that an interrupted race goes on where it
// stopped, and a longer one starts from what is there.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file_io.h"
#include "core/parallel.h"
#include "tools/commands.h"
#include "tools/compare/comparison_page.h"
#include "tools/compare/report.h"
#include "tools/converge/run.h"
#include "tools/converge/study.h"
#include "tools/converge_arguments.h"
#include "tools/display_arguments.h"
#include "tools/interrupt.h"
#include "tools/progress.h"
#include "tools/scene_arguments.h"
#include "tools/setting_arguments.h"
#include "tools/settings.h"

namespace octolux {
namespace {

namespace fs = std::filesystem;

constexpr int kNotFinite = 1;
constexpr int kInterrupted = 130;
constexpr int kPlotPixels = 2;  // of the PNG, per point of the plot

constexpr char kFooter[] =
    "Error is sqrt(relMSE), less the reference's own noise; bias and noise are told apart by the\n"
    "spread between seeds. Written to the output folder: index.html, converge.csv, .json, .svg\n"
    "and .png, pictures.html, and runs/ with every picture and what to go on from: the same\n"
    "command again renders only what is missing.\n\n"
    "Exit codes: 0 done, 1 samples that are not finite or a fault of the program, 2 bad input,\n"
    "130 interrupted (what there is so far is written).";

/// Shows progress, and hears Ctrl-C.
class Watcher final : public RenderObserver {
 public:
  explicit Watcher(ProgressPrinter& printer) : printer_(printer), interrupt_(!printer.quiet()) {}
  bool pass_done(const Progress& progress, const Film&) override {
    printer_.update(progress);
    return !interrupt_.requested();
  }
  bool stopped() const { return interrupt_.requested(); }

 private:
  ProgressPrinter& printer_;
  Interrupt interrupt_;
};

class ConvergeCommand final : public Command {
 public:
  ConvergeCommand(CLI::App& app, std::string command_line);
  bool chosen() const override { return verb_->parsed(); }
  int run() override;

 private:
  using Job = ConvergeJob;
  /// Runs of one variant, by seed.
  using Runs = std::vector<Run>;

  std::string out(const std::string& name) const { return (fs::path(output_) / name).string(); }
  void prepare_folder() const;
  void announce(const Job& job, ProgressPrinter& printer) const;
  std::vector<Runs> race(const Job& job, const Scene& scene, Watcher& watcher,
                         ProgressPrinter& printer) const;
  Study measure(const Job& job, const Reference& reference, const std::vector<Runs>& runs) const;
  void write(const Study& study, const NamedPicture& reference) const;
  void write_pictures(const Study& study, const NamedPicture& reference) const;

  CLI::App* verb_;
  std::string command_line_;
  SceneArguments scene_;
  SettingArguments settings_;
  ConvergeArguments race_;
  std::string output_ = "converge", threads_ = "0";
  DisplayArguments display_;
  bool quiet_ = false;
};

ConvergeCommand::ConvergeCommand(CLI::App& app, std::string command_line)
    : verb_(app.add_subcommand("converge", "Race kernels and integrators: error against time")),
      command_line_(std::move(command_line)) {
  scene_.add_to(*verb_);
  verb_->add_option("-o,--output", output_, "Folder for everything that is written")
      ->type_name("FOLDER")
      ->capture_default_str();
  race_.add_to(*verb_);
  scene_.add_size_to(*verb_);
  settings_.add_to(*verb_, {"seed", "estimator.kernel", "estimator.octants", "estimator.correction",
                            "photons.global", "eye.gather", "stop.passes", "stop.samples",
                            "stop.seconds", "stop.error"});
  display_.add_to(*verb_, "the pictures");
  verb_->add_option("--threads", threads_, "Threads; 0: all processors")
      ->type_name("N")
      ->capture_default_str();
  verb_->add_flag("--quiet", quiet_, "Say nothing but results and errors");
  verb_->footer(kFooter);
}

void ConvergeCommand::prepare_folder() const {
  std::error_code code;
  fs::create_directories(out("runs"), code);
  check_writable(out("index.html"));
}

void ConvergeCommand::announce(const Job& job, ProgressPrinter& printer) const {
  const double seconds = static_cast<double>(job.variants.size()) * job.seeds * job.limit.seconds;
  std::string names;
  for (const Variant& v : job.variants) names += (names.empty() ? "" : "; ") + v.name;
  printer.say(fmt::format("{} variants ({}), {} seeds: at most about {} of rendering",
                          job.variants.size(), names, job.seeds, format_duration(seconds)));
}

/// Seed by seed, so that a slow hour of the machine hits all variants alike.
std::vector<ConvergeCommand::Runs> ConvergeCommand::race(const Job& job, const Scene& scene,
                                                         Watcher& watcher,
                                                         ProgressPrinter& printer) const {
  std::vector<Runs> all(job.variants.size());
  for (int seed = 1; seed <= job.seeds; ++seed) {
    for (std::size_t i = 0; i < job.variants.size() && !watcher.stopped(); ++i) {
      RenderConfig config = job.variants[i].config;
      config.seed = static_cast<std::uint64_t>(seed);
      RunLimit limit = job.limit;
      if (seed > 1) {
        limit.passes = all[i].front().snapshots.back().passes;
        limit.seconds = kInfinity;
      }
      printer.say(fmt::format("seed {} of {}: {}", seed, job.seeds, job.variants[i].name));
      const std::string folder = run_folder(out("runs"), scene, job.variants[i], config.seed);
      all[i].push_back(continue_run(folder, scene, config, limit, watcher));
    }
  }
  return all;
}

/// The points of one variant from its runs.
Series series_of(const std::string& name, const std::vector<Run>& runs, Clock clock,
                 const NamedPicture& reference) {
  Series series{name, false, {}};
  std::size_t count = 0;
  for (const Run& run : runs) count = std::max(count, run.snapshots.size());
  for (std::size_t k = 0; k < count; ++k) {
    std::vector<TimedPicture> pictures;
    for (const Run& run : runs) {
      if (k >= run.snapshots.size()) continue;
      const Snapshot& s = run.snapshots[k];
      pictures.push_back({s.file, time_of(s, clock), s.passes});
    }
    series.points.push_back(measure_point(reference, pictures));
  }
  return series;
}

Study ConvergeCommand::measure(const Job& job, const Reference& reference,
                               const std::vector<Runs>& runs) const {
  Study study;
  study.command = command_line_;
  study.scene = scene_.path;
  study.reference = reference.origin;
  study.width = reference.picture.file.width;
  study.height = reference.picture.file.height;
  study.seeds = job.seeds;
  study.time_unit = job.limit.clock == Clock::wall ? "seconds" : "CPU seconds";
  for (std::size_t i = 0; i < runs.size(); ++i) {
    study.series.push_back(
        series_of(job.variants[i].name, runs[i], job.limit.clock, reference.picture));
  }
  for (const External& external : job.externals) {
    Series series{external.name, true, {}};
    for (const auto& point : external.points) {
      series.points.push_back(measure_point(reference.picture, point));
    }
    study.series.push_back(std::move(series));
  }
  conclude(study);
  return study;
}

/// The last picture of every series on a page of `compare`.
void ConvergeCommand::write_pictures(const Study& study, const NamedPicture& reference) const {
  std::vector<NamedPicture> images;
  for (const Series& series : study.series) {
    if (series.points.empty()) continue;
    images.push_back(load_picture(series.points.back().seeds.front().file, {""}));
    images.back().name = series.name;
  }
  const Comparison comparison =
      compare_pictures(reference, images, {""}, {}, {false, display_.options(), kNoiseAlpha});
  ComparedViews views{view_layer(reference), {}};
  for (const NamedPicture& image : images) views.images.push_back(view_layer(image));
  const std::string json = to_json(comparison, {}).dump(2) + "\n";
  const double range = heat_map_range(relative_differences(views));
  write_file(out("pictures.html"),
             make_page(comparison_page(comparison, views, display_.options(), range, json)));
}

void write_text(const std::string& path, const std::string& text) {
  write_file(path, {text.data(), text.size()});
}

void ConvergeCommand::write(const Study& study, const NamedPicture& reference) const {
  write_text(out("converge.csv"), to_csv(study));
  write_text(out("converge.json"), to_json(study).dump(2) + "\n");
  const Drawing drawing = draw(study);
  write_text(out("converge.svg"), to_svg(drawing));
  write_png(out("converge.png"), to_pixels(drawing, kPlotPixels));
  write_pictures(study, reference);
  write_text(out("index.html"), make_page(study, "pictures.html"));
}

int ConvergeCommand::run() {
  const Job job = race_.job(settings_.apply({}));
  scene_.check();
  check_display(display_.options());
  const ThreadLimit threads(parse_int("--threads " + threads_, threads_, 0, 4096));
  prepare_folder();
  ProgressPrinter printer(quiet_ ? Verbosity::quiet : default_verbosity());
  const std::unique_ptr<Scene> scene = scene_.load(printer);
  check_reference(job.reference, *scene);
  for (const External& external : job.externals) {
    check_external(external, scene->film.crop_width, scene->film.crop_height);
  }
  for (const std::string& warning : scene->warnings) printer.say("warning: " + warning);

  Watcher watcher(printer);
  if (job.reference.file.empty()) printer.say("the reference: path tracing what is missing");
  const Reference reference = obtain_reference(job.reference, *scene, watcher);
  printer.say("reference: " + reference.origin);
  if (reference.interrupted) return kInterrupted;
  announce(job, printer);
  const std::vector<Runs> runs = race(job, *scene, watcher, printer);
  const Study study = measure(job, reference, runs);
  write(study, reference.picture);
  fmt::print("{}", to_text(study));
  printer.say("wrote " + out("index.html"));
  if (watcher.stopped()) return kInterrupted;
  std::int64_t non_finite = 0;
  for (const Runs& of_variant : runs) {
    for (const Run& run : of_variant) non_finite += run.non_finite;
  }
  if (non_finite == 0) return 0;
  fmt::print(stderr, "octolux: left out {} samples that were not finite: please report this\n",
             non_finite);
  return kNotFinite;
}

}  // namespace

std::unique_ptr<Command> make_converge_command(CLI::App& app, const std::string& command_line) {
  return std::make_unique<ConvergeCommand>(app, command_line);
}

}  // namespace octolux
