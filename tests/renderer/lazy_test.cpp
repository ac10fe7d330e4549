// renderer/lazy.h: whoever asks gets the value, made once where nobody asks at the same time.
#include "renderer/lazy.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace octolux {
namespace {

constexpr std::size_t kCount = 1000;

TEST(Lazy, ValuesAreComputedOnce) {
  const LazyValues<double> values(kCount);
  int computed = 0;
  const auto square = [&](std::size_t i) {
    return values.get(i, [&] { return ++computed, static_cast<double>(i * i); });
  };
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(square(i), static_cast<double>(i * i));
  }
  EXPECT_EQ(computed, static_cast<int>(kCount));
}

TEST(Lazy, ObjectsAreMadeOnceAndStay) {
  const LazyObjects<std::vector<int>> objects(kCount);
  const auto get = [&](std::size_t i) -> const std::vector<int>& {
    return objects.get(i, [&] { return std::vector<int>(3, static_cast<int>(i)); });
  };
  const std::vector<int>* first = &get(7);
  for (std::size_t i = 0; i < kCount; ++i) EXPECT_EQ(get(i)[2], static_cast<int>(i));
  EXPECT_EQ(&get(7), first);
}

TEST(Lazy, ThreadsThatAskAtOnceGetTheSame) {
  const LazyValues<double> values(kCount);
  const LazyObjects<std::vector<double>> objects(kCount);
  std::atomic<int> wrong = 0;
  const auto ask = [&] {
    for (std::size_t i = 0; i < kCount; ++i) {
      const auto wanted = static_cast<double>(3 * i);
      if (values.get(i, [&] { return wanted; }) != wanted) ++wrong;
      if (objects.get(i, [&] { return std::vector<double>(9, wanted); })[8] != wanted) ++wrong;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) threads.emplace_back(ask);
  }
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace octolux
