// learned_lights.h: trials, and sums of them by cell and group.
#include "renderer/learned_lights.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "renderer/direct_light.h"
#include "renderer/glance.h"
#include "renderer/scene.h"

namespace octolux {

namespace {

constexpr std::int64_t kLeastPlaces = 1 << 14, kMostPlaces = 1 << 16;  // else one a pixel
constexpr std::int64_t kChunk = 256;                                   // places
constexpr int kTrials = 8;                                             // at each place

/// Counts as so many trials of each group that brought nothing: one that was seen once in few
/// trials is not known well.
constexpr double kDoubt = 2;

/// One place, and what lights bring there.
struct Glance {
  LookUp place;
  std::vector<LearnedLights::Trial> trials;
};

void try_lights(Tracer& tracer, const LightSampler& lights, const Scattering& at,
                const EyeConfig& eye, Glance& glance) {
  glance.place = {at.point().position, at.facing_normal()};
  const DirectStrategy strategy{Lobes::smooth, Lobes::smooth, lights.divided(eye.light_samples),
                                eye.gather_rays,
                                tracer.scene().max_depth < 0 ? 1 << 20 : tracer.scene().max_depth};
  const Receiver lit = receiver(at);
  for (int i = 0; i < kTrials; ++i) {
    const float u = (static_cast<float>(i) + tracer.rng.uniform()) / kTrials;
    const LightSampler::Choice choice = lights.sample(lit, std::min(kOneMinusEpsilon, u));
    const Rgb brought = sample_light(tracer, choice, tracer.rng.uniform2(), at, strategy);
    glance.trials.push_back({glance.place, choice.group, choice.pmf_of_group * luminance(brought)});
  }
}

}  // namespace

LearnedLights::LearnedLights(EyeCells cells, int groups, std::span<const Trial> trials)
    : cells_(std::move(cells)), groups_(static_cast<std::size_t>(groups)) {
  struct Sum {
    double squares = 0, count = 0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(cells_.size()) * groups_);
  for (const Trial& trial : trials) {
    const int cell = cells_.find(trial.at.position, trial.at.normal);
    if (cell < 0 || trial.group < 0 || !std::isfinite(trial.brought)) continue;
    Sum& sum =
        sums[static_cast<std::size_t>(cell) * groups_ + static_cast<std::size_t>(trial.group)];
    sum.squares += static_cast<double>(trial.brought) * trial.brought;
    sum.count += 1;
  }
  for (std::size_t begin = 0; begin < sums.size(); begin += groups_) {
    std::vector<double> chances;
    double total = 0;
    for (std::size_t g = 0; g < groups_; ++g) {
      const Sum& sum = sums[begin + g];
      total += std::sqrt(sum.squares / (sum.count + kDoubt));
      chances.push_back(total);
    }
    for (const double c : chances) {
      cumulative_.push_back(total > 0 ? static_cast<float>(c / total) : 0.0f);
    }
  }
}

std::span<const float> LearnedLights::at(Vec3 position, Vec3 normal) const {
  const int cell = cells_.find(position, normal);
  if (cell < 0) return {};
  return {cumulative_.data() + static_cast<std::size_t>(cell) * groups_, groups_};
}

LearnedLights learn_lights(const Scene& scene, const LightSampler& lights,
                           const RenderConfig& config) {
  if (!config.eye.gather || !config.eye.learn || lights.groups() < 2) return {};
  const FilmSize& film = scene.film;
  const std::int64_t pixels = static_cast<std::int64_t>(film.crop_width) * film.crop_height;
  const std::int64_t places = std::clamp(pixels, kLeastPlaces, kMostPlaces);
  std::vector<Glance> glances(static_cast<std::size_t>(places));
  parallel_for_chunks(places, kChunk, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      Tracer tracer(scene, Rng(config.seed, Stream::lights, 0, static_cast<std::uint64_t>(i)));
      follow_to_smooth(tracer, random_eye_ray(scene, tracer.rng), [&](const Scattering& at) {
        try_lights(tracer, lights, at, config.eye, glances[static_cast<std::size_t>(i)]);
      });
    }
  });
  std::vector<LookUp> seen;
  std::vector<LearnedLights::Trial> trials;
  for (const Glance& glance : glances) {
    if (!glance.trials.empty()) seen.push_back(glance.place);
    trials.insert(trials.end(), glance.trials.begin(), glance.trials.end());
  }
  const Vec3 eye = scene.camera_config.to_world.point({0, 0, 0});
  return {EyeCells(std::move(seen), eye), lights.groups(), trials};
}

}  // namespace octolux
