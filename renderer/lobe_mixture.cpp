// lobe_mixture.h.
#include "renderer/lobe_mixture.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "core/constants.h"
#include "core/frame.h"

namespace octolux {

void LobeMixture::add(Vec3 axis, float sharpness, float share) {
  OCTOLUX_CHECK(count_ < kMost);
  if (count_ % kLanes == 0) {
    for (PerLobe* values : {&x_, &y_, &z_, &sharpness_, &peak_}) {
      std::fill_n(values->begin() + static_cast<std::ptrdiff_t>(count_), kLanes, 0.0f);
    }
  }
  x_[count_] = axis.x;
  y_[count_] = axis.y;
  z_[count_] = axis.z;
  sharpness_[count_] = sharpness;
  peak_[count_] = share * (1 + 2 * sharpness) / (4 * kPi);
  share_[count_++] = share;
}

float LobeMixture::pdf_w(Vec3 wi) const {
  std::array<float, kLanes> sums{};
  for (std::size_t first = 0; first < count_; first += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t i = first + lane;
      const float cosine = x_[i] * wi.x + y_[i] * wi.y + z_[i] * wi.z;
      const float width = 1 + sharpness_[i] * (1 - cosine);
      sums[lane] += peak_[i] / (width * width);
    }
  }
  float sum = 0;
  for (const float s : sums) sum += s;
  return sum;
}

Vec3 LobeMixture::sample(Vec2 u) const {
  std::size_t i = 0;
  for (; i + 1 < count_ && u.x >= share_[i]; ++i) u.x -= share_[i];
  const float within = std::clamp(u.x / share_[i], 0.0f, kOneMinusEpsilon);
  // Of within = t (1 + 2k) / (2 (1 + k t)) the inverse.
  const float t = 2 * within / (1 + 2 * sharpness_[i] * (1 - within));
  const float sine = std::sqrt(std::max(0.0f, t * (2 - t)));
  const float phi = 2 * kPi * u.y;
  const Vec3 local{sine * std::cos(phi), sine * std::sin(phi), 1 - t};
  return Frame::from_normal({x_[i], y_[i], z_[i]}).to_world(local);
}

}  // namespace octolux
