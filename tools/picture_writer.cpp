// picture_writer.h.
#include "tools/picture_writer.h"

#include <filesystem>
#include <utility>

#include "core/error.h"
#include "core/file_io.h"

namespace octolux {

PictureWriter::PictureWriter(Options options) : options_(std::move(options)) {
  std::filesystem::path path = options_.exr_path;
  if (path.extension() != ".exr" && path.extension() != ".EXR") {
    throw Error("-o " + options_.exr_path + ": expected a name that ends in .exr");
  }
  png_path_ = path.replace_extension(".png").string();
  check_writable(options_.exr_path);
  if (!options_.png) return;
  check_writable(png_path_);
  check_display(options_.display);
}

void PictureWriter::write(const ExrFile& file) const {
  write_exr(options_.exr_path, file);
  if (options_.png) write_png(png_path_, to_display(file.image(), options_.display));
}

std::string PictureWriter::names() const {
  return options_.exr_path + (options_.png ? " and " + png_path_ : "");
}

}  // namespace octolux
