// The CSV file of a tracker, its clock beside the run's, and where its marker stood.
#include "host/drives/calibration/tracker_track.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/base/random/random.hpp"

namespace liana::calibration {
namespace {

constexpr const char* kHeader = "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n";

// A file of its own that is gone with the test.
struct File {
  std::string path = std::filesystem::temp_directory_path() / ("liana_tracker_" + std::to_string(::getpid()) + ".csv");
  explicit File(const std::string& text) { std::ofstream(path) << text; }
  ~File() { std::filesystem::remove(path); }
};

std::string refusal(const std::string& text) {
  const File file(text);
  try {
    read_tracker(file.path);
  } catch (const std::runtime_error& error) {
    return std::string(error.what()).substr(file.path.size());
  }
  return "";
}

TEST(TrackerTrack, ColumnsComeInAnyOrderBesideOthersAndQuaternionsMayBeRounded) {
  const File file(
      "frame, qx,qy,qz,qw,time_s,z_m,y_m,x_m\r\n1, 0,0,0.6,0.7999,0.5,3,2,1\r\n\r\n2,0,0,0,-1,0.51,3,2,1.5\n");
  const std::vector<TrackedPose> rows = read_tracker(file.path);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].time_s, 0.5);
  EXPECT_EQ(rows[0].marker_in_tracker.position_m, (Vec3{1, 2, 3}));
  EXPECT_NEAR(rows[0].marker_in_tracker.quaternion[3], 0.6, 1e-4);
  EXPECT_TRUE(is_valid(rows[0].marker_in_tracker));
  EXPECT_EQ(rows[1].marker_in_tracker.quaternion[0], -1.0);
}

TEST(TrackerTrack, EveryBadFileIsRefusedWithLineColumnAndValue) {
  const std::string good = "1,0,0,0,1,0,0,0\n";
  const struct {
    std::string text, begins;
  } bad[] = {
      {"time_s,x_m,y_m,qw,qx,qy,qz\n1,0,0,1,0,0,0\n", ": line 1: z_m: 'no such column'"},
      {"time_s,x_m,x_m,y_m,z_m,qw,qx,qy,qz\n", ": line 1: x_m: 'twice'"},
      {kHeader + good + "2,nan,0,0,1,0,0,0\n", ": line 3: x_m: 'nan'"},
      {kHeader + good + "2,0,0,inf,1,0,0,0\n", ": line 3: z_m: 'inf'"},
      {kHeader + good + "2,0,,0,1,0,0,0\n", ": line 3: y_m: ''"},
      {kHeader + good + "2,0,0\n", ": line 3: z_m: ''"},
      {kHeader + good + "2,0,0,1e999,1,0,0,0\n", ": line 3: z_m: '1e999'"},
      {kHeader + good + "2,0,1200,0,1,0,0,0\n", ": line 3: y_m: '1200'"},
      {kHeader + good + "two,0,0,0,1,0,0,0\n", ": line 3: time_s: 'two'"},
      {kHeader + good + "1,0,0,0,1,0,0,0\n", ": line 3: time_s: '1'"},
      {kHeader + good + "0.5,0,0,0,1,0,0,0\n", ": line 3: time_s: '0.5'"},
      {kHeader + good + "1e5,0,0,0,1,0,0,0\n", ": line 3: time_s: '100000, row 2'"},
      {kHeader + good + "2,0,0,0,0.9,0.1,0,0\n", ": line 3: qw, qx"},
      {kHeader + good + "2,0,0,0,0,0,0,0\n", ": line 3: qw, qx"},
      {kHeader + good + "2," + std::string(5000, '1') + "\n", ": line 3: the line: '5002 characters'"},
      {kHeader + good, ": line 2: rows: '1'"},
      {"", ": line 0: time_s: 'no such column'"},
      {std::string("\x00\xff\x7f\n", 4), ": line 1: time_s: 'no such column'"},
  };
  for (const auto& one : bad) EXPECT_TRUE(refusal(one.text).starts_with(one.begins)) << refusal(one.text);
  EXPECT_EQ(refusal(kHeader + good + "2,0,0,0,1,0,0,0\n"), "");
  EXPECT_NE(refusal(kHeader + good + "2,0,1200,0,1,0,0,0\n").find("metres"), std::string::npos);
  EXPECT_THROW(read_tracker("/nowhere/poses.csv"), std::runtime_error);
  EXPECT_THROW(read_tracker(std::filesystem::temp_directory_path()), std::runtime_error);
  const File pipe("");
  std::filesystem::remove(pipe.path);
  ASSERT_EQ(::mkfifo(pipe.path.c_str(), 0600), 0);
  EXPECT_THROW(read_tracker(pipe.path), std::runtime_error);  // nobody will ever write to it
}

