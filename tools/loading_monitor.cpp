// loading_monitor.h.
#include "tools/loading_monitor.h"

#include <fmt/format.h>

#include <chrono>

namespace octolux {

LoadingMonitor::LoadingMonitor(ProgressPrinter& printer) : printer_(printer) {
  if (!printer.quiet()) thread_ = std::thread([this] { watch(); });
}

LoadingMonitor::~LoadingMonitor() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  printer_.clear_bar();
}

LoadProgress LoadingMonitor::progress() {
  return [this](const char* what, double share) {
    what_ = what;
    share_ = share;
  };
}

void LoadingMonitor::watch() {
  using namespace std::chrono_literals;
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  for (auto next = start + 3s; !wake_.wait_until(lock, next, [this] { return done_; });) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    printer_.status(fmt::format("loading {}  {} {:.0f} %", format_duration(elapsed.count()),
                                what_.load(), 100 * share_.load()));
    next += printer_.draws_bar() ? 500ms : 5000ms;
  }
}

}  // namespace octolux
