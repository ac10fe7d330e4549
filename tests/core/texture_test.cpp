// Textures looked up where the result is known by construction.
#include "core/texture.h"

#include <gtest/gtest.h>

#include <utility>

namespace octolux {
namespace {

/// 4 x 2 texels, all different: red = column, green = row.
Image ramp() {
  Image image(4, 2);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) image.at(x, y) = {static_cast<float>(x), static_cast<float>(y), 0};
  }
  return image;
}

Rgb at(const BitmapConfig& config, float u, float v) {
  return make_bitmap_texture(ramp(), config)->eval({u, v});
}

TEST(BitmapTexture, TexelCentresAreExactAndTheTopRowIsFirst) {
  const BitmapConfig config;
  EXPECT_EQ(at(config, 0.125f, 0.25f), (Rgb{0, 0, 0}));
  EXPECT_EQ(at(config, 0.625f, 0.25f), (Rgb{2, 0, 0}));
  EXPECT_EQ(at(config, 0.875f, 0.75f), (Rgb{3, 1, 0}));
}

TEST(BitmapTexture, InterpolatesHalfWay) { EXPECT_EQ(at({}, 0.25f, 0.5f), (Rgb{0.5f, 0.5f, 0})); }

TEST(BitmapTexture, NearestTakesTheTexelThatHoldsThePoint) {
  const BitmapConfig config{.filter = TextureFilter::nearest};
  EXPECT_EQ(at(config, 0.24f, 0.49f), (Rgb{0, 0, 0}));
  EXPECT_EQ(at(config, 0.26f, 0.51f), (Rgb{1, 1, 0}));
  EXPECT_EQ(at(config, 1, 1), (Rgb{0, 0, 0}));  // wraps round
}

TEST(BitmapTexture, WrapsOutsideTheUnitSquare) {
  const auto nearest = [](TextureWrap wrap, float u) {
    return at({.filter = TextureFilter::nearest, .wrap_u = wrap, .wrap_v = wrap}, u, 0.25f).r;
  };
  EXPECT_EQ(nearest(TextureWrap::repeat, 1.125f), 0);
  EXPECT_EQ(nearest(TextureWrap::repeat, -0.125f), 3);
  EXPECT_EQ(nearest(TextureWrap::mirror, 1.125f), 3);
  EXPECT_EQ(nearest(TextureWrap::mirror, -0.125f), 0);
  EXPECT_EQ(nearest(TextureWrap::mirror, 2.375f), 1);
  EXPECT_EQ(nearest(TextureWrap::clamp, 7.3f), 3);
  EXPECT_EQ(nearest(TextureWrap::clamp, -7.3f), 0);
  EXPECT_EQ(nearest(TextureWrap::repeat, 1e30f), 0);  // far out, but never out of bounds
}

TEST(BitmapTexture, InterpolatesAcrossTheSeam) {
  const auto seam = [](TextureWrap wrap) {
    return at({.wrap_u = wrap, .wrap_v = wrap}, 0, 0.25f).r;
  };
  EXPECT_EQ(seam(TextureWrap::repeat), 1.5f);  // between columns 3 and 0
  EXPECT_EQ(seam(TextureWrap::mirror), 0);
  EXPECT_EQ(seam(TextureWrap::clamp), 0);
}

TEST(BitmapTexture, AppliesItsTransform) {
  const BitmapConfig config{.to_uv = translation(0.5, 0, 0) * scaling(0.5, 1, 1),
                            .filter = TextureFilter::nearest};
  EXPECT_EQ(at(config, 0.1f, 0.25f).r, 2);  // u = 0.55
}

TEST(BitmapTexture, MeanIsThatOfTheTexels) {
  EXPECT_EQ(make_bitmap_texture(ramp(), {})->mean(), (Rgb{1.5f, 0.5f, 0}));
}

TEST(Checkerboard, AlternatesByHalves) {
  const Rgb a(1), b(0.25f);
  const auto texture = make_checkerboard_texture(a, b, scaling(2, 1, 1));
  EXPECT_EQ(texture->eval({0.1f, 0.1f}), a);
  EXPECT_EQ(texture->eval({0.3f, 0.1f}), b);  // u = 0.6
  EXPECT_EQ(texture->eval({0.3f, 0.7f}), a);
  EXPECT_EQ(texture->eval({0.6f, 0.1f}), a);   // u = 1.2
  EXPECT_EQ(texture->eval({-0.1f, 0.1f}), b);  // u = -0.2, the upper half of a period
  EXPECT_EQ(texture->mean(), Rgb(0.625f));
}

}  // namespace
}  // namespace octolux
