// Looking the table up.
#include "estimators/octobox_table.h"

#include <algorithm>
#include <iterator>

namespace octolux {
namespace {

constexpr OctoBoxTableEntry kTable[] = {
#include "estimators/octobox_table.inc"
};

/// From 0 at three photons to 1 at `enough`.
float share_of_enough(int photons, float enough) {
  const float none = 3;
  const float t = std::clamp((static_cast<float>(photons) - none) / (enough - none), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

}  // namespace

std::span<const OctoBoxTableEntry> octobox_table() { return kTable; }

int octobox_column(OctantUse use) {
  return use == OctantUse::one ? 0 : use == OctantUse::eight ? 1 : 2;
}

double octobox_ratio(OctantUse use, int photons) {
  const int column = octobox_column(use);
  const auto above =
      std::upper_bound(std::begin(kTable), std::end(kTable), photons,
                       [](int n, const OctoBoxTableEntry& entry) { return n < entry.photons; });
  if (above == std::begin(kTable)) return above->ratio[column];
  const OctoBoxTableEntry& low = *std::prev(above);
  const double x = 1.0 / photons, x_low = 1.0 / low.photons;
  const double x_high = above == std::end(kTable) ? 0 : 1.0 / above->photons;
  const double high = above == std::end(kTable) ? 1 : above->ratio[column];
  return high + (low.ratio[column] - high) * (x - x_high) / (x_low - x_high);
}

float box_share(OctantUse use, int photons) {
  return share_of_enough(photons, use == OctantUse::eight ? 54 : 20);
}

float box_share_of_cut(int photons) { return share_of_enough(photons, 18); }

std::vector<OctoBoxCorrection> make_octobox_corrections(OctantUse use, int photons) {
  std::vector<OctoBoxCorrection> table(static_cast<std::size_t>(photons) + 1);
  for (int n = 1; n <= photons; ++n) {
    table[n] = {static_cast<float>(octobox_ratio(use, n)), box_share(use, n), box_share_of_cut(n)};
  }
  return table;
}

}  // namespace octolux
