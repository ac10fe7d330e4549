// Sums over passes, and the pictures made from them.
#include "renderer/film.h"

#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/check.h"
#include "core/parallel.h"

namespace octolux {

Film::Film(int width, int height)
    : width_(width), height_(height), pixels_(static_cast<std::size_t>(width) * height) {}

void Film::add(const PassImage& pass) {
  OCTOLUX_CHECK(pass.size() == pixels_.size());
  ++passes_;
  constexpr std::int64_t kPixels = 4096;  // worth a thread
  parallel_for_chunks(static_cast<std::int64_t>(pixels_.size()), kPixels,
                      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
                        for (auto i = static_cast<std::size_t>(begin); i < std::size_t(end); ++i) {
                          pixels_[i].add(pass[i]);
                        }
                      });
}

void Film::Pixel::add(const EyeSample& sample) {
  direct += sample.direct;
  caustic += sample.caustic;
  indirect += sample.indirect;
  albedo += sample.albedo;
  normal += sample.normal;
  depth += sample.depth;
  const Rgb radiance = sample.radiance();
  for (int c = 0; c < 3; ++c) {
    sum[c] += radiance[c];
    square[c] += static_cast<double>(radiance[c]) * radiance[c];
  }
  const double y = luminance(radiance);
  luminance_square += y * y;
}

void Film::note_non_finite(std::int64_t count, std::size_t pixel) {
  if (count > 0 && non_finite_ == 0) {
    const auto index = static_cast<int>(pixel);
    first_non_finite_ = {index % width_, index / width_, passes_};
  }
  non_finite_ += count;
}

Image Film::radiance() const {
  Image image(width_, height_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const double* sum = pixels_[i].sum;
    image.pixels[i] =
        Rgb(static_cast<float>(sum[0] / passes_), static_cast<float>(sum[1] / passes_),
            static_cast<float>(sum[2] / passes_));
  }
  return image;
}

Image Film::mean_of(Rgb Pixel::*field) const {
  Image image(width_, height_);
  const float scale = 1.0f / static_cast<float>(passes_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) image.pixels[i] = pixels_[i].*field * scale;
  return image;
}

namespace {

/// Variance of the mean of `n` values from their sum and sum of squares.
double variance_of_mean(double sum, double square, int n) {
  if (n < 2) return 0;
  const double mean = sum / n;
  return std::max(0.0, square / n - mean * mean) / (n - 1);
}

}  // namespace

Image Film::variance() const {
  Image image(width_, height_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    float v[3];
    for (int c = 0; c < 3; ++c) {
      v[c] = static_cast<float>(variance_of_mean(pixels_[i].sum[c], pixels_[i].square[c], passes_));
    }
    image.pixels[i] = Rgb(v[0], v[1], v[2]);
  }
  return image;
}

Image Film::normal() const {
  Image image(width_, height_);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const float size = length(pixels_[i].normal);
    const Vec3 n = size > 0 ? pixels_[i].normal / size : Vec3{};
    image.pixels[i] = Rgb(n.x, n.y, n.z);
  }
  return image;
}

std::vector<float> Film::depth() const {
  std::vector<float> depth(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    depth[i] = pixels_[i].depth / static_cast<float>(passes_);
  }
  return depth;
}

double Film::relative_error() const {
  const auto y_sum = [](const Pixel& p) {
    return 0.2126 * p.sum[0] + 0.7152 * p.sum[1] + 0.0722 * p.sum[2];
  };
  double total = 0;
  for (const Pixel& pixel : pixels_) total += y_sum(pixel);
  const double floor = 0.01 * total / (static_cast<double>(pixels_.size()) * passes_);
  if (passes_ < 2 || !(floor > 0)) return passes_ < 2 ? 1 : 0;
  double error = 0;
  for (const Pixel& pixel : pixels_) {
    const double sum = y_sum(pixel);
    const double deviation = std::sqrt(variance_of_mean(sum, pixel.luminance_square, passes_));
    // Filters with negative lobes make pixels below 0.
    error += deviation / (std::max(0.0, sum / passes_) + floor);
  }
  return error / static_cast<double>(pixels_.size());
}

/// What stands before the pixels in a film's bytes.
struct Film::Tally {
  std::int64_t passes = 0, non_finite = 0;
  Place first_non_finite;
  std::int32_t unused = 0;  // instead of padding: equal films have equal bytes
};

std::string Film::to_bytes() const {
  static_assert(std::is_trivially_copyable_v<Pixel> && std::is_trivially_copyable_v<Tally>);
  static_assert(sizeof(Tally) == 2 * sizeof(std::int64_t) + sizeof(Place) + sizeof(std::int32_t));
  const Tally tally{passes_, non_finite_, first_non_finite_};
  std::string bytes(sizeof tally + pixels_.size() * sizeof(Pixel), '\0');
  std::memcpy(bytes.data(), &tally, sizeof tally);
  std::memcpy(bytes.data() + sizeof tally, pixels_.data(), bytes.size() - sizeof tally);
  return bytes;
}

bool Film::from_bytes(std::string_view bytes) {
  Tally tally;
  if (bytes.size() != sizeof tally + pixels_.size() * sizeof(Pixel)) return false;
  std::memcpy(&tally, bytes.data(), sizeof tally);
  std::memcpy(pixels_.data(), bytes.data() + sizeof tally, bytes.size() - sizeof tally);
  passes_ = static_cast<int>(tally.passes);
  non_finite_ = tally.non_finite;
  first_non_finite_ = tally.first_non_finite;
  return true;
}

}  // namespace octolux
