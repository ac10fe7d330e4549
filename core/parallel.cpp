// parallel.h over oneTBB, which Embree brings along anyway. Half of oneTBB is templates that would
// be compiled with a sanitizer's checks and half a library without, so ThreadSanitizer would see
// half of how its tasks are handed over: under the preset `tsan` this file is built without it
// (CMakeLists.txt) and says by ForkJoin what happens before what.
#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "core/fork_join.h"

namespace octolux {
namespace {

/// Calls work() where as many threads as ThreadLimit allows can join in. oneTBB's own arena has no
/// place for more than there are processors.
void with_all_threads(const std::function<void()>& work) {
  if (tbb::this_task_arena::max_concurrency() >= thread_count()) {
    work();
  } else {
    tbb::task_arena(thread_count()).execute(work);
  }
}

}  // namespace

ThreadLimit::ThreadLimit(int threads)
    : control_(new tbb::global_control(
          tbb::global_control::max_allowed_parallelism,
          static_cast<std::size_t>(threads > 0 ? threads : tbb::info::default_concurrency()))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

int thread_count() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

void parallel_for_chunks(
    std::int64_t count, std::int64_t chunk_size,
    const std::function<void(std::int64_t, std::int64_t, std::int64_t)>& body) {
  const std::int64_t chunks = (count + chunk_size - 1) / chunk_size;
  const ForkJoin work;
  const auto run = [&](const tbb::blocked_range<std::int64_t>& range) {
    for (std::int64_t c = range.begin(); c != range.end(); ++c) {
      const ForkJoin::Task task(work);
      body(c, c * chunk_size, std::min(count, (c + 1) * chunk_size));
    }
  };
  with_all_threads([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, chunks, 1), run,
                      tbb::simple_partitioner());
  });
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
  const ForkJoin work;
  const auto run = [&](const std::function<void()>& body) {
    const ForkJoin::Task task(work);
    body();
  };
  with_all_threads([&] { tbb::parallel_invoke([&] { run(first); }, [&] { run(second); }); });
}

}  // namespace octolux
