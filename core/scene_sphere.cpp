// scene_sphere.h. Around a focus the disk of starting points is star-shaped. Along a direction in
// which it reaches as far as sqrt(T), the square t of the distance from the focus is distributed by
//
//   F(t) = (ln(1 + t / near^2) / ln(1 + T / near^2) + t / T) / 2,
//
// directions being uniform, so that the density on the disk is F'(t) / pi: half of it falls as
// 1 / (near^2 + t), half is even. The unit square becomes directions and F by way of the unit disk,
// where F is the square of the distance from the centre: so neighbours stay neighbours.
#include "core/scene_sphere.h"

#include <cmath>

namespace octolux {

namespace {

class FromFocus {
 public:
  /// Along `way` (of any length) in the plane of s and t of `frame`.
  FromFocus(const SceneSphere& sphere, const Frame& frame, Vec2 way)
      : near2_(static_cast<double>(sphere.near) * static_cast<double>(sphere.near)) {
    const Vec3 from = sphere.focus - sphere.center;
    const auto x = static_cast<double>(dot(from, frame.s));
    const auto y = static_cast<double>(dot(from, frame.t));
    const auto way_x = static_cast<double>(way.x), way_y = static_cast<double>(way.y);
    const auto radius = static_cast<double>(sphere.radius);
    const double size = std::hypot(way_x, way_y);
    const double along = size > 0 ? (x * way_x + y * way_y) / size : 0;
    const double half_chord2 = along * along + radius * radius - x * x - y * y;
    const double reach = std::sqrt(std::max(0.0, half_chord2)) - along;
    all_ = std::max(reach * reach, kLeast * radius * radius);
    log_all_ = std::log1p(all_ / near2_);
  }

  /// F'(t) [m^-2].
  double slope(double t) const { return (1 / ((near2_ + t) * log_all_) + 1 / all_) / 2; }

  /// t with F(t) = v. In s = ln(1 + t / near^2) F is convex; of its two parts each is at most v, so
  /// s lies below either's root, and Newton's method comes down from there.
  double inverse(double v) const {
    double s = std::min(2 * v * log_all_, std::log1p(2 * v * all_ / near2_));
    for (int i = 0; i < kMostSteps; ++i) {
      const double t = near2_ * std::expm1(s);
      const double step = ((s / log_all_ + t / all_) / 2 - v) / ((near2_ + t) * slope(t));
      s -= step;
      if (!(step > kPrecision * s)) break;
    }
    return std::max(0.0, near2_ * std::expm1(s));
  }

 private:
  static constexpr int kMostSteps = 16;
  static constexpr double kPrecision = 1e-12;
  /// Reaches less than a thousandth of the radius are one: the focus may lie on the very rim.
  static constexpr double kLeast = 1e-6;

  double near2_, all_ = 0, log_all_ = 0;  // near^2, T, ln(1 + T / near^2)
};

}  // namespace

SceneSphere::Start SceneSphere::incoming(Vec3 wi, Vec2 u) const {
  const Frame frame = Frame::from_normal(wi);
  const float behind = radius + position_error_bound(abs(center) + Vec3{radius, radius, radius});
  const Vec2 d = sample_disk(u);
  if (!(near > 0)) {
    return {{center + (frame.s * d.x + frame.t * d.y) * radius + wi * behind, -wi},
            1 / cross_section()};
  }
  const double v = static_cast<double>(d.x * d.x + d.y * d.y);
  const FromFocus from(*this, frame, d);
  const double t = from.inverse(v);
  const Vec2 aside = d * static_cast<float>(v > 0 ? std::sqrt(t / v) : 0);
  const float back = dot(center - focus, wi) + behind;
  return {{focus + frame.s * aside.x + frame.t * aside.y + wi * back, -wi},
          static_cast<float>(from.slope(t)) * kInvPi};
}

}  // namespace octolux
