// Files of telemetry: they follow each other, the oldest goes first, what is missing is said.
#include "host/storage/archive/telemetry_files.hpp"

#include <filesystem>
#include <random>

#include "host/storage/archive/segments.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"

namespace liana::archive {
namespace {

// Numbers that no compression makes small.
std::string noise(std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::string record(400, '\0');
  for (char& byte : record) byte = static_cast<char>(generator());
  return record;
}

class Telemetry : public ArchiveFolder {
 protected:
  TelemetryFiles files(TelemetryLimits limits) {
    return {folder_,
            1,
            kPeriod_s,
            limits,
            [this](const Gap& gap) { gaps_.push_back(gap); },
            [this](std::uint64_t first_tick) { files_.push_back(first_tick); }};
  }
  static void fill(TelemetryFiles& files, std::uint64_t first_s, std::uint64_t end_s) {
    for (std::uint64_t tick = first_s * 250; tick < end_s * 250; tick += kInterval) files.add(tick, noise(tick));
  }
  std::vector<Gap> gaps_;
  std::vector<std::uint64_t> files_;
};

TEST_F(Telemetry, ANewFileBeginsWhenTheOldOneIsLongEnough) {
  TelemetryFiles telemetry = files({.file_s = 10.0});
  fill(telemetry, 0, 35);
  telemetry.finish();
  const std::vector<Segment> found = segments_in(folder_);
  ASSERT_EQ(found.size(), 4u);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].first_tick, i * 2500);
  EXPECT_TRUE(gaps_.empty());
  EXPECT_EQ(files_, (std::vector<std::uint64_t>{0, 2500, 5000, 7500}));
}

// req:A25
TEST_F(Telemetry, BeyondItsLimitTheOldestFilesGoAndThatIsSaid) {
  TelemetryFiles telemetry = files({.file_s = 10.0, .bytes = 700000});  // a file takes 220 kB
  fill(telemetry, 0, 60);
  telemetry.finish();
  const std::vector<Segment> found = segments_in(folder_);
  ASSERT_GE(found.size(), 2u);
  ASSERT_LT(found.size(), 6u);
  EXPECT_LE(bytes_of(found), 700000u + 250000u);  // the newest is never dropped
  ASSERT_EQ(gaps_.size(), 6 - found.size());
  EXPECT_EQ(gaps_[0].first_tick, 0u);
  EXPECT_EQ(gaps_[0].last_tick, 2499u);
  EXPECT_EQ(gaps_[0].what, "telemetry");
  EXPECT_EQ(found.front().first_tick, gaps_.back().last_tick + 1);
}

TEST_F(Telemetry, MakesRoomOldestFileFirstAndInTheEndTheOneThatIsWritten) {
  TelemetryFiles telemetry = files({.file_s = 10.0});
  fill(telemetry, 0, 15);
  telemetry.flush();
  EXPECT_TRUE(telemetry.make_room());
  ASSERT_EQ(segments_in(folder_).size(), 1u);
  EXPECT_EQ(segments_in(folder_)[0].first_tick, 2500u);
  EXPECT_TRUE(telemetry.make_room());
  EXPECT_TRUE(segments_in(folder_).empty());
  EXPECT_FALSE(telemetry.make_room());
  fill(telemetry, 15, 17);
  telemetry.finish();
  EXPECT_EQ(segments_in(folder_).size(), 1u);
}

}  // namespace
}  // namespace liana::archive
