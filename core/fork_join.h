// Tells ThreadSanitizer who waits for whom where it cannot see it: the libraries of oneTBB and
// Embree, which start and join our parallel work, are not built with it. Each call of a parallel
// function makes one ForkJoin, and each piece of work one Task. Pieces of the same work are given
// no order among each other, so that races between them are seen. In other builds all of this is
// empty.
#pragma once

#include <cstdint>

#ifdef OCTOLUX_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace octolux {

/// What this thread did so far happens before what follows any later happens_after(what).
inline void happens_before([[maybe_unused]] const void* what) {
#ifdef OCTOLUX_TSAN
  __tsan_release(const_cast<void*>(what));
#endif
}

inline void happens_after([[maybe_unused]] const void* what) {
#ifdef OCTOLUX_TSAN
  __tsan_acquire(const_cast<void*>(what));
#endif
}

/// What is done before it is made happens before all its tasks; these happen before what is done
/// after it is gone.
class ForkJoin {
 public:
  ForkJoin() { happens_before(&fork_); }
  ~ForkJoin() { happens_after(&join_); }
  ForkJoin(const ForkJoin&) = delete;
  ForkJoin& operator=(const ForkJoin&) = delete;

  class Task {
   public:
    explicit Task(const ForkJoin& work) : work_(work) { happens_after(&work.fork_); }
    ~Task() { happens_before(&work_.join_); }
    Task(const Task&) = delete;
    Task& operator=(const Task&) = delete;

   private:
    const ForkJoin& work_;
  };

 private:
  std::int64_t fork_ = 0;  // only their addresses count
  std::int64_t join_ = 0;
};

}  // namespace octolux
