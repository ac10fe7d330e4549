// `octolux lab`: estimators against truth, without rendering.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <optional>

#include "core/error.h"
#include "core/file_io.h"
#include "tools/commands.h"
#include "tools/lab/csv_photons.h"
#include "tools/lab/reach.h"
#include "tools/lab/report.h"

namespace octolux {
namespace {

constexpr double kAngleStep = 7.5;  // [degrees] of --angles

struct LabArguments {
  std::vector<std::string> cases{"plane", "wall", "corner", "reentrant", "strip"};
  std::vector<std::string> kernels;
  std::vector<int> neighbours{3, 5, 10, 20, 50, 100, 200, 500, 1000, 2000};
  int runs = 4000;
  std::uint64_t seed = 1;
  std::optional<double> angle, distance, size;
  double shrink = 1;
  bool angles = false, low_discrepancy = false, time = false, reach = false;
  std::string csv, json, plot, photons, queries;
};

std::string describe_cases() {
  std::string text = "Cases (lengths in units of the bandwidth; [default distance, size]):\n";
  for (const LabCase& c : lab_cases()) {
    text += fmt::format("  {:<10} {}", c.name, c.help);
    if (c.distance > 0 || c.size > 0) text += fmt::format(" [{:g}, {:g}]", c.distance, c.size);
    text += "\n";
  }
  return text +
         "\nKernels: those of octolux render, with options: octobox:eight, cone:published,\n"
         "octobox:one:published. Without --kernel: every kernel, corrected.\n"
         "\nYour own photons: --photons FILE --queries FILE, CSV with a header line of\n"
         "x,y,z,nx,ny,nz,wx,wy,wz,r,g,b (a query needs only the first six).\n"
         "\nExample: octolux lab --case wall --neighbours 50 --angles --plot wall.svg";
}

void add_options(CLI::App& verb, LabArguments& a) {
  verb.footer(describe_cases());
  verb.add_option("--case", a.cases, "Cases, or all (default: plane wall corner reentrant strip)")
      ->type_name("NAME");
  verb.add_option("--kernel", a.kernels, "Kernels with their options")->type_name("NAME");
  verb.add_option("--neighbours", a.neighbours, "Photons in a look-up (default: 3 to 2000)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  verb.add_option("--runs", a.runs,
                  "Look-ups of 50 photons; of n photons 50/n times as many (4000)")
      ->type_name("N")
      ->check(CLI::Range(16, 100000000).description(""));
  verb.add_option("--angle", a.angle, "Turn the case by this angle (default: all round)")
      ->type_name("DEGREES")
      ->check(CLI::Range(0.0, 360.0).description(""));
  verb.add_flag("--angles", a.angles, "Every 7.5 degrees from 0 to 90, each by itself");
  verb.add_option("--distance", a.distance, "Of the query from what the case has nearby")
      ->type_name("D");
  verb.add_option("--size", a.size, "What it means depends on the case")->type_name("S");
  verb.add_option("--shrink", a.shrink, "Shrink the bandwidth, as later passes of a render do (1)")
      ->type_name("S")
      ->check(CLI::Range(1e-3, 1.0).description(""));
  verb.add_flag("--low-discrepancy", a.low_discrepancy, "Evenly spread photons, not Poisson");
  verb.add_flag("--time", a.time, "Measure nanoseconds per query as well");
  verb.add_flag("--reach", a.reach, "Print the worst figures of every kernel as a Markdown table");
  verb.add_option("--seed", a.seed, "Another seed draws other photons (1)")->type_name("N");
  verb.add_option("--csv", a.csv, "Write the figures as CSV")->type_name("FILE");
  verb.add_option("--json", a.json, "Write the figures as JSON")->type_name("FILE");
  verb.add_option("--plot", a.plot, "Draw bias against photons (--angles: against the angle)")
      ->type_name("FILE.svg");
  CLI::Option* photons = verb.add_option("--photons", a.photons, "Your own photons, CSV");
  CLI::Option* queries = verb.add_option("--queries", a.queries, "Where to estimate them, CSV");
  photons->type_name("FILE")->needs(queries);
  queries->type_name("FILE")->needs(photons);
}

LabSettings make_settings(const LabArguments& a) {
  LabSettings settings;
  for (const std::string& name : a.kernels.empty() ? kernel_names() : a.kernels) {
    settings.kernels.push_back(parse_lab_kernel(name));
  }
  settings.neighbours = a.neighbours;
  settings.runs = a.runs;
  settings.angle = a.angle.value_or(-1);
  settings.shrink = a.shrink;
  settings.pattern = a.low_discrepancy ? PhotonPattern::low_discrepancy : PhotonPattern::poisson;
  settings.seed = a.seed;
  return settings;
}

std::vector<std::string> chosen_cases(const LabArguments& a) {
  if (a.cases != std::vector<std::string>{"all"}) return a.cases;
  std::vector<std::string> names;
  for (const LabCase& c : lab_cases()) names.emplace_back(c.name);
  return names;
}

LabTable run_case(const LabArguments& a, LabSettings settings, const std::string& name) {
  const LabCase& chosen = find_lab_case(name);
  const double distance = a.distance.value_or(chosen.distance);
  const double size = a.size.value_or(chosen.size);
  if (!(distance >= 0) || !(size >= 0) || (chosen.size > 0 && size == 0)) {
    throw Error("--distance must be 0 or more, and --size above 0");
  }
  LabTable table{lab_title(chosen, distance, size), {}};
  const LabLayout layout = chosen.layout(distance, size);
  const int steps = a.angles ? static_cast<int>(90 / kAngleStep) : 0;
  for (int i = 0; i <= steps; ++i) {
    if (a.angles) settings.angle = kAngleStep * i;
    for (LabResult& r : measure(layout, settings)) table.results.push_back(r);
  }
  if (a.time) measure_time(settings, table.results);
  return table;
}

void write_text(const std::string& file, const std::string& text) {
  if (!file.empty()) write_file(file, {text.data(), text.size()});
}

int run_cases(const LabArguments& a) {
  for (const std::string& file : {a.csv, a.json, a.plot}) {
    if (!file.empty()) check_writable(file);
  }
  const LabSettings settings = make_settings(a);
  for (const std::string& name : chosen_cases(a)) find_lab_case(name);
  std::vector<LabTable> tables;
  for (const std::string& name : chosen_cases(a)) {
    tables.push_back(run_case(a, settings, name));
    fmt::print("{}", to_text({tables.back()}));
    std::fflush(stdout);
  }
  write_text(a.csv, to_csv(tables));
  write_text(a.json, to_json(tables));
  if (!a.plot.empty()) {
    write_text(a.plot, to_svg(tables, a.angles ? PlotAxis::angle : PlotAxis::neighbours));
  }
  return 0;
}

/// What the kernels reach, for estimators/README.md.
int run_reach(const LabArguments& a) {
  const LabSettings settings = make_settings(a);
  std::vector<std::string> header{"worst over all"};
  for (const LabKernel& kernel : settings.kernels) header.push_back(kernel.name);
  std::vector<std::vector<std::string>> rows = reach_rows(settings);
  rows.insert(rows.begin(), {header, std::vector<std::string>(header.size(), "---")});
  for (const std::vector<std::string>& row : rows) {
    fmt::print("| {} |\n", fmt::join(row, " | "));
  }
  return 0;
}

/// Every kernel at every query, as CSV.
int run_own_photons(const LabArguments& a) {
  const LabSettings settings = make_settings(a);
  const PhotonMap map(read_photon_csv(a.photons));
  const std::vector<LabPoint> queries = read_query_csv(a.queries);
  if (map.rejected() > 0) {
    fmt::print(stderr, "octolux: {} photons with infinite, missing or negative values left out\n",
               map.rejected());
  }
  Bandwidth bandwidth;
  bandwidth.shrink = static_cast<float>(a.shrink);
  std::string text = "query,kernel,neighbours,r,g,b,h,area,count\n";
  for (std::size_t q = 0; q < queries.size(); ++q) {
    const LabQuery query(queries[q].position, queries[q].normal);
    for (const LabKernel& kernel : settings.kernels) {
      for (const int n : a.neighbours) {
        EstimatorConfig config = kernel.config;
        config.neighbours = n;
        const Estimate e = query.irradiance(*make_estimator(config), map, bandwidth, nullptr, 0.5f);
        text += fmt::format("{},{},{},{:.7g},{:.7g},{:.7g},{:.7g},{:.7g},{}\n", q, kernel.name, n,
                            e.radiance.r, e.radiance.g, e.radiance.b, e.bandwidth, e.area, e.count);
      }
    }
  }
  if (a.csv.empty()) fmt::print("{}", text);
  write_text(a.csv, text);
  return 0;
}

class LabCommand final : public Command {
 public:
  explicit LabCommand(CLI::App& app)
      : verb_(app.add_subcommand("lab", "Measure the density estimators against known answers")) {
    add_options(*verb_, arguments_);
  }
  bool chosen() const override { return verb_->parsed(); }
  int run() override {
    if (arguments_.reach) return run_reach(arguments_);
    return arguments_.photons.empty() ? run_cases(arguments_) : run_own_photons(arguments_);
  }

 private:
  CLI::App* verb_;
  LabArguments arguments_;
};

}  // namespace

std::unique_ptr<Command> make_lab_command(CLI::App& app) {
  return std::make_unique<LabCommand>(app);
}

}  // namespace octolux
