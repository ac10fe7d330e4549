// mask.h.
#include "tools/compare/mask.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace octolux {

Rectangle parse_rectangle(const std::string& source, const std::string& text) {
  Rectangle r;
  int* const numbers[] = {&r.x, &r.y, &r.width, &r.height};
  const char separators[] = {',', ',', 'x', '\0'};
  const char* at = text.c_str();
  const char* const end = at + text.size();
  bool good = true;
  for (int i = 0; i < 4 && good; ++i) {
    const auto [stop, code] = std::from_chars(at, end, *numbers[i]);
    good = code == std::errc() && *stop == separators[i];
    at = stop + 1;
  }
  if (!good || r.x < 0 || r.y < 0 || r.width < 1 || r.height < 1) {
    throw Error(source + ": expected X,Y,WIDTHxHEIGHT in pixels, such as 10,20,64x48");
  }
  return r;
}

Mask mask_of(const NamedPicture& picture, const LayerView& reference) {
  const LayerView view = view_layer(picture);
  if (view.width != reference.width || view.height != reference.height) {
    throw Error(fmt::format("{}: the mask has {}x{} pixels; expected {}x{}, the size of {}",
                            picture.name, view.width, view.height, reference.width,
                            reference.height, reference.source));
  }
  Mask mask(view.pixels(), 0);
  for (const auto& plane : view.planes) {
    for (std::size_t i = 0; i < mask.size(); ++i) mask[i] |= plane[i] > 0;
  }
  if (count_pixels(mask, mask.size()) == 0) {
    throw Error(picture.name + ": the mask leaves no pixel; expected values above 0 somewhere");
  }
  return mask;
}

Mask mask_of(const std::string& source, const Rectangle& r, const LayerView& reference) {
  if (r.x > reference.width - r.width || r.y > reference.height - r.height) {
    throw Error(fmt::format("{}: does not lie inside the {}x{} pixels of {}", source,
                            reference.width, reference.height, reference.source));
  }
  Mask mask(reference.pixels(), 0);
  for (int y = r.y; y < r.y + r.height; ++y) {
    const auto row = mask.begin() + std::ptrdiff_t{y} * reference.width + r.x;
    std::fill(row, row + r.width, std::uint8_t{1});
  }
  return mask;
}

Mask intersection(const Mask& a, const Mask& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  Mask both(a.size());
  std::transform(a.begin(), a.end(), b.begin(), both.begin(),
                 [](std::uint8_t p, std::uint8_t q) { return static_cast<std::uint8_t>(p & q); });
  return both;
}

std::int64_t count_pixels(const Mask& mask, std::size_t pixels) {
  if (mask.empty()) return static_cast<std::int64_t>(pixels);
  return static_cast<std::int64_t>(mask.size()) - std::count(mask.begin(), mask.end(), 0);
}

}  // namespace octolux
