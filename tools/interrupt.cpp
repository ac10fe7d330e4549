// interrupt.h with POSIX signals. The two flags are what a handler may touch: lock-free atomics.
#include "tools/interrupt.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace octolux {
namespace {

std::atomic<bool> requested_flag{false};
std::atomic<bool> announce_flag{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void handle_both(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void on_signal(int) {
  handle_both(SIG_DFL);
  requested_flag = true;
  if (!announce_flag) return;
  constexpr char kMessage[] = "\noctolux: finishing this pass; once more to stop at once\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, kMessage, sizeof kMessage - 1);
}

}  // namespace

Interrupt::Interrupt(bool announce) {
  requested_flag = false;
  announce_flag = announce;
  handle_both(on_signal);
}

Interrupt::~Interrupt() { handle_both(SIG_DFL); }

bool Interrupt::requested() const { return requested_flag; }

}  // namespace octolux
