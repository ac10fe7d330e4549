// sky.h: interpolation of Hosek & Wilkie's coefficients (quintic Bezier over the sun's elevation,
// linear over turbidity and albedo), and transmission of sunlight through the air.
#include "core/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "core/sky_tables.h"
#include "core/spectrum.h"

namespace octolux {
namespace {

using std::numbers::pi;

double to_radians(double degrees) { return degrees * pi / 180; }

/// Value `offset` of `stride` parameters in a table of [albedo][turbidity][elevation][parameter].
double interpolate(std::span<const double> table, int stride, int offset, double turbidity,
                   double albedo, double elevation) {
  const double t = std::cbrt(elevation / (pi / 2)), s = 1 - t;
  const double bernstein[6] = {s * s * s * s * s,      5 * s * s * s * s * t,
                               10 * s * s * s * t * t, 10 * s * s * t * t * t,
                               5 * s * t * t * t * t,  t * t * t * t * t};
  const int low = std::clamp(static_cast<int>(turbidity), 1, 9);
  const double high_share = turbidity - low;
  double sum = 0;
  for (int a = 0; a < 2; ++a) {
    for (int high = 0; high < 2; ++high) {
      const double weight =
          (a == 0 ? 1 - albedo : albedo) * (high == 0 ? 1 - high_share : high_share);
      const int row = (a * 10 + low - 1 + high) * 6;
      for (int k = 0; k < 6; ++k) {
        sum += weight * bernstein[k] * table[static_cast<std::size_t>((row + k) * stride + offset)];
      }
    }
  }
  return sum;
}

/// Wavelengths [nm] and absorption coefficients [cm^-1] of Preetham's table 2: ozone, mixed gases,
/// water vapour; and the sun's radiance above the air [W m^-2 sr^-1 nm^-1].
constexpr SpectrumSample kOzone[] = {
    {300, 10.0}, {305, 4.8},  {310, 2.7},  {315, 1.35}, {320, .8},   {325, .380}, {330, .160},
    {335, .075}, {340, .04},  {345, .019}, {350, .007}, {355, .0},   {445, .003}, {450, .003},
    {455, .004}, {460, .006}, {465, .008}, {470, .009}, {475, .012}, {480, .014}, {485, .017},
    {490, .021}, {495, .025}, {500, .03},  {505, .035}, {510, .04},  {515, .045}, {520, .048},
    {525, .057}, {530, .063}, {535, .07},  {540, .075}, {545, .08},  {550, .085}, {555, .095},
    {560, .103}, {565, .110}, {570, .12},  {575, .122}, {580, .12},  {585, .118}, {590, .115},
    {595, .12},  {600, .125}, {605, .130}, {610, .12},  {620, .105}, {630, .09},  {640, .079},
    {650, .067}, {660, .057}, {670, .048}, {680, .036}, {690, .028}, {700, .023}, {710, .018},
    {720, .014}, {730, .011}, {740, .010}, {750, .009}, {760, .007}, {770, .004}, {780, .0},
    {790, .0}};
constexpr SpectrumSample kGases[] = {{759, 0}, {760, 3.0}, {770, .210}, {771, 0}};
constexpr SpectrumSample kVapour[] = {
    {689, 0},    {690, .016},   {700, .024},   {710, .0125}, {720, 1},     {730, .87}, {740, .061},
    {750, .001}, {760, .00001}, {770, .00001}, {780, .0006}, {790, .0175}, {800, .036}};
constexpr SpectrumSample kSun[] = {
    {380, 16559.0}, {390, 16233.7}, {400, 21127.5}, {410, 25888.2}, {420, 25829.1}, {430, 24232.3},
    {440, 26760.5}, {450, 29658.3}, {460, 30545.4}, {470, 30057.5}, {480, 30663.7}, {490, 28830.4},
    {500, 28712.1}, {510, 27825.0}, {520, 27100.6}, {530, 27233.6}, {540, 26361.3}, {550, 25503.8},
    {560, 25060.2}, {570, 25311.6}, {580, 25355.9}, {590, 25134.2}, {600, 24631.5}, {610, 24173.2},
    {620, 23685.3}, {630, 23212.1}, {640, 22827.7}, {650, 22339.8}, {660, 21970.2}, {670, 21526.7},
    {680, 21097.9}, {690, 20728.3}, {700, 20240.4}, {710, 19870.8}, {720, 19427.2}, {730, 19072.4},
    {740, 18628.9}, {750, 18259.2}};

/// Share of light of `nm` that comes through the air; `mass` is the length of the way in units of
/// the shortest (Kasten).
double air_transmittance(double nm, double mass, double turbidity) {
  const double um = nm / 1000;
  const double beta = 0.04608365822050 * turbidity - 0.04586025928522;
  constexpr double ozone_cm = 0.35, water_cm = 2;
  const double gases = interpolate_spectrum(kGases, nm) * mass;
  const double vapour = interpolate_spectrum(kVapour, nm) * water_cm * mass;
  return std::exp(-mass * 0.008735 * std::pow(um, -4.08)  // molecules
                  - mass * beta * std::pow(um, -1.3)      // dust
                  - mass * interpolate_spectrum(kOzone, nm) * ozone_cm -
                  1.41 * gases / std::pow(1 + 118.93 * gases, 0.45) -
                  0.2385 * vapour / std::pow(1 + 20.07 * vapour, 0.45));
}

/// Days since noon of 1 January 2000, universal time.
double days_since_2000(const SunTime& t, double universal_hours) {
  const int a = (t.month - 14) / 12;  // integer divisions throughout (Fliegel & van Flandern)
  const int day = (1461 * (t.year + 4800 + a)) / 4 + (367 * (t.month - 2 - 12 * a)) / 12 -
                  (3 * ((t.year + 4900 + a) / 100)) / 4 + t.day - 32075;
  return day - 0.5 + universal_hours / 24 - 2451545.0;
}

}  // namespace

Vec3 to_vector(SkyDirection d) {
  const double s = std::sin(d.zenith);
  return {static_cast<float>(std::sin(d.azimuth) * s), static_cast<float>(std::cos(d.zenith)),
          static_cast<float>(-std::cos(d.azimuth) * s)};
}

SkyDirection to_sky_direction(Vec3 w) {
  const double azimuth = std::atan2(double{w.x}, -double{w.z});
  return {std::atan2(std::hypot(w.x, w.z), double{w.y}), azimuth < 0 ? azimuth + 2 * pi : azimuth};
}

SkyDirection sun_position(const SunTime& time) {
  const double hours = time.hour - time.timezone + (time.minute + time.second / 60) / 60;
  const double days = days_since_2000(time, hours);
  const double omega = 2.1429 - 0.0010394594 * days;
  const double longitude = 4.8950630 + 0.017202791698 * days;
  const double anomaly = 6.2400600 + 0.0172019699 * days;
  const double ecliptic = longitude + 0.03341607 * std::sin(anomaly) +
                          0.00034894 * std::sin(2 * anomaly) - 0.0001134 -
                          0.0000203 * std::sin(omega);
  const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * std::cos(omega);
  const double ascension = std::atan2(std::cos(obliquity) * std::sin(ecliptic), std::cos(ecliptic));
  const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic));

  const double sidereal_hours = 6.6974243242 + 0.0657098283 * days + hours;
  const double hour_angle = to_radians(sidereal_hours * 15 + time.longitude) - ascension;
  const double latitude = to_radians(time.latitude);
  const double zenith =
      std::acos(std::cos(latitude) * std::cos(hour_angle) * std::cos(declination) +
                std::sin(declination) * std::sin(latitude));
  const double azimuth =
      std::atan2(-std::sin(hour_angle), std::tan(declination) * std::cos(latitude) -
                                            std::sin(latitude) * std::cos(hour_angle));
  constexpr double parallax = 6371.01 / 149597890;  // the earth's radius over the sun's distance
  return {zenith + parallax * std::sin(zenith), azimuth < 0 ? azimuth + 2 * pi : azimuth};
}

