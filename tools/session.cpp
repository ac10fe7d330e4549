// session.h.
#include "tools/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace octolux {
namespace {

/// Time between two savings of an unfinished picture: this, or more if saving is slow.
constexpr double kSaveSeconds = 5;
constexpr double kMuchMemory = 1e9;  // bytes
constexpr double kSaveShare = 0.05;  // of the time, at most, goes into saving

}  // namespace

Session::Session(ProgressPrinter& printer, Save save)
    : printer_(printer),
      interrupt_(!printer.quiet()),
      save_(std::move(save)),
      interval_(kSaveSeconds) {}

void Session::photons_foreseen(const PhotonMemory& memory) {
  if (memory.bytes < kMuchMemory) return;
  printer_.say(fmt::format("about {:.2g} photons a pass, in {:.2g} GB of memory", memory.photons,
                           1e-9 * memory.bytes));
}

bool Session::pass_done(const Progress& progress, const Film& film) {
  printer_.update(progress);
  if (Clock::now() - last_save_ >= interval_) save(progress, film);
  return !interrupt_.requested();
}

void Session::finish(const RenderResult& result) {
  if (saved_passes_ != result.progress.passes) save(result.progress, result.film);
}

void Session::save(const Progress& progress, const Film& film) {
  const Clock::time_point start = Clock::now();
  save_(progress, film);
  last_save_ = Clock::now();
  saved_passes_ = progress.passes;
  const Seconds spent = last_save_ - start;
  interval_ = std::max(interval_, spent / kSaveShare);
}

bool report_non_finite(const RenderResult& result, std::uint64_t seed) {
  const std::int64_t photons = result.progress.rejected_photons;
  if (result.film.non_finite() == 0 && photons == 0) return true;
  const Film::Place place = result.film.first_non_finite();
  fmt::print(stderr,
             "octolux: left out {} samples (first: pixel {},{} of pass {}, seed {}) and {} "
             "photons that were not finite: please report this\n",
             result.film.non_finite(), place.x, place.y, place.pass, seed, photons);
  return false;
}

}  // namespace octolux
