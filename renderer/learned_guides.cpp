// learned_guides.h.
#include "renderer/learned_guides.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "accel/facing.h"
#include "core/constants.h"
#include "core/parallel.h"
#include "core/sampling.h"
#include "core/shape.h"

namespace octolux {

namespace {

constexpr std::size_t kCellPhotons = 512;  // at most
constexpr std::size_t kLeafPhotons = 8;    // of a cell's density, fewer
constexpr std::size_t kPhotons = 1 << 21;  // of 40 bytes; more teach little
/// A photon that counts more than so many of the cell's mean would hide what all others tell.
constexpr float kMostMeans = 3;
constexpr std::size_t kParallel = 4 * kCellPhotons;  // photons worth a thread

float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::size_t facing_index(Vec3 normal) {
  return static_cast<std::size_t>(std::countr_zero(facing(normal)));
}

/// The mean, by mass, of a density at points it was not made from.
double mean_at(const QuadDensity& density, std::span<const QuadDensity::Point> points) {
  double sum = 0, mass = 0;
  for (const QuadDensity::Point& p : points) {
    sum += static_cast<double>(p.mass) * density(p.u);
    mass += p.mass;
  }
  return mass > 0 ? sum / mass : 1;
}

}  // namespace

LearnedGuide::LearnedGuide(Vec3 normal, QuadDensity density, float unevenness)
    : frame_(Frame::from_normal(normal)), density_(std::move(density)), unevenness_(unevenness) {}

float LearnedGuide::pdf_w(Vec3 wi) const {
  const Vec3 w = frame_.to_local(wi);
  const float cosine_pdf_w = cosine_hemisphere_pdf_w(w);
  return cosine_pdf_w > 0 ? cosine_pdf_w * density_(square_of_disk({w.x, w.y})) : 0;
}

Vec3 LearnedGuide::sample(Vec2 u) const {
  return frame_.to_world(sample_cosine_hemisphere(density_.sample(u)));
}

bool LearnedGuides::add(const std::vector<Photon>& photons) {
  const std::size_t stride = 1 + photons.size() / kPhotons;  // of a very large pass, some
  for (std::size_t i = 0; i < photons.size(); i += stride) {
    const Photon& p = photons[i];
    const float flux = luminance(p.flux);
    // What came straight from a light is brought by next-event estimation.
    if (p.segments < 2 || !is_usable(p) || !(flux > 0)) continue;
    arrivals_[facing_index(p.normal)].push_back({p.position, p.wi, p.normal, flux});
    ++kept_;
  }
  return kept_ < kPhotons;
}

void LearnedGuides::build() {
  for (std::size_t f = 0; f < kFacings; ++f) {
    if (arrivals_[f].empty()) continue;
    const std::size_t cells =
        std::bit_ceil((arrivals_[f].size() + kCellPhotons - 1) / kCellPhotons);
    trees_[f] = {std::vector<Split>(cells - 1), std::vector<LearnedGuide>(cells)};
    trees_[f].build(arrivals_[f], 0);
  }
  arrivals_ = {};
}

LearnedGuides::Split LearnedGuides::split(std::span<Arrival> arrivals) {
  Bounds bounds;
  for (const Arrival& a : arrivals) bounds.add(a.position);
  const Vec3 side = bounds.upper - bounds.lower;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  const auto middle = arrivals.begin() + static_cast<std::ptrdiff_t>(arrivals.size() / 2);
  std::nth_element(arrivals.begin(), middle, arrivals.end(),
                   [axis](const Arrival& a, const Arrival& b) {
                     return component(a.position, axis) < component(b.position, axis);
                   });
  return {axis, component(middle->position, axis)};
}

void LearnedGuides::Tree::build(std::span<Arrival> arrivals, std::size_t node) {
  if (node >= splits.size()) {
    cells[node - splits.size()] = guide(arrivals);
    return;
  }
  splits[node] = split(arrivals);
  const std::size_t half = arrivals.size() / 2;
  const auto lower = [&] { build(arrivals.first(half), 2 * node + 1); };
  const auto upper = [&] { build(arrivals.subspan(half), 2 * node + 2); };
  if (arrivals.size() < kParallel) {
    lower();
    upper();
  } else {
    parallel_invoke(lower, upper);
  }
}

LearnedGuide LearnedGuides::Tree::guide(std::span<Arrival> arrivals) {
  split(arrivals);
  Vec3 normal{};
  double flux = 0;
  for (const Arrival& a : arrivals) {
    normal += a.normal;
    flux += a.flux;
  }
  normal = normalize(normal);
  const Frame frame = Frame::from_normal(normal);
  const auto most = static_cast<float>(kMostMeans * flux / static_cast<double>(arrivals.size()));
  std::vector<QuadDensity::Point> points;
  points.reserve(arrivals.size());
  for (const Arrival& a : arrivals) {
    const Vec3 w = frame.to_local(a.wi);  // below the horizon only where the cell is curved
    points.push_back({square_of_disk({w.x, w.y}), w.z > 0 ? std::min(a.flux, most) : 0});
  }
  const std::span<QuadDensity::Point> all(points);
  const std::span<QuadDensity::Point> below = all.first(all.size() / 2);
  const std::span<QuadDensity::Point> above = all.subspan(all.size() / 2);
  const double unevenness = (mean_at(QuadDensity(below, kLeafPhotons), above) +
                             mean_at(QuadDensity(above, kLeafPhotons), below)) /
                            2;
  return {normal, QuadDensity(all, kLeafPhotons), static_cast<float>(unevenness)};
}

const LearnedGuide* LearnedGuides::find(Vec3 position, Vec3 normal) const {
  const Tree& tree = trees_[facing_index(normal)];
  if (tree.cells.empty()) return nullptr;
  std::size_t node = 0;
  while (node < tree.splits.size()) {
    const Split& split = tree.splits[node];
    node = 2 * node + (component(position, split.axis) < split.at ? 1 : 2);
  }
  return &tree.cells[node - tree.splits.size()];
}

}  // namespace octolux
