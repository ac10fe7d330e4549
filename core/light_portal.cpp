// light_portal.h.
#include "core/light_portal.h"

#include <cmath>

#include "core/sampling.h"
#include "core/scene_sphere.h"

namespace octolux {

Portals::Portals(const std::vector<TriangleMesh>& meshes) {
  std::vector<double> areas;
  for (const TriangleMesh& mesh : meshes) {
    for (const auto& t : mesh.triangles) {
      const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
      const Vec3d normal = cross(b - a, c - a);
      corners_.push_back({a, b - a, c - a, normal});
      areas.push_back(length(normal) / 2);
    }
  }
  triangles_ = Distribution1D(areas);
}

Portals::Point Portals::sample(Vec2 u) const {
  const Distribution1D::Sample chosen = triangles_.sample(u.x);
  const Triangle& t = corners_[static_cast<std::size_t>(chosen.index)];
  const Vec2 b = sample_triangle({chosen.u, u.y});
  return {to_float(t.corner + t.u * static_cast<double>(b.x) + t.v * static_cast<double>(b.y)),
          chosen.index};
}

double Portals::line_density(Vec3 position, Vec3 direction, int triangle) const {
  const Vec3d d(direction);
  double shadows = 0;  // sum over the triangles crossed of area / area of its shadow
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Triangle& t = corners_[i];
    const double facing = dot(d, t.normal);
    const double across = std::abs(facing) / length(t.normal);  // cosine
    if (!(across > 0)) continue;
    if (static_cast<int>(i) != triangle) {
      const Vec3d moment = cross(Vec3d(position) - t.corner, d);  // Moller & Trumbore 1997
      const double b = -dot(t.v, moment) / facing;
      const double c = dot(t.u, moment) / facing;
      if (b < 0 || c < 0 || b + c > 1) continue;
    }
    shadows += 1 / across;
  }
  return shadows / area();
}

namespace {

/// A light as it was, but for its photons.
template <class Kind>
class AimedLight : public Kind {
 public:
  AimedLight(std::unique_ptr<Light> light, const Portals& portals)
      : light_(std::move(light)), portals_(portals) {}

  std::optional<LightSample> sample(Vec3 x, Vec2 u) const override { return light_->sample(x, u); }

  EmittedPhoton emit(Vec2 u_position, Vec2 u_direction) const override {
    const std::optional<LightSample> s = light_->sample(scene_.center, u_direction);
    if (!s) return {{scene_.center, {0, 0, 1}}, Rgb(0)};
    const bool aimed = u_position.x < kPortalShare;
    const float first = aimed ? 0 : kPortalShare;
    const float share = aimed ? kPortalShare : 1 - kPortalShare;
    u_position.x = std::min(kOneMinusEpsilon, (u_position.x - first) / share);

    Ray ray = scene_.incoming(s->wi, u_position).ray;
    int triangle = -1;
    if (aimed) {
      const Portals::Point p = portals_.sample(u_position);
      triangle = p.triangle;
      ray.origin = p.position + s->wi * dot(ray.origin - p.position, s->wi);
    }
    const Vec3 from_center = ray.origin - scene_.center;
    const Vec3 aside = from_center - s->wi * dot(from_center, s->wi);
    const bool in_disk = !aimed || length(aside) <= scene_.radius;
    const double pdf_a = (in_disk ? (1 - kPortalShare) / scene_.cross_section() : 0) +
                         kPortalShare * portals_.line_density(ray.origin, s->wi, triangle);
    if (!(pdf_a > 0)) return {ray, Rgb(0)};
    return {ray, s->radiance * static_cast<float>(1 / (pdf_a * static_cast<double>(s->pdf_w)))};
  }

  Rgb power() const override { return light_->power(); }

  bool narrow() const override { return light_->narrow(); }

  void set_scene_bounds(Vec3 center, float radius) override {
    scene_ = {center, radius, center};
    light_->set_scene_bounds(center, radius);
  }

 protected:
  const Light& light() const { return *light_; }

 private:
  std::unique_ptr<Light> light_;
  const Portals& portals_;
  SceneSphere scene_;
};

class AimedEnvironment final : public AimedLight<EnvironmentLight> {
 public:
  using AimedLight::AimedLight;
  Rgb radiance(Vec3 wi) const override { return environment().radiance(wi); }
  float pdf_w(Vec3 wi) const override { return environment().pdf_w(wi); }

 private:
  const EnvironmentLight& environment() const {
    return static_cast<const EnvironmentLight&>(light());
  }
};

}  // namespace

std::unique_ptr<Light> aim_at_portals(std::unique_ptr<Light> light, const Portals& portals) {
  if (dynamic_cast<const EnvironmentLight*>(light.get())) {
    return std::make_unique<AimedEnvironment>(std::move(light), portals);
  }
  return std::make_unique<AimedLight<Light>>(std::move(light), portals);
}

}  // namespace octolux
