// A picture of the surroundings, in the layout of Mitsuba 3's `envmap`: column i is centred on
// u = (i + 1/2) / width and wraps around, row j lies on polar angle pi j / (height - 1), so the
// first and last row are the poles; bilinear in between.
//
// Four neighbouring texels span a cell. A cell is chosen with probability proportional to its exact
// integral of luminance over solid angle, a place in it with density proportional to the bilinear
// luminance: radiance / pdf_w is then constant for a grey picture but for the ratio of sin theta to
// its luminance-weighted mean in the cell, at most 3. sample() evaluates radiance and density for
// the direction it has rounded, so both agree with radiance() and pdf_w() even across the border of
// a cell.
#include <array>
#include <cmath>
#include <numbers>

#include "core/distribution.h"
#include "core/envmap_sun.h"
#include "core/light.h"
#include "core/scene_sphere.h"
#include "core/vec3d.h"

namespace octolux {
namespace {

using std::numbers::pi;

Rgb sanitised(Rgb c) {
  const auto channel = [](float v) { return std::isfinite(v) && v > 0 ? v : 0.0f; };
  return {channel(c.r), channel(c.g), channel(c.b)};
}

/// Orthonormal columns from A's by Gram and Schmidt; the third keeps A's handedness.
std::array<Vec3, 3> rotation_of(const Affine& a) {
  const auto column = [&a](int j) { return Vec3d(a.m[0][j], a.m[1][j], a.m[2][j]); };
  const Vec3d x(unit_or(column(0), {1, 0, 0}));
  const Vec3 y = unit_or(column(1) - x * dot(x, column(1)), {0, 1, 0});
  const Vec3d z = cross(x, Vec3d(y));
  return {to_float(x), y, unit_or(z * (dot(z, column(2)) < 0 ? -1 : 1), {0, 0, 1})};
}

/// Integrals over a row of cells, polar angles theta0 to theta1, of sin theta (1 - t) and
/// sin theta t, where t runs from 0 to 1: the weights of its upper and lower texels.
struct RowWeights {
  double upper, lower;
};
RowWeights row_weights(int row, int rows) {
  const double step = pi / rows;
  const double theta0 = row * step;
  const double theta1 = theta0 + step;
  const double lower = (std::sin(theta1) - std::sin(theta0)) / step - std::cos(theta1);
  return {std::cos(theta0) - std::cos(theta1) - lower, lower};
}

class EnvmapLight final : public EnvironmentLight {
 public:
  EnvmapLight(Image image, const Affine& to_world, float scale)
      : image_(std::move(image)),
        rows_(std::max(1, image_.height - 1)),
        axes_(rotation_of(to_world)) {
    for (Rgb& c : image_.pixels) c = sanitised(c * scale);
    prepare();
    narrow_ = lit_solid_angle(image_) <= kNarrow;
  }

  std::optional<LightSample> sample(Vec3 /*x*/, Vec2 u) const override {
    const Distribution2D::Sample chosen = cells_.sample(u);
    if (chosen.pmf == 0) return std::nullopt;
    const Corners l = luminances(chosen.x, chosen.y);
    const float t = sample_linear(chosen.u.y, l[0] + l[1], l[2] + l[3]);
    const float s = sample_linear(chosen.u.x, lerp(t, l[0], l[2]), lerp(t, l[1], l[3]));
    LightSample result;
    result.wi = direction(static_cast<float>(chosen.x) + s, static_cast<float>(chosen.y) + t);
    const Place place = locate(result.wi);
    result.radiance = radiance_at(place);
    result.pdf_w = pdf_w_at(place);
    result.infinite = true;
    if (result.pdf_w == 0) return std::nullopt;
    return result;
  }

  EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const override {
    const std::optional<LightSample> s = sample(scene_.center, u_direction);
    if (!s) return {{scene_.center, {0, 0, 1}}, Rgb(0)};
    const SceneSphere::Start start = scene_.incoming(s->wi, u_position);
    return {start.ray, s->radiance * (1 / start.pdf_a / s->pdf_w)};
  }

  Rgb power() const override { return integral_ * scene_.cross_section(); }

  void set_scene_bounds(Vec3 center, float radius) override { scene_ = {center, radius, center}; }

  void set_focus(Vec3 focus, float near) override { scene_.focus = focus, scene_.near = near; }

  Rgb radiance(Vec3 wi) const override { return radiance_at(locate(wi)); }

  float pdf_w(Vec3 wi) const override { return pdf_w_at(locate(wi)); }

  bool narrow() const override { return narrow_; }

 private:
  using Corners = std::array<float, 4>;  // upper left, upper right, lower left, lower right

  /// A place on the picture: its cell, and (s, t) in [0, 1]^2 there.
  struct Place {
    int x, y;
    float s, t;
    float sin_theta;
  };

