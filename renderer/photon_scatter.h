// Where a photon goes on from a surface, or that it ends there.
//
// Inside the focus, where photons are read (focus.h), as the surface scatters. Of light outside, on
// the ground around a house, hardly any finds the window, and so few photons of so much flux would
// be seen as specks. There some are aimed: into the cone under which the focus is seen, with so
// much less flux. Both ways together have one density, so either carries what the balance heuristic
// leaves it (Veach 1997, 9.2.2), and none from outside that comes near the focus is heavy.
#pragma once

#include "core/rng.h"
#include "core/scattering.h"
#include "renderer/focus.h"

namespace octolux {

/// A photon in flight.
struct Flight {
  Ray ray;
  Rgb flux;                // [W]
  int segments = 0;        // behind it
  bool scattered = false;  // by a smooth lobe
  float flown = 0;         // [m] since then
};

/// Scatters the photon at `at` by one of `lobes`; false if it ends. A BSDF's choice passes Russian
/// roulette by the ratio of new to old flux, so that survivors keep theirs and the lights' watts do
/// not matter.
bool scatter(Flight& flight, const Scattering& at, Lobes lobes, const std::optional<Focus>& focus,
             Rng& rng);

}  // namespace octolux
