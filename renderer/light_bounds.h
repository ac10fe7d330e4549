// What is known about a group of lights from afar: the box they are in, a cone that holds all their
// normals, how far from a normal they shine, and their weight (Conty Estevez & Kulla, "Importance
// Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018, 4.1). Angles in radians.
#pragma once

#include "core/light.h"

namespace octolux {

struct LightBounds {
  LightExtent extent;
  double weight = 0;  // by which lights are to be chosen where nothing else tells them apart

  /// Both groups together. The cone is no wider than needed, to rounding (their algorithm 1).
  LightBounds united(const LightBounds& other) const;

  /// Solid angle [sr] the lights shine into, weighted by the profile 1 within the cone of normals
  /// and cos(angle beyond it) outside: weight over this is the intensity along the axis. 4 pi for a
  /// point, pi for a flat one (their M_Omega).
  double solid_angle() const;

  /// Cost of having these lights in one node, up to a constant: weight, spread over directions and
  /// space. Their surface area orientation heuristic with the bounding sphere in place of the box,
  /// since the sphere is all that choosing looks at.
  double cost() const;
};

}  // namespace octolux