  static float lerp(float t, float a, float b) { return a * (1 - t) + b * t; }

  const Rgb& texel(int x, int y) const {
    return image_.at(x < image_.width ? x : 0, std::min(y, image_.height - 1));
  }

  Corners luminances(int x, int y) const {
    return {luminance(texel(x, y)), luminance(texel(x + 1, y)), luminance(texel(x, y + 1)),
            luminance(texel(x + 1, y + 1))};
  }

  /// Cell weights, and the integral of radiance over all directions, both exact: around the axis
  /// the mean of a bilinear row is the mean of its texels.
  void prepare() {
    std::vector<double> weights;
    weights.reserve(static_cast<std::size_t>(image_.width) * rows_);
    std::array<double, 3> sum{};
    for (int y = 0; y < rows_; ++y) {
      const auto [upper, lower] = row_weights(y, rows_);
      for (int x = 0; x < image_.width; ++x) {
        const Corners l = luminances(x, y);
        weights.push_back((l[0] + l[1]) * upper + (l[2] + l[3]) * lower);
        for (int c = 0; c < 3; ++c) sum[c] += texel(x, y)[c] * upper + texel(x, y + 1)[c] * lower;
      }
    }
    cells_ = Distribution2D(weights, image_.width, rows_);
    const double cell_width = 2 * pi / image_.width;
    integral_ = {static_cast<float>(sum[0] * cell_width), static_cast<float>(sum[1] * cell_width),
                 static_cast<float>(sum[2] * cell_width)};
  }

  /// World direction of a place in units of cells, x in [0, width], y in [0, rows].
  Vec3 direction(float x, float y) const {
    const float theta = y / static_cast<float>(rows_) * kPi;
    const float phi = (x + 0.5f) / static_cast<float>(image_.width) * (2 * kPi);
    const float sin_theta = std::sin(theta);
    return normalize(axes_[0] * (std::sin(phi) * sin_theta) + axes_[1] * std::cos(theta) -
                     axes_[2] * (std::cos(phi) * sin_theta));
  }

  Place locate(Vec3 wi) const {
    const Vec3 d{dot(wi, axes_[0]), dot(wi, axes_[1]), dot(wi, axes_[2])};
    const float sin_theta = std::hypot(d.x, d.z);
    const float turn = std::atan2(d.x, -d.z) * (0.5f * kInvPi);  // [-1/2, 1/2]
    float x = turn * static_cast<float>(image_.width) - 0.5f;
    if (x < 0) x += static_cast<float>(image_.width);
    const float y = std::atan2(sin_theta, d.y) * kInvPi * static_cast<float>(rows_);
    const int column = std::clamp(static_cast<int>(x), 0, image_.width - 1);
    const int row = std::clamp(static_cast<int>(y), 0, rows_ - 1);
    return {column, row, std::clamp(x - static_cast<float>(column), 0.0f, 1.0f),
            std::clamp(y - static_cast<float>(row), 0.0f, 1.0f), sin_theta};
  }

  Rgb radiance_at(const Place& p) const {
    const Rgb upper = texel(p.x, p.y) * (1 - p.s) + texel(p.x + 1, p.y) * p.s;
    const Rgb lower = texel(p.x, p.y + 1) * (1 - p.s) + texel(p.x + 1, p.y + 1) * p.s;
    return upper * (1 - p.t) + lower * p.t;
  }

  float pdf_w_at(const Place& p) const {
    const float pmf = cells_.total() > 0 ? cells_.pmf(p.x, p.y) : 0;
    if (pmf == 0) return 0;
    const Corners l = luminances(p.x, p.y);
    const float here = lerp(p.t, lerp(p.s, l[0], l[1]), lerp(p.s, l[2], l[3]));
    const float in_cell = 4 * here / (l[0] + l[1] + l[2] + l[3]);  // on [0, 1]^2
    // d omega = sin theta d theta d phi; at the very pole the density is only kept finite.
    const float cells_per_area = static_cast<float>(image_.width) * static_cast<float>(rows_);
    return pmf * in_cell * cells_per_area / (2 * kPi * kPi * std::max(p.sin_theta, 0x1p-40f));
  }

  Image image_;
  int rows_;                  // of cells
  std::array<Vec3, 3> axes_;  // of the picture, in the world
  Distribution2D cells_;
  Rgb integral_;  // of radiance over directions [W m^-2]
  bool narrow_ = false;
  SceneSphere scene_;
};

}  // namespace

std::unique_ptr<EnvironmentLight> make_envmap_light(Image image, const Affine& to_world,
                                                    float scale) {
  return std::make_unique<EnvmapLight>(std::move(image), to_world, scale);
}

}  // namespace octolux
