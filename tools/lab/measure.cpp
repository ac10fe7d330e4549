// Runs are independent and seeded by their number, and sums are joined in a fixed order, so the
// figures do not depend on the number of threads.
#include "tools/lab/measure.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/bsdf_makers.h"
#include "core/error.h"
#include "core/parallel.h"
#include "estimators/radial.h"

namespace octolux {
namespace {

constexpr int kAngles = 16;
constexpr std::int64_t kChunk = 64;

struct Sums {
  double sum = 0, square = 0;
};

using Estimators = std::vector<std::unique_ptr<Estimator>>;

Estimators make_estimators(const LabSettings& settings, int neighbours) {
  Estimators estimators;
  for (const LabKernel& kernel : settings.kernels) {
    EstimatorConfig config = kernel.config;
    config.neighbours = neighbours;
    estimators.push_back(make_estimator(config));
  }
  return estimators;
}

std::vector<std::unique_ptr<LabWorld>> make_worlds(const LabLayout& layout, double angle) {
  std::vector<std::unique_ptr<LabWorld>> worlds;
  const int count = angle < 0 ? kAngles : 1;
  for (int i = 0; i < count; ++i) {
    // Offset, so that no wall is exactly along an axis of the query's frame.
    const double turned = angle < 0 ? 360.0 * (i + 0.37) / count : angle;
    worlds.push_back(std::make_unique<LabWorld>(layout, turned));
  }
  return worlds;
}

struct Experiment {
  const LabSettings& settings;
  const std::vector<std::unique_ptr<LabWorld>>& worlds;
  const Estimators& estimators;
  int neighbours;
};

std::vector<Sums> run_chunk(const Experiment& e, std::int64_t begin, std::int64_t end) {
  std::vector<Sums> sums(e.estimators.size());
  for (std::int64_t run = begin; run < end; ++run) {
    Rng rng(e.settings.seed, Stream::test, static_cast<std::uint64_t>(e.neighbours),
            static_cast<std::uint64_t>(run));
    const LabWorld& world = *e.worlds[static_cast<std::size_t>(run) % e.worlds.size()];
    const LabQuery query({}, {0, 0, 1}, world.viewer());
    const PhotonMap map(world.photons(e.neighbours, e.settings.pattern, rng));
    const float turn = rng.uniform();
    Bandwidth bandwidth;
    bandwidth.shrink = static_cast<float>(e.settings.shrink);
    for (std::size_t k = 0; k < sums.size(); ++k) {
      const double value =
          query.irradiance(*e.estimators[k], map, bandwidth, &world.caster(), turn).radiance.g;
      sums[k].sum += value;
      sums[k].square += value * value;
    }
  }
  return sums;
}

LabResult summary(const Sums& sums, std::int64_t runs) {
  const auto n = static_cast<double>(runs);
  LabResult result;
  result.runs = static_cast<int>(runs);
  result.mean = sums.sum / n;
  const double variance = (sums.square - sums.sum * sums.sum / n) / std::max(n - 1, 1.0);
  result.deviation = std::sqrt(std::max(variance, 0.0));
  result.standard_error = result.deviation / std::sqrt(n);
  return result;
}

std::vector<LabResult> measure_one(const Experiment& e) {
  const double share = 50.0 / e.neighbours;  // noise is about 1 / sqrt(neighbours)
  const auto runs = std::max<std::int64_t>(16, static_cast<std::int64_t>(e.settings.runs * share));
  std::vector<std::vector<Sums>> parts(static_cast<std::size_t>((runs + kChunk - 1) / kChunk));
  parallel_for_chunks(runs, kChunk, [&](std::int64_t c, std::int64_t begin, std::int64_t end) {
    parts[static_cast<std::size_t>(c)] = run_chunk(e, begin, end);
  });
  std::vector<LabResult> results;
  for (std::size_t k = 0; k < e.estimators.size(); ++k) {
    Sums total;
    for (const auto& part : parts) total.sum += part[k].sum, total.square += part[k].square;
    results.push_back(summary(total, runs));
    results.back().kernel = e.settings.kernels[k].name;
    results.back().neighbours = e.neighbours;
    results.back().angle = e.settings.angle;
  }
  return results;
}

/// An open plane with one photon per unit of area.
PhotonMap plane_map(int side) {
  Rng rng(1, Stream::test, 0, 0);
  std::vector<Photon> photons(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (Photon& p : photons) {
    const Vec2 u = rng.uniform2();
    p.position = {u.x * static_cast<float>(side), u.y * static_cast<float>(side), 0};
    p.normal = p.wi = {0, 0, 1};
    p.flux = Rgb(1);
  }
  return PhotonMap(std::move(photons));
}

}  // namespace

double LabResult::rmse() const { return std::sqrt(bias() * bias() + deviation * deviation); }

LabKernel parse_lab_kernel(const std::string& text, const EstimatorConfig& base) {
  LabKernel kernel{text, base};
  std::size_t end = text.find(':');
  kernel.config.kernel = text.substr(0, end);
  while (end != std::string::npos) {
    const std::size_t start = end + 1;
    end = text.find(':', start);
    const std::string option = text.substr(start, end - start);
    if (option == "one" || option == "eight" || option == "auto") {
      kernel.config.octants = option;
    } else if (option == "published") {
      kernel.config.correction = false;
    } else {
      throw Error(unknown_name("kernel option", option, {"one", "eight", "auto", "published"}));
    }
  }
  make_estimator(kernel.config);
  return kernel;
}

std::vector<LabResult> measure(const LabLayout& layout, const LabSettings& settings) {
  const auto worlds = make_worlds(layout, settings.angle);
  std::vector<LabResult> results;
  for (const int n : settings.neighbours) {
    const Estimators estimators = make_estimators(settings, n);
    for (LabResult& r : measure_one({settings, worlds, estimators, n})) results.push_back(r);
  }
  return results;
}

void measure_time(const LabSettings& settings, std::vector<LabResult>& results) {
  using Clock = std::chrono::steady_clock;
  constexpr int kSide = 500, kQueries = 500, kRepeats = 5;
  const PhotonMap map = plane_map(kSide);
  const auto worlds = make_worlds(find_lab_case("plane").layout(0, 0), 0);
  for (LabResult& r : results) {
    EstimatorConfig config = parse_lab_kernel(r.kernel).config;
    config.neighbours = r.neighbours;
    const std::unique_ptr<Estimator> estimator = make_estimator(config);
    double best = kInfinity;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
      Rng rng(settings.seed, Stream::test, 1, 0);
      const Clock::time_point start = Clock::now();
      for (int i = 0; i < kQueries; ++i) {
        const Vec2 u = rng.uniform2();
        const LabQuery query({kSide * (0.25f + u.x / 2), kSide * (0.25f + u.y / 2), 0}, {0, 0, 1});
        query.irradiance(*estimator, map, {}, &worlds[0]->caster(), u.x);
      }
      best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
    }
    r.nanoseconds = best / kQueries;
  }
}

LabQuery::LabQuery(Vec3 position, Vec3 normal, Vec3 wo)
    : white_(make_diffuse(Color(Rgb(1)))), wo_(wo) {
  point_.position = position;
  point_.ng = point_.ns = normal;
}

Estimate LabQuery::irradiance(const Estimator& estimator, const PhotonMap& map,
                              const Bandwidth& bandwidth, const RayCaster* caster,
                              float turn) const {
  const Scattering scattering(point_, *white_, wo_, Carried::radiance);
  GatherPoint at{scattering};
  at.caster = caster;
  at.turn = turn;
  Estimate estimate = estimator.estimate(at, map, bandwidth);
  estimate.radiance = in_range(estimate.radiance * kPi);
  return estimate;
}

}  // namespace octolux
