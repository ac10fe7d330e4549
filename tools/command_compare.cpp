// `octolux compare`: images against a reference, in numbers (tools/compare/). With gates it is a
// test: exit code 1 when a figure is beyond its limit.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/file_io.h"
#include "core/parallel.h"
#include "tools/commands.h"
#include "tools/compare/comparison.h"
#include "tools/compare/comparison_page.h"
#include "tools/compare/gates.h"
#include "tools/compare/report.h"
#include "tools/compare/sheets.h"
#include "tools/display_arguments.h"
#include "tools/settings.h"

namespace octolux {
namespace {

constexpr int kGateClosed = 1;
constexpr char kRoot[] = "root";

constexpr char kFooter[] =
    "x is an image, y the reference; means run over pixels and channels, both scene-linear. "
    "Pixels\n"
    "with a NaN or an infinity are counted and left out. A layer 'variance' gives bias^2 and a "
    "test\n"
    "of every value against its noise (Welch's t, Sidak's correction).\n\n"
    "Exit codes: 0 done, 1 a gate failed, 2 bad input.";

/// Pictures that take more than this are announced.
constexpr double kMuchMemory = 1e9;  // bytes

/// What the pictures will take; 0 for those that are no EXR, and small.
double bytes_of(const std::string& path, const std::vector<std::string>& layers) {
  const std::optional<ExrFile> header = exr_header(path);
  if (!header) return 0;
  double channels = 1;  // errors per pixel
  for (const Layer& layer : header->layers) {
    const bool read = layer.name == "variance" ||
                      std::find(layers.begin(), layers.end(), layer.name) != layers.end();
    if (read) channels += static_cast<double>(layer.channels.size());
  }
  return sizeof(float) * channels * header->width * header->height;
}

void announce_memory(const std::vector<std::string>& paths,
                     const std::vector<std::string>& layers) {
  double bytes = 0;
  for (const std::string& path : paths) bytes += bytes_of(path, layers);
  if (bytes < kMuchMemory) return;
  fmt::print(stderr, "octolux: the pictures take {:.1f} GB of memory\n", 1e-9 * bytes);
}

class CompareCommand final : public Command {
 public:
  explicit CompareCommand(CLI::App& app);
  bool chosen() const override { return verb_->parsed(); }
  int run() override;

 private:
  /// A gate as it was typed.
  struct Limit {
    const Figure* figure;
    std::string text;
  };

  void add_gates();
  std::vector<Gate> gates() const;
  bool wants_flip() const;
  std::vector<std::string> layers() const;
  Mask mask(const LayerView& reference) const;
  Comparison compare(const NamedPicture& reference, const std::vector<NamedPicture>& images,
                     const std::vector<std::string>& layers) const;
  void check_outputs() const;
  void write_results(const Comparison& comparison, const ComparedViews& views,
                     const std::string& json) const;

