// What a render says about itself on stderr: on a terminal one line with a bar, redrawn; elsewhere
// a plain line now and then.
#pragma once

#include <string>

#include "renderer/render.h"

namespace octolux {

enum class Verbosity { quiet, lines, bar };

/// bar if stderr is a terminal that can redraw a line, else lines.
Verbosity default_verbosity();

class ProgressPrinter {
 public:
  explicit ProgressPrinter(Verbosity verbosity) : verbosity_(verbosity) {}

  /// After a pass: redraws the bar, or prints a line if the last one is some seconds old.
  void update(const Progress& progress);
  /// What is going on before the first pass: redraws the bar's line, or prints a line.
  void status(const std::string& line);
  /// Takes away a bar, if there is one.
  void clear_bar();
  /// A line of its own, after the bar if there is one.
  void say(const std::string& line);
  bool quiet() const { return verbosity_ == Verbosity::quiet; }
  bool draws_bar() const { return verbosity_ == Verbosity::bar; }

 private:
  void draw(const std::string& line);

  Verbosity verbosity_;
  bool bar_drawn_ = false;
  double last_line_ = -1;  // Progress::seconds of the last plain line; below 0: none yet
};

/// "0:07", "12:34", "1:02:03".
std::string format_duration(double seconds);

}  // namespace octolux
