// Scripted faults of the embedded bus beyond loss: what arrives, in which order, and what the controller's interface
// says.
#include <gtest/gtest.h>
#include <linux/can/error.h>

#include "host/drives/bus_simulator/bus_sim.hpp"

namespace liana::bus_simulator {
namespace {

constexpr std::uint64_t kSlotNs = 4'000'000;
constexpr int kPlant = 1;

bus::CanFrame full_frame(std::uint32_t id) {
  bus::CanFrame frame;
  frame.id = id;
  frame.length = 8;
  return frame;
}

class Wires : private FrameSink {
 public:
  explicit Wires(std::vector<BusFault> faults)
      : sim({{"can0", 1000000}, {"can1", 1000000}}, 4000, 2, FaultScript(std::move(faults)), *this) {}

  // Lets virtual time go on to the start of `slot`.
  void run_to(std::uint64_t slot) {
    sim.arbitrate(now_ns);
    while (sim.next_end_ns() < slot * kSlotNs) {
      now_ns = sim.next_end_ns();
      sim.finish(now_ns);
      sim.arbitrate(now_ns);
    }
    now_ns = slot * kSlotNs;
    sim.arbitrate(now_ns);
  }
  bool send(int sender, int bus, std::uint32_t id) { return sim.queue(sender, bus, full_frame(id), now_ns); }
  // Identifiers that the controller has heard at its connector `bus`, and the plant on the wire `bus`.
  std::vector<std::uint32_t> heard_by_controller(int bus) const {
    return ids([=](const EndedFrame& each) {
      return each.sender != kController && each.heard_by_controller && each.controller_bus == bus;
    });
  }
  std::vector<std::uint32_t> heard_by_plant(int bus) const {
    return ids([=](const EndedFrame& each) { return each.sender != kPlant && each.bus == bus; });
  }

  std::vector<bus::CanFrame> errors;
  std::vector<bool> links;
  BusSim sim;
  std::uint64_t now_ns = 0;

 private:
  template <typename Wanted>
  std::vector<std::uint32_t> ids(const Wanted& wanted) const {
    std::vector<std::uint32_t> found;
    for (const EndedFrame& each : ended_) {
      if (!each.dropped && wanted(each)) found.push_back(each.frame.id);
    }
    return found;
  }
  void frame_ended(const EndedFrame& ended) override { ended_.push_back(ended); }
  void error_state_changed(int, const bus::CanFrame& frame) override { errors.push_back(frame); }
  void link_changed(int, bool is_up) override { links.push_back(is_up); }

