// The wires of the embedded bus: bit time, arbitration, bounded queues, scripted loss.
#include "host/drives/bus_simulator/bus_sim.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include "tests/message.hpp"

namespace liana::bus_simulator {
namespace {

struct Recorder : FrameSink {
  std::vector<EndedFrame> ended;
  std::vector<bus::CanFrame> errors;
  std::vector<bool> links;
  void frame_ended(const EndedFrame& frame) override { ended.push_back(frame); }
  void error_state_changed(int, const bus::CanFrame& frame) override { errors.push_back(frame); }
  void link_changed(int, bool is_up) override { links.push_back(is_up); }
};

bus::CanFrame frame_of(std::uint32_t id, std::uint8_t length = 0) {
  bus::CanFrame frame;
  frame.id = id;
  frame.length = length;
  return frame;
}

struct Bench {
  explicit Bench(FaultScript script = {}, std::uint32_t bitrate = 1000000)
      : sim({{"can0", bitrate}, {"can1", bitrate}}, 4000, 2, std::move(script), recorder) {}

  void run_until_idle() {
    sim.arbitrate(now_ns);
    while (sim.next_end_ns() != kNeverNs) {
      now_ns = sim.next_end_ns();
      sim.finish(now_ns);
      sim.arbitrate(now_ns);
    }
  }

  bool queue(int participant, int bus, const bus::CanFrame& frame) {
    return sim.queue(participant, bus, frame, now_ns);
  }

  Recorder recorder;
  BusSim sim;
  std::uint64_t now_ns = 0;
};

TEST(BusSim, AFrameOccupiesTheWireForExactlyItsBits) {
  Bench bench({}, 500000);
  bench.queue(0, 0, frame_of(0x201, 6));
  bench.run_until_idle();
  ASSERT_EQ(bench.recorder.ended.size(), 1U);
  EXPECT_EQ(bench.recorder.ended[0].frame.time_us, 2U * bus::frame_bits(frame_of(0x201, 6)));
  EXPECT_EQ(bench.sim.stats(0).bits, bus::frame_bits(frame_of(0x201, 6)));
}

TEST(BusSim, PendingFramesGoInTheOrderOfTheirIdentifiersWhoeverSendsThem) {
  Bench bench;
  for (const std::uint32_t id : {0x603U, 0x201U, 0x080U}) bench.queue(0, 0, frame_of(id));
  for (const std::uint32_t id : {0x182U, 0x081U, 0x701U}) bench.queue(1, 0, frame_of(id));
  bench.run_until_idle();
  std::vector<std::uint32_t> order;
  for (const EndedFrame& each : bench.recorder.ended) order.push_back(each.frame.id);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0x080, 0x081, 0x182, 0x201, 0x603, 0x701}));
}

TEST(BusSim, AFrameOnTheWireIsNotInterruptedByAHigherPriority) {
  Bench bench;
  bench.queue(0, 0, frame_of(0x700));
  bench.sim.arbitrate(0);
  bench.queue(1, 0, frame_of(0x080));
  bench.run_until_idle();
  EXPECT_EQ(bench.recorder.ended[0].frame.id, 0x700U);
  EXPECT_EQ(bench.recorder.ended[1].frame.id, 0x080U);
}

TEST(BusSim, FramesWithEqualIdentifiersKeepTheirOrder) {
  Bench bench;
  for (std::uint8_t i = 0; i < 5; ++i) {
    bus::CanFrame frame = frame_of(0x601, 1);
    frame.data[0] = i;
    bench.queue(0, 0, frame);
  }
  bench.run_until_idle();
  for (std::uint8_t i = 0; i < 5; ++i) EXPECT_EQ(bench.recorder.ended[i].frame.data[0], i);
}

TEST(BusSim, TheWiresDoNotDisturbEachOther) {
  Bench bench;
  bench.queue(0, 0, frame_of(0x080));
  bench.queue(0, 1, frame_of(0x080));
  EXPECT_TRUE(bench.sim.is_sync_under_way());
  bench.run_until_idle();
  EXPECT_EQ(bench.recorder.ended[0].frame.time_us, bench.recorder.ended[1].frame.time_us);
  EXPECT_FALSE(bench.sim.is_sync_under_way());
}

TEST(BusSim, The65thFrameIsRefusedAndOneOnTheWireNoLongerCounts) {
  Bench bench;
  for (int i = 0; i < 64; ++i) EXPECT_TRUE(bench.queue(0, 0, frame_of(0x601)));
  EXPECT_FALSE(bench.queue(0, 0, frame_of(0x601)));
  EXPECT_TRUE(bench.queue(1, 0, frame_of(0x581))) << "the other participant has a queue of its own";
  EXPECT_TRUE(bench.queue(0, 1, frame_of(0x601))) << "and so has the other bus";
  EXPECT_EQ(bench.sim.stats(0).refused, 1U);
  bench.sim.arbitrate(0);  // 0x581 wins
  EXPECT_FALSE(bench.queue(0, 0, frame_of(0x601)));
  bench.now_ns = bench.sim.next_end_ns();
  bench.sim.finish(bench.now_ns);
  bench.sim.arbitrate(bench.now_ns);
  EXPECT_TRUE(bench.queue(0, 0, frame_of(0x601)));
}

