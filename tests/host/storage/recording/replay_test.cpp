// Replay finds no difference in a true recording, and the first changed bit in a false one.
#include "host/storage/recording/replay.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "firmware_like/cable_controller.hpp"
#include "host/storage/recording/build_id.hpp"
#include "host/storage/recording/recording.hpp"
#include "host/storage/recording/tick_packet.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::recording {

using namespace cable;
namespace {

constexpr std::uint64_t kFirstTick = 40;

// Inputs of a run in which drives report slowly changing positions, one falls silent, and somebody asks for a clear.
cable::Inputs inputs_of(std::uint64_t tick) {
  cable::Inputs inputs;
  inputs.tick = tick;
  for (std::size_t i = 0; i < zhu2022::kCables; ++i) {
    DriveFeedback& drive = inputs.drive[i];
    drive.statusword = 0x0250;
    drive.position_counts = static_cast<std::int32_t>(1000000 + 10 * i + tick);
    drive.torque_permille = static_cast<std::int16_t>(60 + i);
    drive.feedback_age_ticks = i == 3 && tick > 100 ? 9 : 0;
    drive.heartbeat_age_ticks = 0;
    drive.operational = 1;
  }
  if (tick == 120) inputs.request = Request::kClear;
  return inputs;
}

std::string fresh_folder(const std::string& name) {
  const std::string folder = testing::TempDir() + "liana_" + std::to_string(::getpid()) + name;
  std::filesystem::create_directories(folder);
  return folder;
}

// Records `ticks` ticks; `change` may falsify what is written. An image is written at every tick in `images`.
template <class Change>
std::string record_run(const std::string& folder, std::uint64_t ticks, Change change,
                       std::uint64_t image_at = kFirstTick) {
  Recording recording(folder, {"hash", "{}", "{}", "{}", "fast", 0.004});
  cable::Controller controller(zhu2022::table());
  for (std::uint64_t tick = kFirstTick; tick < kFirstTick + ticks; ++tick) {
    if (tick == image_at) {
      recording.take(tick == kFirstTick ? image_packet<cable::CableArm>(tick, zhu2022::table())
                                        : image_packet<cable::CableArm>(tick, controller));
    }
    TickRecord<cable::CableArm> record{inputs_of(tick), controller.tick(inputs_of(tick))};
    change(record);
    recording.take(tick_packet<cable::CableArm>(record, 0, counts_of(zhu2022::table())));
  }
  recording.finish();
  return folder;
}

TEST(Replay, ATrueRecordingHasNoDifferingTick) {
  const ReplayResult result = replay(record_run(fresh_folder("true"), 200, [](TickRecord<cable::CableArm>&) {}));
  EXPECT_EQ(result.ticks, 200u);
  EXPECT_EQ(result.differing_ticks, 0u);
  EXPECT_TRUE(result.complete);
}

TEST(Replay, OneChangedBitIsFoundAndNamed) {
  const ReplayResult result = replay(record_run(fresh_folder("bit"), 200, [](TickRecord<cable::CableArm>& record) {
    if (record.outputs.tick == 77) record.outputs.drive[5].target_counts ^= 1;
  }));
  EXPECT_EQ(result.ticks, 200u);
  EXPECT_EQ(result.differing_ticks, 1u);
  EXPECT_EQ(result.first_differing_tick, 77u);
  EXPECT_EQ(result.first_differing_field, "drive[5].target_counts");
}

TEST(Replay, AChangedInputShowsInTheOutputs) {
  const ReplayResult result = replay(record_run(fresh_folder("input"), 100, [](TickRecord<cable::CableArm>& record) {
    if (record.inputs.tick == 60) record.inputs.drive[2].position_counts += 1000;
  }));
  EXPECT_GT(result.differing_ticks, 0u);
  EXPECT_EQ(result.first_differing_tick, 60u);
}

TEST(Replay, ARecordingThatStartsInMidRunGoesOnFromItsImage) {
  const ReplayResult result = replay(record_run(
      fresh_folder("image"), 200, [](TickRecord<cable::CableArm>&) {}, 150));
  EXPECT_EQ(result.ticks, kFirstTick + 200 - 150);
  EXPECT_EQ(result.missing_ticks, 150 - kFirstTick);
  EXPECT_EQ(result.differing_ticks, 0u);
}

TEST(Replay, DeadlinesThatWereLostAreNoGapInARecording) {
  const std::string folder = fresh_folder("lost");
  Recording recording(folder, {"hash", "{}", "{}", "{}", "real", 0.004});
  cable::Controller controller(zhu2022::table());
  recording.take(image_packet<cable::CableArm>(kFirstTick, zhu2022::table()));
  std::uint64_t tick = kFirstTick;
  for (const std::uint32_t lost : {0u, 0u, 4u, 0u, 1u, 0u}) {
    cable::Inputs inputs = inputs_of(tick += lost);
    inputs.lost_ticks = lost;
    recording.take(tick_packet<cable::CableArm>({inputs, controller.tick(inputs)}, 0, counts_of(zhu2022::table())));
    ++tick;
  }
  recording.finish();
  const ReplayResult result = replay(folder);
  EXPECT_EQ(result.ticks, 6u);
  EXPECT_EQ(result.missing_ticks, 0u);
  EXPECT_EQ(result.differing_ticks, 0u);
}

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Replay, AFlippedByteAnywhereIsNoticedBeforeTheCoreSeesIt) {
  const std::string folder = record_run(fresh_folder("flipped"), 100, [](TickRecord<cable::CableArm>&) {});
  const std::string file = folder + "/" + kRecordingFile, good = bytes_of(file);
  std::mt19937 draw(5);
  for (int i = 0; i < 100; ++i) {
    std::string bad = good;
    char& byte = bad[draw() % bad.size()];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1 + draw() % 255));
    std::ofstream(file, std::ios::binary) << bad;
    try {
      const ReplayResult result = replay(folder);
      EXPECT_FALSE(result.complete) << "byte " << &byte - bad.data();
    } catch (const std::runtime_error&) {
      // noticed and said
    }
  }
}

