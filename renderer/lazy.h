// Values that are computed when they are asked for first, by any thread. The function that computes
// one must give the same value whoever calls it: threads that ask at the same time may both compute
// it, and one result is kept. No locks.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace octolux {

/// Small values, kept in place.
template <class T>
class LazyValues {
 public:
  static constexpr double kBytesPerValue = sizeof(T) + 1;

  explicit LazyValues(std::size_t count = 0) : values_(count), states_(count) {}

  template <class Compute>
  T get(std::size_t i, const Compute& compute) const {
    if (states_[i].load(std::memory_order_acquire) == kReady) return values_[i];
    const T value = compute();
    std::uint8_t expected = kEmpty;
    if (states_[i].compare_exchange_strong(expected, kTaken, std::memory_order_relaxed)) {
      values_[i] = value;
      states_[i].store(kReady, std::memory_order_release);
    }
    return value;
  }

 private:
  static constexpr std::uint8_t kEmpty = 0, kTaken = 1, kReady = 2;
  mutable std::vector<T> values_;
  mutable std::vector<std::atomic<std::uint8_t>> states_;
};

/// Large objects, each allocated when it is made. References stay valid.
template <class T>
class LazyObjects {
 public:
  explicit LazyObjects(std::size_t count = 0) : objects_(count) {}
  LazyObjects(LazyObjects&&) noexcept = default;
  LazyObjects& operator=(LazyObjects&& other) noexcept {
    objects_.swap(other.objects_);
    return *this;
  }
  ~LazyObjects() {
    for (std::atomic<const T*>& object : objects_) delete object.load(std::memory_order_relaxed);
  }

  template <class Make>
  const T& get(std::size_t i, const Make& make) const {
    if (const T* object = objects_[i].load(std::memory_order_acquire)) return *object;
    auto made = std::make_unique<const T>(make());
    const T* expected = nullptr;
    if (objects_[i].compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel)) {
      return *made.release();
    }
    return *expected;
  }

 private:
  mutable std::vector<std::atomic<const T*>> objects_;
};

}  // namespace octolux