Rgb sun_radiance(double zenith, double turbidity) {
  const double mass = 1 / (std::cos(zenith) + 0.15 * std::pow(93.885 - zenith * 180 / pi, -1.253));
  std::vector<SpectrumSample> samples;
  for (int nm = 350; nm <= 800; nm += 5) {
    const double value = interpolate_spectrum(kSun, nm) * air_transmittance(nm, mass, turbidity);
    samples.push_back({static_cast<double>(nm), value});
  }
  const Rgb c = spectrum_to_rgb(samples, SpectrumKind::emissive);
  return {std::max(c.r, 0.0f), std::max(c.g, 0.0f), std::max(c.b, 0.0f)};
}

SkyModel::SkyModel(double turbidity, Rgb albedo, SkyDirection sun) : sun_(sun) {
  const std::span<const double> shapes[] = {sky::kX, sky::kY, sky::kZ};
  const std::span<const double> radiances[] = {sky::kXRadiance, sky::kYRadiance, sky::kZRadiance};
  const double elevation = std::max(0.0, pi / 2 - sun.zenith);
  const double ground = std::clamp(luminance(albedo), 0.0f, 1.0f);
  for (std::size_t c = 0; c < 3; ++c) {
    for (int i = 0; i < 9; ++i) {
      channels_[c].shape[static_cast<std::size_t>(i)] =
          interpolate(shapes[c], 9, i, turbidity, ground, elevation);
    }
    channels_[c].mean_radiance = interpolate(radiances[c], 1, 0, turbidity, ground, elevation);
  }
}

double SkyModel::luminance_like(const Channel& c, double cos_zenith, double gamma) {
  const auto& [a, b, c0, d, e, f, g, h, i] = c.shape;
  const double cos_gamma = std::cos(gamma);
  const double mie = (1 + cos_gamma * cos_gamma) / std::pow(1 + i * i - 2 * i * cos_gamma, 1.5);
  return (1 + a * std::exp(b / (cos_zenith + 0.01))) *
         (c0 + d * std::exp(e * gamma) + f * cos_gamma * cos_gamma + g * mie +
          h * std::sqrt(cos_zenith)) *
         c.mean_radiance;
}

Rgb SkyModel::radiance(SkyDirection d) const {
  const double cos_zenith = std::cos(d.zenith);
  if (!(cos_zenith > 0)) return Rgb(0);
  const double cos_gamma =
      cos_zenith * std::cos(sun_.zenith) +
      std::sin(d.zenith) * std::sin(sun_.zenith) * std::cos(d.azimuth - sun_.azimuth);
  const double gamma = std::acos(std::clamp(cos_gamma, -1.0, 1.0));
  double xyz[3];
  for (std::size_t c = 0; c < 3; ++c) xyz[c] = luminance_like(channels_[c], cos_zenith, gamma);
  // The tables are integrals over the observer's curves; their sum over 1 nm steps makes them
  // means.
  constexpr double observer = 106.856980;
  const Rgb rgb = xyz_to_rec709(xyz[0] / observer, xyz[1] / observer, xyz[2] / observer);
  return {std::max(rgb.r, 0.0f), std::max(rgb.g, 0.0f), std::max(rgb.b, 0.0f)};
}

}  // namespace octolux
