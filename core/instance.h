// Shapes standing in the scene more than once: a group of shapes is stored once, in a space of its
// own, and every Instance puts all of it somewhere. What a point of the group looks like in the
// world is computed here; finding the point is accel/'s work. Pure functions, thread-safe.
#pragma once

#include "core/shape.h"

namespace octolux {

/// One placement of the shapes whose Shape::group is `group`.
struct Instance {
  int group = 0;
  Affine to_world;
  Affine to_object;  // inverse of to_world
};

/// A point of the group's space as it is in the world. `error` grows by what a ray caster loses
/// that maps rays into the group's space in float; true while skew(to_world) is a few units.
SurfacePoint place(const SurfacePoint& point, const Instance& instance);

/// Box round the image of a box.
Bounds place(const Bounds& box, const Affine& to_world);

/// The shape itself moved by an invertible map; what was the front stays in front, also where the
/// map mirrors. Coordinates and normals are rounded to float.
Shape moved(Shape shape, const Affine& to_world);

/// Area [m^2] of the shape's image; as exact as area(Shape).
double area(const Shape& shape, const Affine& to_world);

/// |a| |b| |c| / |det| of the columns of A (Hadamard): 1 for scaling followed by rotation, large
/// for shears. The inverse computed in float is wrong by about this times 2^-24.
double skew(const Affine& map);

}  // namespace octolux
