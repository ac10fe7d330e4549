// learn_emission.h. Trials of all rounds are used together, weighed by the balance heuristic: each
// stands for 1 / (mean density of the rounds at its place) uniform trials.
#include "renderer/learn_emission.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/parallel.h"
#include "renderer/eye_cells.h"
#include "renderer/tracer.h"

namespace octolux {

namespace {

constexpr std::int64_t kChunk = 1024;  // paths
/// Trials of all rounds: so many times the global photon paths of a pass, within limits. Each round
/// has as many as all before, the first a 32nd part.
constexpr std::int64_t kTrialsPerPhoton = 8;
constexpr std::int64_t kMostTrials = 1 << 19, kFewestTrials = 1 << 12;
constexpr int kRounds = 6;
/// Gains are believed from so many useful trials on.
constexpr int kTellingTrials = 100;

/// A photon in a cell.
struct Landing {
  int cell = 0;
  double share = 0;  // of the power of all lights, had the path been emitted uniformly
};

/// A photon path, and what became of it.
struct Path {
  EmissionPoint at{};
  double emitted = 1;        // density it was emitted with
  double density = 0;        // of trials here, summed over the rounds
  std::size_t landings = 0;  // number of its last in the list, plus one
};

struct Trials {
  std::vector<Path> paths;
  std::vector<Landing> landings;
  std::size_t round = 0;  // first path of the last round

  /// Appends what one chunk found.
  void append(const Trials& part) {
    const std::size_t before = landings.size();
    for (Path path : part.paths) {
      path.landings += before;
      paths.push_back(path);
    }
    landings.insert(landings.end(), part.landings.begin(), part.landings.end());
  }
  std::span<const Landing> of(std::size_t path) const {
    const std::size_t first = path == 0 ? 0 : paths[path - 1].landings;
    return {landings.data() + first, paths[path].landings - first};
  }
};

class Learner {
 public:
  Learner(const Scene& scene, const LightSampler& lights, PhotonKind kind, EyeCells cells,
          std::uint64_t seed)
      : scene_(scene), lights_(lights), kind_(kind), cells_(std::move(cells)), seed_(seed) {}

  /// Emits the first round by `density`.
  void start_from(const EmissionDensity& density) { density_ = density; }

  /// A round of trials, and what is known after it.
  void round(std::int64_t count) {
    densities_.emplace_back(static_cast<double>(count), density_);
    trace(count);
    weigh();
    judge();
  }

  const EmissionDensity& density() const { return density_; }
  /// By how much fewer photons would do with the density known before the last round (1: uniform),
  /// measured by the trials of that round, which it was not learned from.
  double tested_gain() const { return tested_gain_; }
  /// Are there enough useful trials to believe in gains?
  bool telling() const { return useful_ >= kTellingTrials; }

 private:
  void trace(std::int64_t count);
  void weigh();
  void judge();
  std::vector<double> cell_shares() const;
  double use_of(std::size_t path, const std::vector<double>& scores) const;

  const Scene& scene_;
  const LightSampler& lights_;
  const PhotonKind kind_;
  const EyeCells cells_;
  const std::uint64_t seed_;
  Trials trials_;
  std::vector<std::pair<double, EmissionDensity>> densities_;  // of each round, with its trials
  EmissionDensity density_;
  double tested_gain_ = 1;
  double useful_ = 0;  // trials, as many as they were if all were alike
};

void Learner::trace(std::int64_t count) {
  trials_.round = trials_.paths.size();
  const auto stage = 2 * densities_.size() + (kind_ == PhotonKind::global ? 0 : 1);
  std::vector<Trials> parts(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  parallel_for_chunks(count, kChunk, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
    Trials& part = parts[static_cast<std::size_t>(chunk)];
    std::vector<Photon> photons;
    for (std::int64_t i = begin; i < end; ++i) {
      Tracer tracer(scene_, Rng(seed_, Stream::learning, stage, static_cast<std::uint64_t>(i)));
      const double u = (static_cast<double>(i) + tracer.rng.uniform()) / static_cast<double>(count);
      const EmissionDensity::Sample sample = density_.sample(u, tracer.rng);
      photons.clear();
      trace_photon(tracer, emit_photon(lights_, sample.at, 1), kind_, photons);
      for (const Photon& photon : photons) {
        const int cell = cells_.find(photon.position, photon.normal);
        const double share = mean(photon.flux) / lights_.total_power();
        if (cell >= 0 && std::isfinite(share)) part.landings.push_back({cell, share});
      }
      part.paths.push_back(
          {sample.at, 1 / static_cast<double>(sample.weight), 0, part.landings.size()});
    }
  });
  for (const Trials& part : parts) trials_.append(part);
}

/// Brings every path's density of trials up to date.
void Learner::weigh() {
  const auto count = static_cast<std::int64_t>(trials_.paths.size());
  const auto fresh = static_cast<std::int64_t>(trials_.round);
  parallel_for_chunks(count, kChunk, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      Path& path = trials_.paths[static_cast<std::size_t>(i)];
      const std::size_t first = i < fresh ? densities_.size() - 1 : 0;
      for (std::size_t r = first; r < densities_.size(); ++r) {
        path.density += densities_[r].first * densities_[r].second.density(path.at);
      }
    }
  });
}

