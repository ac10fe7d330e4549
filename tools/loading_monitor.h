// Says how far the loading of a scene is, once it takes longer than a few seconds.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "renderer/load_progress.h"
#include "tools/progress.h"

namespace octolux {

/// Watches from a thread of its own, because a single large file may take long between two reports.
class LoadingMonitor {
 public:
  /// `printer` must outlive this, and nobody else may use it meanwhile.
  explicit LoadingMonitor(ProgressPrinter& printer);
  ~LoadingMonitor();
  LoadingMonitor(const LoadingMonitor&) = delete;
  LoadingMonitor& operator=(const LoadingMonitor&) = delete;

  /// To be called while this lives.
  LoadProgress progress();

 private:
  void watch();

  ProgressPrinter& printer_;
  std::atomic<const char*> what_ = "reading the scene";
  std::atomic<double> share_ = 0;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;  // guarded by mutex_
  std::thread thread_;
};

}  // namespace octolux
