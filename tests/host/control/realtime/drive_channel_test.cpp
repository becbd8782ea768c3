// What the drives' line makes of frames: reports, and who else speaks under a drive's identifiers.
#include "host/control/realtime/drive_channel.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "firmware_like/safety/drive_link_monitor.hpp"
#include "tests/host/drives/bus/quiet_bus.hpp"

namespace liana::realtime {
namespace {

// Gives the frames that a test lays into it; what is sent is lost.
class FrameSource final : public test::QuietBus {
 public:
  FrameSource() : QuietBus(1) {}
  bool receive(bus::ReceivedFrame& received) noexcept override {
    if (at >= frames.size()) return false;
    received = {0, frames[at++]};
    return true;
  }

  std::vector<bus::CanFrame> frames;
  std::size_t at = 0;
};

bus::CanFrame report(std::uint8_t position) { return {0x182, 8, {0x27, 0, position, 0, 0, 0, 0, 0}, 0}; }
const bus::CanFrame kForeignTarget{0x202, 6, {0x0F, 0, 0, 0, 0, 0}, 0};

class TwoVoices : public ::testing::Test {
 protected:
  TwoVoices() : line_(drives(), buses(), bus_) {}

  static config::BusesConfig buses() {
    config::BusesConfig buses;
    buses.rate_hz = 250.0;
    buses.heartbeat_ms = 100;
    buses.buses = {{"can0", 1000000, {1, 2}}};
    return buses;
  }
  static std::vector<canopen::ExpectedDrive> drives() {
    std::vector<canopen::ExpectedDrive> drives(2);
    drives[0].node = 1;
    drives[1].node = 2;
    return drives;
  }
  std::uint32_t mask_after(const std::vector<bus::CanFrame>& frames, std::uint32_t lost_ticks = 0) {
    bus_.frames = frames;
    bus_.at = 0;
    line_.collect({++tick_, 0, lost_ticks, false}, inputs_);
    return inputs_.twice_mask;
  }

  FrameSource bus_;
  DriveChannel line_;
  CycleInputs inputs_;
  std::uint64_t tick_ = 0;
};

TEST_F(TwoVoices, AreNamedAfterEightTicksInARowWithReportsThatDiffer) {
  for (int i = 1; i < kTwiceTicks; ++i) EXPECT_EQ(mask_after({report(1), report(2)}), 0U) << i;
  EXPECT_EQ(mask_after({report(1), report(2)}), 2U);
  EXPECT_EQ(mask_after({report(1)}), 0U) << "gone as soon as one is silent";
}

TEST_F(TwoVoices, ACommandThatIsNotOursIsOne) {
  for (int i = 1; i < kTwiceTicks; ++i) EXPECT_EQ(mask_after({report(1), kForeignTarget}), 0U);
  EXPECT_EQ(mask_after({report(1), kForeignTarget}), 2U);
}

TEST_F(TwoVoices, FramesThatTheBusDoublesOrDelaysAreNone) {
  for (int i = 0; i < 50; ++i) EXPECT_EQ(mask_after({report(1), report(1)}), 0U) << "the same twice";
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(mask_after({}), 0U);
    EXPECT_EQ(mask_after({report(1), report(2)}), 0U) << "late, with the next one";
  }
  for (int i = 0; i < 50; ++i) EXPECT_EQ(mask_after({report(1), report(2)}, 1), 0U) << "after a tick that was lost";
}

}  // namespace
}  // namespace liana::realtime