TEST(FaultScript, FramesOfTheNamedSlotsOccupyTheWireButGetLost) {
  Bench bench(FaultScript({{BusAction::kDrop, 0, 1, 2, 0x181}}));
  for (std::uint64_t slot = 0; slot < 5; ++slot) {
    bench.now_ns = slot * 4'000'000;
    for (const int bus : {0, 1}) {
      bench.queue(1, bus, frame_of(0x181, 8));
      bench.queue(1, bus, frame_of(0x182, 8));
    }
    bench.run_until_idle();
  }
  for (const EndedFrame& each : bench.recorder.ended) {
    const std::uint64_t slot = each.frame.time_us / 4000;
    EXPECT_EQ(each.dropped, each.bus == 0 && each.frame.id == 0x181 && (slot == 1 || slot == 2)) << slot;
  }
  EXPECT_EQ(bench.sim.stats(0).dropped, 2U);
  EXPECT_EQ(bench.sim.stats(1).dropped, 0U);
  EXPECT_EQ(bench.sim.stats(0).bits, bench.sim.stats(1).bits);
}

// Writes `text` to a file and reads it as a script of two buses; the message when it is refused.
std::string message_for(const std::string& text) {
  const std::string path = testing::TempDir() + "/script.json";
  std::ofstream(path) << text;
  try {
    load_fault_script(path, 2);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(FaultScript, ReadsIdentifiersAndWholeBuses) {
  const std::string path = testing::TempDir() + "/good_script.json";
  std::ofstream(path) << R"([{"bus":0,"id":"0x181","from_slot":100,"to_slot":102,"action":"drop"},
                             {"bus":1,"from_slot":5,"to_slot":5,"count":2,"action":"duplicate"},
                             {"bus":1,"id":"0x000","data":"8104","from_slot":7,"load_percent":30,"action":"send"}])";
  FaultScript script = load_fault_script(path, 2);
  EXPECT_FALSE(script.takes(BusAction::kDrop, 0, 0x181, 99));
  EXPECT_TRUE(script.takes(BusAction::kDrop, 0, 0x181, 100));
  EXPECT_TRUE(script.takes(BusAction::kDrop, 0, 0x181, 102));
  EXPECT_FALSE(script.takes(BusAction::kDrop, 0, 0x181, 103));
  EXPECT_FALSE(script.takes(BusAction::kDrop, 0, 0x182, 100));
  EXPECT_TRUE(script.takes(BusAction::kDuplicate, 1, 0x7FF, 5));
  EXPECT_TRUE(script.takes(BusAction::kDuplicate, 1, 0x080, 5));
  EXPECT_FALSE(script.takes(BusAction::kDuplicate, 1, 0x080, 5)) << "two frames were to be taken";
  const BusFault& stranger = script.faults()[2];
  EXPECT_EQ(stranger.to_slot, kLastSlot);
  EXPECT_EQ(stranger.load_percent, 30);
  EXPECT_EQ(stranger.frame.length, 2);
  EXPECT_EQ(stranger.frame.data[0], 0x81);
}

TEST(FaultScript, RefusesWhatItDoesNotUnderstandAndNamesIt) {
  EXPECT_TRUE(names(message_for("{}"), {"array"}));
  EXPECT_TRUE(names(message_for(R"([{"bus":0,"from_slot":1e400}])"), {"[0].from_slot", "1e400"}));
  EXPECT_NE(message_for(R"([{"bus":2,"from_slot":1,"to_slot":2,"action":"drop"}])").find("[0].bus: 2"),
            std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":3,"to_slot":2,"action":"drop"}])").find("to_slot: 2"),
            std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":1,"to_slot":2,"action":"burn"}])").find("action"), std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"id":"zz","from_slot":1,"to_slot":2,"action":"drop"}])").find("id: \"zz\""),
            std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":1,"action":"cut","count":3}])").find("count: 3"), std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":1,"action":"swap","with_bus":0}])").find("with_bus: 0"),
            std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":1,"action":"send","data":"00"}])").find("id: missing"),
            std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":1,"action":"send","id":"0x1","data":"0"}])").find("data: \"0\""),
            std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"from_slot":1,"action":"drop","count":0}])").find("count: 0"), std::string::npos);
  EXPECT_NE(message_for(R"([{"bus":0,"slot":1,"from_slot":1,"to_slot":2,"action":"drop"}])").find("slot: 1"),
            std::string::npos);
}

}  // namespace
}  // namespace liana::bus_simulator
