// result_folder.h.
#include "tools/ab/result_folder.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/file_io.h"
#include "tools/ab/pictures.h"
#include "tools/ab/report.h"

namespace octolux {

std::vector<std::string> result_files() {
  return {"ab.png", "leaks.png", "index.html", "ab.json", "table.md"};
}

void write_results(const AbResult& r, const std::string& folder, const DisplayOptions& display,
                   double range) {
  const auto file = [&](const std::string& name) {
    return (std::filesystem::path(folder) / name).string();
  };
  const std::string json = to_json(r).dump(2) + "\n";
  write_png(file("ab.png"), ab_sheet(r, display));
  write_png(file("leaks.png"), leak_sheet(r, range));
  for (const NamedMask& m : r.masks) {
    if (m.mask.empty()) continue;
    Image image(r.width(), r.height());
    for (std::size_t i = 0; i < m.mask.size(); ++i) image.pixels[i] = Rgb(m.mask[i]);
    write_png(file("mask-" + m.key + ".png"), image);
  }
  write_file(file("ab.json"), json);
  write_file(file("table.md"), to_markdown(r));
  write_file(file("index.html"), make_page(ab_page(r, display, range, json)));
}

}  // namespace octolux
