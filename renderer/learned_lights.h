// What next-event estimation learns before the first pass of which lights are seen where. The tree
// of lights (light_tree.h) knows distances and cosines, not walls: in a house most lamps are in
// other rooms, and a sky that shines through one window reaches few places. So trial samples are
// taken at what the eye sees, and in cells of the surfaces seen each group of lights is chosen in
// proportion to the root of its contributions' second moment, where variance is least (as photons'
// emission is in learn_emission.h). What was never seen is still chosen by the share of choices
// that does not follow what was learned, so the picture stays right.
//
// Where no light was seen at all, those are the only shadow rays. All passes share what is learned.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/config.h"
#include "renderer/eye_cells.h"
#include "renderer/light_sampler.h"

namespace octolux {

class LearnedLights {
 public:
  /// What one sample brought.
  struct Trial {
    LookUp at;
    int group;
    float brought;  // [W m^-2 sr^-1], if its group had been certain
  };

  LearnedLights() = default;
  /// Trials that are not finite are left out.
  LearnedLights(EyeCells cells, int groups, std::span<const Trial> trials);

  /// Chances of the groups, cumulative, as Receiver wants them: the last is 1, or 0 if no light was
  /// seen there. Empty if nobody looked there. O(log cells).
  std::span<const float> at(Vec3 position, Vec3 normal) const;

 private:
  EyeCells cells_;
  std::size_t groups_ = 0;
  std::vector<float> cumulative_;  // cell by cell
};

/// Nothing where there is only one group, or learning is off, or there is no final gathering. The
/// same on any number of threads.
LearnedLights learn_lights(const Scene& scene, const LightSampler& lights,
                           const RenderConfig& config);

}  // namespace octolux
