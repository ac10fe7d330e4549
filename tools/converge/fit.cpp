// fit.h.
#include "tools/converge/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/statistics.h"

namespace octolux {
namespace {

using Kind = TimeToTarget::Kind;

/// Two curves closer than this are called level.
constexpr double kLevelAlpha = 0.05;

/// A point below this share of the reference's own noise says nothing about the error.
constexpr double kFloorShare = 0.25;

struct LogPoint {
  double time = 0, error = 0;  // natural logarithms
};

std::size_t seed_count(const Series& series) {
  std::size_t n = 0;
  for (const SeriesPoint& p : series.points) n = std::max(n, p.seeds.size());
  return n;
}

/// One seed's curve, as far as it is above the reference's noise.
std::vector<LogPoint> seed_curve(const Series& series, std::size_t seed) {
  std::vector<LogPoint> curve;
  for (const SeriesPoint& p : series.points) {
    if (seed >= p.seeds.size()) continue;
    const double error2 = p.seeds[seed].rel_mse - p.floor;
    if (!(error2 > kFloorShare * p.floor) || !(p.seeds[seed].seconds > 0)) continue;
    curve.push_back({std::log(p.seeds[seed].seconds), 0.5 * std::log(error2)});
  }
  return curve;
}

/// Slope of the regression line; 0 for points at one time.
double regression(const std::vector<LogPoint>& curve) {
  Running time, error;
  for (const LogPoint& p : curve) time.add(p.time), error.add(p.error);
  double xy = 0, xx = 0;
  for (const LogPoint& p : curve) {
    xy += (p.time - time.mean()) * (p.error - error.mean());
    xx += (p.time - time.mean()) * (p.time - time.mean());
  }
  return xx > 0 ? xy / xx : 0;
}

struct SeedTime {
  Kind kind = Kind::never;
  double log_time = 0;
};

SeedTime seed_time(const std::vector<LogPoint>& curve, double log_target) {
  if (curve.empty()) return {};
  if (curve.front().error <= log_target) return {Kind::at_once, curve.front().time};
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const LogPoint a = curve[i - 1], b = curve[i];
    if (b.error > log_target) continue;
    const double share = (a.error - log_target) / (a.error - b.error);
    return {Kind::reached, a.time + share * (b.time - a.time)};
  }
  const double slope = curve.size() < 3 ? 0 : regression(curve);
  if (!(slope < 0)) return {};
  return {Kind::foreseen, curve.back().time + (log_target - curve.back().error) / slope};
}

double standard_error(const Running& r) {
  return r.count() > 1 ? r.standard_error() : std::numeric_limits<double>::quiet_NaN();
}

bool told_apart(const TimeToTarget& a, const TimeToTarget& b) {
  if (!(a.log_error >= 0) || !(b.log_error >= 0)) return true;  // one seed: taken at its word
  const double va = a.log_error * a.log_error, vb = b.log_error * b.log_error;
  const double difference = std::log(a.seconds / b.seconds);
  if (!(va + vb > 0)) return difference != 0;
  const double dof = welch_dof(va, a.seeds, vb, b.seeds);
  return student_t_p(difference / std::sqrt(va + vb), dof) < kLevelAlpha;
}

}  // namespace

std::optional<Slope> fit_slope(const Series& series) {
  Running slopes;
  int points = 0;
  for (std::size_t seed = 0; seed < seed_count(series); ++seed) {
    const std::vector<LogPoint> curve = seed_curve(series, seed);
    if (curve.size() < 3) continue;
    points = std::max(points, static_cast<int>(curve.size()));
    slopes.add(regression(curve));
  }
  if (slopes.count() == 0) return std::nullopt;
  return Slope{slopes.mean(), standard_error(slopes), points, static_cast<int>(slopes.count())};
}

TimeToTarget time_to(const Series& series, double target) {
  Running times;
  Kind worst = Kind::reached;
  std::size_t at_once = 0;
  const std::size_t seeds = seed_count(series);
  for (std::size_t seed = 0; seed < seeds; ++seed) {
    const SeedTime t = seed_time(seed_curve(series, seed), std::log(target));
    if (t.kind == Kind::never) return {};
    if (t.kind == Kind::foreseen) worst = Kind::foreseen;
    at_once += t.kind == Kind::at_once;
    times.add(t.log_time);
  }
  if (seeds == 0) return {};
  if (at_once == seeds) worst = Kind::at_once;
  return {worst, std::exp(times.mean()), standard_error(times), static_cast<int>(times.count())};
}

Winner find_winner(const std::vector<Series>& series, double target) {
  Winner winner{target, -1, false, {}, {}};
  for (const Series& s : series) winner.times.push_back(time_to(s, target));
  const auto consider = [&](bool foreseen) {
    for (std::size_t i = 0; i < series.size(); ++i) {
      const TimeToTarget& t = winner.times[i];
      if (t.kind == Kind::never || (t.kind == Kind::foreseen) != foreseen) continue;
      const bool first = winner.series < 0 || t.seconds < winner.times[winner.series].seconds;
      if (first) winner.series = static_cast<int>(i);
    }
  };
  consider(false);
  winner.foreseen = winner.series < 0;
  if (winner.foreseen) consider(true);
  for (std::size_t i = 0; winner.series >= 0 && i < series.size(); ++i) {
    const TimeToTarget &t = winner.times[i], &best = winner.times[winner.series];
    const bool rival = static_cast<int>(i) != winner.series && t.kind != Kind::never &&
                       (t.kind == Kind::foreseen) == winner.foreseen;
    if (rival && !told_apart(best, t)) winner.level_with.push_back(static_cast<int>(i));
  }
  return winner;
}

std::string to_text(const TimeToTarget& time) {
  constexpr const char* kMarks[] = {"", "< ", "~ "};
  if (time.kind == Kind::never) return "-";
  return fmt::format("{}{:.3g} s", kMarks[static_cast<int>(time.kind)], time.seconds);
}

std::string to_text(const Winner& winner, const std::vector<Series>& series) {
  const std::string target = fmt::format("to {:g} % error", 100 * winner.target);
  if (winner.series < 0) return target + ": nobody";
  std::string text = fmt::format("{}: {}, {}", target, series[winner.series].name,
                                 to_text(winner.times[winner.series]));
  if (winner.foreseen) text += " (nobody got there; foreseen from the slope)";
  for (std::size_t i = 0; i < winner.level_with.size(); ++i) {
    text += (i == 0 ? "; level with it: " : ", ") + series[winner.level_with[i]].name;
  }
  return text;
}

}  // namespace octolux
