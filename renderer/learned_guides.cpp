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
/// How much is learned from: so many paths a pixel, traced in rounds, until there are so many
/// photons (of 40 bytes); more teach little.
constexpr std::int64_t kPathsPerPixel = 4;
constexpr std::int64_t kRoundPaths = 1 << 17;
constexpr std::size_t kPhotons = 1 << 21;
/// A photon that counts more than so many of the cell's mean would hide what all others tell.
constexpr float kMostMeans = 3;
/// The share of the flux that must be left then, the heaviest photon apart. Where several heavy
/// ones bring the rest, too few of them are known.
constexpr double kTellingShare = 0.8;
constexpr std::size_t kParallel = 4 * kCellPhotons;  // photons worth a thread

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

void LearnedGuides::add(const std::vector<Photon>& photons) {
  for (const Photon& p : photons) {
    const float flux = luminance(p.flux);
    // Next-event estimation and the caustic map bring the others.
    if (!p.scattered || !is_usable(p) || !(flux > 0)) continue;
    deposits_[facing_index(p.normal)].push_back({p.position, p.wi, p.normal, flux});
    ++photons_;
  }
}

void LearnedGuides::build() {
  for (std::size_t f = 0; f < kFacings; ++f) {
    if (deposits_[f].empty()) continue;
    const std::size_t cells =
        std::bit_ceil((deposits_[f].size() + kCellPhotons - 1) / kCellPhotons);
    trees_[f] = {std::vector<Split>(cells - 1), std::vector<LearnedGuide>(cells)};
    trees_[f].build(deposits_[f], 0);
  }
  deposits_ = {};
}

LearnedGuides::Split LearnedGuides::split(std::span<Deposit> deposits) {
  Bounds bounds;
  for (const Deposit& a : deposits) bounds.add(a.position);
  const int axis = bounds.longest_axis();
  const auto middle = deposits.begin() + static_cast<std::ptrdiff_t>(deposits.size() / 2);
  std::nth_element(
      deposits.begin(), middle, deposits.end(),
      [axis](const Deposit& a, const Deposit& b) { return a.position[axis] < b.position[axis]; });
  return {axis, middle->position[axis]};
}

void LearnedGuides::Tree::build(std::span<Deposit> deposits, std::size_t node) {
  if (node >= splits.size()) {
    cells[node - splits.size()] = guide(deposits);
    return;
  }
  splits[node] = split(deposits);
  const std::size_t half = deposits.size() / 2;
  const auto lower = [&] { build(deposits.first(half), 2 * node + 1); };
  const auto upper = [&] { build(deposits.subspan(half), 2 * node + 2); };
  if (deposits.size() < kParallel) {
    lower();
    upper();
  } else {
    parallel_invoke(lower, upper);
  }
}

LearnedGuide LearnedGuides::Tree::guide(std::span<Deposit> deposits) {
  split(deposits);
  Vec3 normal{};
  double flux = 0;
  for (const Deposit& a : deposits) {
    normal += a.normal;
    flux += a.flux;
  }
  normal = normalize(normal);
  const Frame frame = Frame::from_normal(normal);
  const auto most = static_cast<float>(kMostMeans * flux / static_cast<double>(deposits.size()));
  std::vector<QuadDensity::Point> points;
  points.reserve(deposits.size());
  double cut = 0, most_cut = 0;  // flux, of all photons and of one
  for (const Deposit& a : deposits) {
    const Vec3 w = frame.to_local(a.wi);  // below the horizon only where the cell is curved
    points.push_back({square_of_disk({w.x, w.y}), w.z > 0 ? std::min(a.flux, most) : 0});
    const double over = std::max(0.0f, a.flux - most);
    cut += over;
    most_cut = std::max(most_cut, over);
  }
  const bool telling = cut - most_cut < (1 - kTellingShare) * flux;
  const std::span<QuadDensity::Point> all(points);
  const std::span<QuadDensity::Point> below = all.first(all.size() / 2);
  const std::span<QuadDensity::Point> above = all.subspan(all.size() / 2);
  const double unevenness = (mean_at(QuadDensity(below, kLeafPhotons), above) +
                             mean_at(QuadDensity(above, kLeafPhotons), below)) /
                            2;
  return {normal, QuadDensity(all, kLeafPhotons), telling ? static_cast<float>(unevenness) : 1};
}

const LearnedGuide* LearnedGuides::find(Vec3 position, Vec3 normal) const {
  const Tree& tree = trees_[facing_index(normal)];
  if (tree.cells.empty()) return nullptr;
  std::size_t node = 0;
  while (node < tree.splits.size()) {
    const Split& split = tree.splits[node];
    node = 2 * node + (position[split.axis] < split.at ? 1 : 2);
  }
  return &tree.cells[node - tree.splits.size()];
}

LearnedGuides learn_guides(const Scene& scene, const PhotonSource& source,
                           const RenderConfig& config) {
  LearnedGuides guides;
  if (!config.eye.gather || !config.eye.learn) return guides;
  const FilmSize& film = scene.film;
  const std::int64_t paths = kPathsPerPixel * film.crop_width * film.crop_height;
  const std::int64_t rounds = (paths + kRoundPaths - 1) / kRoundPaths;
  for (std::int64_t i = 0; i < rounds && guides.photons() < kPhotons; ++i) {
    const PassKey key{config.seed, static_cast<std::uint64_t>(i)};
    guides.add(trace_photons(scene, source, PhotonKind::guide, paths / rounds, key).photons);
  }
  guides.build();
  return guides;
}

}  // namespace octolux
