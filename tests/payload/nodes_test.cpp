// The wrist's force sensor and the adapter's electronics as nodes on the bus: what they send, and when.
#include <gtest/gtest.h>

#include <cmath>

#include "hil/payload/adapter_node.hpp"
#include "hil/payload/wrist_sensor.hpp"

namespace liana::bench {
namespace {

CanFrame frame_of(std::uint32_t id, std::vector<std::uint8_t> bytes, std::uint8_t bus = 1) {
  CanFrame frame;
  frame.id = id;
  frame.bus = bus;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

const CanFrame kSync = frame_of(0x080, {});
constexpr std::uint64_t kTick_us = 4000;

std::size_t count(const FrameList& frames, std::uint32_t id) {
  return static_cast<std::size_t>(
      std::count_if(frames.begin(), frames.end(), [id](const CanFrame& frame) { return frame.id == id; }));
}

// The sensor with its frames of the last tick.
constexpr WristParams kQuiet{.force_noise_N = 0.0, .torque_noise_Nm = 0.0};

struct WristOnBus {
  WristOnBus() : sensor(1, false, 1, kQuiet) { tick({}); }
  FrameList tick(const TipLoad& load, FrameList in = {kSync}) {
    FrameList out;
    sensor.exchange(in, now_us += kTick_us, load, out);
    return out;
  }
  WristSensor sensor;
  std::uint64_t now_us = 0;
};

TEST(SelfStartingNode, SaysBootUpThenItsHeartbeatTenTimesASecondWithoutBeingStarted) {
  WristSensor sensor(1, false, 1);
  FrameList all, first;
  sensor.exchange({kSync}, kTick_us, {}, first);
  ASSERT_EQ(first.size(), 1U) << "no report before it is operational";
  EXPECT_EQ(first[0].id, 0x720U);
  EXPECT_EQ(first[0].data[0], 0);
  for (std::uint64_t i = 2; i <= 251; ++i) sensor.exchange({kSync}, i * kTick_us, {}, all);
  EXPECT_EQ(count(all, 0x720), 10U);
  EXPECT_EQ(count(all, 0x1A0), 250U);
  EXPECT_EQ(count(all, 0x2A0), 250U);
}

TEST(SelfStartingNode, HearsOnlyItsOwnBus) {
  WristOnBus wrist;
  EXPECT_EQ(count(wrist.tick({}, {frame_of(0x080, {}, 0)}), 0x1A0), 0U);
}

TEST(SelfStartingNode, StopsAndStartsWhenToldAndBootsAgainAfterAReset) {
  WristOnBus wrist;
  EXPECT_EQ(count(wrist.tick({}, {frame_of(0x000, {0x02, 0x20}), kSync}), 0x1A0), 0U);
  EXPECT_EQ(count(wrist.tick({}, {frame_of(0x000, {0x01, 0x21}), kSync}), 0x1A0), 0U) << "another node was meant";
  EXPECT_EQ(count(wrist.tick({}, {frame_of(0x000, {0x01, 0x00}), kSync}), 0x1A0), 1U);
  const FrameList reset = wrist.tick({}, {frame_of(0x000, {0x81, 0x20})});
  ASSERT_EQ(count(reset, 0x720), 1U);
  EXPECT_EQ(reset.back().data[0], 0);
  EXPECT_EQ(count(wrist.tick({}), 0x1A0), 1U);
}

TEST(WristSensor, SendsForceInFiftiethsOfANewtonAndTorqueInHundredthsWithOneSequence) {
  WristOnBus wrist;
  const FrameList out = wrist.tick({{1.0, -2.5, 30.01}, {0.5, -0.25, 0.004}});
  ASSERT_EQ(out.size(), 2U);
  const auto i16 = [](const CanFrame& frame, std::size_t at) {
    return static_cast<std::int16_t>(frame.data[at] | (frame.data[at + 1] << 8));
  };
  EXPECT_EQ(i16(out[0], 0), 50);
  EXPECT_EQ(i16(out[0], 2), -125);
  EXPECT_EQ(i16(out[0], 4), 1501);
  EXPECT_EQ(i16(out[1], 0), 50);
  EXPECT_EQ(i16(out[1], 2), -25);
  EXPECT_EQ(i16(out[1], 4), 0);
  EXPECT_EQ(out[0].data[6], out[1].data[6]);
  EXPECT_EQ(out[0].data[7], 0);
  EXPECT_EQ(wrist.tick({})[0].data[6], static_cast<std::uint8_t>(out[0].data[6] + 1));
}

TEST(WristSensor, BeyondItsRangeItReadsFullScaleAndSaysSo) {
  WristOnBus wrist;
  const WristReading reading = wrist.sensor.read({{0.0, -900.0, 10.0}, {}});
  EXPECT_EQ(reading.force[1], -25000);
  EXPECT_EQ(reading.status, WristStatus::kSaturated);
  EXPECT_EQ(wrist.sensor.read({{0.0, 0.0, 0.0}, {0.0, 260.0, 0.0}}).status, WristStatus::kSaturated);
  EXPECT_EQ(wrist.sensor.read({{0.0, -499.0, 10.0}, {}}).status, WristStatus::kGood);
}

// Bias within what is stated, another for every seed; noise of the stated size; the same seed reads the same.
TEST(WristSensor, BiasAndNoiseAreThoseThatAreStated) {
  const WristParams figures;
  double largest_N = 0.0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    WristSensor sensor(1, true, seed), same(1, true, seed);
    double sum = 0.0, squares = 0.0;
    constexpr int kReadings = 400;
    for (int i = 0; i < kReadings; ++i) {
      const WristReading reading = sensor.read({});
      ASSERT_EQ(reading.force, same.read({}).force);
      const double force_N = figures.force_step_N * reading.force[2];
      sum += force_N, squares += force_N * force_N;
    }
    const double mean = sum / kReadings, deviation = std::sqrt(squares / kReadings - mean * mean);
    EXPECT_NEAR(mean, sensor.bias().force_N.z, 0.05) << seed;
    EXPECT_NEAR(deviation, figures.force_noise_N, 0.04) << seed;
    EXPECT_LE(std::fabs(sensor.bias().force_N.z), figures.force_bias_N);
    largest_N = std::max(largest_N, std::fabs(sensor.bias().force_N.z));
  }
  EXPECT_GT(largest_N, 0.8 * figures.force_bias_N);
}

// req:B26
TEST(WristSensor, EachFaultShowsAsItIsSaid) {
  WristOnBus wrist;
  const TipLoad load{{0.0, 0.0, -20.0}, {}};
  wrist.tick(load);
  wrist.sensor.suffer({.failed = true});
  EXPECT_EQ(wrist.tick(load)[0].data[7], 2);
  wrist.sensor.suffer({.saturated = true});
  const FrameList saturated = wrist.tick(load);
  EXPECT_EQ(saturated[0].data[7], 1);
  EXPECT_EQ(static_cast<std::int16_t>(saturated[0].data[4] | (saturated[0].data[5] << 8)), -25000);
  wrist.sensor.suffer({});
  const FrameList before = wrist.tick(load);
  wrist.sensor.suffer({.stuck = true});
  const FrameList stuck = wrist.tick({{5.0, 5.0, 5.0}, {}});
  EXPECT_TRUE(std::equal(stuck[0].data.begin(), stuck[0].data.begin() + 6, before[0].data.begin()));
  EXPECT_NE(stuck[0].data[6], before[0].data[6]) << "its sequence goes on";
  EXPECT_EQ(stuck[0].data[7], 0);
  wrist.sensor.suffer({.silent = true});
  for (int i = 0; i < 60; ++i) EXPECT_TRUE(wrist.tick(load).empty());
}

TipState plate_at(double depth_m) { return {{{0.0, 0.0, depth_m}, {}}, {}, {}}; }

// The adapter with its electronics; the plate is where it is told.
struct AdapterOnBus {
  AdapterOnBus() { run(0.0, 1); }
  FrameList run(double depth_m, int ticks, FrameList in = {}) {
    FrameList out;
    for (int i = 0; i < ticks; ++i) {
      FrameList frames = i == 0 ? in : FrameList{};
      frames.push_back(kSync);
      node.exchange(frames, now_us += kTick_us, adapter, out);
      for (int k = 0; k < 16; ++k) adapter.step(0.00025, plate_at(depth_m));
    }
    return out;
  }
  // The last report of so many ticks.
  CanFrame report(double depth_m, int ticks) {
    CanFrame last;
    for (const CanFrame& frame : run(depth_m, ticks))
      if (frame.id == 0x1B0) last = frame;
    return last;
  }
  Adapter adapter;
  AdapterNode node{1};
  std::uint64_t now_us = 0;
};

// req:B19
TEST(AdapterNode, ReportsEveryFourthTickWithDepthsCaptureAndLatch) {
  AdapterOnBus on_bus;
  const FrameList out = on_bus.run(0.0123, 40);
  EXPECT_EQ(count(out, 0x1B0), 10U);
  const CanFrame before = on_bus.report(0.0123, 4);
  EXPECT_EQ(before.data[1], 0);
  for (std::size_t k = 4; k < 7; ++k) EXPECT_EQ(before.data[k], 123);
  const CanFrame after = on_bus.report(0.0205, 60);
  EXPECT_EQ(after.data[1], 1);
  EXPECT_EQ(after.data[2], 2) << "the latch is closed";
  EXPECT_EQ(after.data[3], 0);
  EXPECT_EQ(on_bus.report(-0.5, 4).data[4], 0) << "before the face";
}

TEST(AdapterNode, ACommandCountsOnceForEverySequenceNumber) {
  AdapterOnBus on_bus;
  on_bus.run(0.0205, 60);
  on_bus.run(0.0205, 4, {frame_of(0x230, {1, 1})});
  EXPECT_EQ(on_bus.adapter.lock(), Closure::kClosing);
  on_bus.run(0.0205, 1000);
  EXPECT_EQ(on_bus.adapter.lock(), Closure::kClosed);
  on_bus.run(0.0, 4, {frame_of(0x230, {2, 1})});
  EXPECT_EQ(on_bus.adapter.lock(), Closure::kClosed) << "that number was used";
  on_bus.run(0.0, 4, {frame_of(0x230, {2, 2})});
  EXPECT_EQ(on_bus.adapter.lock(), Closure::kOpen);
  EXPECT_FALSE(on_bus.adapter.captured());
}

// req:B21
TEST(AdapterLock, DrawsThePinsInByThreeMillimetresAndNeedsAClosedLatch) {
  Adapter adapter;
  adapter.begin_lock();
  EXPECT_EQ(adapter.lock(), Closure::kOpen);
  for (int i = 0; i < 1000; ++i) adapter.step(0.00025, plate_at(0.0205));
  ASSERT_EQ(adapter.latch(), Closure::kClosed);
  const double before_N = adapter.push(plate_at(0.0205)).force_N.z;
  adapter.begin_lock();
  for (int i = 0; i < 14000; ++i) adapter.step(0.00025, plate_at(0.0205));
  EXPECT_EQ(adapter.lock(), Closure::kClosed);
  EXPECT_NEAR(adapter.push(plate_at(0.0205)).force_N.z - before_N, 3 * 3e4 * 0.003, 1e-6);
}

TEST(AdapterLock, ThatFailsSaysSoHalfWayAndGoesOnWhenAskedAgain) {
  Adapter adapter;
  for (int i = 0; i < 1000; ++i) adapter.step(0.00025, plate_at(0.0205));
  adapter.break_lock();
  adapter.begin_lock();
  for (int i = 0; i < 15000; ++i) adapter.step(0.00025, plate_at(0.0205));
  EXPECT_EQ(adapter.lock(), Closure::kFailed);
  adapter.break_lock(false);
  adapter.begin_lock();
  for (int i = 0; i < 8000; ++i) adapter.step(0.00025, plate_at(0.0205));
  EXPECT_EQ(adapter.lock(), Closure::kClosed);
}

TEST(AdapterLatch, ThatDoesNotCloseSaysSoHalfASecondLater) {
  Adapter adapter;
  adapter.break_latch();
  for (int i = 0; i < 1200; ++i) adapter.step(0.00025, plate_at(0.0205));
  EXPECT_EQ(adapter.latch(), Closure::kClosing);
  for (int i = 0; i < 1600; ++i) adapter.step(0.00025, plate_at(0.0205));
  EXPECT_EQ(adapter.latch(), Closure::kFailed);
  EXPECT_TRUE(adapter.captured());
  EXPECT_FALSE(adapter.latched());
}

// req:B26
TEST(AdapterNode, EachFaultOfTheCaptureSignalShowsAsItIsSaid) {
  AdapterOnBus on_bus;
  on_bus.node.suffer({.early = true});
  EXPECT_EQ(on_bus.report(0.0, 4).data[1], 1);
  on_bus.node.suffer({.lost = true});
  const FrameList lost = on_bus.run(0.0, 100);
  EXPECT_EQ(count(lost, 0x1B0), 0U);
  EXPECT_GE(count(lost, 0x730), 3U);
  on_bus.node.suffer({.twice = true});
  const FrameList twice = on_bus.run(0.0, 4);
  ASSERT_EQ(count(twice, 0x1B0), 2U);
  on_bus.node.suffer({.stale = true});
  const CanFrame stale = on_bus.report(0.0205, 60);
  EXPECT_EQ(stale.data, twice.front().data);
  on_bus.node.suffer({.denied = true});
  const CanFrame denied = on_bus.report(0.0205, 8);
  EXPECT_TRUE(on_bus.adapter.captured());
  EXPECT_EQ(denied.data[1], 0);
  EXPECT_EQ(denied.data[2], 2) << "the latch is another sensor";
}

}  // namespace
}  // namespace liana::bench