/// Mean over uniform paths of what lands in each cell.
std::vector<double> Learner::cell_shares() const {
  std::vector<double> shares(static_cast<std::size_t>(cells_.size()));
  for (std::size_t p = 0; p < trials_.paths.size(); ++p) {
    for (const Landing& l : trials_.of(p)) {
      shares[static_cast<std::size_t>(l.cell)] += l.share / trials_.paths[p].density;
    }
  }
  return shares;
}

double Learner::use_of(std::size_t path, const std::vector<double>& scores) const {
  double use = 0;
  for (const Landing& l : trials_.of(path)) {
    use += l.share * l.share * scores[static_cast<std::size_t>(l.cell)];
  }
  return use;
}

/// From what landed where to the use of every path, the test of the last density, and the next.
void Learner::judge() {
  std::vector<double> scores = cell_shares();
  std::vector<double> sorted = scores;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (std::size_t c = 0; c < scores.size(); ++c) {
    const double mu2 = scores[c] * scores[c] + median * median;
    scores[c] = mu2 > 0 ? cells_.look_ups(static_cast<int>(c)) / mu2 : 0;
  }
  std::vector<EmissionDensity::Trial> trials;
  trials.reserve(trials_.paths.size());
  double by_uniform = 0, by_learned = 0;
  double sum = 0, sum2 = 0;
  for (std::size_t p = 0; p < trials_.paths.size(); ++p) {
    const Path& path = trials_.paths[p];
    const double use = use_of(p, scores);
    sum += use / path.density;
    sum2 += use / path.density * (use / path.density);
    trials.push_back({path.at, 1 / path.density, use});
    if (p < trials_.round) continue;
    by_uniform += use / path.emitted;
    by_learned += use / (path.emitted * path.emitted);
  }
  useful_ = sum2 > 0 ? sum * sum / sum2 : 0;
  tested_gain_ = by_learned > 0 ? by_uniform / by_learned : 1;
  EmissionDensity learned(std::move(trials));
  // From few trials, only what promises more than what is in use.
  if (telling() || learned.gain() > tested_gain_) density_ = std::move(learned);
}

EmissionDensity learn(const Scene& scene, const LightSampler& lights, PhotonKind kind,
                      const RenderConfig& config, const EmissionDensity& first) {
  const bool global = kind == PhotonKind::global;
  if (lights.empty()) return {};
  if (!global && (!scene.any_specular || config.photons.caustic == 0)) return {};
  EyeCells cells = look_around(scene, kind, config.seed);
  if (cells.size() == 0) return {};

  Learner learner(scene, lights, kind, std::move(cells), config.seed);
  learner.start_from(first);
  std::int64_t count = std::clamp(kTrialsPerPhoton * std::min(config.photons.global, kMostTrials),
                                  kFewestTrials, kMostTrials) >>
                       (kRounds - 1);
  learner.round(count);
  for (int r = 1; r < kRounds; ++r) {
    // With portals, what comes another way is bright and rare, and a first look does not see it.
    const bool trusted = learner.telling() && scene.portals.empty();
    if (trusted && learner.density().gain() < kWorthwhileGain) return {};
    learner.round(count);
    count *= 2;
  }
  return learner.tested_gain() < kWorthwhileGain ? EmissionDensity() : learner.density();
}

}  // namespace

PhotonAim learn_emission(const Scene& scene, const LightSampler& lights,
                         const RenderConfig& config) {
  PhotonAim aim;
  if (!config.photons.learn || !config.eye.gather) return aim;
  aim.global = learn(scene, lights, PhotonKind::global, config, {});
  // Caustics are of the light that comes in, so they are looked for there.
  aim.caustic = learn(scene, lights, PhotonKind::caustic, config, aim.global);
  return aim;
}

}  // namespace octolux
