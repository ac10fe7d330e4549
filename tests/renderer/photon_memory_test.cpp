// renderer/photon_memory.h: what is foreseen comes true, and what cannot be held is refused.
#include "renderer/photon_memory.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/renderer/renders.h"

namespace octolux::test {
namespace {

/// Keeps what was foreseen, and what came of it.
class Memory : public RenderObserver {
 public:
  void photons_foreseen(const PhotonMemory& memory) override { foreseen = memory; }
  bool pass_done(const Progress& progress, const Film&) override {
    photons.add(static_cast<double>(progress.global_photons + progress.caustic_photons));
    bytes = static_cast<double>(progress.photon_bytes);
    return true;
  }
  PhotonMemory foreseen;
  Running photons;
  double bytes = 0;
};

TEST(PhotonMemory, IsForeseen) {
  RenderConfig config = photon_config(8, 4096);  // as many paths as are tried
  const auto scene = shipped_scene("glass-sphere/glass-sphere.xml");
  resize_film(*scene, 8, 8);
  Memory memory;
  render(*scene, config, memory);
  // Passes and the trial are of one kind.
  const double error = std::sqrt(memory.photons.variance() * (1 + 1.0 / 8));
  EXPECT_LT(std::abs(memory.foreseen.photons - memory.photons.mean()), 5 * error);
  EXPECT_GT(memory.foreseen.bytes, memory.bytes);
}

TEST(PhotonMemory, WhatDoesNotFitIsRefused) {
  const RenderConfig config;
  EXPECT_NO_THROW(check_photons({1e6, 1e8}, config, 1e9));
  EXPECT_THROW(check_photons({1e6, 1e9}, config, 1e9), Error);
  EXPECT_THROW(check_photons({1e9, 1e8}, config, 1e9), Error);
}

TEST(PhotonMemory, OfTheMachineIsKnown) { EXPECT_GT(physical_memory(), 1e8); }

}  // namespace
}  // namespace octolux::test
