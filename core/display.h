// From scene-linear light to what a screen shows, through OpenColorIO. Only for pictures to look
// at: nothing here ever touches a scene-linear file.
//
// The shipped configuration has one display, sRGB, with three views:
//   Standard      the plain sRGB curve, clipped at 1. The default, because it is what users of
//                 Mitsuba, pbrt and tev see, and reference PNGs are made with it.
//   ACES 1.0 SDR  the Academy's output transform for SDR video: highlights roll off.
//   Raw           the numbers themselves.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace octolux {

struct DisplayOptions {
  std::string ocio_config;  // file; "": the one $OCIO names if that is set, else the shipped one
  std::string display;      // "": the configuration's default
  std::string view;         // "": the display's default
  float exposure = 0;       // [stops]
};

/// `linear` (Rec.709 primaries) as the display shows it: values in [0, 1]; NaN becomes 0.
/// In a configuration other than the shipped one, Rec.709 is found by the usual names of that
/// space, else through the role aces_interchange; without either, scene_linear is taken for it.
/// Throws Error as check_display.
Image to_display(const Image& linear, const DisplayOptions& options);

/// Throws Error if the configuration cannot be read or has no such display or view (the legal ones
/// are listed). Long work starts with this.
void check_display(const DisplayOptions& options);

/// What a configuration offers.
struct DisplayMenu {
  struct Display {
    std::string name;
    std::vector<std::string> views;
    std::string default_view;
  };
  std::string config;  // its file; "": the shipped one
  std::vector<Display> displays;
  std::string default_display;
};

/// Of the configuration `options` choose. Throws Error if it cannot be read.
DisplayMenu display_menu(const DisplayOptions& options);

/// `options` with the names of display and view filled in. Throws Error as check_display.
DisplayOptions resolved(const DisplayOptions& options);

/// The text of the shipped configuration (display_config.cpp).
const char* shipped_display_config();

}  // namespace octolux
