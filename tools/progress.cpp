// progress.h.
#include "tools/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace octolux {
namespace {

constexpr double kSecondsBetweenLines = 5;
constexpr int kBarWidth = 20;

std::string format_rate(double per_second) {
  return per_second >= 1e6 ? fmt::format("{:.2f} Mrays/s", per_second * 1e-6)
                           : fmt::format("{:.0f} krays/s", per_second * 1e-3);
}

std::string describe(const Progress& p) {
  std::string text = p.total_passes > 0 ? fmt::format("pass {}/{}", p.passes, p.total_passes)
                                        : fmt::format("pass {}", p.passes);
  text += "  " + format_duration(p.seconds);
  if (p.remaining_seconds >= 0) text += " + " + format_duration(p.remaining_seconds) + " left";
  text += "  " + format_rate(p.rays_per_second);
  if (p.passes > 1) text += fmt::format("  error {:.3g} %", 100 * p.error);
  return text;
}

/// Empty if nobody knows how long it will take.
std::string draw_bar(const Progress& p) {
  if (p.remaining_seconds < 0) return "";
  const double total = p.seconds + p.remaining_seconds;
  const double share = total > 0 ? std::clamp(p.seconds / total, 0.0, 1.0) : 1;
  std::string bar(kBarWidth, '.');
  std::fill_n(bar.begin(), std::lround(share * kBarWidth), '#');
  return fmt::format("[{}] ", bar);
}

std::size_t terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

Verbosity default_verbosity() {
  return ::isatty(STDERR_FILENO) ? Verbosity::bar : Verbosity::lines;
}

void ProgressPrinter::update(const Progress& progress) {
  if (verbosity_ == Verbosity::quiet) return;
  if (verbosity_ == Verbosity::bar) {
    const std::string line = draw_bar(progress) + describe(progress);
    fmt::print(stderr, "\r{}\x1b[K", line.substr(0, terminal_width() - 1));
    std::fflush(stderr);
    bar_drawn_ = true;
    return;
  }
  const double since_last = progress.seconds - last_line_;  // below 0: another render has begun
  if (last_line_ >= 0 && since_last >= 0 && since_last < kSecondsBetweenLines) return;
  last_line_ = progress.seconds;
  fmt::print(stderr, "{}\n", describe(progress));
}

void ProgressPrinter::say(const std::string& line) {
  if (verbosity_ == Verbosity::quiet) return;
  fmt::print(stderr, "{}{}\n", bar_drawn_ ? "\n" : "", line);
  bar_drawn_ = false;
}

std::string format_duration(double seconds) {
  const auto s = static_cast<std::int64_t>(std::min(seconds, 1e9));
  const std::int64_t hours = s / 3600, minutes = s / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, s % 60)
                   : fmt::format("{}:{:02}", minutes, s % 60);
}

}  // namespace octolux
