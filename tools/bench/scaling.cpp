// How time grows with photons, triangles, lights, threads and pixels, as tables, CSV and plots:
//
//   build/bench_scaling [--only photons] [--largest 1e6] [-o FOLDER]
//
// Each figure is the median of several runs, or one run where it is long. The slope is that of
// log time against log size: 1 is proportional. Quit other programs: runs follow each other, so
// what else the machine does shows as bumps.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "core/error.h"
#include "core/file_io.h"
#include "core/image_io.h"
#include "core/parallel.h"
#include "tools/bench/scaling/plot.h"
#include "tools/bench/scaling/sweeps.h"

namespace octolux {
namespace {

constexpr int kBadInput = 2;
constexpr int kPlotPixels = 2;  // of the PNG, per point of the plot

struct Arguments {
  std::vector<std::string> only;
  double largest = 0;  // 0: no limit
  std::string output = "scaling";
};

/// The chosen sweeps, with the chosen sizes.
std::vector<Sweep> choose(const std::vector<Sweep>& all, const Arguments& arguments) {
  std::vector<std::string> names;
  for (const Sweep& sweep : all) names.push_back(sweep.name);
  for (const std::string& name : arguments.only) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      throw Error("--only: " + unknown_name("sweep", name, names));
    }
  }
  std::vector<Sweep> chosen;
  for (Sweep sweep : all) {
    const auto& only = arguments.only;
    if (!only.empty() && std::find(only.begin(), only.end(), sweep.name) == only.end()) continue;
    if (arguments.largest > 0) {
      std::erase_if(sweep.sizes, [&](double size) { return size > arguments.largest; });
    }
    if (!sweep.sizes.empty()) chosen.push_back(std::move(sweep));
  }
  if (chosen.empty()) {
    throw Error(fmt::format("--largest {:g}: no step is as small as that", arguments.largest));
  }
  return chosen;
}

/// What is wrong with the text of --largest; "" if nothing.
std::string not_a_size(const std::string& text) {
  double value = 0;
  const bool number = CLI::detail::lexical_cast(text, value);
  return number && value > 0 ? "" : "expected a number above 0, such as 1e6, not '" + text + "'";
}

void write_text(const std::string& path, const std::string& text) {
  write_file(path, {text.data(), text.size()});
}

int run(const Arguments& arguments) {
  const std::vector<Sweep> sweeps =
      choose(all_sweeps(OCTOLUX_SOURCE_DIR "/scenes/cornell/cornell.xml"), arguments);
  std::error_code failed;
  std::filesystem::create_directories(arguments.output, failed);
  const std::string base = arguments.output + "/scaling";
  check_writable(base + ".csv");
  fmt::print("{} threads\n\n", thread_count());
  std::vector<ScalingCurve> curves;
  for (const Sweep& sweep : sweeps) {
    ScalingCurve curve = run_sweep(sweep);
    if (!curve.steps.empty()) curves.push_back(std::move(curve));
    write_text(base + ".csv", to_csv(curves));
  }
  if (curves.empty()) return 0;
  const Drawing drawing = draw(curves);
  write_text(base + ".svg", to_svg(drawing));
  write_png(base + ".png", to_pixels(drawing, kPlotPixels));
  fmt::print("written: {0}.csv, {0}.svg, {0}.png\n", base);
  return 0;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app("Measures and plots how time grows.", "bench_scaling");
  Arguments arguments;
  app.add_option("--only", arguments.only, "photons, triangles, lights, threads or pixels (all)")
      ->type_name("NAME");
  app.add_option("--largest", arguments.largest, "Leave out steps of more than this")
      ->type_name("N")
      ->check(CLI::Validator(not_a_size, ""));
  app.add_option("-o,--output", arguments.output, "Folder of the CSV, SVG and PNG (scaling)")
      ->type_name("FOLDER");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  }
  return run(arguments);
}

}  // namespace
}  // namespace octolux

int main(int argc, char** argv) {
  const auto complain = [](const char* message) {
    fmt::print(stderr, "bench_scaling: {}\n", message);
    return octolux::kBadInput;
  };
  try {
    return octolux::parse_and_run(argc, argv);
  } catch (const octolux::Error& error) {
    return complain(error.what());
  } catch (const CLI::ParseError& error) {
    return complain(error.what());
  }
}
