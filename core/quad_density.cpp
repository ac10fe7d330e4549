// quad_density.h.
#include "core/quad_density.h"

#include <algorithm>

#include "core/check.h"
#include "core/constants.h"

namespace octolux {

namespace {

constexpr float kSmallest = 1 / 1024.0f;  // side of a square

float mass_of(std::span<const QuadDensity::Point> points) {
  double sum = 0;
  for (const QuadDensity::Point& p : points) sum += p.mass;
  return static_cast<float>(sum);
}

/// Which half `u` lies in; `u` becomes its place there.
std::size_t half_of(float& u) {
  u *= 2;
  const bool upper = u >= 1;
  if (upper) u -= 1;
  return upper ? 1 : 0;
}

/// Chooses a half by what the two hold, not both nothing; `u` becomes uniform again.
std::size_t choose_half(float& u, float below, float above) {
  const float lower = below / (below + above);
  const bool upper = u >= lower;
  u = upper ? (u - lower) / (1 - lower) : u / lower;
  u = std::min(u, kOneMinusEpsilon);
  return upper ? 1 : 0;
}

/// In [low, low + size), also where the sum would be rounded up.
float within(float low, float size, float u) {
  return std::min(low + size * u, (low + size) * kOneMinusEpsilon);
}

}  // namespace

QuadDensity::QuadDensity(std::span<Point> points, std::size_t fewest) {
  OCTOLUX_CHECK(points.size() <= kMostPoints && fewest >= 2);
  const float mass = mass_of(points);
  if (mass > 0) build(points, {}, mass, fewest);
}

std::uint16_t QuadDensity::build(std::span<Point> points, Square square, float mass,
                                 std::size_t fewest) {
  const auto index = static_cast<std::uint16_t>(nodes_.size());
  nodes_.emplace_back();
  const float half = square.size / 2;
  const Vec2 middle{square.corner.x + half, square.corner.y + half};
  auto rest = points.begin();
  for (std::size_t q = 0; q < 4; ++q) {
    const bool right = q % 2 == 1;
    const bool top = q >= 2;
    const auto begin = rest;
    rest = std::partition(begin, points.end(), [&](const Point& p) {
      return (p.u.x >= middle.x) == right && (p.u.y >= middle.y) == top;
    });
    const std::span<Point> part(begin, rest);
    const float part_mass = mass_of(part);
    nodes_[index].share[q] = part_mass / mass;
    if (part.size() < fewest || !(part_mass > 0) || half <= kSmallest) continue;
    const Vec2 corner{right ? middle.x : square.corner.x, top ? middle.y : square.corner.y};
    const std::uint16_t child = build(part, {corner, half}, part_mass, fewest);
    nodes_[index].child[q] = child;
  }
  return index;
}

float QuadDensity::operator()(Vec2 u) const {
  if (nodes_.empty()) return 1;
  float density = 1;
  std::uint16_t node = 0;
  do {
    const std::size_t right = half_of(u.x);
    const std::size_t q = right + 2 * half_of(u.y);
    density *= 4 * nodes_[node].share[q];
    node = nodes_[node].child[q];
  } while (node != 0);
  return density;
}

Vec2 QuadDensity::sample(Vec2 u) const {
  if (nodes_.empty()) return u;
  Square square;
  std::uint16_t node = 0;
  do {
    const std::array<float, 4>& share = nodes_[node].share;
    const std::size_t top = choose_half(u.y, share[0] + share[1], share[2] + share[3]);
    const std::size_t right = choose_half(u.x, share[2 * top], share[2 * top + 1]);
    square.size /= 2;
    square.corner.x += right == 1 ? square.size : 0;
    square.corner.y += top == 1 ? square.size : 0;
    node = nodes_[node].child[right + 2 * top];
  } while (node != 0);
  return {within(square.corner.x, square.size, u.x), within(square.corner.y, square.size, u.y)};
}

}  // namespace octolux
