// Ctrl-C without losing the picture: the first SIGINT or SIGTERM asks the render to stop at the end
// of its pass, the second one ends the program at once.
#pragma once

namespace octolux {

/// Listens while it lives. One at a time, because a signal handler can only talk to a global.
class Interrupt {
 public:
  /// `announce`: answer the first signal with a line on stderr.
  explicit Interrupt(bool announce);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  bool requested() const;
};

}  // namespace octolux
