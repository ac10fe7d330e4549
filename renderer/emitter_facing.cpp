// Pieces by union-find over equal positions; see emitter_facing.h.
#include "renderer/emitter_facing.h"

#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace octolux {
namespace {

/// A piece whose net area vector is below this share of its area counts as closed: float positions
/// cancel to about 1e-6, while a flat lamp has 1.
constexpr double kOpenShare = 1e-3;

struct Piece {
  double nx = 0, ny = 0, nz = 0;  // sum of area vectors on the front side, twice [m^2]
  double cx = 0, cy = 0, cz = 0;  // sum of centroids times area
  double area = 0;

  void add(Vec3 normal, Vec3 centroid) {
    const double a = length(normal);
    nx += normal.x, ny += normal.y, nz += normal.z;
    cx += a * centroid.x, cy += a * centroid.y, cz += a * centroid.z;
    area += a;
  }
  bool open() const { return std::sqrt(nx * nx + ny * ny + nz * nz) > kOpenShare * area; }
  bool faces_away_from(Vec3 p) const {
    return open() && nx * (p.x - cx / area) + ny * (p.y - cy / area) + nz * (p.z - cz / area) < 0;
  }
};

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// For each vertex the number of its piece's root.
UnionFind connect(const TriangleMesh& mesh) {
  UnionFind pieces(mesh.positions.size());
  std::map<std::array<float, 3>, std::uint32_t> first;
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 p = mesh.positions[i];
    pieces.join(i, first.try_emplace({p.x, p.y, p.z}, i).first->second);
  }
  for (const auto& t : mesh.triangles) {
    pieces.join(t[0], t[1]);
    pieces.join(t[0], t[2]);
  }
  return pieces;
}

/// Area vector of a triangle on its front side (where its vertex normals are), twice [m^2].
Vec3 front(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
  const Vec3 n = cross(b - a, c - a);
  if (mesh.normals.empty()) return n;
  const Vec3 side = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
  return dot(n, side) < 0 ? -n : n;
}

}  // namespace

std::size_t face_point(TriangleMesh& mesh, Vec3 target) {
  UnionFind pieces = connect(mesh);
  std::map<std::uint32_t, Piece> piece_of_root;
  for (const auto& t : mesh.triangles) {
    const Vec3 sum = mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]];
    piece_of_root[pieces.root(t[0])].add(front(mesh, t), sum / 3);
  }
  const auto turns = [&](std::uint32_t vertex) {
    return piece_of_root[pieces.root(vertex)].faces_away_from(target);
  };
  for (std::uint32_t i = 0; i < mesh.normals.size(); ++i) {
    if (turns(i)) mesh.normals[i] = -mesh.normals[i];
  }
  std::size_t turned = 0;
  for (auto& t : mesh.triangles) {
    if (!turns(t[0])) continue;
    std::swap(t[1], t[2]);
    ++turned;
  }
  return turned;
}

}  // namespace octolux
