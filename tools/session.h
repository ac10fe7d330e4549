// A render in progress, watched: shows how far it is, saves the picture every few seconds, and
// stops it after Ctrl-C.
#pragma once

#include <chrono>
#include <functional>

#include "renderer/render.h"
#include "tools/interrupt.h"
#include "tools/progress.h"

namespace octolux {

class Session final : public RenderObserver {
 public:
  using Save = std::function<void(const Progress&, const Film&)>;

  /// Ctrl-C is caught while this lives. `printer` must live as long.
  Session(ProgressPrinter& printer, Save save);

  void photons_foreseen(const PhotonMemory& memory) override;
  bool pass_done(const Progress& progress, const Film& film) override;
  /// Saves the finished picture, unless it is on disk already.
  void finish(const RenderResult& result);

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  void save(const Progress& progress, const Film& film);

  ProgressPrinter& printer_;
  Interrupt interrupt_;
  Save save_;
  Clock::time_point last_save_ = Clock::now();
  Seconds interval_;      // between two savings
  int saved_passes_ = 0;  // in the picture on disk
};

/// True if all samples and photons were finite; otherwise says on stderr how many were not.
bool report_non_finite(const RenderResult& result, std::uint64_t seed);

}  // namespace octolux
