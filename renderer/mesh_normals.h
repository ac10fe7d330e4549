// What every loader of meshes does with triangles once it has them: drops those without area, makes
// normals where the file has none, and moves everything into the world. Pure functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/affine.h"
#include "core/shape.h"

namespace octolux {

/// Unit vector along `v`, or 0 if it has no direction.
Vec3 direction(Vec3 v);
/// Normal of a triangle with twice its area as length.
Vec3 area_vector(Vec3 a, Vec3 b, Vec3 c);
/// Has the triangle a plane, as far as float arithmetic can tell?
bool has_area(Vec3 a, Vec3 b, Vec3 c);

/// Vertex normals: those of the faces around, weighted by the angle each has at the vertex
/// (Thuermer & Wuethrich 1998).
void compute_smooth_normals(TriangleMesh& mesh);
/// The same, but a corner takes only faces around its position (not: its vertex) whose normal is
/// within `degrees` of its own face's, so that edges sharper than that stay sharp (Mitsuba's
/// maxSmoothAngle). Vertices are split where their corners now differ.
void split_at_creases(TriangleMesh& mesh, double degrees);

/// Keeps the value of a face for each triangle cut from it: face_of_triangle[t].
void spread_face_attributes(TriangleMesh& mesh, std::span<const std::uint32_t> face_of_triangle);

struct MeshOptions {
  Affine to_world = {};
  bool face_normals = false;  // drop the normals
  bool flip_normals = false;  // turn front into back
  bool flip_tex_coords = false;
  std::optional<float> max_smooth_angle = {};  // [degrees] new normals; see split_at_creases
};

/// From the file's space to the world: maps, drops triangles without area, gives smooth normals
/// where there are none. A map that mirrors keeps the front in front. Throws Error that begins with
/// `path` if a vertex leaves the floats or no triangle is left; other things go to `warnings`.
void finish_mesh(TriangleMesh& mesh, const MeshOptions& options, const std::string& path,
                 std::vector<std::string>& warnings);

/// The last of it, for meshes that are in the world already: creases and flipping.
void apply_creases_and_flip(TriangleMesh& mesh, const MeshOptions& options);

}  // namespace octolux
