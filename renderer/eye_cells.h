// What the eye looks at: places where the photon maps will be read, sorted into cells of about
// equal numbers, so that cells are small where many look. Cells of differently facing surfaces are
// apart: the far side of a wall is not looked at. Immutable, so thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/shape.h"
#include "renderer/photon_pass.h"

namespace octolux {

/// A place where a map is read.
struct LookUp {
  Vec3 position;
  Vec3 normal;  // geometric, on the viewer's side
};

class EyeCells {
 public:
  EyeCells() = default;
  /// Cells are not much smaller than they need be for an `eye` there.
  EyeCells(std::vector<LookUp> look_ups, Vec3 eye);

  /// The cell a photon lies in, or -1. O(log cells).
  int find(Vec3 position, Vec3 normal) const;
  /// Look-ups in a cell.
  int look_ups(int cell) const { return cells_[static_cast<std::size_t>(cell)].look_ups; }
  int size() const { return static_cast<int>(cells_.size()); }

 private:
  struct Node {
    int axis = -1;    // of the split; -1: a cell
    float split = 0;  // below it lies the next node
    int other = 0;    // node beyond the split, or the cell's number
  };
  struct Cell {
    Bounds bounds;  // a little wider than its look-ups
    int look_ups = 0;
  };
  void build(std::span<LookUp> look_ups, Vec3 eye);

  static constexpr int kFacings = 6;  // +-x, +-y, +-z
  static int facing(Vec3 normal);

  std::array<int, kFacings> roots_{-1, -1, -1, -1, -1, -1};
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
};

/// Calls see(at) where one more eye path would read the map of `kind`: of the global map at the end
/// of gather rays, but for short ones, which go on (final_gather.h).
void look_once(Tracer& tracer, PhotonKind kind, const std::function<void(const Scattering&)>& see);

/// Where the eye will read the map of `kind`: a few thousand eye paths of their own, on to the end
/// of gather rays for the global map. The same on any number of threads.
EyeCells look_around(const Scene& scene, PhotonKind kind, std::uint64_t seed);

}  // namespace octolux
