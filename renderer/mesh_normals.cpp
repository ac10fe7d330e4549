// mesh_normals.h.
#include "renderer/mesh_normals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/error.h"

namespace octolux {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Angle between the directions from `at` to `b` and to `c`.
float angle(Vec3 at, Vec3 b, Vec3 c) {
  const Vec3 u = direction(b - at), v = direction(c - at);
  return std::atan2(length(cross(u, v)), dot(u, v));
}

float corner_angle(const TriangleMesh& mesh, const Triangle& t, std::size_t k) {
  const std::vector<Vec3>& p = mesh.positions;
  return angle(p[t[k]], p[t[(k + 1) % 3]], p[t[(k + 2) % 3]]);
}

Vec3 face_normal(const TriangleMesh& mesh, const Triangle& t) {
  const std::vector<Vec3>& p = mesh.positions;
  return direction(area_vector(p[t[0]], p[t[1]], p[t[2]]));
}

/// Corners of a mesh (3 t + k), those at the same position one after the other.
struct CornersByPosition {
  std::vector<std::uint32_t> corners;
  std::vector<std::size_t> group_ends;  // in `corners`

  explicit CornersByPosition(const TriangleMesh& mesh) : corners(3 * mesh.triangles.size()) {
    std::iota(corners.begin(), corners.end(), 0u);
    const auto key = [&](std::uint32_t corner) {
      const Vec3 p = mesh.positions[mesh.triangles[corner / 3][corner % 3]];
      return std::tuple(p.x, p.y, p.z);
    };
    std::stable_sort(corners.begin(), corners.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t i = 1; i <= corners.size(); ++i) {
      const bool ends = i == corners.size() || key(corners[i]) != key(corners[i - 1]);
      if (ends) group_ends.push_back(i);
    }
  }
};

/// The normal of each corner.
std::vector<Vec3> crease_normals(const TriangleMesh& mesh, double degrees) {
  std::vector<Vec3> face(mesh.triangles.size());
  for (std::size_t t = 0; t < face.size(); ++t) face[t] = face_normal(mesh, mesh.triangles[t]);
  const auto least_cos = static_cast<float>(std::cos(degrees * std::numbers::pi / 180));
  std::vector<Vec3> result(3 * face.size());
  const CornersByPosition order(mesh);
  std::size_t begin = 0;
  for (const std::size_t end : order.group_ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t here = order.corners[i];
      Vec3 sum;
      for (std::size_t j = begin; j < end; ++j) {
        const std::uint32_t other = order.corners[j];
        if (other / 3 != here / 3 && dot(face[here / 3], face[other / 3]) < least_cos) continue;
        sum += face[other / 3] * corner_angle(mesh, mesh.triangles[other / 3], other % 3);
      }
      const Vec3 n = direction(sum);
      result[here] = length2(n) > 0 ? n : face[here / 3];
    }
    begin = end;
  }
  return result;
}

template <typename T>
void keep(std::vector<T>& values, std::span<const std::uint32_t> indices) {
  if (values.empty()) return;
  std::vector<T> kept;
  kept.reserve(indices.size());
  for (const std::uint32_t i : indices) kept.push_back(values[i]);
  values = std::move(kept);
}

/// Makes vertex i a copy of what was vertex indices[i].
void keep_vertices(TriangleMesh& mesh, std::span<const std::uint32_t> indices) {
  keep(mesh.positions, indices);
  keep(mesh.normals, indices);
  keep(mesh.uvs, indices);
  for (MeshAttribute& a : mesh.attributes) {
    if (!a.per_face) keep(a.values, indices);
  }
}

void drop_degenerate_triangles(TriangleMesh& mesh, const std::string& path,
                               std::vector<std::string>& warnings) {
  std::vector<std::uint32_t> kept;
  kept.reserve(mesh.triangles.size());
  const std::vector<Vec3>& p = mesh.positions;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (has_area(p[t[0]], p[t[1]], p[t[2]])) kept.push_back(i);
  }
  const std::size_t dropped = mesh.triangles.size() - kept.size();
  if (dropped == 0) return;
  if (kept.empty()) throw Error(fmt::format("{}: all {} triangles have no area", path, dropped));
  warnings.push_back(fmt::format("{}: {} triangles without area are left out", path, dropped));
  keep(mesh.triangles, kept);
  spread_face_attributes(mesh, kept);
}

