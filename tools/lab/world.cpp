// Photons and surfaces of a laboratory case. Poisson photons are drawn outwards from the query (the
// squared distances of a Poisson process grow by exponential steps), so that just as many are drawn
// as are needed; low-discrepancy ones are the R2 sequence (Roberts 2018) with a random shift.
#include "tools/lab/world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace octolux {
namespace {

constexpr double kPi2 = 2 * std::numbers::pi;
constexpr double kWallHeight = 4;
/// So many times the photons asked for are drawn, as an estimator may leave out part of the
/// surface.
constexpr double kSpare = 2.5;
constexpr double kFarthest = 50;  // are photons on a floor too small for those wanted

/// A point at arc length x along a circle of the curvature, touching the plane at x = 0.
struct Bend {
  double x, z, normal_x, normal_z;
};
Bend bend(double x, double curvature) {
  if (curvature == 0) return {x, 0, 0, 1};
  const double angle = x * curvature;
  return {std::sin(angle) / curvature, (1 - std::cos(angle)) / curvature, -std::sin(angle),
          std::cos(angle)};
}

void add_quad(TriangleMesh& mesh, const std::array<Vec3, 4>& corners) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

double exponential(Rng& rng) { return -std::log1p(-static_cast<double>(rng.uniform())); }

}  // namespace

