// A recording of a serial arm replays as one of a cable arm does.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/replay.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "host/storage/recording/visit.hpp"
#include "tests/firmware_like/serial_rig.hpp"

namespace liana::recording {
namespace {

using serial::SerialArm;
using Change = std::function<void(TickRecord<SerialArm>&)>;

constexpr std::uint64_t kFirst = 40, kTicks = 400, kMoves = 200, kSilent = 330;

// A run as lianad would record it: switched on, told to move, and at last a drive that falls silent. The image stands
// before the tick `image_at`; `change` may falsify what is written.
std::string record_serial_run(const std::string& name, const Change& change, std::uint64_t image_at = kFirst) {
  const std::string folder = testing::TempDir() + "liana_serial_" + std::to_string(::getpid()) + name;
  std::filesystem::create_directories(folder);
  Recording recording(folder, {"hash", R"({"kind":"serial"})", "{}", "{}", "fast", 0.004});
  serial::micro::Rig rig;
  for (std::uint64_t tick = kFirst; tick < kFirst + kTicks; ++tick) {
    if (tick == image_at) {
      recording.take(tick == kFirst ? image_packet<SerialArm>(tick, rig.robot)
                                    : image_packet<SerialArm>(tick, rig.controller));
    }
    TickRecord<SerialArm> record;
    rig.now = tick;
    record.inputs.tick = tick;
    if (tick == kFirst + 60) record.inputs.request = Request::kEnable;
    if (tick == kMoves) record.inputs.telecommand = rig.release(rig.tip_by({0.02, 0.0, 0.01}));
    if (tick >= kSilent) rig.drive[3].feedback_age_ticks = 9;
    record.inputs.drive = rig.drive;
    rig.tick(record.inputs.request, record.inputs.telecommand);
    record.outputs = rig.out;
    change(record);
    recording.take(tick_packet<SerialArm>(record, 0, counts_of(rig.robot)));
  }
  recording.finish();
  EXPECT_TRUE(serial::micro::has_fault(rig.out, FaultNumber::kDriveSilent));
  return folder;
}

TEST(SerialReplay, ATrueRecordingHasNoDifferingTick) {
  double fastest_m_s = 0.0;
  const ReplayResult result = replay(record_serial_run("true", [&](TickRecord<SerialArm>& record) {
    fastest_m_s = std::max(fastest_m_s, record.outputs.tip_speed_m_s);
  }));
  EXPECT_EQ(result.ticks, kTicks);
  EXPECT_EQ(result.differing_ticks, 0u);
  EXPECT_TRUE(result.complete);
  EXPECT_GT(fastest_m_s, 1e-3) << "the arm moved";
}

TEST(SerialReplay, OneChangedBitIsFoundAndNamed) {
  const ReplayResult result = replay(record_serial_run("bit", [](TickRecord<SerialArm>& record) {
    if (record.outputs.tick == 77) record.outputs.drive[5].target_counts ^= 1;
    if (record.outputs.tick == 78) record.outputs.joint_command_rad[6] += 1e-16;
  }));
  EXPECT_EQ(result.differing_ticks, 2u);
  EXPECT_EQ(result.first_differing_tick, 77u);
  EXPECT_EQ(result.first_differing_field, "drive[5].target_counts");
}

TEST(SerialReplay, AFieldOfTheJointsIsNamedToo) {
  const ReplayResult result = replay(record_serial_run("joint", [](TickRecord<SerialArm>& record) {
    if (record.outputs.tick == 250) record.outputs.torque_measured_Nm[6] += 1.0;
  }));
  EXPECT_EQ(result.differing_ticks, 1u);
  EXPECT_EQ(result.first_differing_field, "torque_measured_Nm[6]");
}

TEST(SerialReplay, AChangedInputShowsInTheOutputs) {
  const ReplayResult result = replay(record_serial_run("input", [](TickRecord<SerialArm>& record) {
    if (record.inputs.tick == 60) record.inputs.drive[2].position_counts += 1000;
  }));
  EXPECT_GT(result.differing_ticks, 0u);
  EXPECT_EQ(result.first_differing_tick, 60u);
}

TEST(SerialReplay, ARecordingThatStartsInMidRunGoesOnFromItsImage) {
  const ReplayResult result = replay(record_serial_run(
      "image", [](TickRecord<SerialArm>&) {}, 250));
  EXPECT_EQ(result.ticks, kFirst + kTicks - 250);
  EXPECT_EQ(result.missing_ticks, 250 - kFirst);
  EXPECT_EQ(result.differing_ticks, 0u);
}

}  // namespace
}  // namespace liana::recording