  std::vector<EndedFrame> ended_;
};

using Ids = std::vector<std::uint32_t>;

BusFault on_bus_0(BusAction action, std::uint64_t from_slot, std::uint64_t to_slot) {
  return {action, 0, from_slot, to_slot};
}

TEST(BusFaults, ADuplicateIsTheSameFrameSentOnceMore) {
  Wires wires({on_bus_0(BusAction::kDuplicate, 0, 0)});
  wires.send(kPlant, 0, 0x181);
  wires.send(kPlant, 0, 0x182);
  wires.run_to(1);
  wires.send(kPlant, 0, 0x183);
  wires.run_to(2);
  EXPECT_EQ(wires.heard_by_controller(0), (Ids{0x181, 0x181, 0x182, 0x182, 0x183}));
  EXPECT_EQ(wires.sim.stats(0).frames, 5U);
}

TEST(BusFaults, AReorderedFrameArrivesAfterTheNextOne) {
  BusFault one = on_bus_0(BusAction::kReorder, 0, kLastSlot);
  one.count = 1;
  Wires wires({one});
  for (const std::uint32_t id : {0x181U, 0x182U, 0x183U}) wires.send(kPlant, 0, id);
  wires.run_to(1);
  EXPECT_EQ(wires.heard_by_controller(0), (Ids{0x182, 0x181, 0x183}));
}

TEST(BusFaults, ADisturbedFrameIsSentAgainAndCosts20BitsMore) {
  BusFault one = on_bus_0(BusAction::kDisturb, 0, kLastSlot);
  one.count = 1;
  Wires wires({one});
  wires.send(kController, 0, 0x201);
  wires.run_to(1);
  EXPECT_EQ(wires.heard_by_plant(0), Ids{0x201});
  EXPECT_EQ(wires.sim.stats(0).bits, 2 * bus::frame_bits(full_frame(0x201)) + kErrorFrameBits);
  EXPECT_TRUE(wires.errors.empty()) << "8 is far from the warning at 96";
}

TEST(BusFaults, SixteenDestroyedFramesMakeTheControllerPassiveAnd32MakeItBusOff) {
  Wires wires({on_bus_0(BusAction::kDisturb, 0, 5)});
  wires.send(kController, 0, 0x080);
  wires.send(kController, 1, 0x080);
  wires.run_to(5);
  ASSERT_EQ(wires.errors.size(), 3U);
  EXPECT_EQ(wires.errors[0].data[1], CAN_ERR_CRTL_TX_WARNING);
  EXPECT_EQ(wires.errors[0].data[6], 96);
  EXPECT_EQ(wires.errors[1].data[1], CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(wires.errors[1].data[6], 128);
  EXPECT_EQ(wires.errors[2].id, bus::kCanErrorFlag | CAN_ERR_BUSOFF);
  EXPECT_EQ(wires.sim.stats(0).disturbed, 32U);
  EXPECT_EQ(wires.heard_by_plant(1), Ids{0x080}) << "the other bus is well";
  EXPECT_TRUE(wires.send(kController, 0, 0x201)) << "Linux takes frames in bus-off, and forgets them";
  wires.send(kPlant, 0, 0x701);
  wires.run_to(8);
  EXPECT_EQ(wires.heard_by_plant(0), Ids{});
  EXPECT_EQ(wires.heard_by_controller(0), Ids{});
}

TEST(BusFaults, ARestartEndsBusOff) {
  Wires wires({on_bus_0(BusAction::kDisturb, 0, 2), on_bus_0(BusAction::kRestart, 5, 5)});
  wires.send(kController, 0, 0x080);
  wires.run_to(6);
  EXPECT_EQ(wires.errors.back().id, bus::kCanErrorFlag | CAN_ERR_RESTARTED);
  wires.send(kController, 0, 0x201);
  wires.run_to(7);
  EXPECT_EQ(wires.heard_by_plant(0), Ids{0x201});
}

TEST(BusFaults, WithoutAnybodyToAcknowledgeTheControllerIsPassiveAndNeverBusOff) {
  Wires wires({on_bus_0(BusAction::kCut, 0, 9)});
  wires.send(kController, 0, 0x201);
  wires.send(kPlant, 0, 0x181);
  wires.run_to(9);
  ASSERT_EQ(wires.errors.size(), 2U);
  EXPECT_EQ(wires.errors[1].data[1], CAN_ERR_CRTL_TX_PASSIVE);
  EXPECT_EQ(wires.heard_by_plant(0), Ids{});
  EXPECT_EQ(wires.heard_by_controller(0), Ids{});
  wires.run_to(12);
  EXPECT_EQ(wires.heard_by_plant(0), Ids{0x201}) << "it goes on trying, and succeeds when the cable is back";
}

TEST(BusFaults, ARefusedFrameIsTheControllersOnly) {
  BusFault target = on_bus_0(BusAction::kRefuse, 0, 0);
  target.id = 0x201;
  Wires wires({target});
  EXPECT_FALSE(wires.send(kController, 0, 0x201));
  EXPECT_TRUE(wires.send(kController, 0, 0x202));
  EXPECT_TRUE(wires.send(kPlant, 0, 0x201));
  EXPECT_EQ(wires.sim.stats(0).refused, 1U);
}

TEST(BusFaults, AnInterfaceThatIsDownForgetsItsQueueAndHearsNothing) {
  Wires wires({on_bus_0(BusAction::kDown, 1, 2)});
  wires.run_to(1);
  wires.send(kController, 0, 0x201);
  wires.send(kPlant, 0, 0x181);
  wires.run_to(3);
  wires.send(kController, 0, 0x202);
  wires.run_to(4);
  EXPECT_EQ(wires.links, (std::vector<bool>{false, true}));
  EXPECT_EQ(wires.heard_by_plant(0), Ids{0x202});
  EXPECT_EQ(wires.heard_by_controller(0), Ids{});
}

TEST(BusFaults, WithSwappedCablesEachConnectorIsOnTheOtherWire) {
  BusFault swap = on_bus_0(BusAction::kSwap, 0, 0);
  swap.with_bus = 1;
  Wires wires({swap});
  wires.send(kController, 0, 0x201);
  wires.send(kPlant, 0, 0x181);
  wires.run_to(1);
  wires.send(kController, 0, 0x202);
  wires.run_to(2);
  EXPECT_EQ(wires.heard_by_plant(1), Ids{0x201});
  EXPECT_EQ(wires.heard_by_plant(0), Ids{0x202});
  EXPECT_EQ(wires.heard_by_controller(1), Ids{0x181});
}

TEST(BusFaults, AStrangerTakesItsShareOfTheWireByPriority) {
  BusFault babble = on_bus_0(BusAction::kSend, 0, 0);
  babble.frame = full_frame(0x100);
  babble.load_percent = 50;
  Wires wires({babble});
  for (const std::uint32_t id : {0x080U, 0x100U, 0x101U}) wires.send(kController, 0, id);
  wires.run_to(2);
  const Ids heard = wires.heard_by_plant(0);
  const std::size_t strangers = 4000 / 2 / bus::frame_bits(babble.frame);
  ASSERT_EQ(heard.size(), strangers + 3);
  EXPECT_EQ(heard.front(), 0x080U);
  EXPECT_EQ(heard[1], 0x100U) << "of equals a participant is first";
  EXPECT_EQ(heard.back(), 0x101U);
  EXPECT_EQ(wires.heard_by_controller(0), Ids(strangers, 0x100));
}

TEST(BusFaults, APausedControllerGoesOnWithTheFirstSlotAfterThePause) {
  const FaultScript script({{BusAction::kPause, 0, 10, 12}});
  EXPECT_EQ(script.awake_from(9), 9U);
  EXPECT_EQ(script.awake_from(10), 13U);
  EXPECT_EQ(script.awake_from(12), 13U);
  EXPECT_EQ(script.awake_from(13), 13U);
}

}  // namespace
}  // namespace liana::bus_simulator
