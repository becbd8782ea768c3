// The way back on disk: what is read is what was commanded, or less, and never anything else.
#include "host/control/server/retract_path_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "host/control/arbiter/path_history.hpp"
#include "tests/message.hpp"

namespace liana::server {
namespace {

using arbiter::WayChange;
using arbiter::WayPoint;

class FileOfTheWay : public testing::Test {
 protected:
  FileOfTheWay() : path_(testing::TempDir() + "liana_way_" + std::to_string(::getpid())) {}
  ~FileOfTheWay() override { std::filesystem::remove(path_); }

  static WayPoint point(double x, bool begins = false) { return {begins, {x, -x, 0.5 * x}}; }
  void write(const std::vector<WayChange>& changes) {
    RetractPathFile file(path_, kArm, 3);
    for (const WayChange& change : changes) file.follow(change);
  }
  std::vector<double> kept(const PathBasis& basis = kArm) {
    std::vector<double> out;
    RetractPathFile file(path_, basis, 3);
    const auto event = file.trouble();
    unused_ = event ? event->text : "";
    for (const WayPoint& each : file.kept().points) out.push_back(each.joint_rad[0]);
    return out;
  }
  // Changes one byte of the file.
  void damage(std::streamoff at) {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(at);
    const char byte = static_cast<char>(file.get() ^ 1);
    file.seekp(at);
    file.put(byte);
  }
  std::string why_not(const std::string& path) const {
    try {
      RetractPathFile(path, kArm, 3);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  inline static const PathBasis kArm{"an arm", "its table", "its calibration", "its scene"};
  static constexpr std::streamoff kHeader = 64, kRecord = 48;
  std::string unused_;  // what kept() was told of the file
  std::string path_;
};

TEST_F(FileOfTheWay, KeepsEveryPointToTheLastBit) {
  write({{0, 0, {point(0.1), point(1.0 / 3.0), point(0.7, true)}}});
  const RetractPathFile file(path_, kArm, 3);
  EXPECT_EQ(file.kept().first, 0u);
  EXPECT_EQ(file.kept().points, (std::vector<WayPoint>{point(0.1), point(1.0 / 3.0), point(0.7, true)}));
}

TEST_F(FileOfTheWay, FollowsWhatIsTakenOffAndAddedAgainInOneLifeAndInTwo) {
  write({{0, 0, {point(0), point(1), point(2), point(3)}}, {0, 2, {point(7)}}});
  EXPECT_EQ(kept(), (std::vector<double>{0, 1, 7}));
  write({{0, 1, {}}});
  EXPECT_EQ(kept(), (std::vector<double>{0}));
  write({{0, 1, {point(8), point(9)}}, {0, 0, {}}, {0, 0, {point(5)}}});
  EXPECT_EQ(kept(), (std::vector<double>{5}));
}

TEST_F(FileOfTheWay, IsARingWhoseOldestPointsGoFirst) {
  const std::uint64_t most = arbiter::kMaxRetractPoints;
  write({{0, 0, std::vector<WayPoint>(most, point(1))}, {2, most, {point(2), point(3)}}});
  const RetractPathFile file(path_, kArm, 3);
  EXPECT_EQ(file.kept().first, 2u);
  ASSERT_EQ(file.kept().points.size(), most);
  EXPECT_EQ(file.kept().points.back(), point(3));
  EXPECT_EQ(std::filesystem::file_size(path_), static_cast<std::uintmax_t>(kHeader) + most * kRecord);
}

TEST_F(FileOfTheWay, OfADamagedPointWhatFollowsItIsLeft) {
  write({{0, 0, {point(0), point(1), point(2), point(3)}}});
  damage(kHeader + 1 * kRecord + 20);
  EXPECT_EQ(kept(), (std::vector<double>{2, 3})) << "the way back from where the arm is, as far as it is known";
  write({{2, 4, {point(4)}}});
  EXPECT_EQ(kept(), (std::vector<double>{2, 3, 4}));
}

TEST_F(FileOfTheWay, VerifiedWithAnotherTableCalibrationOrSceneIsPutAsideAndSaysSo) {
  const std::string aside = path_ + ".unused";
  const struct {
    std::string PathBasis::*member;
    const char* word;
  } others[] = {
      {&PathBasis::robot, "robot table"}, {&PathBasis::calibration, "calibration"}, {&PathBasis::scene, "scene"}};
  for (const auto& [member, word] : others) {
    write({{0, 0, {point(0), point(1)}}});
    PathBasis other = kArm;
    other.*member = "another one";
    EXPECT_TRUE(kept(other).empty()) << word;
    EXPECT_TRUE(names(unused_, {path_, word, aside}));
    std::filesystem::rename(aside, path_);
    EXPECT_EQ(kept(), (std::vector<double>{0, 1})) << "it is there for whoever has the first " << word;
    EXPECT_EQ(unused_, "");
  }
}

// A start with the wrong table, and another one with the right table again.
TEST_F(FileOfTheWay, ThatIsEmptyDoesNotTakeThePlaceOfOneThatWasPutAside) {
  const std::string aside = path_ + ".unused", second = path_ + ".unused-2";
  PathBasis other = kArm;
  other.scene = "another one";
  write({{0, 0, {point(0), point(1)}}});
  EXPECT_TRUE(kept(other).empty());
  EXPECT_TRUE(kept().empty());
  EXPECT_EQ(unused_, "");
  write({{0, 0, {point(5)}}});
  EXPECT_TRUE(kept(other).empty());
  EXPECT_TRUE(names(unused_, {path_, "scene", second}));
  std::filesystem::rename(second, path_);
  EXPECT_EQ(kept(), (std::vector<double>{5}));
  std::filesystem::rename(aside, path_);
  EXPECT_EQ(kept(), (std::vector<double>{0, 1}));
}

TEST_F(FileOfTheWay, WithADamagedHeadingOrAnglesThatAreNoNumbersKeepsNothing) {
  for (const std::streamoff at : {8, 10, 12, 16, 24, 32, 40, 48, 63}) {
    write({{0, 0, {point(0), point(1)}}});
    damage(at);
    EXPECT_TRUE(kept().empty()) << at;
  }
  write({{0, 0, {point(0), point(std::nan("")), point(2)}}});
  EXPECT_EQ(kept(), (std::vector<double>{2}));
  for (const char* number : {"", "-2", "-3", "-4", "-5", "-6", "-7", "-8", "-9"})
    std::filesystem::remove(path_ + ".unused" + number);
}

TEST_F(FileOfTheWay, ThatIsNoneOrCannotBeMadeOrIsInUseIsRefusedAndLeftAlone) {
  std::ofstream(path_) << "a file of somebody else, longer than a heading of this one could be";
  EXPECT_TRUE(names(why_not(path_), {"--retract-path", path_, "way back"}));
  EXPECT_GT(std::filesystem::file_size(path_), 60u);
  std::filesystem::remove(path_);
  EXPECT_TRUE(names(why_not("/nonexistent/way"), {"--retract-path", "/nonexistent/way"}));
  const RetractPathFile file(path_, kArm, 3);
  EXPECT_NE(why_not(path_).find("another lianad"), std::string::npos);
}

// A full disk: half a way would lead into nothing.
TEST_F(FileOfTheWay, ThatCannotBeWrittenIsRemovedAndSaysSoOnce) {
  std::signal(SIGXFSZ, SIG_IGN);
  RetractPathFile file(path_, kArm, 3);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{static_cast<rlim_t>(kHeader + 2 * kRecord), before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  file.follow({0, 0, {point(0), point(1), point(2)}});
  std::optional<event::Event> trouble;
  for (int i = 0; i < 1000 && !trouble; ++i) {
    trouble = file.trouble();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_TRUE(trouble);
  EXPECT_EQ(trouble->number, event::number_of(event::HostTroubleEvent::kWayFile));
  EXPECT_FALSE(file.trouble());
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace liana::server
