// colour_map.h. CIELAB to sRGB goes through the matrices of flip_colour.h.
#include "tools/compare/colour_map.h"

#include <algorithm>
#include <cmath>

#include "tools/compare/flip_colour.h"

namespace octolux {
namespace {

using Lab = flip::Triple;

constexpr Lab kBlueEnd{40, 10, -48};
constexpr Lab kMiddle{97, 0, 0};
constexpr Lab kOrangeEnd{40, 31.6f, 37.5f};  // as far from the middle as blue
constexpr Lab kDark{14, 8, -28};
constexpr Lab kLight{91, -8, 62};

Lab mix(Lab p, Lab q, float t) {
  return {p.a + t * (q.a - p.a), p.b + t * (q.b - p.b), p.c + t * (q.c - p.c)};
}

/// CIE 15:2004, 8.2.1, backwards: X/Xn and so on.
float lab_uncurve(float f) {
  constexpr float kDelta = 6.0f / 29;
  return f > kDelta ? f * f * f : 3 * kDelta * kDelta * (f - 4.0f / 29);
}

Rgb to_srgb(Lab lab) {
  const float f = (lab.a + 16) / 116;
  const float x = lab_uncurve(f + lab.b / 500), y = lab_uncurve(f),
              z = lab_uncurve(f - lab.c / 200);
  const flip::Triple linear =
      flip::opponent_to_linear({116 * y - 16, 500 * (x - y), 200 * (y - z)});
  const auto encoded = [](float v) { return flip::linear_to_srgb(std::clamp(v, 0.0f, 1.0f)); };
  return {encoded(linear.a), encoded(linear.b), encoded(linear.c)};
}

}  // namespace

Rgb ColourMap::operator()(float t) const {
  const float place = std::clamp(t, 0.0f, 1.0f) * (kSize - 1);
  return colours_[static_cast<std::size_t>(std::lround(place))];
}

ColourMap ColourMap::diverging() {
  ColourMap map;
  constexpr int kHalf = (kSize - 1) / 2;
  for (int i = -kHalf; i <= kHalf; ++i) {
    const float t = static_cast<float>(std::abs(i)) / kHalf;
    map.colours_.push_back(to_srgb(mix(kMiddle, i < 0 ? kBlueEnd : kOrangeEnd, t)));
  }
  return map;
}

ColourMap ColourMap::sequential() {
  ColourMap map;
  for (int i = 0; i < kSize; ++i) {
    map.colours_.push_back(to_srgb(mix(kDark, kLight, static_cast<float>(i) / (kSize - 1))));
  }
  return map;
}

}  // namespace octolux
