// Shapes that emit. Meshes are sampled uniformly by area, density 1 / area. A quadric is sampled
// uniformly on the unit shape (area a) and carried to the world by its map A, which stretches area
// at the object normal n by |det A| |A^-T n| (Nanson): the density is the inverse of that over a.
// In terms of the world normal ng, which is A^-T n made unit, |A^-T n| = 1 / |A^T ng|.
//
// A sphere that emits outwards is seen from outside under a cone, and sampled uniformly in its
// solid angle (Shirley & Wang 1992): no noise from distance or foreshortening. All in double, in
// forms that do not cancel, from touching distance to a million radii away.
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/area_sampling.h"
#include "core/frame.h"
#include "core/light.h"
#include "core/mesh_patch.h"
#include "core/quadric.h"
#include "core/sampling.h"
#include "core/vec3d.h"

namespace octolux {
namespace {

using std::numbers::pi;

/// Radiance, and what all area lights do with a point once they have it.
class EmittingSurface : public AreaLight {
 public:
  explicit EmittingSurface(Color radiance) : radiance_(radiance) {}

  Rgb radiance(const SurfacePoint& y, Vec3 wo) const final {
    return dot(y.ng, wo) > 0 ? radiance_(y.uv) : Rgb(0);
  }

 protected:
  /// `y`, chosen with that density [m^-2], for a place x.
  std::optional<LightSample> towards(const SurfacePoint& y, Vec3 x, double pdf_a) const {
    return octolux::towards(y, x, pdf_a, radiance_(y.uv));
  }

  EmittedPhoton emit_from(const SurfacePoint& y, double pdf_a, Vec2 u_direction) const {
    const Frame frame = Frame::from_normal(y.ng);
    const Vec3 direction = normalize(frame.to_world(sample_cosine_hemisphere(u_direction)));
    return {{offset_origin(y.position, y.ng, y.error, direction), direction},
            radiance_(y.uv) * static_cast<float>(pi / pdf_a)};
  }

  /// pi times the integral of radiance over the area [m^2]; `place` is the surface's point for u in
  /// the unit square, and `pdf_a` its density. A texture is integrated by 128^2 points.
  template <class Place, class Density>
  Rgb power_of(double area, const Place& place, const Density& pdf_a) const {
    if (radiance_.is_constant()) return radiance_.mean() * static_cast<float>(pi * area);
    constexpr std::uint32_t n = 128 * 128;
    double sum[3] = {};
    for (std::uint32_t i = 0; i < n; ++i) {
      const SurfacePoint y = place(shifted_hammersley(i, n, {0.5f / n, 0.5f / n}));
      const Rgb radiance = radiance_(y.uv);
      for (int c = 0; c < 3; ++c) sum[c] += static_cast<double>(radiance[c]) / pdf_a(y);
    }
    return {static_cast<float>(sum[0] * pi / n), static_cast<float>(sum[1] * pi / n),
            static_cast<float>(sum[2] * pi / n)};
  }

  const Color radiance_;  // [W m^-2 sr^-1]
};

std::vector<std::uint32_t> all_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

class MeshLight final : public EmittingSurface {
 public:
  MeshLight(const TriangleMesh& mesh, Color radiance)
      : EmittingSurface(radiance), faces_(mesh, all_triangles(mesh)) {
    if (!dark()) {
      power_ = power_of(
          faces_.area(), [this](Vec2 u) { return faces_.point(u); },
          [this](const SurfacePoint&) { return pdf_a(); });
    }
  }

  std::optional<LightSample> sample(Vec3 x, Vec2 u) const override {
    return dark() ? std::nullopt : towards(faces_.point(u), x, pdf_a());
  }

  EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const override {
    if (dark()) return {{{}, {0, 0, 1}}, Rgb(0)};
    return emit_from(faces_.point(u_position), pdf_a(), u_direction);
  }

  Rgb power() const override { return power_; }

  float pdf_w(Vec3 x, const SurfacePoint& y) const override {
    return dark() ? 0 : to_pdf_w(pdf_a(), x, y);
  }

  std::optional<LightExtent> extent() const override { return faces_.extent(); }

 private:
  double pdf_a() const { return 1 / faces_.area(); }
  bool dark() const { return faces_.area() == 0 || is_black(radiance_.mean()); }

  MeshPatch faces_;
  Rgb power_;
};

/// The cone under which a sphere is seen from outside it.
struct Cone {
  Vec3d axis;      // unit, towards the centre
  double sin_max;  // sine and versine (1 - cosine) of its half angle
  double versine_max;

  double pdf_w() const { return 1 / (2 * pi * versine_max); }
};

class QuadricLight final : public EmittingSurface {
 public:
  QuadricLight(const Shape& shape, const Quadric& quadric, Color radiance)
      : EmittingSurface(radiance), quadric_(quadric), area_(octolux::area(shape)) {
    const Affine& a = quadric.to_world;
    for (int j = 0; j < 3; ++j) columns_[j] = {a.m[0][j], a.m[1][j], a.m[2][j]};
    center_ = {a.m[0][3], a.m[1][3], a.m[2][3]};
    volume_ = std::abs(dot(columns_[0], cross(columns_[1], columns_[2])));
    const bool sphere = quadric.kind == Quadric::Kind::sphere;
    if (sphere && !quadric.flip && is_similarity()) radius_ = std::cbrt(volume_);
    if (!dark()) {
      power_ = power_of(
          area_, [this](Vec2 u) { return point(u); },
          [this](const SurfacePoint& y) { return pdf_a(y); });
    }
  }

