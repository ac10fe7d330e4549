// What benchmark programs share: a watch, medians, renders nobody listens to, other film sizes.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "renderer/render.h"

namespace octolux {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

class Silent : public RenderObserver {
 public:
  bool pass_done(const Progress&, const Film&) override { return true; }
};

inline void set_size(Scene& scene, int width, int height) {
  scene.film = {width, height, 0, 0, width, height};
  scene.camera = Camera(scene.camera_config, scene.film);
}

}  // namespace octolux
