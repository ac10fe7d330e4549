// <sensor>, its <film> and <rfilter>. Fields of view as in Mitsuba's `perspective`: fov is the
// angle along fov_axis of the whole film (not of the crop window); a focal length is that of a
// 36 x 24 mm picture and gives the angle of its diagonal.
#include <cmath>
#include <numbers>

#include "renderer/xml_objects.h"

namespace octolux {
namespace {

// ---- reconstruction filter

Filter box(Properties& p) {
  return {.kind = Filter::Kind::box, .radius = p.positive("radius", 0.5f)};
}

Filter tent(Properties& p) {
  return {.kind = Filter::Kind::tent, .radius = p.positive("radius", 1)};
}

Filter gaussian(Properties& p) {
  const float stddev = p.positive("stddev", 0.5f);
  return {.kind = Filter::Kind::gaussian, .radius = 4 * stddev, .stddev = stddev};
}

Filter mitchell(Properties& p) {
  constexpr float kRecommended = 1.0f / 3;
  return {.kind = Filter::Kind::mitchell,
          .radius = 2,
          .b = p.number("b").value_or(kRecommended),
          .c = p.number("c").value_or(kRecommended)};
}

Filter catmull_rom(Properties&) {
  return {.kind = Filter::Kind::mitchell, .radius = 2, .b = 0, .c = 0.5f};
}

Filter lanczos(Properties& p) {
  constexpr int kMostLobes = 16;
  const int lobes = p.integer("lobes").value_or(3);
  if (lobes < 1 || lobes > kMostLobes) p.fail("lobes", "'lobes' must lie between 1 and 16");
  return {.kind = Filter::Kind::lanczos, .radius = static_cast<float>(lobes)};
}

constexpr Plugin<Filter (*)(Properties&)> kFilters[] = {
    {"box", box},           {"tent", tent},       {"gaussian", gaussian},
    {"mitchell", mitchell}, {"lanczos", lanczos}, {"catmullrom", catmull_rom},
};

// ---- film

int read_size(Properties& p, const std::string& name, int fallback) {
  const int size = p.integer(name).value_or(fallback);
  if (size < 1) p.fail(name, "'" + name + "' must be at least 1");
  return size;
}

FilmSize read_film_size(Properties& p) {
  FilmSize film;
  film.width = read_size(p, "width", film.width);
  film.height = read_size(p, "height", film.height);
  film.crop_x = p.integer("crop_offset_x").value_or(0);
  film.crop_y = p.integer("crop_offset_y").value_or(0);
  if (film.crop_x < 0 || film.crop_x >= film.width) {
    p.fail("crop_offset_x", "'crop_offset_x' lies outside the film");
  }
  if (film.crop_y < 0 || film.crop_y >= film.height) {
    p.fail("crop_offset_y", "'crop_offset_y' lies outside the film");
  }
  const int width = film.width - film.crop_x, height = film.height - film.crop_y;
  film.crop_width = read_size(p, "crop_width", width);
  film.crop_height = read_size(p, "crop_height", height);
  if (film.crop_width > width) p.fail("crop_width", "the crop window is wider than the film");
  if (film.crop_height > height) p.fail("crop_height", "the crop window is higher than the film");
  constexpr long long kMostPixels = 1LL << 28;
  if (1LL * film.crop_width * film.crop_height > kMostPixels) {
    p.fail("width", "the film has more than 2^28 pixels");
  }
  return film;
}

void film(Properties& p, SceneBuilder& b) {
  p.ignore({"filename", "file_format", "pixel_format", "component_format", "banner", "attach_log",
            "high_quality_edges", "sample_border", "compensate", "label", "gamma", "exposure",
            "tonemap_method", "key", "burn"});
  b.scene().film = read_film_size(p);
  const std::vector<const XmlNode*> filters = p.objects("rfilter");
  if (filters.size() > 1) fail(p.node().where, "a film takes only one rfilter");
  for (const XmlNode* object : filters) {
    Properties properties(*object);
    b.scene().filter = find_plugin(kFilters, properties)(properties);
    properties.finish();
  }
}

constexpr Plugin<void (*)(Properties&, SceneBuilder&)> kFilms[] = {
    {"hdrfilm", film},
    {"ldrfilm", film},
    {"tiledhdrfilm", film},
};

void read_film(Properties& sensor, SceneBuilder& b) {
  const std::vector<const XmlNode*> films = sensor.objects("film");
  if (films.size() > 1) fail(sensor.node().where, "a sensor takes only one film");
  for (const XmlNode* object : films) {
    Properties properties(*object);
    find_plugin(kFilms, properties)(properties, b);
    b.finish(properties);
  }
}

// ---- perspective camera

constexpr double kDegrees = 180 / std::numbers::pi;

/// Twice the tangent of half the angle: the extent of the picture at distance 1.
double extent_of(double degrees) { return 2 * std::tan(degrees / kDegrees / 2); }

/// Extent of the whole film along x at distance 1, from its extent along `axis`.
double extent_x(double extent, const std::string& axis, double aspect) {
  const bool wide = aspect > 1;
  if (axis == "y" || (axis == "smaller" && wide) || (axis == "larger" && !wide)) {
    return extent * aspect;
  }
  if (axis == "diagonal") return extent / std::sqrt(1 + 1 / (aspect * aspect));
  return extent;
}

/// Extent of a picture's diagonal, from the focal length of a 36 x 24 mm camera: "50mm".
double read_focal_length(Properties& p) {
  std::string text = p.text("focal_length").value_or("50mm");
  if (text.ends_with("mm")) text.resize(text.size() - 2);
  const double length = parse_number(text, p.where("focal_length"));
  if (!(length > 0)) p.fail("focal_length", "'focal_length' must be above 0");
  return std::hypot(36, 24) / length;
}

}  // namespace

double read_extent_x(Properties& p, double aspect) {
  const std::string axis = p.choice("fov_axis", {"x", "y", "diagonal", "smaller", "larger"});
  const std::optional<float> fov = p.number("fov");
  const double diagonal = read_focal_length(p);
  if (fov && p.find("focal_length")) p.fail("fov", "give either 'fov' or 'focal_length'");
  if (fov && !(*fov > 0 && *fov < 180)) p.fail("fov", "'fov' must lie between 0 and 180 degrees");
  return fov ? extent_x(extent_of(*fov), axis, aspect) : extent_x(diagonal, "diagonal", aspect);
}

namespace {

float read_fov_x(Properties& p, const FilmSize& film) {
  const double x = read_extent_x(p, static_cast<double>(film.width) / film.height);
  return static_cast<float>(2 * std::atan(x / 2) * kDegrees);
}

/// What all sensors have.
CameraConfig& read_camera(Properties& p, SceneBuilder& b) {
  p.objects("sampler");
  p.ignore({"shutter_open", "shutter_close"});
  read_film(p, b);
  CameraConfig& camera = b.scene().camera_config;
  camera.to_world = p.transform("to_world");
  camera.near_clip = p.positive("near_clip", camera.near_clip);
  camera.far_clip = p.positive("far_clip", camera.far_clip);
  if (camera.far_clip <= camera.near_clip) {
    p.fail("far_clip", "'far_clip' must be above 'near_clip'");
  }
  return camera;
}

void perspective(Properties& p, SceneBuilder& b) {
  CameraConfig& camera = read_camera(p, b);
  if (p.type() == "perspective") p.ignore({"focus_distance"});
  camera.fov_x_degrees = read_fov_x(p, b.scene().film);
  camera.principal_offset = {p.number("principal_point_offset_x").value_or(0),
                             p.number("principal_point_offset_y").value_or(0)};
}

void thin_lens(Properties& p, SceneBuilder& b) {
  perspective(p, b);
  CameraConfig& camera = b.scene().camera_config;
  if (!p.find("aperture_radius")) p.fail("aperture_radius", "'aperture_radius' is missing");
  camera.aperture_radius = p.positive("aperture_radius", 0);
  camera.focus_distance = p.positive("focus_distance", camera.far_clip);
}

void orthographic(Properties& p, SceneBuilder& b) {
  p.ignore({"focus_distance"});
  read_camera(p, b).projection = Projection::orthographic;
}

constexpr Plugin<void (*)(Properties&, SceneBuilder&)> kSensors[] = {
    {"perspective", perspective},
    {"thinlens", thin_lens},
    {"orthographic", orthographic},
};

}  // namespace

void read_sensor(Properties& properties, SceneBuilder& builder) {
  find_plugin(kSensors, properties)(properties, builder);
}

}  // namespace octolux