LabWorld::LabWorld(const LabLayout& layout, double angle)
    : layout_(layout),
      cosine_(std::cos(angle * std::numbers::pi / 180)),
      sine_(std::sin(angle * std::numbers::pi / 180)) {
  TriangleMesh mesh;
  for (const FloorPiece& piece : layout_.pieces) {
    brightest_ = std::max(brightest_, piece.irradiance * (piece.slope != 0 ? 2 : 1));
    for (const Point2 p : piece.corners) farthest_ = std::max(farthest_, std::hypot(p.x, p.y));
    const int strips = layout_.curvature == 0 ? 1 : 256;
    const double low = piece.corners[0].x, high = piece.corners[1].x;
    for (int i = 0; i < strips && layout_.curvature != 0; ++i) {
      const Bend a = bend(low + (high - low) * i / strips, layout_.curvature);
      const Bend b = bend(low + (high - low) * (i + 1) / strips, layout_.curvature);
      const double y0 = piece.corners[0].y, y1 = piece.corners[2].y;
      add_quad(mesh, {turned(a.x, y0, a.z), turned(b.x, y0, b.z), turned(b.x, y1, b.z),
                      turned(a.x, y1, a.z)});
    }
    for (std::size_t i = 2; i < piece.corners.size() && layout_.curvature == 0; ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (const Point2 p : {piece.corners[0], piece.corners[i - 1], piece.corners[i]}) {
        mesh.positions.push_back(turned(p.x, p.y, 0));
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  farthest_ = std::min(farthest_, kFarthest);
  for (const LabWall& w : layout_.walls) {
    add_quad(mesh, {turned(w.from.x, w.from.y, 0), turned(w.to.x, w.to.y, 0),
                    turned(w.to.x, w.to.y, kWallHeight), turned(w.from.x, w.from.y, kWallHeight)});
  }
  shapes_.push_back({std::move(mesh), -1, -1, "laboratory"});
  caster_ = std::make_unique<RayCaster>(shapes_);
  viewer_ = find_viewer();
}

Vec3 LabWorld::turned(double x, double y, double z) const {
  return {static_cast<float>(x * cosine_ - y * sine_), static_cast<float>(x * sine_ + y * cosine_),
          static_cast<float>(z)};
}

double LabWorld::irradiance(Point2 p, bool& near) const {
  for (const FloorPiece& piece : layout_.pieces) {
    if (!contains(piece, p)) continue;
    near = piece.near;
    return piece.irradiance + piece.slope * p.x;
  }
  return 0;
}

Vec3 LabWorld::find_viewer() const {
  constexpr int kSamples = 10000;
  Point2 sum{0, 0};
  int count = 0;
  for (int i = 0; i < kSamples; ++i) {  // Vogel's spiral covers the disc evenly
    const double radius = std::sqrt((i + 0.5) / kSamples), angle = 2.399963229728653 * i;
    const Point2 p{radius * std::cos(angle), radius * std::sin(angle)};
    bool near = false;
    irradiance(p, near);
    if (near) sum.x += p.x, sum.y += p.y, ++count;
  }
  // Low over the floor, so that a query in a wall's plane is clearly seen from one side: rounding
  // leaves walls as long as these a little off the query.
  constexpr double kHeight = 0.25, kNoDirection = 1e-3;
  const double away = std::hypot(sum.x, sum.y);
  if (away <= kNoDirection * count) return {0, 0, 1};
  return normalize(turned(sum.x / away, sum.y / away, kHeight));
}

Photon LabWorld::photon_on_floor(Point2 p, double flux) const {
  const Bend at = bend(p.x, layout_.curvature);
  Photon photon;
  photon.position = turned(at.x, p.y, at.z);
  photon.normal = normalize(turned(at.normal_x, 0, at.normal_z));
  photon.wi = photon.normal;
  photon.flux = Rgb(static_cast<float>(flux));
  return photon;
}

std::vector<Photon> LabWorld::photons(int n, PhotonPattern pattern, Rng& rng) const {
  const double density = (n + 1) / near_flux(layout_, 1);
  std::vector<Photon> photons = pattern == PhotonPattern::poisson
                                    ? poisson_floor(n, density, rng)
                                    : low_discrepancy_floor(n, density, rng);
  double reach2 = 0;
  for (const Photon& p : photons) reach2 = std::max(reach2, double{length2(p.position)});
  add_wall_photons(density, std::sqrt(reach2), rng, photons);
  if (layout_.power_decades == 0) return photons;
  // Mean of 10^(d u), u uniform, is (10^d - 1) / (d ln 10).
  const double log_range = layout_.power_decades * std::numbers::ln10;
  for (Photon& p : photons) {
    const double power = std::exp(log_range * rng.uniform()) * log_range / std::expm1(log_range);
    p.flux = p.flux * static_cast<float>(power);
  }
  return photons;
}

bool LabWorld::add_floor_photon(Point2 p, double density, Rng& rng,
                                std::vector<Photon>& photons) const {
  bool near = false;
  const double share = irradiance(p, near) / brightest_;
  const bool kept = rng.uniform() < share;
  if (kept) photons.push_back(photon_on_floor(p, 1 / density));
  return kept && near;
}

std::vector<Photon> LabWorld::poisson_floor(int n, double density, Rng& rng) const {
  const double enough = kSpare * (n + 1) + 10;
  std::vector<Photon> photons;
  int near_count = 0;
  double radius2 = 0, last2 = 0;
  while ((near_count < enough || radius2 < kSpare * last2) && radius2 < farthest_ * farthest_) {
    radius2 += exponential(rng) / (std::numbers::pi * density * brightest_);
    const double angle = kPi2 * rng.uniform();
    const Point2 p{std::sqrt(radius2) * std::cos(angle), std::sqrt(radius2) * std::sin(angle)};
    if (add_floor_photon(p, density, rng, photons) && ++near_count == n + 1) last2 = radius2;
  }
  return photons;
}

std::vector<Photon> LabWorld::low_discrepancy_floor(int n, double density, Rng& rng) const {
  constexpr double kStepX = 0.75487766624669276, kStepY = 0.56984029099805327;
  const double reach = std::sqrt(kSpare) + 25.0 / (n + 1);
  const auto count = static_cast<std::int64_t>(4 * reach * reach * density * brightest_);
  const Vec2 shift = rng.uniform2();
  std::vector<Photon> photons;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i);
    const double x = std::fmod(shift.x + k * kStepX, 1.0), y = std::fmod(shift.y + k * kStepY, 1.0);
    add_floor_photon({reach * (2 * x - 1), reach * (2 * y - 1)}, density, rng, photons);
  }
  return photons;
}

void LabWorld::add_wall_photons(double density, double reach, Rng& rng,
                                std::vector<Photon>& photons) const {
  for (const LabWall& w : layout_.walls) {
    if (w.irradiance == 0) continue;
    const double dx = w.to.x - w.from.x, dy = w.to.y - w.from.y, length = std::hypot(dx, dy);
    const double foot = -(w.from.x * dx + w.from.y * dy) / length;  // nearest to the query
    for (double area = exponential(rng);; area += exponential(rng)) {
      const double radius = std::sqrt(area / (std::numbers::pi * density * w.irradiance));
      const double angle = kPi2 * rng.uniform();
      if (radius > reach) break;
      const double along = foot + radius * std::cos(angle), z = radius * std::sin(angle);
      if (along < 0 || along > length || z < 0 || z > kWallHeight) continue;
      Photon photon;
      photon.position = turned(w.from.x + dx * along / length, w.from.y + dy * along / length, z);
      photon.normal = normalize(turned(-dy, dx, 0));
      photon.wi = photon.normal;
      photon.flux = Rgb(static_cast<float>(1 / density));
      photons.push_back(photon);
    }
  }
}

}  // namespace octolux
