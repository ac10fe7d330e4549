// shared_gathers.h.
#include "renderer/shared_gathers.h"

#include <map>
#include <tuple>

#include "estimators/simd8.h"

namespace octolux {

namespace {

constexpr int kReach = SharedGathers::kMostPixels;
constexpr int kRows = 2 * kReach + 1;
constexpr int kVectors = (kRows + 7) / 8;  // in a row of neighbours
constexpr int kLanes = 8 * kVectors;
constexpr float kMinCosine = 0.95f;  // between normals
/// Squared sine of the angle to the tangent plane. On a surface whose normals are as near as that
/// none is larger; what is seen past its edge lies far behind.
constexpr float kMostOutOfPlane = 1 - kMinCosine * kMinCosine;
constexpr std::uint32_t kChannels = 7;  // bits of a kind: which channels are not black
constexpr std::uint32_t kNothing = 0;   // the kind of pixels without anything to share

/// Numbers pixels by what they know: those that came another way, or look under another coat, know
/// something else.
class Kinds {
 public:
  std::uint32_t of(const Gathered& g) {
    if (!g.diffuse || !is_finite(g.radiance)) return kNothing;
    const Key key{g.way, g.segments, g.coated};
    if (key != last_) {
      const auto next = static_cast<std::uint32_t>(numbers_.size() + 1);
      number_ = numbers_.try_emplace(key, next).first->second;
      last_ = key;
    }
    std::uint32_t channels = 0;
    for (int c = 0; c < 3; ++c) channels |= g.reflectance[c] > 0 ? 1u << c : 0u;
    return number_ * (kChannels + 1) + channels;
  }

 private:
  using Key = std::tuple<Way, int, const Bsdf*>;
  std::map<Key, std::uint32_t> numbers_;
  Key last_{{}, -1, nullptr};
  std::uint32_t number_ = 0;
};

/// Where neighbours stand in the picture, by row and column.
struct Places {
  float far[kRows][kLanes];   // squared distance over that which is too far; 1: no neighbour
  float near[kRows][kLanes];  // 1: near enough to share along what is close
};
constexpr Places kPlaces = [] {
  constexpr auto near = [](int d) { return -kAlongPixels <= d && d <= kAlongPixels; };
  Places places{};
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kLanes; ++i) {
      const int x = i - kReach, y = j - kReach, square = x * x + y * y;
      constexpr float kTooFar = (kReach + 1) * (kReach + 1);
      places.far[j][i] = i < kRows && square > 0 ? static_cast<float>(square) / kTooFar : 1;
      places.near[j][i] = near(x) && near(y) ? 1 : 0;
    }
  }
  return places;
}();

/// Nearness::times of a distance, eight at once.
class Nearness8 {
 public:
  explicit Nearness8(const Nearness& n)
      : even_(n.even()), squares_(n.excess_squares()), products_(2 * n.excess_products()) {}

  __attribute__((always_inline)) Float8 times(Float8 x, Float8 y, Float8 z, Float8 length) const {
    const Float8 across = squares_.x * (x * x) + squares_.y * (y * y) + squares_.z * (z * z) +
                          products_.x * (y * z) + products_.y * (z * x) + products_.z * (x * y);
    return even_ * length + (length > 0 ? across / length : splat8(0));
  }

 private:
  float even_;
  Vec3 squares_, products_;
};

}  // namespace

/// What neighbours weigh, by row and column; eight more columns before the first are nothing.
struct SharedGathers::Weights {
  float of[kRows][8 + kLanes] = {};
  bool any[kRows] = {};

  float* at(int row, int k) { return of[row] + 8 + 8 * k; }
  /// Of neighbours 8k to 8k + 7 of a row as much as those opposite weigh, too.
  __attribute__((always_inline)) Float8 paired(int row, int k) const {
    const float* opposite = of[kRows - 1 - row] + 8 + kRows - 8 - 8 * k;
    return min8(load8(of[row] + 8 + 8 * k), reverse8(load8(opposite)));
  }
};

SharedGathers::SharedGathers(const GatheredGrid& grid, const GatherSharing& sharing, float shrink)
    : grid_(grid),
      sharing_(sharing),
      shrink_(shrink),
      stride_(static_cast<std::size_t>(grid.width + kLanes)),
      kinds_(stride_ * static_cast<std::size_t>(grid.height + kRows), kNothing) {
  for (std::vector<float>& field : of_) field.resize(kinds_.size());
  Kinds kinds;
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Gathered& gathered = grid.at(x, y);
      const std::uint32_t kind = kinds.of(gathered);
      if (kind != kNothing) add(gathered, kind, index(x, y));
    }
  }
}

