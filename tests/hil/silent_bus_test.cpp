// In real time slots go on when the master is gone: drives and arm do not stand still because nobody counts.
#include "bench_harness.hpp"

namespace liana::bench {
namespace {

// SYNCs on both buses for `syncs` periods, then `silent_wakes` wake-ups without a frame, `apart_us` after each other.
class RealBus final : public Bus {
 public:
  RealBus(int syncs, int silent_wakes, std::uint64_t apart_us)
      : syncs_(syncs), silent_wakes_(silent_wakes), apart_us_(apart_us) {}

  bool wait(Wake& wake) override {
    wake.frames.clear();
    if (syncs_-- > 0) {
      for (const std::uint8_t bus : {std::uint8_t{0}, std::uint8_t{1}}) wake.frames.push_back(frame_of(bus, 0x080, {}));
      wake.now_us = now_us_ += period_us();
      return true;
    }
    wake.now_us = now_us_ += apart_us_;
    return silent_wakes_-- > 0;
  }
  void send(const FrameList&) override {}
  bool lockstep() const override { return false; }
  std::uint32_t period_us() const override { return 4000; }
  std::uint64_t refused() const override { return 0; }

 private:
  int syncs_, silent_wakes_;
  std::uint64_t apart_us_, now_us_ = 0;
};

std::uint64_t slots(int syncs, int silent_wakes, std::uint64_t apart_us) {
  BenchOptions options = options_of(1);
  options.arm = "light";
  options.physics = "ideal";
  options.summary_path = temporary("silent.json");
  Bench bench(options);
  RealBus bus(syncs, silent_wakes, apart_us);
  bench.run(bus);
  return nlohmann::json::parse(content(options.summary_path)).at("slots");
}

TEST(SilentBus, EverySyncIsASlot) { EXPECT_EQ(slots(50, 0, 0), 50U); }

TEST(SilentBus, SlotsGoOnByTheClockWithoutSync) {
  // 600 ms in wake-ups of 2 ms: SYNC counts as missing after more than 6 ms, so the first slot ends after 8, then one
  // every 4.
  EXPECT_EQ(slots(50, 300, 2000), 50U + 149U);
}

TEST(SilentBus, AStoppedBenchMakesUpForNothing) { EXPECT_EQ(slots(50, 1, 10'000'000), 51U); }

}  // namespace
}  // namespace liana::bench
