// Parallel loops over fixed chunks. The cut does not depend on the number of threads, and a body
// writes only what belongs to its chunk, so results do not depend on threads either.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace octolux {

/// Limits all parallel work of this process to `threads` (0: all processors) while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Number of threads parallel loops use now.
int thread_count();

/// Calls body(chunk, begin, end) once for every chunk of [0, count): chunk c covers
/// [c * chunk_size, min(count, (c + 1) * chunk_size)). In any order, on any thread.
void parallel_for_chunks(
    std::int64_t count, std::int64_t chunk_size,
    const std::function<void(std::int64_t chunk, std::int64_t begin, std::int64_t end)>& body);

/// Calls both functions, at the same time if a thread is free.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

}  // namespace octolux
