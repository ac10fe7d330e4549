// emission_density.h. Splits are looked for at the edges of 16 bins along every coordinate.
#include "renderer/emission_density.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/constants.h"

namespace octolux {

namespace {

constexpr int kBins = 16;
constexpr int kAxes = 5;
constexpr std::size_t kFewestTrials = 32;  // in a box that may be split
constexpr double kThinnest = 0x1p-16;      // side of a box that may be split
/// A split that lowers sqrt m by less than this over the number of useful trials may be chance.
constexpr double kChance = 0.7;
constexpr double kDoubt = 0.1;

using Trial = EmissionDensity::Trial;

struct Sums {
  double weight = 0, use = 0;  // of trials: weight, weight * use
  void add(const Trial& t) { weight += t.weight, use += t.weight * t.use; }
  void add(const Sums& s) { weight += s.weight, use += s.use; }
};

using Histogram = std::array<std::array<Sums, kBins>, kAxes>;

struct Split {
  int axis = 0;
  double share = 0;             // of the volume below it
  double below = 0, above = 0;  // m there
  double gain = 0;              // of sqrt m, relative
};

/// m of a part of a box, as if `doubt` were added to its trials.
double use_of(const Sums& part, const Sums& doubt) {
  return (part.use + doubt.use) / (part.weight + doubt.weight);
}

Split best_split(const Histogram& histogram, const Sums& all, const Sums& doubt) {
  Split best;
  for (int axis = 0; axis < kAxes; ++axis) {
    Sums below;
    for (int bin = 1; bin < kBins; ++bin) {
      below.add(histogram[axis][bin - 1]);
      const Sums above{all.weight - below.weight, all.use - below.use};
      Split s{axis, static_cast<double>(bin) / kBins};
      s.below = use_of(below, doubt);
      s.above = use_of({std::max(0.0, above.weight), std::max(0.0, above.use)}, doubt);
      const double mean = s.share * s.below + (1 - s.share) * s.above;
      const double roots = s.share * std::sqrt(s.below) + (1 - s.share) * std::sqrt(s.above);
      s.gain = 1 - roots / std::sqrt(mean);
      if (s.gain > best.gain) best = s;
    }
  }
  return best;
}

}  // namespace

double EmissionDensity::Box::volume() const {
  double v = 1;
  for (int i = 0; i < kAxes; ++i) v *= upper[i] - lower[i];
  return v;
}

/// Splits boxes, depth first, as long as trials show a difference inside.
class EmissionDensity::Builder {
 public:
  explicit Builder(EmissionDensity& made) : made_(made) {}

  void build(std::span<Trial> trials, const Box& box, double use) {
    const std::size_t here = made_.nodes_.size();
    made_.nodes_.emplace_back();
    const std::optional<Split> split = find_split(trials, box);
    if (!split) {
      made_.nodes_[here].other = static_cast<int>(made_.leaves_.size());
      made_.leaves_.push_back({box, std::sqrt(use), 1});
      return;
    }
    const int axis = split->axis;
    const double place = box.lower[axis] + split->share * (box.upper[axis] - box.lower[axis]);
    const auto middle = std::partition(trials.begin(), trials.end(), [&](const Trial& t) {
      return static_cast<double>(t.at[axis]) < place;
    });
    const auto below = static_cast<std::size_t>(middle - trials.begin());
    Box lower = box, upper = box;
    lower.upper[axis] = upper.lower[axis] = place;
    build(trials.first(below), lower, split->below);
    made_.nodes_[here] = {axis, place, static_cast<int>(made_.nodes_.size())};
    build(trials.subspan(below), upper, split->above);
  }

 private:
  static std::optional<Split> find_split(std::span<const Trial> trials, const Box& box) {
    if (trials.size() < kFewestTrials) return std::nullopt;
    Histogram histogram{};
    Sums all;
    double use2 = 0, weight2_use2 = 0;
    for (const Trial& t : trials) {
      all.add(t);
      use2 += t.weight * t.use * t.use;
      weight2_use2 += t.weight * t.use * t.weight * t.use;
      for (int axis = 0; axis < kAxes; ++axis) {
        const double side = box.upper[axis] - box.lower[axis];
        const double place = (static_cast<double>(t.at[axis]) - box.lower[axis]) / side;
        histogram[axis][std::clamp(static_cast<int>(place * kBins), 0, kBins - 1)].add(t);
      }
    }
    const double trial_weight = all.weight / static_cast<double>(trials.size());
    if (!(all.use > 0)) return std::nullopt;
    const double useful = all.use * all.use / weight2_use2;  // as many as it were if all alike
    const double doubt = kDoubt * trial_weight;
    const Split best = best_split(histogram, all, {doubt, doubt * use2 / all.use});
    const bool thin = box.upper[best.axis] - box.lower[best.axis] < kThinnest;
    if (thin || !(best.gain * useful > kChance)) return std::nullopt;
    return best;
  }

  EmissionDensity& made_;
};

EmissionDensity::EmissionDensity(std::vector<Trial> trials) {
  Sums all;
  for (const Trial& t : trials) all.add(t);
  if (!(all.use > 0)) return;
  Builder(*this).build(trials, {}, all.use / all.weight);
  set_weights();
}

void EmissionDensity::set_weights() {
  double mean = 0, mean_root = 0;
  for (const Leaf& leaf : leaves_) {
    mean += leaf.box.volume() * leaf.root_use * leaf.root_use;
    mean_root += leaf.box.volume() * leaf.root_use;
  }
  gain_ = mean / (mean_root * mean_root);
  double sum = 0;
  for (Leaf& leaf : leaves_) {
    const double density = kDefensiveShare + (1 - kDefensiveShare) * leaf.root_use / mean_root;
    leaf.weight = static_cast<float>(1 / density);
    sum += density * leaf.box.volume();
    cdf_.push_back(sum);
  }
  for (double& c : cdf_) c /= sum;
}

EmissionDensity::Sample EmissionDensity::sample(double u, Rng& rng) const {
  Sample s;
  const auto found = std::upper_bound(cdf_.begin(), cdf_.end(), u);
  const Leaf* leaf = nullptr;
  if (uniform()) {
    s.at[0] = std::min(kOneMinusEpsilon, static_cast<float>(u));
  } else {
    leaf = &leaves_[static_cast<std::size_t>(std::min(found, cdf_.end() - 1) - cdf_.begin())];
    s.weight = leaf->weight;
    s.at[0] = rng.uniform();
  }
  for (int i = 1; i < kAxes; ++i) s.at[i] = rng.uniform();
  if (!leaf) return s;
  for (int i = 0; i < kAxes; ++i) {
    const double side = leaf->box.upper[i] - leaf->box.lower[i];
    const double place = leaf->box.lower[i] + static_cast<double>(s.at[i]) * side;
    s.at[i] = std::min(kOneMinusEpsilon, static_cast<float>(place));
  }
  return s;
}

double EmissionDensity::density(const EmissionPoint& at) const {
  if (uniform()) return 1;
  std::size_t n = 0;
  while (nodes_[n].axis >= 0) {
    const Node& node = nodes_[n];
    n = static_cast<double>(at[node.axis]) < node.split ? n + 1
                                                        : static_cast<std::size_t>(node.other);
  }
  return 1 / static_cast<double>(leaves_[static_cast<std::size_t>(nodes_[n].other)].weight);
}

}  // namespace octolux
