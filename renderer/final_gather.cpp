// final_gather.h.
#include "renderer/final_gather.h"

#include <algorithm>
#include <cmath>

#include "renderer/roulette.h"

namespace octolux {

namespace {

constexpr int kUnlimited = 1 << 20;  // segments
constexpr int kMaxRetraces = 16;
/// Retraced paths end by roulette where a surface scatters less than the inverse of this. A dark
/// living room then takes 0.7 of the time, with 2 % more noise; without the factor, 7 % more.
constexpr float kRetraceChance = 1.5f;
/// Of the points behind retraced rays, the share that looks caustics up. Were it all, a dark living
/// room would take 1.26 times as long as with none; the noise of a glass sphere's room is the same
/// to 1 %.
constexpr float kCausticChance = 0.25f;

}  // namespace

FinalGather::FinalGather(const Scene& scene, const LightSampler& lights, const PhotonMaps& maps,
                         const Learned& learned, const RenderConfig& config)
    : scene_(scene),
      lights_(lights),
      maps_(maps),
      learned_(learned),
      config_(config),
      light_samples_(lights.divided(config.eye.light_samples)) {}

int FinalGather::remaining(int segments) const {
  return scene_.max_depth < 0 ? kUnlimited : scene_.max_depth - segments;
}

GatherPoint FinalGather::gather_point(Tracer& tracer, const Scattering& at, int segments) const {
  return {at, std::min(kMaxSegments, remaining(segments)), scene_.caster.get(),
          tracer.rng.uniform()};
}

/// What the eye sees gathers along the pixel's own sequence, so that its passes complement each
/// other; what lies behind is met anew in every pass. Rays that follow the BSDF and those that
/// follow the guide have sequences of their own: half of each sample's points of one would not be
/// spread evenly through the passes.
GatherDirections::Points FinalGather::gather_points(Tracer& tracer, const Level& level,
                                                    int guided) const {
  const auto points = [&](PixelUse use, int n) {
    return level.retraces > 0 ? PointSet(n, tracer.rng)
                              : tracer.sequence.points(use, level.segments, n);
  };
  if (guided == 0) {
    const PointSet all = points(PixelUse::gather, level.rays);
    return {all, all};
  }
  return {points(PixelUse::gather_by_bsdf, level.rays - guided),
          points(PixelUse::gather_by_guide, guided)};
}

LightPoints FinalGather::light_points(Tracer& tracer, const Level& level, LightSamples n) const {
  if (level.retraces > 0) return {n, tracer.rng};
  return {tracer.sequence.points(PixelUse::lights, level.segments, n.others),
          tracer.sequence.points(PixelUse::light_choice, level.segments, 1),
          tracer.sequence.points(PixelUse::narrow_lights, level.segments, n.narrow)};
}

/// [m]
float FinalGather::read_distance(const GatherPoint& at) const {
  const std::optional<float> shared = maps_.records.bandwidth(at);
  const float bandwidth =
      shared ? *shared : mean_bandwidth(maps_.global, at, config_.estimator.neighbours);
  return static_cast<float>(config_.eye.retrace) * bandwidth;
}

LightSamples FinalGather::light_samples(int paths) const {
  const auto part = [paths](int n) { return (n + paths - 1) / paths; };
  return {part(light_samples_.others), part(light_samples_.narrow)};
}

FinalGather::Level FinalGather::first_level(int segments, int paths) const {
  return {segments, (config_.eye.gather_rays + paths - 1) / paths, 0, 0, light_samples(paths)};
}

SplitRadiance FinalGather::radiance(Tracer& tracer, const Scattering& at, int segments,
                                    int paths) const {
  if (!config_.eye.gather) {
    return {Rgb(0), Rgb(0), Rgb(0), maps_.global.radiance(gather_point(tracer, at, segments))};
  }
  return radiance(tracer, at, first_level(segments, paths));
}

SplitRadiance FinalGather::direct(Tracer& tracer, const Scattering& at, int segments,
                                  int paths) const {
  if (remaining(segments) < 1) return {};
  return direct(tracer, at, first_level(segments, paths), learned_receiver(at),
                gather_point(tracer, at, segments));
}

SplitRadiance FinalGather::radiance(Tracer& tracer, const Scattering& at,
                                    const Level& level) const {
  if (remaining(level.segments) < 1) return {};
  const Receiver lit = learned_receiver(at);
  const GatherPoint point = gather_point(tracer, at, level.segments);
  SplitRadiance out = direct(tracer, at, level, lit, point);
  gather(tracer, at, level, lit, point, out);
  return out;
}

Receiver FinalGather::learned_receiver(const Scattering& at) const {
  Receiver lit = receiver(at);
  lit.learned = learned_.lights.at(lit.position, at.facing_normal());
  return lit;
}

SplitRadiance FinalGather::direct(Tracer& tracer, const Scattering& at, const Level& level,
                                  const Receiver& lit, const GatherPoint& point) const {
  SplitRadiance out;
  const LightSamples samples = level.light_samples;
  const DirectStrategy strategy{Lobes::smooth, Lobes::smooth, samples, level.rays,
                                remaining(level.segments) - 1};
  out.direct =
      sample_lights(tracer, lights_, at, lit, strategy, light_points(tracer, level, samples));
  const float caustic_chance = level.retraces > 0 ? kCausticChance : 1;
  if (maps_.caustics_mapped && (caustic_chance == 1 || tracer.rng.uniform() < caustic_chance)) {
    out.caustic = maps_.caustic.radiance(point) / caustic_chance;
  }
  return out;
}

void FinalGather::gather(Tracer& tracer, const Scattering& at, const Level& level,
                         const Receiver& lit, const GatherPoint& point, SplitRadiance& out) const {
  const bool first = level.retraces == 0;
  const bool coated = first && at.coated_reflectance();
  Level next = level;
  if (first) next.read_distance = read_distance(point);
  const LobeMixture guide =
      first ? learned_.guides.at(lit.position, at.facing_normal()) : LobeMixture();
  const int guided = GatherDirections::guided(guide, level.rays);
  const GatherDirections directions(at, guide, level.rays, gather_points(tracer, level, guided));
  for (int i = 0; i < level.rays; ++i) {
    std::optional<GatherDirection> chosen = directions.draw(i, tracer.rng);
    if (!chosen) continue;
    Rgb& weight = chosen->weight;
    const float chance = std::min(1.0f, kRetraceChance * max_component(weight));
    if (level.retraces > 0 && !survives(tracer.rng, weight, chance)) continue;
    const Arrival arrival{lit, chosen->bsdf_pdf_w, level.rays, level.light_samples};
    const Rgb scattered = weight * follow(tracer, at.spawn(chosen->wi), next, arrival);
    if (coated) {
      const Rgb share = at.coated_share(chosen->wi);
      out.base += scattered * share;
      out.indirect += scattered * (Rgb(1) - share);
    } else {
      out.base += scattered;
    }
  }
}

/// Radiance leaving `at`, where a gather ray of this length [m] ended: read from the map, or
/// followed further.
Rgb FinalGather::scattered(Tracer& tracer, const Scattering& at, const Level& here,
                           float distance) const {
  const auto go_on = [&] {
    // One light sample will do, of one path of many: with half as many as at the first point eight
    // interiors took 1.01 to 1.08 times as long for 0.94 to 1.00 of the noise.
    const LightSamples samples{std::min(1, light_samples_.others),
                               std::min(1, light_samples_.narrow)};
    return radiance(tracer, at, {here.segments, 1, here.read_distance, here.retraces + 1, samples})
        .total();
  };
  const bool may_go_on = here.retraces < kMaxRetraces;
  const float threshold = here.read_distance * (0.5f + tracer.rng.uniform());
  if (may_go_on && distance < threshold) return go_on();
  const GatherPoint point = gather_point(tracer, at, here.segments);
  const GatherRecords::Nearest record = maps_.records.nearest(point);
  if (may_go_on && maps_.records.is_detail(point, record)) return go_on();
  const Rgb sunlit = narrow_direct(tracer, at, here);
  if (const std::optional<Rgb> shared = maps_.records.radiance(point, record)) {
    return sunlit + *shared;
  }
  return sunlit + maps_.global.radiance(point);
}

/// What of narrow lights arrives straight is not in the map (photon_pass.h): look-ups are too
/// bright where it ends at an edge, and one shadow ray tells all of it.
Rgb FinalGather::narrow_direct(Tracer& tracer, const Scattering& at, const Level& here) const {
  if (light_samples_.narrow == 0 || remaining(here.segments) < 1) return Rgb(0);
  const LightSamples one{0, 1};
  const DirectStrategy strategy{Lobes::smooth, Lobes::smooth, one, 0, remaining(here.segments) - 1};
  return sample_lights(tracer, lights_, at, receiver(at), strategy, {one, tracer.rng});
}

/// Radiance arriving along `ray`, through specular lobes S*, from the first smooth lobes met, and
/// the share of directly hit emitters that belongs to BSDF sampling.
Rgb FinalGather::follow(Tracer& tracer, Ray ray, const Level& level, Arrival arrival) const {
  Rgb total(0), beta(1);
  int segments = level.segments;
  int bounces = 0;
  float distance = 0;
  bool emitters = true;  // would light hit now be counted nowhere else?
  while (remaining(segments) > 0) {
    const std::optional<SurfaceHit> hit = tracer.next(ray, beta, segments);
    if (remaining(segments) < 0) break;
    if (!hit) {
      if (emitters) total += beta * environment(scene_, lights_, ray.direction, arrival);
      break;
    }
    const Vec3 wo = -ray.direction;
    if (emitters) total += beta * emitted(lights_, *hit, wo, arrival);
    distance += hit->distance;
    const Scattering at(hit->point, *hit->bsdf, wo, Carried::radiance);
    if (hit->bsdf->has(Lobes::smooth)) {
      const Level here{segments, 1, level.read_distance, level.retraces, {}};
      total += beta * scattered(tracer, at, here, distance);
    }
    if (!hit->bsdf->has(Lobes::specular)) break;
    const std::optional<BsdfSample> sample = sample_lobes(tracer.rng, at, Lobes::specular);
    if (!sample) break;
    beta *= sample->weight;
    // What a varnish shows is worth less than what it covers, which has been read.
    float chance = hit->bsdf->has(Lobes::smooth) ? std::min(1.0f, max_component(beta)) : 1;
    if (++bounces > kSafeBounces) chance = std::min(chance, survival(beta));
    if (chance < 1 && !survives(tracer.rng, beta, chance)) break;
    ray = at.spawn(sample->wi);
    emitters = !maps_.caustics_mapped;
    arrival = {};
  }
  return total;
}

}  // namespace octolux
