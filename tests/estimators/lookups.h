// One look-up, as the estimator tests want it: photons, a query on a floor, and a white surface, so
// that the answer is an irradiance.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "core/rng.h"
#include "estimators/estimator.h"
#include "tools/lab/measure.h"

namespace octolux::test {

/// Every kernel, with every option that changes what it computes.
inline std::vector<EstimatorConfig> all_configs() {
  std::vector<EstimatorConfig> configs;
  for (const std::string& name : kernel_names()) {
    for (const bool correction : {true, false}) {
      for (const char* octants : {"auto", "one", "eight"}) {
        if (name != "octobox" && std::string(octants) != "auto") continue;
        EstimatorConfig config;
        config.kernel = name;
        config.correction = correction;
        config.octants = octants;
        config.neighbours = 50;
        configs.push_back(config);
        config.seen = true;
        if (correction && name != "feeler" && name != "region") configs.push_back(config);
      }
    }
  }
  return configs;
}

inline std::string describe(const EstimatorConfig& config) {
  return config.kernel + ":" + config.octants + (config.correction ? "" : ":published") +
         (config.seen ? ":seen" : "") + " n " + std::to_string(config.neighbours);
}

struct Lookup {
  std::vector<Photon> photons;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 0, 1};
  float floor = 100;  // half the side of the square floor around the query
  Bandwidth bandwidth;

  Estimate operator()(const EstimatorConfig& config) const {
    const std::vector<Shape> shapes{floor_shape()};
    const RayCaster caster(shapes);
    const PhotonMap map(photons);
    return LabQuery(position, normal)
        .irradiance(*make_estimator(config), map, bandwidth, &caster, 0.25f);
  }

 private:
  Shape floor_shape() const {
    const Frame frame = Frame::from_normal(normal);
    TriangleMesh mesh;
    for (const Vec2 c : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}}) {
      mesh.positions.push_back(position + (frame.s * c.x + frame.t * c.y) * floor);
    }
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    Shape shape;
    shape.geometry = mesh;
    return shape;
  }
};

inline Photon photon_at(Vec3 position, Rgb flux = Rgb(1)) {
  Photon photon;
  photon.position = position;
  photon.normal = photon.wi = {0, 0, 1};
  photon.flux = flux;
  return photon;
}

/// `count` photons uniform in the square of half side `size` around the origin.
inline std::vector<Photon> uniform_photons(int count, float size, std::uint64_t seed) {
  Rng rng(seed, Stream::test, 0, 0);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    const Vec2 u = rng.uniform2();
    photons.push_back(photon_at({size * (2 * u.x - 1), size * (2 * u.y - 1), 0}));
  }
  return photons;
}

}  // namespace octolux::test