  std::optional<LightSample> sample(Vec3 x, Vec2 u) const override {
    if (dark()) return std::nullopt;
    if (const std::optional<Cone> cone = cone_from(x)) return sample_cone(*cone, u);
    const SurfacePoint y = point(u);
    return towards(y, x, pdf_a(y));
  }

  EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const override {
    if (dark()) return {{{}, {0, 0, 1}}, Rgb(0)};
    const SurfacePoint y = point(u_position);
    return emit_from(y, pdf_a(y), u_direction);
  }

  Rgb power() const override { return power_; }

  float pdf_w(Vec3 x, const SurfacePoint& y) const override {
    if (dark()) return 0;
    const float from_area = to_pdf_w(pdf_a(y), x, y);
    if (from_area == 0) return 0;
    const std::optional<Cone> cone = cone_from(x);
    return cone ? static_cast<float>(cone->pdf_w()) : from_area;
  }

  std::optional<LightExtent> extent() const override {
    const Bounds box = octolux::bounds(quadric_);
    const bool flat = quadric_.kind == Quadric::Kind::disk;
    return flat ? LightExtent{box, surface_point(quadric_, {}).ng, 0} : LightExtent{box};
  }

 private:
  bool dark() const { return !(area_ > 0) || !(volume_ > 0) || is_black(radiance_.mean()); }

  /// Are A's columns orthogonal and equally long, to the precision of numbers in scene files?
  bool is_similarity() const {
    constexpr double tolerance = 1e-6;
    const double size2 = std::cbrt(volume_ * volume_);
    bool similar = volume_ > 0;
    for (int i = 0; i < 3; ++i) {
      const Vec3d next = columns_[(i + 1) % 3];
      similar &= std::abs(dot(columns_[i], columns_[i]) - size2) <= tolerance * size2;
      similar &= std::abs(dot(columns_[i], next)) <= tolerance * size2;
    }
    return similar;
  }

  SurfacePoint point(Vec2 u) const {
    if (quadric_.kind == Quadric::Kind::sphere) return surface_point(quadric_, sample_sphere(u));
    if (quadric_.kind == Quadric::Kind::disk) {
      const Vec2 d = sample_disk(u);
      return surface_point(quadric_, {d.x, d.y, 0});
    }
    const float phi = 2 * kPi * u.x;
    return surface_point(quadric_, {std::cos(phi), std::sin(phi), u.y});
  }

  /// A^T v.
  Vec3d transposed(Vec3d v) const {
    return {dot(columns_[0], v), dot(columns_[1], v), dot(columns_[2], v)};
  }

  double pdf_a(const SurfacePoint& y) const {
    constexpr double kUnitArea[] = {4 * pi, pi, 2 * pi};  // sphere, disk, cylinder
    return length(transposed(Vec3d(y.ng))) / (kUnitArea[int(quadric_.kind)] * volume_);
  }

  /// Empty if the sphere is not to be sampled by solid angle from x. That is also so within
  /// rounding of its surface: x may then be a point of the sphere, which sees nothing of it.
  std::optional<Cone> cone_from(Vec3 x) const {
    if (radius_ == 0) return std::nullopt;
    const Vec3d d = center_ - Vec3d(x);
    const double distance = length(d);
    const Vec3 extent = abs(to_float(center_)) + Vec3{1, 1, 1} * static_cast<float>(radius_);
    if (!(distance > radius_ + position_error_bound(extent))) return std::nullopt;
    const double sin_max = radius_ / distance;
    const double cos_max = std::sqrt((distance - radius_) * (distance + radius_)) / distance;
    return Cone{d * (1 / distance), sin_max, sin_max * sin_max / (1 + cos_max)};
  }

  LightSample sample_cone(const Cone& cone, Vec2 u) const {
    const double versine = u.x * cone.versine_max;
    const double cosine = 1 - versine;
    const double sine2 = versine * (2 - versine);
    const double phi = 2 * pi * u.y;
    const Frame frame = Frame::from_normal(to_float(cone.axis));
    const Vec3d across =
        Vec3d(frame.s) * std::cos(phi) + Vec3d(frame.t) * std::sin(phi);  // unit, normal to axis

    // The angle at the centre between the way to x and the way to the point that is seen: its
    // cosine is sin_max s^2 + cos theta sqrt(1 - s^2) with s = sin theta / sin_max.
    const double s2 = std::min(1.0, sine2 / (cone.sin_max * cone.sin_max));
    const double cos_centre = cone.sin_max * s2 + cosine * std::sqrt(1 - s2);
    const double sin_centre = std::sqrt(std::max(0.0, (1 - cos_centre) * (1 + cos_centre)));
    const Vec3d normal = across * sin_centre - cone.axis * cos_centre;

    LightSample s;
    s.wi = unit_or(cone.axis * cosine + across * std::sqrt(sine2), to_float(cone.axis));
    s.pdf_w = static_cast<float>(cone.pdf_w());
    s.at = surface_point(quadric_, to_float(transposed(normal) * (1 / radius_)));
    s.radiance = radiance_(s.at.uv);
    return s;
  }

  const Quadric& quadric_;
  std::array<Vec3d, 3> columns_;  // of A
  Vec3d center_;
  double volume_ = 0;  // |det A|
  double area_ = 0;    // [m^2]
  Rgb power_;
  double radius_ = 0;  // [m] of a sphere that is sampled by solid angle; otherwise 0
};

}  // namespace

std::unique_ptr<AreaLight> make_area_light(const Shape& shape, Color radiance) {
  if (const auto* quadric = std::get_if<Quadric>(&shape.geometry)) {
    return std::make_unique<QuadricLight>(shape, *quadric, radiance);
  }
  return std::make_unique<MeshLight>(std::get<TriangleMesh>(shape.geometry), radiance);
}

}  // namespace octolux
