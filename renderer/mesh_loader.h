// Reads the mesh files of a scene, several at a time: a scene file first says what it wants of
// which file, then all of it is read at once. Every file is read once, however many shapes are made
// of it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/load_progress.h"
#include "renderer/mesh_normals.h"

namespace octolux {

/// What a shape wants.
struct MeshRequest {
  enum class Format { obj, ply, serialized };
  Format format = Format::obj;
  std::string path;
  MeshOptions options;
  int shape_index = 0;                  // of a serialized file
  std::vector<std::string> attributes;  // that textures read
};

struct LoadedMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;
};

struct LoadedMeshes {
  std::vector<LoadedMesh> meshes;  // one per request, in their order
  std::uint64_t hash = 0;          // of all files' bytes
};

/// The result does not depend on the number of threads. Throws the Error of the first request, in
/// their order, that cannot be met.
LoadedMeshes load_meshes(const std::vector<MeshRequest>& requests, const LoadProgress& progress);

}  // namespace octolux
