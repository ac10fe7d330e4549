// Linear Rec.709 colour: radiance, flux, reflectance. The only type with component-wise products.
#pragma once

#include <algorithm>
#include <cmath>

namespace octolux {

struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr Rgb(float r_, float g_, float b_) : r(r_), g(g_), b(b_) {}
  explicit constexpr Rgb(float grey) : r(grey), g(grey), b(grey) {}

  constexpr Rgb& operator+=(Rgb c) { return r += c.r, g += c.g, b += c.b, *this; }
  constexpr Rgb& operator*=(Rgb c) { return r *= c.r, g *= c.g, b *= c.b, *this; }
  constexpr Rgb& operator*=(float s) { return r *= s, g *= s, b *= s, *this; }
  constexpr float operator[](int channel) const { return channel == 0 ? r : channel == 1 ? g : b; }
};

constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Rgb operator*(float s, Rgb a) { return a * s; }
constexpr Rgb operator/(Rgb a, Rgb b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }
constexpr Rgb operator/(Rgb a, float s) { return a * (1 / s); }
constexpr bool operator==(Rgb a, Rgb b) { return a.r == b.r && a.g == b.g && a.b == b.b; }

/// Relative luminance Y of linear Rec.709 (ITU-R BT.709-6, 3.2).
constexpr float luminance(Rgb c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; }
constexpr float max_component(Rgb c) { return std::max(c.r, std::max(c.g, c.b)); }
constexpr float mean(Rgb c) { return (c.r + c.g + c.b) * (1.0f / 3.0f); }
constexpr bool is_black(Rgb c) { return c.r == 0 && c.g == 0 && c.b == 0; }
inline bool is_finite(Rgb c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

}  // namespace octolux
