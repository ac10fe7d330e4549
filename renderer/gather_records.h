// What gather rays share within a pass (Christensen, "Faster photon map global illumination",
// Journal of Graphics Tools 4(3), 1999): of the many that end near a record (record_sites.h) only
// the first pays for a look-up, and of the points they leave from only the first finds the
// bandwidth around it.
// Diffuse surfaces share irradiance; to others a record lends the photons it found, whose flux each
// scatters by its own BSDF. All are made when they are asked for first, so places nobody looks at
// cost nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/bsdf.h"
#include "estimators/clearing.h"
#include "estimators/radiance_map.h"
#include "renderer/lazy.h"
#include "renderer/record_sites.h"

namespace octolux {

/// The bandwidth [m] of look-ups of `neighbours` photons around the point, told by more photons
/// than those, evener than one look-up has it.
float mean_bandwidth(const RadianceMap& map, const GatherPoint& at, int neighbours);

/// What all records of a pass have in common.
struct RecordConfig {
  int neighbours = 20;              // of the bandwidth
  int max_segments = kMaxSegments;  // of photons that may count where gather rays from the eye end
  bool must_see = false;            // does a record serve only points it sees?
  std::uint64_t turn_key = 0;       // of the records' random turns (GatherPoint::turn)
};

/// Thread-safe: a record holds the same whoever makes it.
class GatherRecords {
  /// Where paths may have few segments, irradiance depends on how many are left to the photons.
  static constexpr int kDepths = 4;
  /// A photon that a record found.
  struct Arriving {
    Vec3 wi;
    Rgb density;  // [W m^-2] of flux: its share of the estimate
  };
  using Arrivals = std::vector<Arriving>;

 public:
  /// Without arrivals, which few records are asked for.
  static constexpr double kBytesPerRecord =
      RecordSites::kBytesPerSite + kDepths * LazyValues<Rgb>::kBytesPerValue +
      2 * LazyValues<float>::kBytesPerValue + LazyValues<std::uint8_t>::kBytesPerValue +
      LazyValues<Clearing>::kBytesPerValue + kDepths * sizeof(void*);

  GatherRecords() = default;
  /// The map and the caster must outlive the records and stay where they are.
  GatherRecords(RecordSites sites, const RadianceMap& map, const RayCaster& caster,
                const RecordConfig& config);

  /// The record nearest to the point, which may serve it; none near surfaces that let light
  /// through.
  using Nearest = std::optional<RecordSites::Found>;
  Nearest nearest(const GatherPoint& at) const;
  /// Radiance [W m^-2 sr^-1] leaving the point through its smooth lobes; empty if no record serves
  /// it.
  std::optional<Rgb> radiance(const GatherPoint& at, const Nearest& nearest) const;
  /// Is the surface there a detail too small for look-ups (RecordSites::is_detail)?
  bool is_detail(const GatherPoint& at, const Nearest& nearest) const;
  /// The mean bandwidth [m] near the point; empty if no record serves it.
  std::optional<float> bandwidth(const GatherPoint& at) const;

 private:
  /// A record, and which of its values counts the photons asked for.
  struct Serving {
    std::uint32_t record = 0;
    int depth = 0;
    std::size_t value() const { return std::size_t{record} * kDepths + depth; }
  };
  int depth_index(int max_segments) const;
  std::optional<Serving> serving(const GatherPoint& at, const Nearest& nearest) const;
  bool reaches(const Nearest& nearest) const;
  Rgb white_radiance(const Serving& by) const;
  const Arrivals& arrivals(const Serving& by) const;
  float spacing(std::uint32_t record) const;  // [m]
  float reach(std::uint32_t record) const;    // [m]
  Clearing clearing(std::uint32_t record) const;
  bool sees(std::uint32_t record, const SurfacePoint& point, Vec3 normal) const;
  template <class Use>
  auto at_record(std::uint32_t record, int max_segments, const Use& use) const;

  const RadianceMap* map_ = nullptr;
  const RayCaster* caster_ = nullptr;
  RecordConfig config_;
  int longest_ = 0;  // segments of any photon in the map
  std::unique_ptr<Bsdf> white_;
  RecordSites sites_;
  LazyValues<Rgb> white_radiance_;  // kDepths per record
  LazyObjects<Arrivals> arrivals_;  // kDepths per record
  LazyValues<float> spacing_;       // [m] as RecordSites has it
  LazyValues<std::uint8_t> detail_;
  LazyValues<Clearing> clearing_;  // of the record's reach
  LazyValues<float> bandwidth_;    // [m]
};

}  // namespace octolux
