// What a failing regression test leaves behind: image, reference and difference, as files and on a
// page to look at.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file_io.h"
#include "tests/regression/batches.h"
#include "tools/compare/comparison_page.h"
#include "tools/compare/report.h"
#include "tools/compare/sheets.h"

namespace octolux::test {

/// Writes image.exr, reference.exr, difference.png and index.html to a folder under the build
/// folder; returns its path.
inline std::string leave_evidence(const std::string& name, const ExrFile& reference,
                                  const Batches& batches) {
  const std::string folder = std::string(OCTOLUX_BINARY_DIR "/regression/") + name;
  std::filesystem::create_directories(folder);
  const Image mean = mean_image(batches);
  ExrFile image{mean.width, mean.height, {rgb_layer("", mean)}, {}};
  image.layers.push_back(rgb_layer("variance", variance_image(batches)));
  image.attributes.number["octolux.passes"] = kBatches;  // of which the variance knows
  write_exr(folder + "/image.exr", image);
  write_exr(folder + "/reference.exr", reference);

  const NamedPicture truth{"reference", reference};
  const NamedPicture pictures[] = {{name, image}};
  const Comparison comparison =
      compare_pictures(truth, pictures, {""}, {}, {false, DisplayOptions{}, kNoiseAlpha});
  const ComparedViews views{view_layer(truth), {view_layer(pictures[0])}};
  const double range = heat_map_range(relative_differences(views));
  write_png(folder + "/difference.png", heat_map_sheet(comparison, views, range));
  const std::string json = to_json(comparison, {}).dump(2) + "\n";
  write_file(folder + "/index.html",
             make_page(comparison_page(comparison, views, DisplayOptions{}, range, json)));
  return folder;
}

}  // namespace octolux::test
