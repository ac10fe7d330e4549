// core/parallel.h: every chunk once, on as many threads as were asked for; and ThreadSanitizer
// still sees races.
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>
#include <vector>

namespace octolux {
namespace {

using namespace std::chrono_literals;

TEST(Parallel, EveryChunkOnce) {
  for (const std::int64_t count : {0, 1, 99, 100, 101, 12'345}) {
    std::vector<int> visits(static_cast<std::size_t>(count));
    std::vector<std::int64_t> starts(static_cast<std::size_t>(count + 99) / 100);
    parallel_for_chunks(count, 100, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
      starts[static_cast<std::size_t>(chunk)] = begin;
      for (std::int64_t i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
    });
    EXPECT_EQ(visits, std::vector<int>(visits.size(), 1));
    for (std::size_t c = 0; c < starts.size(); ++c) EXPECT_EQ(starts[c], 100 * static_cast<int>(c));
  }
}

/// Waits until `wanted` threads are here, at most ten seconds; whether they came.
bool meet(std::atomic<int>& here, int wanted) {
  ++here;
  const auto end = std::chrono::steady_clock::now() + 10s;
  while (here < wanted && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
  return here >= wanted;
}

/// Also more threads than there are processors.
TEST(Parallel, AsManyThreadsAsAskedFor) {
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(thread_count(), threads);
    std::atomic<int> here = 0, missed = 0;
    parallel_for_chunks(threads, 1, [&](std::int64_t, std::int64_t, std::int64_t) {
      if (!meet(here, threads)) ++missed;
    });
    EXPECT_EQ(missed, 0) << threads << " threads";
  }
}

TEST(Parallel, OneThreadKeepsToItself) {
  const ThreadLimit limit(1);
  std::vector<std::thread::id> ids(50);
  parallel_for_chunks(50, 1, [&](std::int64_t chunk, std::int64_t, std::int64_t) {
    ids[static_cast<std::size_t>(chunk)] = std::this_thread::get_id();
  });
  EXPECT_EQ(ids, std::vector<std::thread::id>(50, std::this_thread::get_id()));
}

TEST(Parallel, BothAtTheSameTime) {
  const ThreadLimit limit(2);
  std::atomic<int> here = 0;
  bool first = false, second = false;
  parallel_invoke([&] { first = meet(here, 2); }, [&] { second = meet(here, 2); });
  EXPECT_TRUE(first && second);
}

TEST(Parallel, ExceptionsComeBack) {
  const auto fail = [](std::int64_t chunk, std::int64_t, std::int64_t) {
    if (chunk == 7) throw std::runtime_error("seven");
  };
  EXPECT_THROW(parallel_for_chunks(100, 1, fail), std::runtime_error);
}

#ifdef OCTOLUX_TSAN
/// What ForkJoin tells ThreadSanitizer must not hide what two chunks do to each other.
TEST(ParallelDeathTest, RacesBetweenChunksAreReported) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto race = [] {
    const ThreadLimit limit(2);
    std::atomic<int> here = 0;
    int count = 0;
    parallel_for_chunks(2, 1, [&](std::int64_t, std::int64_t, std::int64_t) {
      meet(here, 2);
      ++count;
    });
    std::exit(count == 0);
  };
  EXPECT_EXIT(race(), testing::ExitedWithCode(66), "data race");
}
#endif

}  // namespace
}  // namespace octolux
