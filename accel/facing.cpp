// facing.h.
#include "accel/facing.h"

#include <array>
#include <cmath>

namespace octolux {

namespace {

/// Classes as a structure of arrays, for SIMD. The first six are walls: normals within 1.8 degrees
/// of an axis. The others are the cells of the 26 directions, less the walls.
struct Classes {
  static constexpr int kWalls = 6, kCount = 32;
  alignas(64) std::array<float, kCount> x{}, y{}, z{};
  alignas(64) std::array<float, kCount> near_cosine{}, across_cosine{};

  constexpr Classes() {
    int wall = 0, cell = kWalls;
    for (int i = 0; i < 27; ++i) {
      const int a = i % 3 - 1, b = i / 3 % 3 - 1, c = i / 9 - 1;
      const int components = a * a + b * b + c * c;
      if (components == 1) set(wall++, a, b, c, kNearWall, kAcrossWall);
      if (components != 0) set(cell++, a, b, c, kNearCell, kAcrossCell);
    }
  }

 private:
  // kFacingCosine is that of 45.6 degrees. A cell reaches 27.9 degrees from its direction, the
  // radius of the circle through those of a face, an edge and a corner. So these are the cosines of
  // 47.4 and 73.5 degrees, with room for rounding,
  static constexpr float kNearWall = 0.675f, kNearCell = 0.28f;
  // and these of 43.8 and 17.7 degrees.
  static constexpr float kAcrossWall = 0.724f, kAcrossCell = 0.954f;

  constexpr void set(int i, int a, int b, int c, float near, float across) {
    constexpr float kInverseLength[4] = {0, 1, 0.70710678f, 0.57735027f};
    const float scale = kInverseLength[a * a + b * b + c * c];
    x[i] = static_cast<float>(a) * scale;
    y[i] = static_cast<float>(b) * scale;
    z[i] = static_cast<float>(c) * scale;
    near_cosine[i] = near;
    across_cosine[i] = across;
  }
};
constexpr Classes kClasses;
constexpr float kWallCosine = 0.9995f;

float cosine_to(int i, Vec3 normal) {
  return kClasses.x[i] * normal.x + kClasses.y[i] * normal.y + kClasses.z[i] * normal.z;
}

}  // namespace

FacingSet facing(Vec3 normal) {
  for (int i = 0; i < Classes::kWalls; ++i) {
    if (cosine_to(i, normal) > kWallCosine) return FacingSet{1} << i;
  }
  int best = Classes::kWalls;
  for (int i = best + 1; i < Classes::kCount; ++i) {
    if (cosine_to(i, normal) > cosine_to(best, normal)) best = i;
  }
  return FacingSet{1} << best;
}

FacingSet facing_near(Vec3 normal) {
  FacingSet classes = 0;
  for (int i = 0; i < Classes::kCount; ++i) {
    classes |= static_cast<FacingSet>(cosine_to(i, normal) > kClasses.near_cosine[i]) << i;
  }
  return classes;
}

FacingSet facing_across(Vec3 normal) {
  FacingSet classes = 0;
  for (int i = 0; i < Classes::kCount; ++i) {
    const bool across = std::abs(cosine_to(i, normal)) < kClasses.across_cosine[i];
    classes |= static_cast<FacingSet>(across) << i;
  }
  return classes;
}

}  // namespace octolux
