// What gather rays learn before the first pass of where light comes from, from photons of their own
// (Jensen, "Importance driven path tracing using the photon map", 1995; kept in a spatial
// tree as by Vorba et al., "On-line Learning of Parametric Mixture Models for Light Transport
// Simulation", 2014). The photons of one pass around a point are few, and do not know the small
// bright things that a gather ray meets now and then; many more do. All passes share what is
// learned, so that each pixel's samples still complement each other, and a render that goes on from
// a checkpoint learns the same again.
//
// The surfaces that light reaches are cut into cells of about equal numbers of photons. A cell
// keeps where they flew from (light_origins.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/facing.h"
#include "core/photon.h"
#include "renderer/config.h"
#include "renderer/light_origins.h"
#include "renderer/photon_pass.h"

namespace octolux {

/// What is known in one cell, fixed once made.
struct LearnedGuide {
  LightOrigins origins;
  /// The second moment of radiance times cosine, were directions chosen by the cosine, over that of
  /// the best choice: 1 where light comes evenly from everywhere. What the photons of each half of
  /// the cell say is held against those of the other half, so a cell too large for what is near it
  /// is not believed.
  float unevenness = 1;
};

class LearnedGuides {
 public:
  /// Takes note of photons.
  void add(const std::vector<Photon>& photons);
  /// How many were of use.
  std::size_t photons() const { return photons_; }
  /// Learns from all of them, and forgets them. The same on any number of threads.
  void build();

  /// What is known at a point of a surface, `normal` its geometric normal on the side of the light;
  /// nullptr if light has never reached one that faces this way.
  const LearnedGuide* find(Vec3 position, Vec3 normal) const;
  /// What gather rays from there should follow: nothing where light comes evenly.
  LobeMixture at(Vec3 position, Vec3 normal) const;

 private:
  /// What is kept of a photon.
  struct Deposit {
    Vec3 position, origin;  // [m]
    Vec3 normal;
    float flux;  // [W]
  };
  /// Surfaces that face one way: a complete binary tree in the order of a heap, its leaves cells.
  struct Split {
    int axis = 0;
    float at = 0;  // below it lies the first child
  };
  /// Halves them, sorted into those below and above.
  static Split split(std::span<Deposit> deposits);
  struct Tree {
    std::vector<Split> splits;
    std::vector<LearnedGuide> cells;

    void build(std::span<Deposit> deposits, std::size_t node);
    static LearnedGuide guide(std::span<Deposit> deposits);
    static float unevenness(const LightOrigins& origins, std::span<const Deposit> others);
  };
  std::array<std::vector<Deposit>, kFacings> deposits_;
  std::array<Tree, kFacings> trees_;
  std::size_t photons_ = 0;
};

/// From some photon paths a pixel; nothing where learning is off or there is no final gathering.
/// `config` resolved.
LearnedGuides learn_guides(const Scene& scene, const PhotonSource& source,
                           const RenderConfig& config);

}  // namespace octolux