  CLI::App* verb_;
  std::string reference_, mask_, rectangle_, threads_ = "0";
  std::string json_, heat_map_, side_by_side_, html_, range_;
  std::vector<std::string> images_, layers_{kRoot};
  std::deque<Limit> limits_;
  DisplayArguments display_;
  bool flip_ = false, within_noise_ = false;
};

CompareCommand::CompareCommand(CLI::App& app)
    : verb_(app.add_subcommand("compare", "Measure images against a reference")) {
  verb_->add_option("REFERENCE", reference_, "EXR (or HDR, PNG, ...)")->required();
  verb_->add_option("IMAGE", images_, "Images to measure")->required();
  verb_->add_option("--layer", layers_, "Layers to compare: root, names, or all both files have")
      ->type_name("NAME")
      ->capture_default_str();
  verb_->add_option("--mask", mask_, "Only pixels where this picture is above 0")
      ->type_name("FILE");
  verb_->add_option("--rect", rectangle_, "Only pixels of this rectangle")->type_name("X,Y,WxH");
  verb_->add_flag("--flip", flip_, "FLIP too: HDR, and LDR of what the view shows; takes seconds");
  verb_->add_option("--json", json_, "Write every number to this file")->type_name("FILE");
  verb_->add_option("--side-by-side", side_by_side_, "Write labelled pictures of the first layer")
      ->type_name("FILE.png");
  verb_->add_option("--heat-map", heat_map_, "Write where images are too bright or too dark")
      ->type_name("FILE.png");
  verb_
      ->add_option("--range", range_,
                   "Largest relative difference a heat map tells apart, e.g. 0.1")
      ->type_name("R");
  verb_->add_option("--html", html_, "Write a page to look at them: wipe, blink, zoom, values")
      ->type_name("FILE.html");
  display_.add_to(*verb_, "pictures");
  verb_->add_option("--threads", threads_, "Threads; 0: all processors. Never changes a number")
      ->type_name("N")
      ->capture_default_str();
  add_gates();
  verb_->footer(kFooter);
}

void CompareCommand::add_gates() {
  for (const Figure& figure : figures()) {
    const std::string option = gate_option(figure);
    if (option.empty()) continue;
    Limit& limit = limits_.emplace_back(Limit{&figure, ""});
    verb_->add_option(option, limit.text, std::string("Gate on ") + figure.title)
        ->type_name("LIMIT")
        ->group("Gates");
  }
  verb_->add_flag("--within-noise", within_noise_, "Gate: no value differs beyond its noise")
      ->group("Gates");
}

std::vector<Gate> CompareCommand::gates() const {
  std::vector<Gate> gates;
  for (const Limit& limit : limits_) {
    if (limit.text.empty()) continue;
    const std::string source = gate_option(*limit.figure) + " " + limit.text;
    gates.push_back({limit.figure, parse_number(source, limit.text)});
  }
  if (within_noise_) gates.push_back({});
  return gates;
}

bool CompareCommand::wants_flip() const {
  return flip_ || std::any_of(limits_.begin(), limits_.end(), [](const Limit& limit) {
           return !limit.text.empty() &&
                  std::string(limit.figure->key).find("flip") != std::string::npos;
         });
}

std::vector<std::string> CompareCommand::layers() const {
  if (layers_ == std::vector<std::string>{"all"}) return common_layers(reference_, images_);
  std::vector<std::string> names = layers_;
  std::replace(names.begin(), names.end(), std::string(kRoot), std::string());
  return names;
}

Mask CompareCommand::mask(const LayerView& reference) const {
  Mask mask;
  if (!mask_.empty()) mask = mask_of(load_picture(mask_, {""}), reference);
  if (rectangle_.empty()) return mask;
  const std::string source = "--rect " + rectangle_;
  mask = intersection(mask, mask_of(source, parse_rectangle(source, rectangle_), reference));
  if (count_pixels(mask, mask.size()) == 0) {
    throw Error(source + ": no pixel of it is in the mask " + mask_);
  }
  return mask;
}

Comparison CompareCommand::compare(const NamedPicture& reference,
                                   const std::vector<NamedPicture>& images,
                                   const std::vector<std::string>& layers) const {
  const LayerView first = view_layer(reference, layers.front());
  for (const NamedPicture& image : images) {
    for (const std::string& layer : layers) {
      check_comparable(view_layer(reference, layer), view_layer(image, layer));
    }
  }
  CompareOptions options;
  options.flip = wants_flip();
  options.display = display_.options();
  Comparison result = compare_pictures(reference, images, layers, mask(first), options);
  if (!mask_.empty()) result.mask = "mask " + mask_;
  if (!rectangle_.empty()) {
    result.mask += (mask_.empty() ? "rectangle " : ", rectangle ") + rectangle_;
  }
  return result;
}

void CompareCommand::check_outputs() const {
  check_display(display_.options());
  for (const std::string& path : {json_, side_by_side_, heat_map_, html_}) {
    if (!path.empty()) check_writable(path);
  }
  if (!range_.empty() && !(parse_number("--range " + range_, range_) > 0)) {
    throw Error("--range " + range_ + ": expected a number above 0");
  }
}

void CompareCommand::write_results(const Comparison& comparison, const ComparedViews& views,
                                   const std::string& json) const {
  if (!json_.empty()) write_file(json_, json);
  const DisplayOptions display = display_.options();
  if (!side_by_side_.empty()) {
    write_png(side_by_side_, side_by_side_sheet(comparison, views, display));
  }
  if (heat_map_.empty() && html_.empty()) return;
  const double range = range_.empty() ? heat_map_range(relative_differences(views))
                                      : parse_number("--range " + range_, range_);
  if (!heat_map_.empty()) write_png(heat_map_, heat_map_sheet(comparison, views, range));
  if (html_.empty()) return;
  write_file(html_, make_page(comparison_page(comparison, views, display, range, json)));
}

int CompareCommand::run() {
  const std::vector<Gate> limits = gates();
  const ThreadLimit threads(parse_int("--threads " + threads_, threads_, 0, 4096));
  check_outputs();

  const std::vector<std::string> names = layers();
  if (names.empty()) throw Error(reference_ + ": has no layer in common with the images");
  std::vector<std::string> paths = images_;
  paths.push_back(reference_);
  for (const std::string& path : paths) check_layers(path, names);
  announce_memory(paths, names);
  const NamedPicture reference = load_picture(reference_, names);
  std::vector<NamedPicture> images;
  for (const std::string& path : images_) images.push_back(load_picture(path, names));
  const Comparison comparison = compare(reference, images, names);

  const std::vector<GateResult> results = check_gates(comparison, limits);
  fmt::print("{}", to_text(comparison));
  for (const GateResult& result : results) fmt::print("gate: {}\n", result.line);
  ComparedViews views{view_layer(reference, names.front()), {}};
  for (const NamedPicture& image : images) views.images.push_back(view_layer(image, names.front()));
  write_results(comparison, views, to_json(comparison, results).dump(2) + "\n");
  const bool passed =
      std::all_of(results.begin(), results.end(), [](const GateResult& r) { return r.passed; });
  return passed ? 0 : kGateClosed;
}

}  // namespace

std::unique_ptr<Command> make_compare_command(CLI::App& app) {
  return std::make_unique<CompareCommand>(app);
}

}  // namespace octolux
