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

TEST(BitmapTexture, GradientIsTheDifferenceQuotient) {
  const BitmapConfig config{.to_uv = translation(0.1, 0.2, 0) * rotation(0, 0, 1, 30)};
  Image image(5, 4);
  for (std::size_t i = 0; i < 20; ++i) image.pixels[i] = Rgb(static_cast<float>((i * 7) % 11));
  const auto texture = make_bitmap_texture(image, config);
  const Scalar height(*texture);
  const float e = 0x1p-12f;
  for (const Vec2 p : {Vec2{0.31f, 0.43f}, Vec2{0.87f, 0.12f}, Vec2{-0.42f, 1.33f}}) {
    const Vec2 g = height.gradient(p);
    // Values up to 10 rounded to 2^-24, and the mixed derivative of a cell, up to 10 * 5 * 4 e.
    const float tolerance = 10 * 0x1p-22f / e + 0.1f;
    EXPECT_NEAR(g.x, (height({p.x + e, p.y}) - height({p.x - e, p.y})) / (2 * e), tolerance);
    EXPECT_NEAR(g.y, (height({p.x, p.y + e}) - height({p.x, p.y - e})) / (2 * e), tolerance);
    EXPECT_GT(std::abs(g.x) + std::abs(g.y), 5 * tolerance);
  }
}

TEST(BitmapTexture, ZeroAndOneOutside) {
  const BitmapConfig config{
      .filter = TextureFilter::nearest, .wrap_u = TextureWrap::zero, .wrap_v = TextureWrap::one};
  EXPECT_EQ(at(config, 0.6f, 0.25f), (Rgb{2, 0, 0}));
  EXPECT_EQ(at(config, 1.2f, 0.25f), Rgb(0));
  EXPECT_EQ(at(config, -3.0f, 0.25f), Rgb(0));
  EXPECT_EQ(at(config, 0.6f, -0.1f), Rgb(1));
}

TEST(ScaleTexture, MultipliesAndTheClampedOneCuts) {
  const auto inner = make_bitmap_texture(ramp(), {});
  const auto scaled = make_scale_texture(*inner, {2, 0.5f, 1});
  EXPECT_EQ(scaled->eval({0.875f, 0.75f}), (Rgb{6, 0.5f, 0}));
  EXPECT_EQ(scaled->mean(), (Rgb{3, 0.25f, 0}));
  EXPECT_EQ(scaled->maximum(), 6);
  const auto cut = make_clamped_texture(*scaled);
  EXPECT_EQ(cut->eval({0.875f, 0.75f}), (Rgb{1, 0.5f, 0}));
  EXPECT_EQ(cut->maximum(), 1);
}

TEST(Checkerboard, ExchangesItsColoursWhereANumberIsWanted) {
  const auto texture = make_checkerboard_texture(Rgb(0.75f), Rgb(0.25f), Affine{});
  EXPECT_FLOAT_EQ(texture->eval({0.1f, 0.1f}).r, 0.75f);
  EXPECT_FLOAT_EQ(texture->number({0.1f, 0.1f}), 0.25f);
}

}  // namespace
}  // namespace octolux
