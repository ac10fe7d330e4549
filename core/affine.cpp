// Affine maps in double precision: composition, inverse by cofactors, rotation (Rodrigues'
// formula), look-at. Pure functions.
#include "core/affine.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace octolux {
namespace {

using Column = std::array<double, 3>;

Column operator-(const Column& a, const Column& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Column cross(const Column& a, const Column& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Column& a) { return std::hypot(a[0], a[1], a[2]); }
Column unit(const Column& a) {
  const double l = length(a);
  return {a[0] / l, a[1] / l, a[2] / l};
}
Column column(const Affine& a, int j) { return {a.m[0][j], a.m[1][j], a.m[2][j]}; }
Column to_column(Vec3 v) { return {v.x, v.y, v.z}; }

/// A p, plus b times `w`.
Vec3 apply(const Affine& a, Vec3 p, double w) {
  const auto row = [&](int i) {
    return static_cast<float>(a.m[i][0] * p.x + a.m[i][1] * p.y + a.m[i][2] * p.z + a.m[i][3] * w);
  };
  return {row(0), row(1), row(2)};
}

}  // namespace

Vec3 Affine::point(Vec3 p) const { return apply(*this, p, 1); }
Vec3 Affine::vector(Vec3 v) const { return apply(*this, v, 0); }

Vec3 Affine::normal(const Affine& inverse, Vec3 n) {
  const auto row = [&](int i) {
    return static_cast<float>(inverse.m[0][i] * n.x + inverse.m[1][i] * n.y +
                              inverse.m[2][i] * n.z);
  };
  return {row(0), row(1), row(2)};
}

double Affine::determinant() const {
  const Column c = cross(column(*this, 0), column(*this, 1));
  const Column z = column(*this, 2);
  return c[0] * z[0] + c[1] * z[1] + c[2] * z[2];
}

std::optional<Affine> Affine::inverse() const {
  const Column x = column(*this, 0), y = column(*this, 1), z = column(*this, 2);
  const double det = determinant();
  // Hadamard: |det A| <= |x| |y| |z|. Below the rounding error of that product there is nothing.
  const double rounding = 16 * std::numeric_limits<double>::epsilon();
  if (!(std::abs(det) > rounding * length(x) * length(y) * length(z))) return std::nullopt;

  const std::array<Column, 3> rows{cross(y, z), cross(z, x), cross(x, y)};
  Affine result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.m[i][j] = rows[i][j] / det;
    const auto& r = result.m[i];
    result.m[i][3] = -(r[0] * m[0][3] + r[1] * m[1][3] + r[2] * m[2][3]);
    for (const double value : r) {
      if (!std::isfinite(value)) return std::nullopt;
    }
  }
  return result;
}

Affine operator*(const Affine& outer, const Affine& inner) {
  Affine result;
  for (int i = 0; i < 3; ++i) {
    const auto& o = outer.m[i];
    for (int j = 0; j < 4; ++j) {
      result.m[i][j] = o[0] * inner.m[0][j] + o[1] * inner.m[1][j] + o[2] * inner.m[2][j];
    }
    result.m[i][3] += o[3];
  }
  return result;
}

Affine translation(double x, double y, double z) {
  return {{{{1, 0, 0, x}, {0, 1, 0, y}, {0, 0, 1, z}}}};
}

Affine scaling(double x, double y, double z) {
  return {{{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}}};
}

Affine rotation(double x, double y, double z, double degrees) {
  const double angle = degrees * (std::numbers::pi / 180);
  const double c = std::cos(angle), s = std::sin(angle);
  const Column k = unit({x, y, z});
  const double t = 1 - c;
  return {{{{t * k[0] * k[0] + c, t * k[0] * k[1] - s * k[2], t * k[0] * k[2] + s * k[1], 0},
            {t * k[0] * k[1] + s * k[2], t * k[1] * k[1] + c, t * k[1] * k[2] - s * k[0], 0},
            {t * k[0] * k[2] - s * k[1], t * k[1] * k[2] + s * k[0], t * k[2] * k[2] + c, 0}}}};
}

std::optional<Affine> look_at(Vec3 origin, Vec3 target, Vec3 up) {
  const Column from = to_column(origin);
  const Column view = to_column(target) - from;
  const Column left = cross(to_column(up), view);
  // The sine between `up` and the view; float input makes anything below float precision noise.
  const double sine = length(left) / (length(view) * length(to_column(up)));
  if (!(sine > std::numeric_limits<float>::epsilon())) return std::nullopt;

  const Column x = unit(left), z = unit(view), y = cross(z, x);
  Affine result;
  for (int i = 0; i < 3; ++i) result.m[i] = {x[i], y[i], z[i], from[i]};
  return result;
}

}  // namespace octolux
