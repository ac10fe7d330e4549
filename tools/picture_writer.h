// The pictures of a render on disk: the EXR, and a PNG of it beside it.
#pragma once

#include <string>

#include "core/display.h"
#include "core/image_io.h"

namespace octolux {

class PictureWriter {
 public:
  struct Options {
    std::string exr_path;
    bool png = true;
    DisplayOptions display;
  };

  /// Throws Error now if the files could not be written or the display is unknown.
  explicit PictureWriter(Options options);

  void write(const ExrFile& file) const;
  /// The files written, for messages.
  std::string names() const;

 private:
  Options options_;
  std::string png_path_;
};

}  // namespace octolux
