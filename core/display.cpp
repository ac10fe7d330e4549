// display.h over OpenColorIO 2.1. The sole user of OpenColorIO, and the only place that reads the
// environment ($OCIO, the industry's way to name a configuration). Thread-safe.
#include "core/display.h"

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <vector>

#include "core/error.h"

namespace octolux {
namespace {

namespace ocio = OCIO_NAMESPACE;

/// What configurations call scene-linear Rec.709, most specific first.
constexpr const char* kRec709Names[] = {
    "Linear Rec.709 (sRGB)",   "Linear Rec.709", "lin_rec709_srgb", "lin_rec709", "lin_srgb",
    "Utility - Linear - sRGB", "Linear BT.709",  "Linear"};

/// The largest half; whatever is brighter looks the same, and infinities would turn into NaN.
constexpr float kBrightest = 65504;

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string config_path(const DisplayOptions& options) {
  if (!options.ocio_config.empty()) return options.ocio_config;
  const char* environment = std::getenv("OCIO");
  return environment ? environment : "";
}

ocio::ConstConfigRcPtr load_config(const DisplayOptions& options) {
  const std::string path = config_path(options);
  try {
    if (!path.empty()) return ocio::Config::CreateFromFile(path.c_str());
    std::istringstream text(shipped_display_config());
    return ocio::Config::CreateFromStream(text);
  } catch (const ocio::Exception& e) {
    throw Error(path + ": cannot be read as an OpenColorIO configuration: " + one_line(e.what()));
  }
}

/// A display and one of its views, both legal.
struct Target {
  std::string display, view;
};

DisplayMenu read_menu(const ocio::Config& config) {
  DisplayMenu menu;
  menu.default_display = config.getDefaultDisplay();
  for (int i = 0; i < config.getNumDisplays(); ++i) {
    const char* name = config.getDisplay(i);
    DisplayMenu::Display display{name, {}, config.getDefaultView(name)};
    for (int v = 0; v < config.getNumViews(name); ++v) {
      display.views.push_back(config.getView(name, v));
    }
    menu.displays.push_back(std::move(display));
  }
  return menu;
}

Target find_target(const ocio::Config& config, const DisplayOptions& options) {
  const DisplayMenu menu = read_menu(config);
  Target target{options.display, options.view};
  if (target.display.empty()) target.display = menu.default_display;
  std::vector<std::string> names;
  for (const DisplayMenu::Display& display : menu.displays) {
    names.push_back(display.name);
    if (display.name != target.display) continue;
    const auto& views = display.views;
    if (target.view.empty()) target.view = display.default_view;
    if (std::find(views.begin(), views.end(), target.view) != views.end()) return target;
    throw Error("display '" + target.display + "': " + unknown_name("view", target.view, views));
  }
  throw Error(unknown_name("display", target.display, names));
}

/// Rec.709 to ACES2065-1: the shipped configuration's own matrix.
ocio::ConstTransformRcPtr rec709_to_aces() {
  std::istringstream text(shipped_display_config());
  return ocio::Config::CreateFromStream(text)
      ->getColorSpace("ACES2065-1")
      ->getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE);
}

ocio::ConstProcessorRcPtr make_processor(const ocio::Config& config, const Target& target) {
  auto view = ocio::DisplayViewTransform::Create();
  view->setDisplay(target.display.c_str());
  view->setView(target.view.c_str());
  for (const char* name : kRec709Names) {
    if (!config.getColorSpace(name)) continue;
    view->setSrc(name);
    return config.getProcessor(view);
  }
  if (!config.hasRole("aces_interchange")) {
    view->setSrc(ocio::ROLE_SCENE_LINEAR);
    return config.getProcessor(view);
  }
  view->setSrc("aces_interchange");
  auto group = ocio::GroupTransform::Create();
  group->appendTransform(rec709_to_aces()->createEditableCopy());
  group->appendTransform(view);
  return config.getProcessor(group);
}

/// Lossless: OpenColorIO's default swaps pow() for an approximation that shows in 8 bits.
ocio::ConstCPUProcessorRcPtr make_cpu_processor(const DisplayOptions& options) {
  const ocio::ConstConfigRcPtr config = load_config(options);
  const Target target = find_target(*config, options);
  try {
    return make_processor(*config, target)->getOptimizedCPUProcessor(ocio::OPTIMIZATION_LOSSLESS);
  } catch (const ocio::Exception& e) {
    throw Error("view '" + target.view + "' of display '" + target.display +
                "' cannot be used: " + one_line(e.what()));
  }
}

float exposed(float value, float scale) {
  const float v = value * scale;
  return std::isnan(v) ? 0 : std::clamp(v, -kBrightest, kBrightest);
}

float clamped(float value) { return value > 0 ? std::min(value, 1.0f) : 0.0f; }

}  // namespace

Image to_display(const Image& linear, const DisplayOptions& options) {
  const ocio::ConstCPUProcessorRcPtr processor = make_cpu_processor(options);
  const float scale = std::exp2(options.exposure);
  Image image = linear;
  for (Rgb& p : image.pixels) {
    p = {exposed(p.r, scale), exposed(p.g, scale), exposed(p.b, scale)};
  }
  static_assert(sizeof(Rgb) == 3 * sizeof(float), "pixels are packed");
  ocio::PackedImageDesc pixels(image.pixels.data(), image.width, image.height, 3);
  processor->apply(pixels);
  for (Rgb& p : image.pixels) p = {clamped(p.r), clamped(p.g), clamped(p.b)};
  return image;
}

void check_display(const DisplayOptions& options) { make_cpu_processor(options); }

DisplayMenu display_menu(const DisplayOptions& options) {
  DisplayMenu menu = read_menu(*load_config(options));
  menu.config = config_path(options);
  return menu;
}

DisplayOptions resolved(const DisplayOptions& options) {
  const Target target = find_target(*load_config(options), options);
  DisplayOptions result = options;
  result.display = target.display;
  result.view = target.view;
  return result;
}

}  // namespace octolux
