// Lambert's law: the same radiance towards every direction of the front side. By far the most
// frequent BSDF, so everything here is a few instructions.
#include "core/bsdf_makers.h"
#include "core/constants.h"
#include "core/sampling.h"

namespace octolux {
namespace {

class Diffuse final : public Bsdf {
 public:
  explicit Diffuse(Color reflectance) : Bsdf(Lobes::smooth), reflectance_(reflectance) {}

  Rgb f(const SurfacePoint& at, Vec3 wo, Vec3 wi, Lobes lobes, Carried) const override {
    if (wo.z <= 0 || wi.z <= 0 || !any(lobes & Lobes::smooth)) return Rgb(0);
    return reflectance_(at.uv) * kInvPi;
  }

  float pdf_w(const SurfacePoint&, Vec3 wo, Vec3 wi, Lobes lobes) const override {
    if (wo.z <= 0 || !any(lobes & Lobes::smooth)) return 0;
    return cosine_hemisphere_pdf_w(wi);
  }

  std::optional<BsdfSample> sample(const SurfacePoint& at, Vec3 wo, float, Vec2 u, Lobes lobes,
                                   Carried) const override {
    if (wo.z <= 0 || !any(lobes & Lobes::smooth)) return std::nullopt;
    const Rgb weight = reflectance_(at.uv);
    if (is_black(weight)) return std::nullopt;
    const Vec3 wi = sample_cosine_hemisphere(u);
    return BsdfSample{wi, weight, wi.z * kInvPi, Lobes::smooth, 1};
  }

  Rgb albedo(const SurfacePoint& at) const override { return reflectance_(at.uv); }

  std::optional<Rgb> lambertian(const SurfacePoint& at, Vec3 wo) const override {
    return wo.z > 0 ? reflectance_(at.uv) : Rgb(0);
  }

 private:
  Color reflectance_;
};

}  // namespace

std::unique_ptr<Bsdf> make_diffuse(Color reflectance) {
  return std::make_unique<Diffuse>(reflectance);
}

}  // namespace octolux
