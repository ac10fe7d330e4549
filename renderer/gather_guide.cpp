// gather_guide.h.
#include "renderer/gather_guide.h"

#include <algorithm>
#include <cmath>

#include "core/constants.h"
#include "core/frame.h"
#include "core/sampling.h"

namespace octolux {

namespace {

// A lobe's density is (1 + 2k) / (4 pi (1 + k t)^2), t = 1 - cos of the angle to its axis: a
// quarter of its peak at t = 1 / k. Limits of k: 26 and 2.6 degrees there.
constexpr float kMinSharpness = 10;
constexpr float kMaxSharpness = 1000;

/// The unevenness from which on rays follow a guide. Nearby: from 2 to 4 the error's variance grew
/// by a tenth where light comes through few openings, and fell by a sixth in Cornell. Learned: a
/// guide that is the same in all passes pays earlier; from 1.2 to 2.5 the variance changed by a
/// tenth at most, and was about least here.
constexpr float kNearbyWorthFollowing = 2.5f;
constexpr float kLearnedWorthFollowing = 1.5f;
constexpr float kMinCosine = 0.01f, kMinShare = 1e-6f;  // divisors

/// t of a lobe of sharpness k; the inverse of u = t (1 + 2k) / (2 (1 + k t)).
float sample_lobe(float u, float k) { return 2 * u / (1 + 2 * k * (1 - u)); }

}  // namespace

GatherGuide::GatherGuide(const PhotonMap& map, std::span<const Neighbour> photons, Vec3 normal) {
  const std::size_t stride = (photons.size() + kMaxLobes - 1) / kMaxLobes;
  float total = 0;
  for (std::size_t i = 0; i < photons.size(); i += stride) {
    const PhotonPayload& payload = map.payload(photons[i].photon);
    const float flux = luminance(unpack_flux(payload.flux));
    if (!scattered(payload) || !(flux > 0)) continue;
    const Vec3 axis = wi(payload);
    x_[count_] = axis.x;
    y_[count_] = axis.y;
    z_[count_] = axis.z;
    share_[count_++] = flux;
    total += flux;
  }
  for (std::size_t i = 0; i < count_; ++i) share_[i] /= total;
  fit_widths();
  unevenness_ = find_unevenness(normal);
}

/// A lobe reaches to the second nearest of the other axes.
void GatherGuide::fit_widths() {
  for (std::size_t i = 0; i < count_; ++i) {
    float nearest = 2;
    float second = 2;
    for (std::size_t j = 0; j < count_; ++j) {
      const float cosine = x_[i] * x_[j] + y_[i] * y_[j] + z_[i] * z_[j];
      const float t = i == j ? 2.0f : 1 - cosine;
      second = std::min(second, std::max(nearest, t));
      nearest = std::min(nearest, t);
    }
    const float k =
        std::clamp(1 / std::max(second, 1 / kMaxSharpness), kMinSharpness, kMaxSharpness);
    sharpness_[i] = k;
    peak_[i] = share_[i] * (1 + 2 * k) / (4 * kPi);
  }
}

float GatherGuide::find_unevenness(Vec3 normal) const {
  if (count_ < 2) return count_ == 0 ? 1 : kInfinity;
  float moment = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3 axis{x_[i], y_[i], z_[i]};
    const float own = peak_[i];  // its density at its own axis
    const float others = std::max(0.0f, pdf_w(axis) - own) / std::max(1 - share_[i], kMinShare);
    moment += share_[i] * others / (std::max(dot(axis, normal), kMinCosine) * kInvPi);
  }
  return moment;
}

float GatherGuide::pdf_w(Vec3 wi) const {
  float sum = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const float cosine = x_[i] * wi.x + y_[i] * wi.y + z_[i] * wi.z;
    const float width = 1 + sharpness_[i] * (1 - cosine);
    sum += peak_[i] / (width * width);
  }
  return sum;
}

Vec3 GatherGuide::sample(Vec2 u) const {
  std::size_t i = 0;
  for (; i + 1 < count_ && u.x >= share_[i]; ++i) u.x -= share_[i];
  const float t = sample_lobe(std::clamp(u.x / share_[i], 0.0f, kOneMinusEpsilon), sharpness_[i]);
  const float sine = std::sqrt(std::max(0.0f, t * (2 - t)));
  const float phi = 2 * kPi * u.y;
  const Vec3 local{sine * std::cos(phi), sine * std::sin(phi), 1 - t};
  return Frame::from_normal({x_[i], y_[i], z_[i]}).to_world(local);
}

GuidePair::GuidePair(const GatherGuide& nearby, const LearnedGuide* learned) : nearby_(nearby) {
  const float near = nearby.unevenness(), far = learned ? learned->unevenness() : 1;
  share_ = near > kNearbyWorthFollowing ? 1 : 0;
  if (!(far > kLearnedWorthFollowing)) return;
  learned_ = learned;
  // A single photon, infinite, has nobody to confirm it.
  if (share_ > 0) share_ = std::isinf(near) ? 0 : near / (near + far);
}

float GuidePair::pdf_w(Vec3 wi) const {
  return (share_ > 0 ? share_ * nearby_.pdf_w(wi) : 0) +
         (share_ < 1 ? (1 - share_) * learned_->pdf_w(wi) : 0);
}

Vec3 GuidePair::sample(Vec2 u) const {
  if (u.x < share_) return nearby_.sample({u.x / share_, u.y});
  return learned_->sample({std::min((u.x - share_) / (1 - share_), kOneMinusEpsilon), u.y});
}

GatherDirections::GatherDirections(const Scattering& at, const GuidePair& guides, int rays,
                                   const Points& points)
    : at_(at),
      guides_(guides),
      guided_(guided(guides, rays)),
      unguided_(rays - guided_),
      points_(points) {}

std::optional<GatherDirection> GatherDirections::draw(int i, Rng& rng) const {
  if (i >= unguided_) return by_guide(points_.by_guide[i - unguided_]);
  const float u_lobe = rng.uniform();
  return by_bsdf(u_lobe, points_.by_bsdf[i]);
}

std::optional<GatherDirection> GatherDirections::by_bsdf(float u_lobe, Vec2 u) const {
  const std::optional<BsdfSample> s = at_.sample(u_lobe, u, Lobes::smooth);
  if (!s || is_black(s->weight)) return std::nullopt;
  float rays = static_cast<float>(unguided_);
  if (guided_ > 0) rays += static_cast<float>(guided_) * guides_.pdf_w(s->wi) / s->pdf_w;
  return GatherDirection{s->wi, s->weight / rays, s->pdf_w};
}

std::optional<GatherDirection> GatherDirections::by_guide(Vec2 u) const {
  const Vec3 wi = guides_.sample(u);
  const Rgb f_cos = at_.f_cos(wi, Lobes::smooth);
  if (is_black(f_cos)) return std::nullopt;
  const float pdf_w = at_.pdf_w(wi, Lobes::smooth);
  const float density =
      static_cast<float>(unguided_) * pdf_w + static_cast<float>(guided_) * guides_.pdf_w(wi);
  if (!(density > 0)) return std::nullopt;  // rounded over the edge of what is known
  return GatherDirection{wi, f_cos / density, pdf_w};
}

}  // namespace octolux
