// The camera against Mitsuba's conventions, worked out by hand: the picture's left is camera +x.
#include "core/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace octolux {
namespace {

// Directions are sums of three products, divided by a length: a few units in the last place.
constexpr float kTolerance = 8 * 0x1p-24f;

void expect_near(Vec3 a, Vec3 b, float tolerance = kTolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

Affine matrix(std::array<double, 12> rows) {
  Affine a;
  for (int i = 0; i < 12; ++i) a.m[i / 4][i % 4] = rows[i];
  return a;
}

/// 4 x 2 pixels, 90 degrees wide: at z = 1 the film spans x +-1, y +-1/2; a pixel is 1/2 wide.
const FilmSize kFilm{4, 2, 0, 0, 4, 2};
CameraConfig right_angle() {
  CameraConfig config;
  config.fov_x_degrees = 90;
  return config;
}

TEST(Camera, RaysThroughPixelCentresAndCorners) {
  const Camera camera(right_angle(), kFilm);
  expect_near(camera.ray({2, 1}).direction, {0, 0, 1});
  expect_near(camera.ray({0, 0}).direction, normalize({1, 0.5f, 1}));
  expect_near(camera.ray({4, 2}).direction, normalize({-1, -0.5f, 1}));
  expect_near(camera.ray({0.5f, 0.5f}).direction, normalize({0.75f, 0.25f, 1}));
  expect_near(camera.ray({3.5f, 1.5f}).direction, normalize({-0.75f, -0.25f, 1}));
  EXPECT_EQ(camera.ray({1, 1}).origin, (Vec3{0, 0, 0}));
  EXPECT_EQ(camera.forward(), (Vec3{0, 0, 1}));
}

TEST(Camera, FieldOfViewIsTheAngleBetweenTheSides) {
  for (const float fov : {1.0f, 19.5f, 39.6f, 120.0f, 170.0f}) {
    CameraConfig config;
    config.fov_x_degrees = fov;
    const Camera camera(config, {640, 480, 0, 0, 640, 480});
    const float cosine = dot(camera.ray({0, 240}).direction, camera.ray({640, 240}).direction);
    const double radians = fov * std::acos(-1.0) / 180;
    EXPECT_NEAR(cosine, std::cos(radians), kTolerance) << fov;
  }
}

TEST(Camera, ClipPlanesAreAtConstantDepth) {
  CameraConfig config = right_angle();
  config.near_clip = 2;
  config.far_clip = 7;
  const Camera camera(config, kFilm);
  for (const Vec2 p : {Vec2{2, 1}, Vec2{0, 0}, Vec2{3.2f, 0.7f}}) {
    const Ray ray = camera.ray(p);
    EXPECT_NEAR(ray.direction.z * ray.t_min, 2, 2 * kTolerance);
    EXPECT_NEAR(ray.direction.z * ray.t_max, 7, 7 * kTolerance);
    EXPECT_NEAR(length(ray.direction), 1, kTolerance);
  }
}

TEST(Camera, CropShowsAPartOfTheSamePicture) {
  const FilmSize film{400, 300, 0, 0, 400, 300}, crop{400, 300, 120, 70, 50, 20};
  const Camera whole(right_angle(), film), part(right_angle(), crop);
  for (const Vec2 p : {Vec2{0, 0}, Vec2{50, 20}, Vec2{3.5f, 11.25f}}) {
    expect_near(part.ray(p).direction, whole.ray(p + Vec2{120, 70}).direction, 2 * kTolerance);
  }
}

TEST(Camera, PrincipalOffsetShiftsByFractionsOfTheWholeFilm) {
  // Mitsuba 3 adds offset * film size to the pixel.
  CameraConfig config = right_angle();
  config.principal_offset = {0.25f, -0.5f};
  const FilmSize film{400, 300, 0, 0, 400, 300}, crop{400, 300, 120, 70, 50, 20};
  const Camera plain(right_angle(), film);
  expect_near(Camera(config, film).ray({10, 200}).direction, plain.ray({110, 50}).direction,
              2 * kTolerance);
  expect_near(Camera(config, crop).ray({10, 20}).direction, plain.ray({230, -60}).direction,
              2 * kTolerance);
}

TEST(Camera, CornellBoxMatrixPutsWorldMinusXOnTheLeft) {
  // Eye at z = 6.8 looking to -z; the box's red wall is at x = -1 and must be on the left.
  CameraConfig config;
  config.to_world = matrix({-1, 0, 0, 0, 0, 1, 0, 1, 0, 0, -1, 6.8});
  config.fov_x_degrees = 19.5f;
  const Camera camera(config, {1024, 1024, 0, 0, 1024, 1024});
  EXPECT_EQ(camera.ray({512, 512}).origin, (Vec3{0, 1, 6.8f}));
  expect_near(camera.ray({512, 512}).direction, {0, 0, -1});
  const auto t = static_cast<float>(std::tan(19.5 / 360 * std::acos(-1.0)));
  expect_near(camera.ray({0, 512}).direction, normalize({-t, 0, -1}));
  expect_near(camera.ray({512, 0}).direction, normalize({0, t, -1}));
}

TEST(Camera, MirroredMatrixMirrorsThePicture) {
  CameraConfig mirrored = right_angle();
  mirrored.to_world = matrix({-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  const Camera plain(right_angle(), kFilm), camera(mirrored, kFilm);
  expect_near(camera.ray({0.5f, 0.5f}).direction, plain.ray({3.5f, 0.5f}).direction);
  EXPECT_EQ(camera.forward(), (Vec3{0, 0, 1}));
}

TEST(Camera, ScaleChangesDirectionsButNotClipDistances) {
  CameraConfig config = right_angle();
  config.to_world = matrix({2, 0, 0, 1, 0, 3, 0, 2, 0, 0, 4, 3});
  config.near_clip = 0.5f;
  config.far_clip = 10;
  const Camera camera(config, kFilm);
  const Ray ray = camera.ray({0, 0});
  EXPECT_EQ(ray.origin, (Vec3{1, 2, 3}));
  expect_near(ray.direction, normalize({2, 1.5f, 4}));
  expect_near(camera.forward(), {0, 0, 1});
  EXPECT_NEAR(ray.t_min * ray.direction.z, 0.5f, kTolerance);
  EXPECT_NEAR(ray.t_max * ray.direction.z, 10, 10 * kTolerance);
}

TEST(Camera, ShearedOrMirroredDepthIsAlwaysPositive) {
  CameraConfig config = right_angle();
  config.to_world = matrix({1, 0.3, 2, 0, 0, -1, 0.5, 0, 0.2, 0, 1, 0});
  const Camera camera(config, kFilm);
  EXPECT_NEAR(length(camera.forward()), 1, kTolerance);
  for (int i = 0; i < 9; ++i) {
    const Ray ray = camera.ray({2.0f * (i % 3), 1.0f * (i / 3)});
    EXPECT_GT(dot(ray.direction, camera.forward()), 0);
    EXPECT_LT(ray.t_min, ray.t_max);
  }
}

TEST(Camera, NeighbouringPixelsOfALargeFilmAreDistinct) {
  const Camera camera(CameraConfig{}, {8192, 8192, 8000, 8000, 100, 100});
  const Vec3 a = camera.ray({50, 50}).direction, b = camera.ray({51, 50}).direction;
  const double pixel = 2 * std::tan(39.6 / 360 * std::acos(-1.0)) / 8192;
  const Vec3 at = a * (1 / a.z) - b * (1 / b.z);  // one pixel on the plane z = 1
  EXPECT_NEAR(at.x / pixel, 1, 0.01);             // 4 roundings of 2^-24 against 9e-5
}

TEST(OrthographicCamera, RaysAreParallelAndSpanTheFilm) {
  CameraConfig config;
  config.projection = Projection::orthographic;
  config.near_clip = 1;
  config.to_world = matrix({2, 0, 0, 5, 0, 2, 0, 6, 0, 0, 1, 7});
  const Camera camera(config, kFilm);  // 4 x 2 pixels: x from +1 to -1, y from 1/2 to -1/2
  expect_near(camera.ray({0, 0}).origin, {5 + 2, 6 + 1, 7});
  expect_near(camera.ray({4, 2}).origin, {5 - 2, 6 - 1, 7});
  for (const Vec2 p : {Vec2{0, 0}, Vec2{1.5f, 0.5f}, Vec2{4, 2}}) {
    EXPECT_EQ(camera.ray(p).direction, (Vec3{0, 0, 1}));
    EXPECT_EQ(camera.ray(p).t_min, 1);
  }
}

TEST(ThinLensCamera, AllRaysOfAPixelMeetInFocus) {
  CameraConfig config = right_angle();
  config.aperture_radius = 0.25f;
  config.focus_distance = 3;
  const Camera lens(config, kFilm), pinhole(right_angle(), kFilm);
  ASSERT_TRUE(lens.has_lens() && !pinhole.has_lens());
  const Vec2 p{0.5f, 1.7f};
  const Ray sharp = pinhole.ray(p);
  const Vec3 focus = sharp.direction * (3 / sharp.direction.z);
  float widest = 0;
  for (const Vec2 u : {Vec2{0, 0}, Vec2{0.99f, 0.5f}, Vec2{0.3f, 0.8f}, Vec2{0.5f, 0.5f}}) {
    const Ray ray = lens.ray(p, u);
    widest = std::max(widest, length(ray.origin));
    EXPECT_EQ(ray.origin.z, 0);
    const Vec3 there = ray.origin + ray.direction * ((3 - ray.origin.z) / ray.direction.z);
    expect_near(there, focus, 16 * kTolerance);
  }
  EXPECT_GT(widest, 0.2f);
  EXPECT_LE(widest, 0.25f + kTolerance);
}

}  // namespace
}  // namespace octolux