const SharingLimit& SharedGathers::limit(const Gathered& gathered) const {
  return sharing_.limits()[static_cast<std::size_t>(&gathered - grid_.pixels.data())];
}

void SharedGathers::add(const Gathered& gathered, std::uint32_t kind, std::size_t i) {
  const Vec3 p = gathered.position, n = gathered.normal;
  const Rgb lit = gathered.radiance;
  const bool known = limit(gathered).way == gathered.way;
  const float nearness = known ? limit(gathered).nearness.most() / shrink_ : kInfinity;
  const float fields[kFields] = {p.x, p.y, p.z, n.x, n.y, n.z, lit.r, lit.g, lit.b, nearness};
  for (std::size_t f = 0; f < kFields; ++f) of_[f][i] = fields[f];
  kinds_[i] = kind;
}

Rgb SharedGathers::shared(int x, int y) const {
  const Gathered& own = grid_.at(x, y);
  const std::size_t i = index(x, y);
  if (kinds_[i] == kNothing || limit(own).way != own.way) return own.radiance;
  Weights weights;
  weigh(limit(own).nearness * (1 / shrink_), i, weights);
  return mean(own.radiance, i, weights);
}

/// Epanechnikov's kernel of the distance, in the scene or the picture, whichever is nearer to its
/// limit; 0 for pixels that do not know what this one asks.
void SharedGathers::weigh(const Nearness& nearness, std::size_t i, Weights& weights) const {
  const Nearness8 along(nearness);
  const std::uint32_t kind = kinds_[i], asked = kind & kChannels;
  const std::size_t first = i - kReach * (stride_ + 1);
  for (int j = 0; j < kRows; ++j) {
    Mask8 any{};
    for (int k = 0; k < kVectors; ++k) {
      const std::size_t at = first + static_cast<std::size_t>(j) * stride_ + 8u * unsigned(k);
      const auto field = [&](Field f) { return load8(&of_[f][at]); };
      const Float8 x = field(px) - of_[px][i], y = field(py) - of_[py][i];
      const Float8 z = field(pz) - of_[pz][i], square = x * x + y * y + z * z;
      const Float8 out = x * of_[nx][i] + y * of_[ny][i] + z * of_[nz][i];
      const Float8 cosine =
          field(nx) * of_[nx][i] + field(ny) * of_[ny][i] + field(nz) * of_[nz][i];
      const auto theirs = reinterpret_as<Unsigned8>(load8(&kinds_[at]));
      const Unsigned8 unlike = ((theirs ^ kind) & ~kChannels) | (~theirs & asked);
      const Mask8 one_surface =
          (unlike == 0) & (cosine > kMinCosine) & (out * out <= kMostOutOfPlane * square);

      const Float8 length = sqrt8(square);
      const Float8 even = length * max8(field(most), splat8(of_[most][i]));
      const Float8 share = load8(kPlaces.near[j] + 8 * k) > 0 ? along.times(x, y, z, length) : even;
      const Float8 distance = max8(share * share, load8(kPlaces.far[j] + 8 * k));
      const Mask8 counts = one_surface & (distance < 1);
      store8(weights.at(j, k), counts ? 1 - distance : splat8(0));
      any |= counts;
    }
    weights.any[j] = any8(any);
  }
}

/// Neighbours count in pairs, each as much as the one opposite.
Rgb SharedGathers::mean(Rgb own, std::size_t i, const Weights& weights) const {
  Float8 r{}, g{}, b{}, total{};
  const std::size_t first = i - kReach * (stride_ + 1);
  for (int j = 0; j < kRows; ++j) {
    if (!weights.any[j] || !weights.any[kRows - 1 - j]) continue;
    for (int k = 0; k < kVectors; ++k) {
      const std::size_t at = first + static_cast<std::size_t>(j) * stride_ + 8u * unsigned(k);
      const Float8 weight = weights.paired(j, k);
      r += load8(&of_[red][at]) * weight;
      g += load8(&of_[green][at]) * weight;
      b += load8(&of_[blue][at]) * weight;
      total += weight;
    }
  }
  return (own + Rgb(sum8(r), sum8(g), sum8(b))) / (1 + sum8(total));
}

}  // namespace octolux