TEST(Replay, ARecordingCutShortIsComparedAsFarAsItGoesAndNotCalledComplete) {
  const std::string folder = record_run(fresh_folder("cut"), 2000, [](TickRecord<cable::CableArm>&) {});
  std::filesystem::resize_file(folder + "/" + kRecordingFile,
                               std::filesystem::file_size(folder + "/" + kRecordingFile) / 2);
  const ReplayResult result = replay(folder);
  EXPECT_FALSE(result.complete);
  EXPECT_GT(result.ticks, 10u);
  EXPECT_EQ(result.differing_ticks, 0u);
}

TEST(Replay, ItIsKnownWhoRecorded) {
  const ReplayResult result = replay(record_run(fresh_folder("build"), 5, [](TickRecord<cable::CableArm>&) {}));
  EXPECT_TRUE(result.same_build);
  EXPECT_EQ(result.recorded_by, build_id());
}

TEST(Replay, ARepeatedRunGivesTheSameFileByteForByte) {
  const auto recorded = [](const std::string& name) {
    return bytes_of(record_run(fresh_folder(name), 50, [](TickRecord<cable::CableArm>&) {}) + "/" + kRecordingFile);
  };
  const std::string first = recorded("one");
  EXPECT_EQ(first, recorded("two"));
  EXPECT_GT(first.size(), 1000u);
}

TEST(Replay, AFolderWithoutARecordingIsRefused) {
  EXPECT_THROW(replay(fresh_folder("none")), std::runtime_error);
  EXPECT_THROW(replay(record_run(
                   fresh_folder("no_image"), 5, [](TickRecord<cable::CableArm>&) {}, 0)),
               std::runtime_error);
}

}  // namespace
}  // namespace liana::recording
