// A look from the eye, before it sees: along a random eye path to the first place where light is
// gathered, and on to where gather rays end. What is learned for the picture is learned from such
// places, and there a pass keeps its records.
#pragma once

#include <functional>

#include "core/scattering.h"
#include "renderer/tracer.h"

namespace octolux {

/// A ray through a random point of the film.
Ray random_eye_ray(const Scene& scene, Rng& rng);

/// Follows `ray` through specular lobes and calls see(at) where it meets the first smooth ones, if
/// ever it does.
void follow_to_smooth(Tracer& tracer, Ray ray, const std::function<void(const Scattering&)>& see);

/// Sends `rays` rays from `at` as its smooth lobes scatter, and calls see(at) where such a ray
/// would read the photon map: where it meets the first smooth lobes.
void gather_from(Tracer& tracer, const Scattering& at, int rays,
                 const std::function<void(const Scattering&)>& see);

}  // namespace octolux