void turn_round(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

void move_to_world(TriangleMesh& mesh, const Affine& to_world, const std::string& path) {
  const std::optional<Affine> inverse = to_world.inverse();
  if (!inverse) throw Error(path + ": to_world is singular");
  for (Vec3& p : mesh.positions) {
    p = to_world.point(p);
    if (!is_finite(p)) throw Error(path + ": to_world moves a vertex out of the range of float");
  }
  for (Vec3& n : mesh.normals) n = direction(Affine::normal(*inverse, direction(n)));
  if (to_world.determinant() < 0) turn_round(mesh);
}

}  // namespace

Vec3 direction(Vec3 v) {
  const float scale = max_component(abs(v));  // so that squares neither overflow nor vanish
  if (!(scale > 0) || !std::isfinite(scale)) return {};
  return normalize(v / scale);
}

Vec3 area_vector(Vec3 a, Vec3 b, Vec3 c) { return cross(b - a, c - a); }

bool has_area(Vec3 a, Vec3 b, Vec3 c) {
  const float size2 = length2(area_vector(a, b, c));
  return size2 > 0 && std::isfinite(size2);
}

void compute_smooth_normals(TriangleMesh& mesh) {
  std::vector<Vec3> any(mesh.positions.size());  // of some face, where the sum has no direction
  mesh.normals.assign(mesh.positions.size(), {});
  for (const Triangle& t : mesh.triangles) {
    const Vec3 n = face_normal(mesh, t);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.normals[t[k]] += n * corner_angle(mesh, t, k);
      any[t[k]] = n;
    }
  }
  for (std::size_t i = 0; i < any.size(); ++i) {
    const Vec3 n = direction(mesh.normals[i]);
    mesh.normals[i] = length2(n) > 0 ? n : any[i];
  }
}

void split_at_creases(TriangleMesh& mesh, double degrees) {
  const std::vector<Vec3> normals = crease_normals(mesh, degrees);
  std::map<std::tuple<std::uint32_t, float, float, float>, std::uint32_t> known;
  std::vector<std::uint32_t> origin;  // of each new vertex
  std::vector<Vec3> split_normals;
  for (std::size_t corner = 0; corner < normals.size(); ++corner) {
    std::uint32_t& vertex = mesh.triangles[corner / 3][corner % 3];
    const Vec3 n = normals[corner];
    const auto next = static_cast<std::uint32_t>(origin.size());
    const auto [entry, added] = known.try_emplace({vertex, n.x, n.y, n.z}, next);
    if (added) {
      origin.push_back(vertex);
      split_normals.push_back(n);
    }
    vertex = entry->second;
  }
  keep_vertices(mesh, origin);
  mesh.normals = std::move(split_normals);
}

void spread_face_attributes(TriangleMesh& mesh, std::span<const std::uint32_t> face_of_triangle) {
  for (MeshAttribute& a : mesh.attributes) {
    if (a.per_face) keep(a.values, face_of_triangle);
  }
}

void apply_creases_and_flip(TriangleMesh& mesh, const MeshOptions& options) {
  if (options.max_smooth_angle) split_at_creases(mesh, *options.max_smooth_angle);
  if (!options.flip_normals) return;
  turn_round(mesh);
  for (Vec3& n : mesh.normals) n = -n;
}

void finish_mesh(TriangleMesh& mesh, const MeshOptions& options, const std::string& path,
                 std::vector<std::string>& warnings) {
  if (options.face_normals) mesh.normals.clear();
  move_to_world(mesh, options.to_world, path);
  drop_degenerate_triangles(mesh, path, warnings);
  if (options.flip_tex_coords) {
    for (Vec2& uv : mesh.uvs) uv.y = 1 - uv.y;
  }
  const bool smooth = mesh.normals.empty() && !options.face_normals && !options.max_smooth_angle;
  if (smooth) compute_smooth_normals(mesh);
  apply_creases_and_flip(mesh, options);
}

}  // namespace octolux
