// Fresnel reflectance of conductors, and the hemispherical averages of dielectrics; see fresnel.h.
#include "core/fresnel.h"

namespace octolux {

float fresnel_conductor(float cos_incident, float eta, float k) {
  const float c2 = cos_incident * cos_incident;
  const float s2 = 1 - c2;
  const float t = eta * eta - k * k - s2;
  // (eta + i k)^2 - sin^2 = (a + i b)^2, of which a and a^2 + b^2 are wanted.
  const float a2_plus_b2 = std::sqrt(t * t + 4 * eta * eta * k * k);
  const float a = std::sqrt(std::max(0.0f, 0.5f * (a2_plus_b2 + t)));

  const float even_s = a2_plus_b2 + c2;
  const float odd_s = 2 * cos_incident * a;
  const float rs = (even_s - odd_s) / (even_s + odd_s);

  const float even_p = a2_plus_b2 * c2 + s2 * s2;
  const float odd_p = odd_s * s2;
  const float rp = even_p + odd_p > 0 ? rs * (even_p - odd_p) / (even_p + odd_p) : rs;
  return std::clamp(0.5f * (rs + rp), 0.0f, 1.0f);
}

Rgb fresnel_conductor(float cos_incident, Rgb eta, Rgb k) {
  return {fresnel_conductor(cos_incident, eta.r, k.r), fresnel_conductor(cos_incident, eta.g, k.g),
          fresnel_conductor(cos_incident, eta.b, k.b)};
}

float fresnel_diffuse_reflectance(float eta) {
  if (eta < 1) return -1.4399f * eta * eta + 0.7099f * eta + 0.6681f + 0.0636f / eta;
  const float x = 1 / eta;
  const float high = -7.80989f + x * (4.98554f - 1.36881f * x);
  return 0.919317f + x * (-3.4793f + x * (6.75335f + x * high));
}

}  // namespace octolux
