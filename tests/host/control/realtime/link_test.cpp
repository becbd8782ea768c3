// The lock-free queues between the threads.
#include <gtest/gtest.h>

#include <thread>

#include "host/control/realtime/latest_value.hpp"
#include "host/control/realtime/spsc_ring.hpp"

namespace liana::realtime {
namespace {

TEST(SpscRing, KeepsOrderAndRefusesWhenFull) {
  SpscRing<int, 4> ring;
  EXPECT_EQ(ring.front(), nullptr);
  EXPECT_TRUE(ring.push(1) && ring.push(2) && ring.push(3));
  EXPECT_FALSE(ring.push(4));
  for (int expected = 1; expected <= 3; ++expected) {
    ASSERT_NE(ring.front(), nullptr);
    EXPECT_EQ(*ring.front(), expected);
    ring.pop();
  }
  EXPECT_TRUE(ring.push(5));
}

TEST(SpscRing, NothingIsLostOrTornBetweenTwoThreads) {
  struct Pair {
    std::uint64_t a, b;
  };
  static SpscRing<Pair, 64> ring;
  constexpr std::uint64_t kCount = 200000;
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < kCount;) {
      if (ring.push({i, ~i}))
        ++i;
      else
        std::this_thread::yield();
    }
  });
  for (std::uint64_t i = 0; i < kCount;) {
    const Pair* pair = ring.front();
    if (pair == nullptr) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(pair->a, i);
    ASSERT_EQ(pair->b, ~i);
    ring.pop();
    ++i;
  }
  writer.join();
}

TEST(LatestValue, TheReaderSeesOnlyTheNewest) {
  LatestValue<int> value(0);
  EXPECT_FALSE(value.refresh());
  value.publish(1);
  value.publish(2);
  EXPECT_EQ(value.value(), 0) << "nothing changes under the reader";
  EXPECT_TRUE(value.refresh());
  EXPECT_EQ(value.value(), 2);
  EXPECT_FALSE(value.refresh());
}

TEST(LatestValue, ValuesAreNeverTornAndNeverGoBack) {
  struct Block {
    std::array<std::uint64_t, 64> words;
  };
  static LatestValue<Block> value(Block{});
  constexpr std::uint64_t kCount = 200000;
  std::thread writer([&] {
    Block block{};
    for (std::uint64_t i = 1; i <= kCount; ++i) {
      block.words.fill(i);
      value.publish(block);
    }
  });
  std::uint64_t last = 0;
  while (last < kCount) {
    if (!value.refresh()) {
      std::this_thread::yield();
      continue;
    }
    const Block& block = value.value();
    ASSERT_GT(block.words[0], last);
    last = block.words[0];
    for (const std::uint64_t word : block.words) ASSERT_EQ(word, last);
  }
  writer.join();
}

}  // namespace
}  // namespace liana::realtime
