// Daylight: where the sun stands, how bright it is, and the radiance of a clear sky. The models are
// those of Mitsuba 0.6, in its units: radiance per nanometre, W m^-2 sr^-1 nm^-1, as linear
// Rec.709.
//
//   sky  Hosek & Wilkie, "An Analytic Model for Full Spectral Sky-Dome Radiance", SIGGRAPH 2012
//        (their XYZ version), clear skies of turbidity 1 to 10, the sun above the horizon
//   sun  Preetham, Shirley & Smits, "A Practical Analytic Model for Daylight", SIGGRAPH 1999, A.1
//   its place  Blanco-Muriel et al., "Computing the Solar Vector", Solar Energy 70(5), 2001
//
// Local axes: +y is up; the azimuth runs from -z over +x. Pure functions.
#pragma once

#include <array>

#include "core/rgb.h"
#include "core/vec.h"

namespace octolux {

/// A direction of the sky.
struct SkyDirection {
  double zenith = 0;   // angle from +y [rad]
  double azimuth = 0;  // from -z over +x [rad]
};
Vec3 to_vector(SkyDirection d);
/// `w` unit.
SkyDirection to_sky_direction(Vec3 w);

struct SunTime {
  int year = 2010, month = 7, day = 10;
  double hour = 15, minute = 0, second = 0;                       // local time
  double latitude = 35.6894, longitude = 139.6917, timezone = 9;  // [degrees], [hours]; Tokyo
};
/// Azimuth here is from north (-z) over east (+x).
SkyDirection sun_position(const SunTime& time);

/// Radiance of the sun's disc after its way through the air; zenith below pi / 2.
Rgb sun_radiance(double zenith, double turbidity);
/// Half the angle under which the sun is seen [rad].
inline constexpr double kSunAngularRadius = 0.5358 / 2 * 3.14159265358979323846 / 180;

class SkyModel {
 public:
  /// turbidity in [1, 10]; albedo of the ground in [0, 1]; sun.zenith at most pi / 2.
  SkyModel(double turbidity, Rgb albedo, SkyDirection sun);

  /// Not below 0; black under the horizon.
  Rgb radiance(SkyDirection d) const;

 private:
  struct Channel {
    std::array<double, 9> shape;  // the parameters A to I of the paper's equation 8
    double mean_radiance;
  };
  static double luminance_like(const Channel& c, double cos_zenith, double gamma);

  SkyDirection sun_;
  std::array<Channel, 3> channels_;  // X, Y, Z
};

}  // namespace octolux
