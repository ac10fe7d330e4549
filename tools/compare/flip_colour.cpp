// flip_colour.h: the colour pipeline of the FLIP paper's section 4.1, with its numbers.
#include "tools/compare/flip_colour.h"

#include <cmath>

namespace octolux::flip {
namespace {

/// Rec.709 to XYZ, from the primaries' exact chromaticities.
constexpr double kToXyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};

struct Matrix {
  float m[3][3];

  Triple operator*(Triple v) const {
    return {m[0][0] * v.a + m[0][1] * v.b + m[0][2] * v.c,
            m[1][0] * v.a + m[1][1] * v.b + m[1][2] * v.c,
            m[2][0] * v.a + m[2][1] * v.b + m[2][2] * v.c};
  }
};

/// Rec.709 to XYZ divided by white: every row sums to 1.
constexpr double relative_xyz(int row, int column) {
  return kToXyz[row][column] / (kToXyz[row][0] + kToXyz[row][1] + kToXyz[row][2]);
}

constexpr Matrix make_forward() {
  Matrix forward{};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) forward.m[r][c] = static_cast<float>(relative_xyz(r, c));
  }
  return forward;
}

/// Cofactor of row r, column c.
constexpr double cofactor(int r, int c) {
  const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
  return relative_xyz(r1, c1) * relative_xyz(r2, c2) - relative_xyz(r1, c2) * relative_xyz(r2, c1);
}

constexpr Matrix make_inverse() {
  double determinant = 0;
  for (int c = 0; c < 3; ++c) determinant += relative_xyz(0, c) * cofactor(0, c);
  Matrix inverse{};
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      inverse.m[r][c] = static_cast<float>(cofactor(c, r) / determinant);
    }
  }
  return inverse;
}

constexpr Matrix kForward = make_forward();
constexpr Matrix kInverse = make_inverse();

/// CIELAB's cube root with a straight line near black (CIE 15:2004, 8.2.1).
float lab_curve(float t) {
  constexpr float kDelta = 6.0f / 29;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0f / 29;
}

constexpr float kColourPower = 0.7f;

/// The largest distance, between green and blue, to the power.
float largest() {
  static const float value =
      std::pow(hyab(linear_to_hunt_lab({0, 1, 0}), linear_to_hunt_lab({0, 0, 1})), kColourPower);
  return value;
}

}  // namespace

float srgb_to_linear(float v) {
  return v > 0.04045f ? std::pow((v + 0.055f) / 1.055f, 2.4f) : v / 12.92f;
}

float linear_to_srgb(float v) {
  return v > 0.0031308f ? 1.055f * std::pow(v, 1 / 2.4f) - 0.055f : 12.92f * v;
}

Triple linear_to_opponent(Triple rgb) {
  const Triple xyz = kForward * rgb;
  return {116 * xyz.b - 16, 500 * (xyz.a - xyz.b), 200 * (xyz.b - xyz.c)};
}

Triple opponent_to_linear(Triple ycxcz) {
  const float y = (ycxcz.a + 16) / 116;
  return kInverse * Triple{y + ycxcz.b / 500, y, y - ycxcz.c / 200};
}

Triple linear_to_hunt_lab(Triple rgb) {
  const Triple xyz = kForward * rgb;
  const float x = lab_curve(xyz.a), y = lab_curve(xyz.b), z = lab_curve(xyz.c);
  const float lightness = 116 * y - 16;
  return {lightness, 0.01f * lightness * 500 * (x - y), 0.01f * lightness * 200 * (y - z)};
}

float hyab(Triple p, Triple q) {
  const float da = p.b - q.b, db = p.c - q.c;
  return std::abs(p.a - q.a) + std::sqrt(da * da + db * db);
}

float colour_error(float hyab_distance) {
  constexpr float kShare = 0.4f, kTarget = 0.95f;
  const float most = largest(), knee = kShare * most;
  const float e = std::pow(hyab_distance, kColourPower);
  if (e < knee) return kTarget / knee * e;
  return kTarget + (e - knee) / (most - knee) * (1 - kTarget);
}

}  // namespace octolux::flip
