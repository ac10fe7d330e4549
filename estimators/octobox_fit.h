// How many photons there are on how much surface, by OctoBoxes: the paper's area as published, and
// the corrected form this program uses.
//
// The corrected form rests on this: an OctoBox is known as soon as the photons outside its inside
// are known, so given the box the photons strictly inside are uniform there, and their number over
// its area has exactly the mean density of the photons, whatever the number of photons, for every
// convex region the box fits (a stopping set; for the convex hull: Baldin & Reiss, "Unbiased
// estimation of the volume of a convex body", 2016). The published count includes the photons that
// hold the box up, which is why it is 17 % too bright at 50 photons. The box is that of the whole
// look-up; photons and area are those within the disc of the bandwidth, so a pass that shrinks the
// bandwidth has the same mean and still knows the region's shape.
//
// What is left over is that the axes, and the octants that are open, are chosen by the same
// photons: octobox_table.h has the ratio that this makes on an open plane.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "estimators/octobox.h"

namespace octolux {

/// How many boxes: one; one per octant; or, octant by octant, what its photons allow.
enum class OctantUse { automatic, one, eight };
/// Throws Error unless `name` is auto, one or eight.
OctantUse parse_octant_use(const std::string& name);

/// count / area is the density of photons.
struct Fit {
  float count = 0;  // photons strictly inside
  float area = 0;
};

/// Points of the bandwidth strictly inside their box.
float count_inside(const PlanePoints& points, const Lanes& box);

/// Fit in the disc of `radius`; the points are those of the disc of radius 1 around the query, and
/// are left turned into the box's axes.
Fit fit_octobox(PlanePoints& points, float radius, OctantUse use);

/// The published area: axes as they are, the whole octagon; one box for each octant, all
/// containing the query, as far as all octants have photons (50 and more: these alone).
float published_octobox_area(const PlanePoints& points, OctantUse use);

}  // namespace octolux
