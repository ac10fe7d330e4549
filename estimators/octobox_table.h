// What the corrected OctoBox estimate is divided by at each number of photons, and how far it is
// trusted there. The numbers come from simulation (octobox_table.inc, made by
// build/make_octobox_table); they tend to 1 as the number grows.
#pragma once

#include <span>
#include <vector>

#include "estimators/octobox_fit.h"

namespace octolux {

/// One simulated ratio: mean of (count / area) pi / n over n photons uniform in the unit disc.
struct OctoBoxTableEntry {
  int photons;
  double ratio[3];           // one box, one per octant, automatic
  double standard_error[3];  // of the ratio
};
std::span<const OctoBoxTableEntry> octobox_table();
/// Column of `ratio`.
int octobox_column(OctantUse use);

/// Ratio at any number of photons >= 1: linear in 1/photons between entries, and from the last one
/// to the asymptote 1.
double octobox_ratio(OctantUse use, int photons);

/// Weight of the box; the rest is the disc's. From 0 where the box's noise has no bound to 1 where
/// it is below 1.3 times that of the disc: 20 photons, what a render looks up. Eight boxes are held
/// up by four times as many photons.
float box_share(OctantUse use, int photons);
/// The same where a wall cuts the disc, which is wrong there: fewer photons are trusted, so that
/// the estimate is darker by less and the noise of the box is still bearable.
float box_share_of_cut(int photons);

/// At one number of photons.
struct OctoBoxCorrection {
  float ratio = 1;
  float share = 0;      // of the box
  float cut_share = 0;  // where a wall cuts the disc
};
/// For 0 to `photons` photons.
std::vector<OctoBoxCorrection> make_octobox_corrections(OctantUse use, int photons);

}  // namespace octolux
