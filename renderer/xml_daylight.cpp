// xml_daylight.h: parameters and defaults of Mitsuba 0.6. As there, sky and sun are drawn into one
// environment map of `resolution` columns, the sun as many small shares of its power, so that no
// resolution loses any of it; with a `sun_radius_scale` of 0 it is a directional light instead.
#include "renderer/xml_daylight.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "core/frame.h"
#include "core/light.h"
#include "core/sampling.h"
#include "core/sky.h"
#include "renderer/xml_objects.h"

namespace octolux {
namespace {

using std::numbers::pi;

struct Daylight {
  Affine to_world;
  SkyDirection sun;
  double turbidity = 3;
  double stretch = 1;  // of zenith angles, 1 to 2
  int resolution = 512;
};

double read_in_range(Properties& p, const std::string& name, double fallback, double low,
                     double high) {
  const double value = p.number(name).value_or(static_cast<float>(fallback));
  if (value >= low && value <= high) return value;
  p.fail(name, "'" + name + "' must lie between " + std::to_string(static_cast<int>(low)) +
                   " and " + std::to_string(static_cast<int>(high)));
}

SunTime read_time(Properties& p) {
  SunTime t;
  t.year = p.integer("year").value_or(t.year);
  t.month = p.integer("month").value_or(t.month);
  t.day = p.integer("day").value_or(t.day);
  const std::pair<const char*, double*> numbers[] = {
      {"hour", &t.hour},         {"minute", &t.minute},       {"second", &t.second},
      {"latitude", &t.latitude}, {"longitude", &t.longitude}, {"timezone", &t.timezone}};
  for (const auto& [name, value] : numbers) {
    if (const std::optional<float> given = p.number(name)) *value = static_cast<double>(*given);
  }
  return t;
}

SkyDirection read_sun(Properties& p, const Affine& to_world) {
  const std::optional<Vec3> direction = p.point("sun_direction");
  const SunTime time = read_time(p);
  if (!direction) return sun_position(time);
  for (const char* name : {"latitude", "longitude", "timezone", "day", "hour"}) {
    if (p.find(name)) p.fail(name, std::string("give either 'sun_direction' or '") + name + "'");
  }
  const Vec3 local = to_world.inverse()->vector(*direction);
  if (!(length(local) > 0)) p.fail("sun_direction", "'sun_direction' must not be zero");
  return to_sky_direction(normalize(local));
}

Daylight read_daylight(Properties& p) {
  Daylight d;
  d.to_world = p.transform("to_world");
  d.turbidity = read_in_range(p, "turbidity", 3, 1, 10);
  d.stretch = read_in_range(p, "stretch", 1, 1, 2);
  d.resolution = p.integer("resolution").value_or(512);
  if (d.resolution < 4 || d.resolution > 16384) {
    p.fail("resolution", "'resolution' must lie between 4 and 16384");
  }
  d.sun = read_sun(p, d.to_world);
  if (!(d.sun.zenith <= pi / 2)) {
    fail(p.node().where, "the sun of emitter '" + p.type() + "' is below the horizon");
  }
  return d;
}

Image empty_map(const Daylight& d) { return {d.resolution, d.resolution / 2 + 1}; }

/// Zenith angle of a row of the map.
double zenith_of(const Image& map, int row) { return pi * row / (map.height - 1); }

void draw_sky(Image& map, const Daylight& d, Properties& p, float scale) {
  const Rgb albedo = p.color("albedo", ColorRole::reflectance).value_or(Rgb(0.2f));
  if (max_component(albedo) > 1) p.fail("albedo", "'albedo' must lie between 0 and 1");
  const bool extend = p.boolean("extend").value_or(false);
  const SkyModel model(d.turbidity, albedo, d.sun);
  for (int y = 0; y < map.height; ++y) {
    const double zenith = zenith_of(map, y);
    double share = 1, seen = zenith / d.stretch;
    if (extend) {  // the horizon's colour further down, fading towards the nadir
      const double t = std::clamp(2 - 2 * zenith / pi, 0.0, 1.0);
      share = t * t * (3 - 2 * t);
      seen = std::min(seen, pi / 2 - 1e-4);
    }
    for (int x = 0; x < map.width; ++x) {
      const double azimuth = 2 * pi * (x + 0.5) / map.width;
      map.at(x, y) += model.radiance({seen, azimuth}) * static_cast<float>(share) * scale;
    }
  }
}

/// Adds a sun of `irradiance`, spread evenly over a disc of angular radius `radius`.
void draw_sun(Image& map, SkyDirection sun, Rgb irradiance, double radius) {
  const double versine = 1 - std::cos(radius);
  const double covered = 0.5 * versine * map.width * map.height;
  const auto shares = static_cast<std::uint32_t>(std::clamp(covered * 1000, 100.0, 1e6));
  const Frame frame = Frame::from_normal(to_vector(sun));
  for (std::uint32_t i = 0; i < shares; ++i) {
    const Vec2 u = shifted_hammersley(i, shares, {0.5f / static_cast<float>(shares), 0});
    const double z = 1 - static_cast<double>(u.x) * versine, r = std::sqrt(1 - z * z);
    const double phi = 2 * pi * static_cast<double>(u.y);
    const Vec3 local{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                     static_cast<float>(z)};
    const SkyDirection d = to_sky_direction(normalize(frame.to_world(local)));
    const int x = std::min(map.width - 1, static_cast<int>(d.azimuth / (2 * pi) * map.width));
    const int y = static_cast<int>(std::lround(d.zenith / pi * (map.height - 1)));
    const double texel = 2 * pi / map.width * pi / (map.height - 1) *  // [sr]
                         std::max(1e-3, std::sin(zenith_of(map, y)));
    map.at(x, y) += irradiance * static_cast<float>(1 / (texel * shares));
  }
}

void add_daylight(Properties& p, SceneBuilder& b, bool with_sky, bool with_sun) {
  const Daylight d = read_daylight(p);
  const float scale = p.number("scale").value_or(1);
  Image map = empty_map(d);
  if (with_sky) {
    draw_sky(map, d, p, with_sun ? p.number("sky_scale").value_or(scale) : scale);
  }
  if (with_sun) {
    const float sun_scale = with_sky ? p.number("sun_scale").value_or(scale) : scale;
    const double radius_scale = read_in_range(p, "sun_radius_scale", 1, 0, 100);
    const double solid_angle = 2 * pi * (1 - std::cos(kSunAngularRadius));
    const Rgb irradiance =
        sun_radiance(d.sun.zenith, d.turbidity) * (sun_scale * static_cast<float>(solid_angle));
    const SkyDirection place{d.sun.zenith * d.stretch, d.sun.azimuth};
    if (radius_scale > 0) {
      draw_sun(map, place, irradiance, kSunAngularRadius * radius_scale);
    } else {
      const Vec3 direction = normalize(d.to_world.vector(-to_vector(place)));
      b.scene().lights.push_back(make_directional_light(direction, irradiance));
    }
    if (!with_sky && radius_scale == 0) return;
  }
  set_environment(std::move(map), d.to_world, 1, p, b);
}

}  // namespace

void add_sun(Properties& p, SceneBuilder& b) { add_daylight(p, b, false, true); }
void add_sky(Properties& p, SceneBuilder& b) { add_daylight(p, b, true, false); }
void add_sun_and_sky(Properties& p, SceneBuilder& b) { add_daylight(p, b, true, true); }

}  // namespace octolux
