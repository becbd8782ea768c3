// Drives of the bench and the host's boot of them, without buses and arm between.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hil/drive/drive.hpp"
#include "host/drives/canopen/boot_sequence.hpp"
#include "tests/host/drives/bus/quiet_bus.hpp"

namespace liana::test {

// Frames wait here until the drives get them.
class FrameQueue final : public test::QuietBus {
 public:
  FrameQueue() : QuietBus(1) {}
  bus::SendResult send(int, const bus::CanFrame& frame) noexcept override {
    frames.push_back(frame);
    return bus::SendResult::kOk;
  }

  std::vector<bus::CanFrame> frames;
};

// What a master at 250 Hz expects of a drive of the bench, whatever its type and serial number.
inline canopen::ExpectedDrive expectation() {
  canopen::ExpectedDrive drive;
  drive.vendor = 0x4C49;
  drive.product = drive.revision = 1;
  drive.counts_per_turn = 65536;
  drive.rated_torque_mNm = 9000;
  drive.demand = {-100000, 100000, 7000};
  drive.period = {4, -3};
  drive.rpdo_deadline_ms = 12;
  drive.following_window_counts = 3476;
  return drive;
}

// One drive, booted as `expected` says, at 250 Hz.
class BootedDrive {
 public:
  BootedDrive(const canopen::ExpectedDrive& expected, const bench::DriveSettings& settings)
      : drive(settings, 1000.0), boot({expected}, kRate_hz) {}

  // Until the boot has ended, 1200 s at most.
  void run_boot() {
    for (int tick = 0; tick < 300000 && boot.state() == canopen::BootState::kRunning; ++tick) {
      boot.step(queue);
      pass_on();
    }
  }

  // One period: SYNC, motion, and the target for the next.
  void cycle(std::uint16_t controlword, std::int32_t target) {
    bus::CanFrame command{0x200U + static_cast<std::uint32_t>(drive.node()), 6, {}, 0};
    for (std::size_t i = 0; i < 2; ++i) command.data[i] = static_cast<std::uint8_t>(controlword >> (8 * i));
    for (std::size_t i = 0; i < 4; ++i)
      command.data[2 + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(target) >> (8 * i));
    queue.frames = {{0x080, 0, {}, 0}, {0x77F, 1, {0x05}, 0}, command};
    pass_on();
    for (int i = 0; i < 4; ++i) drive.move(0.001, 50.0);
  }

  // Through the states of CiA 402 to Operation enabled.
  void enable(std::int32_t target) {
    constexpr std::array<std::uint16_t, 6> kCommands{0x00, 0x06, 0x07, 0x0F, 0x0F, 0x0F};
    for (const std::uint16_t controlword : kCommands) cycle(controlword, target);
  }

  std::string refusals() const { return describe(boot.mismatches(0), boot.more_mismatches(0), "node 1 on can0"); }

  bench::Drive drive;
  canopen::BootSequence boot;
  FrameQueue queue;
  std::vector<std::uint16_t> emergencies;
  std::optional<bus::CanFrame> report;  // the last TPDO1; whoever takes it resets it
  std::uint64_t power_us = 0;           // before this it has no power

 private:
  static constexpr double kRate_hz = 250.0;
  static constexpr std::uint64_t kPeriod_us = 4000;

  void pass_on() {
    now_us_ += kPeriod_us;
    if (now_us_ < power_us) return queue.frames.clear();
    bench::FrameList out;
    for (const bus::CanFrame& frame : queue.frames) {
      bench::CanFrame there;
      there.time_us = now_us_;
      there.id = frame.id;
      there.length = frame.length;
      std::copy(frame.data.begin(), frame.data.begin() + frame.length, there.data.begin());
      drive.receive(there, out);
    }
    queue.frames.clear();
    drive.tick(now_us_, out);
    for (const bench::CanFrame& frame : out) {
      bus::CanFrame here{frame.id, frame.length, {}, 0};
      std::copy(frame.data.begin(), frame.data.begin() + frame.length, here.data.begin());
      if (here.id == 0x080U + static_cast<std::uint32_t>(drive.node()))
        emergencies.push_back(static_cast<std::uint16_t>(here.data[0] | here.data[1] << 8));
      if (here.id == 0x180U + static_cast<std::uint32_t>(drive.node())) report = here;
      boot.on_frame(0, here);
    }
  }

  std::uint64_t now_us_ = 0;
};

}  // namespace liana::test
