// A drive and a master that talks to it frame by frame.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/drive/drive.hpp"

namespace liana::bench {

class DriveHarness : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kNode = 5;
  static constexpr std::uint64_t kPeriod_us = 4000;

  static DriveSettings settings() {
    DriveSettings settings;
    settings.node = kNode;
    settings.vendor = 0x4C49;
    settings.product = 1;
    settings.serial = 70412;
    settings.revision = 1;
    return settings;
  }

  DriveHarness() : DriveHarness(settings()) {}
  explicit DriveHarness(const DriveSettings& settings) : drive_(settings, 1000.0) {}

  FrameList give(std::uint32_t id, std::vector<std::uint8_t> bytes) {
    CanFrame frame;
    frame.time_us = now_us_;
    frame.id = id;
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    FrameList out;
    drive_.receive(frame, out);
    return out;
  }

  FrameList tick(std::uint64_t after_us = 0) {
    now_us_ += after_us;
    FrameList out;
    drive_.tick(now_us_, out);
    return out;
  }

  // The SDO server's eight bytes.
  std::vector<std::uint8_t> sdo(std::vector<std::uint8_t> request) {
    request.resize(8);
    const FrameList out = give(0x600 + kNode, request);
    if (out.size() != 1 || out[0].id != 0x580 + kNode) return {};
    return {out[0].data.begin(), out[0].data.end()};
  }

  // The request of an expedited write.
  static std::vector<std::uint8_t> write_request(std::uint16_t index, std::uint8_t sub, std::size_t size,
                                                 std::uint32_t value) {
    std::vector<std::uint8_t> request(8);
    request[0] = static_cast<std::uint8_t>(0x23U | ((4U - size) << 2U));
    put_little_endian(&request[1], 2, index);
    request[3] = sub;
    put_little_endian(&request[4], size, value);
    return request;
  }

  // Abort code of it, 0 when accepted.
  std::uint32_t write(std::uint16_t index, std::uint8_t sub, std::size_t size, std::uint32_t value) {
    return aborted(sdo(write_request(index, sub, size, value)));
  }

  std::optional<std::uint32_t> read(std::uint16_t index, std::uint8_t sub) {
    last_ = sdo({0x40, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), sub});
    if (last_.empty() || (last_[0] & 0xE3) != 0x43) return std::nullopt;
    return static_cast<std::uint32_t>(get_little_endian(&last_[4], 4U - ((last_[0] >> 2U) & 3U)));
  }

  static std::uint32_t aborted(const std::vector<std::uint8_t>& answer) {
    if (answer.empty()) return 0xFFFFFFFF;
    return answer[0] == 0x80 ? static_cast<std::uint32_t>(get_little_endian(&answer[4], 4)) : 0;
  }

  void boot() { tick(); }

  // RPDO1 and TPDO1 as docs/reference/drives.md wants them, heartbeats both ways, mode csp, then NMT start; or what is
  // given.
  void configure(std::uint32_t deadline_ms = 12, const std::vector<std::uint32_t>& received = {0x60400010, 0x607A0020},
                 std::uint32_t mode = 8) {
    for (const auto& [receive, mapped] :
         {std::pair{true, received},
          std::pair{false, std::vector<std::uint32_t>{0x60410010, 0x60640020, 0x60770010}}}) {
      const auto communication = static_cast<std::uint16_t>(receive ? 0x1400 : 0x1800);
      const auto mapping = static_cast<std::uint16_t>(communication + 0x200);
      const std::uint32_t cob = (receive ? 0x200U : 0x180U) + kNode;
      EXPECT_EQ(write(communication, 1, 4, cob | 0x80000000U), 0U);
      EXPECT_EQ(write(mapping, 0, 1, 0), 0U);
      for (std::size_t i = 0; i < mapped.size(); ++i)
        EXPECT_EQ(write(mapping, static_cast<std::uint8_t>(i + 1), 4, mapped[i]), 0U);
      EXPECT_EQ(write(mapping, 0, 1, static_cast<std::uint32_t>(mapped.size())), 0U);
      EXPECT_EQ(write(communication, 2, 1, 1), 0U);
      EXPECT_EQ(write(communication, 5, 2, receive ? deadline_ms : 0), 0U);
      EXPECT_EQ(write(communication, 1, 4, cob), 0U);
    }
    EXPECT_EQ(write(0x6060, 0, 1, mode), 0U);
    EXPECT_EQ(write(0x1016, 1, 4, (127U << 16U) | 300U), 0U);
    give(0x000, {0x01, kNode});
  }

  void command(int controlword, std::int32_t target) {
    const auto t = static_cast<std::uint32_t>(target);
    give(0x200 + kNode, {static_cast<std::uint8_t>(controlword), static_cast<std::uint8_t>(controlword >> 8),
                         static_cast<std::uint8_t>(t), static_cast<std::uint8_t>(t >> 8),
                         static_cast<std::uint8_t>(t >> 16), static_cast<std::uint8_t>(t >> 24)});
  }

  // One period: SYNC, what was sent, motion, then the next command; returns everything the drive sent.
  FrameList cycle(std::optional<int> controlword, std::int32_t target) {
    now_us_ += kPeriod_us;
    FrameList out = give(0x080, {});
    const FrameList later = tick();
    out.insert(out.end(), later.begin(), later.end());
    for (int i = 0; i < 4; ++i) drive_.move(0.001, 50.0);
    if (controlword) command(*controlword, target);
    return out;
  }

  void enable(std::int32_t target = 1000) {
    for (const int controlword : {0x06, 0x07, 0x0F, 0x0F}) cycle(controlword, target);
    ASSERT_EQ(drive_.power_state(), PowerState::kOperationEnabled);
  }

  static std::optional<CanFrame> find(const FrameList& frames, std::uint32_t id) {
    for (const auto& frame : frames)
      if (frame.id == id) return frame;
    return std::nullopt;
  }

  // Emergency code among the frames, -1 when there is none.
  static int emergency(const FrameList& frames) {
    const auto frame = find(frames, 0x080 + kNode);
    return frame ? static_cast<int>(get_little_endian(frame->data.data(), 2)) : -1;
  }

  Drive drive_;
  std::uint64_t now_us_ = 0;
  std::vector<std::uint8_t> last_;
};

}  // namespace liana::bench
