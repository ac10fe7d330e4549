// What a curve says: how fast the error falls, and when it reaches a target.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/converge/series.h"

namespace octolux {

/// error ~ time^slope, a straight line through log error over log time by least squares. Each seed
/// is fitted by itself and the slopes averaged: points of one seed share passes and are not
/// independent, seeds are.
struct Slope {
  double value = 0;
  double standard_error = 0;  // over the seeds; NaN: one seed only
  int points = 0, seeds = 0;
};

/// Empty with fewer than three points above the reference's noise.
std::optional<Slope> fit_slope(const Series& series);

/// The time at which the error falls to a target, between points by a straight line in log-log; the
/// geometric mean over seeds.
struct TimeToTarget {
  enum class Kind {
    reached,
    at_once,   // before the first point: `seconds` is an upper bound
    foreseen,  // after the last point: by the fitted slope, which a bias that stays would betray
    never,     // the error does not fall
  };
  Kind kind = Kind::never;
  double seconds = 0;
  double log_error = 0;  // standard error of log(seconds); NaN: one seed only
  int seeds = 0;
};

TimeToTarget time_to(const Series& series, double target);

/// Who is first at a target, among those who reached it; if nobody did, among the foreseen.
struct Winner {
  double target = 0;
  int series = -1;                  // index; -1: nobody
  bool foreseen = false;            // nobody reached it
  std::vector<int> level_with;      // not told apart from the winner (Welch's t-test, 5 %)
  std::vector<TimeToTarget> times;  // of every series
};

Winner find_winner(const std::vector<Series>& series, double target);

/// A sentence about it.
std::string to_text(const Winner& winner, const std::vector<Series>& series);

/// "2.5 s", "< 0.4 s", "~ 80 s", "-".
std::string to_text(const TimeToTarget& time);

}  // namespace octolux
