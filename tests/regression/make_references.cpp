// Renders the references of the regression tests: tools/update-references calls it. Path traced by
// us until the stated noise is reached; the EXR says how, by which commit and with which seed.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "core/image_io.h"
#include "renderer/picture.h"
#include "tests/regression/bits.h"
#include "tests/regression/cases.h"
#include "tools/progress.h"

namespace octolux::test {
namespace {

constexpr std::uint64_t kSeed = 20'061;  // no test's seed

RenderConfig reference_config(const RegressionCase& c) {
  RenderConfig config = path_config(0, kSeed);
  config.stop.error = c.reference_error;
  return config;
}

void make_reference(const RegressionCase& c, const std::string& commit) {
  const auto scene = load_case(c);
  const RenderConfig config = reference_config(c);
  ProgressPrinter printer(default_verbosity());
  printer.say(fmt::format("{} ({}x{}, to {:g} %)", c.name, c.film.width, c.film.height,
                          100 * c.reference_error));
  Watch watch([&](const Progress& progress, const Film&) { printer.update(progress); });
  const RenderResult result = render(*scene, config, watch);
  ExrFile file = make_exr(*scene, config, result.progress, result.film, false);
  file.attributes.text["octolux.command"] = std::string("tools/update-references ") + c.name;
  file.attributes.text["octolux.commit"] = commit;
  file.attributes.text["octolux.filter"] = "box";
  file.attributes.number["octolux.relativeStandardError"] = result.progress.error;
  write_exr(reference_path(c), file);
  printer.say(fmt::format("wrote {}: {} passes, {:.2g} %", reference_path(c),
                          result.progress.passes, 100 * result.progress.error));
}

}  // namespace
}  // namespace octolux::test

/// make_references COMMIT [NAME...], or make_references --hashes.
int main(int argc, char** argv) {
  using namespace octolux::test;
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) {
    std::fprintf(stderr, "make_references: expected a commit; see tools/update-references\n");
    return 2;
  }
  try {
    if (words[0] == "--hashes") {
      store_hashes();
      return 0;
    }
    std::vector<std::string> names(words.begin() + 1, words.end());
    for (const RegressionCase& c : regression_cases()) {
      if (words.size() == 1) names.push_back(c.name);
    }
    for (const std::string& name : names) regression_case(name);  // all known?
    for (const std::string& name : names) make_reference(regression_case(name), words[0]);
  } catch (const octolux::Error& e) {
    std::fprintf(stderr, "make_references: %s\n", e.what());
    return 2;
  }
  return 0;
}
