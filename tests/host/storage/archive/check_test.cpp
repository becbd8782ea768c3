// Whether an archive is whole: files that are missing are named, those that were dropped are not (req:A25).
#include "host/storage/archive/check.hpp"

#include <filesystem>

#include "host/storage/archive/database.hpp"
#include "host/storage/archive/recorder.hpp"
#include "host/storage/archive/schema.hpp"
#include "host/storage/archive/segments.hpp"
#include "tests/host/storage/archive/archive_folder.hpp"
#include "tests/message.hpp"

namespace liana::archive {
namespace {

class Whole : public ArchiveFolder {
 protected:
  // 20 s of telemetry in files of 5 s.
  void record(TelemetryLimits limits = {.file_s = 5.0}) const {
    Recorder recorder(folder_, life(), kInterval, limits);
    for (std::uint64_t tick = 0; tick < 5000; tick += kInterval) recorder.take(state_at(tick));
    recorder.finish();
  }
  void remove(std::uint64_t first_tick) const { std::filesystem::remove(segment_path(folder_, 1, first_tick)); }
};

TEST_F(Whole, AFileOfTelemetryThatIsMissingIsNamed) {
  record();
  EXPECT_TRUE(check(folder_).problems.empty());
  remove(1250);
  const Check found = check(folder_);
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_TRUE(names(found.problems[0], {"telemetry-1-000000001250.db", "missing"}));
}

TEST_F(Whole, EveryMissingFileIsNamedAlsoWhenAllAre) {
  record();
  for (const Segment& file : segments_in(folder_)) remove_segment(file);
  EXPECT_EQ(check(folder_).problems.size(), 4u);
}

TEST_F(Whole, AFileThatWasDroppedForRoomIsAGapAndNoProblem) {
  record({.file_s = 5.0, .bytes = 1});
  ASSERT_EQ(segments_in(folder_).size(), 1u);
  const Check found = check(folder_);
  EXPECT_TRUE(found.problems.empty()) << found.problems[0];
  EXPECT_EQ(found.lives.at(0).gaps.size(), 3u);
}

TEST_F(Whole, AnArchiveWithoutAListOfItsFilesIsAskedForAny) {
  record();
  Database(folder_ + "/" + kArchiveFile, Database::Open::kDurable).run("DROP TABLE telemetry_file");
  EXPECT_TRUE(check(folder_).problems.empty());
  for (const Segment& file : segments_in(folder_)) remove_segment(file);
  const Check found = check(folder_);
  ASSERT_EQ(found.problems.size(), 1u);
  EXPECT_TRUE(names(found.problems[0], {"telemetry-1-*.db", "missing"}));
}

}  // namespace
}  // namespace liana::archive