// A tip that rests and moves by turns for some minutes, and its marker as a tracker far away sees it.
struct Motion {
  std::vector<TimedPoint> tip;
  std::vector<TrackedPose> tracked;

  Motion(std::uint64_t seed, double offset_s, double tracker_rate_hz, double noise_m) {
    simulated::RandomStream random(seed, 3);
    const auto vector = [&](double max) {
      return Vec3{random.uniform(-max, max), random.uniform(-max, max), random.uniform(-max, max)};
    };
    std::vector<TimedPoint> corners{{0.0, {}}};
    while (corners.back().time_s < 200.0) {
      const TimedPoint last = corners.back();
      const double moves_s = random.uniform(3.0, 10.0);
      corners.push_back({last.time_s + 3.0, last.position_m});
      corners.push_back({last.time_s + 3.0 + moves_s, add(last.position_m, vector(0.1))});
    }
    const auto at = [&](double time_s) {
      std::size_t i = 1;
      while (i + 1 < corners.size() && corners[i].time_s < time_s) ++i;
      const TimedPoint &a = corners[i - 1], &b = corners[i];
      const double share = std::fmin(1.0, (time_s - a.time_s) / (b.time_s - a.time_s));
      return add(a.position_m, scale(subtract(b.position_m, a.position_m), share));
    };
    const Pose frame{vector(2.0), quaternion_of(vector(1.0))};
    for (double time_s = 0.0; time_s < 200.0; time_s += 0.02) tip.push_back({time_s, at(time_s)});
    for (double time_s = 5.0; time_s < 180.0; time_s += 1.0 / tracker_rate_hz) {
      const Vec3 noise{random.normal(noise_m), random.normal(noise_m), random.normal(noise_m)};
      const Vec3 seen = add(add(rotate(frame.quaternion, at(time_s)), frame.position_m), noise);
      tracked.push_back({time_s - offset_s, {seen, frame.quaternion}});
    }
  }
};

TEST(TrackerTrack, TheClocksOffsetIsFoundWhateverTheFramesTheRateAndTheNoise) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const double offset_s = static_cast<double>(seed) * 37.3 - 1500.0, rate_hz = seed % 3 == 0 ? 30.0 : 100.0;
    const Motion motion(seed, offset_s, rate_hz, seed % 2 == 0 ? 0.2e-3 : 0.0);
    EXPECT_NEAR(clock_offset_s(motion.tip, motion.tracked), offset_s, 0.08) << seed;
  }
}

TEST(TrackerTrack, PosesOfAnotherRunAreRefused) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_THROW(clock_offset_s(Motion(seed, 0.0, 100.0, 0.2e-3).tip, Motion(seed + 100, 0.0, 100.0, 0.2e-3).tracked),
                 std::runtime_error)
        << seed;
  Motion still(1, 0.0, 100.0, 0.0);
  for (TrackedPose& row : still.tracked) row.marker_in_tracker.position_m = {};
  EXPECT_THROW(clock_offset_s(still.tip, still.tracked), std::runtime_error);
}

TEST(TrackerTrack, AMeanPoseTakesEitherSignOfAQuaternionAndNoneOfAMarkerThatMovesOrIsSeldomSeen) {
  std::vector<TrackedPose> rows;
  for (int i = 0; i < 20; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    rows.push_back({0.1 * i, {{1e-3 * sign, 0.0, 0.0}, {sign * 0.6, 0.0, sign * 0.8, 0.0}}});
  }
  const std::optional<Pose> mean = mean_pose(rows, 0.05, 1.05);
  ASSERT_TRUE(mean);
  EXPECT_NEAR(mean->position_m[0], 0.0, 1e-12);
  EXPECT_NEAR(std::fabs(mean->quaternion[2]), 0.8, 1e-12);
  EXPECT_FALSE(mean_pose(rows, 0.05, 0.35));
  EXPECT_FALSE(mean_pose(rows, 5.0, 6.0));
  rows[4].marker_in_tracker.position_m[2] = 0.01;
  EXPECT_FALSE(mean_pose(rows, 0.05, 1.05));
}

}  // namespace
}  // namespace liana::calibration
