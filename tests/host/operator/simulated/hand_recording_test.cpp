// `.hand` files: the recordings that ship with Liana, and bad ones.
#include "host/operator/simulated/hand_recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "host/operator/simulated/recorded_vr.hpp"
#include "tests/message.hpp"

namespace liana::simulated {
namespace {

const std::string kRecordings = LIANA_RECORDINGS_DIR;

// Message of the error that reading this text gives, empty when it is read.
std::string error_of(const std::string& text) {
  const std::string path = ::testing::TempDir() + "bad.hand";
  std::ofstream(path) << text;
  try {
    read_hand_recording(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return {};
}

constexpr const char* kPose = " 0 0 0 1 0 0 0";

// req:A24 req:A32
TEST(HandRecording, ShippedVrRecordingHasOneDropoutOneJumpAndNinetyHertz) {
  const VrRecording recording = read_vr_recording(kRecordings + "/panel_edge_vr.hand");
  const double rate_hz =
      static_cast<double>(recording.size() - 1) / (static_cast<double>(recording.back().right.t_us) * 1e-6);
  EXPECT_NEAR(rate_hz, 90.0, 0.1);
  int dropouts = 0, jumps = 0;
  for (std::size_t i = 1; i < recording.size(); ++i) {
    const device::Sample &before = recording[i - 1].right, &now = recording[i].right;
    dropouts += before.valid && !now.valid ? 1 : 0;
    jumps += norm(subtract(now.pose.position_m, before.pose.position_m)) > 0.2 ? 1 : 0;
  }
  EXPECT_EQ(dropouts, 1);
  EXPECT_EQ(jumps, 2);  // away and back
}

// req:A31
TEST(HandRecording, ShippedVrRecordingLeadsTipAndNodeFromPrepareToPanelEdge) {
  const VrRecording recording = read_vr_recording(kRecordings + "/panel_edge_vr.hand");
  const auto way = [&](auto pick) {
    return scale(subtract(pick(recording.back()).pose.position_m, pick(recording.front()).pose.position_m), 4.0);
  };
  const Vec3 tip = way([](const BothHands& s) { return s.right; });
  const Vec3 node = way([](const BothHands& s) { return s.left; });
  EXPECT_LT(norm(subtract(tip, {0.244568 - 0.646615, -0.271144 + 1.519711, 0.581923 - 0.020182})), 0.012);
  EXPECT_LT(norm(subtract(node, {-0.947447 + 0.242596, -0.395663 + 1.662394, 1.151544 - 0.111163})), 0.012);
}

// req:A30
TEST(HandRecording, ShippedHandControllerRecordingIsReadAtOneKilohertz) {
  const HandRecording recording = read_hand_controller_recording(kRecordings + "/approach_hand.hand");
  EXPECT_EQ(recording.size(), 10001u);
  EXPECT_EQ(recording.back().t_us, 10000000);
  EXPECT_TRUE(std::any_of(recording.begin(), recording.end(), [](const device::Sample& s) { return s.deadman; }));
}

TEST(HandRecording, BadFilesAreRefusedWithLineValueAndWhatIsAllowed) {
  const std::string head = "liana-hand 1 hand\n";
  const std::string good = std::string("0 1 0") + kPose + "\n";
  EXPECT_EQ(error_of(head + "# comment\n" + good), "");
  const std::vector<std::pair<std::string, Facts>> cases = {
      {"", {"line 1"}},
      {"liana-hand 2 hand\n" + good, {"line 1", "liana-hand 1 vr"}},
      {head, {"samples"}},
      {head + "0 1 0 0 0 0 1 0 0\n", {"line 2", "9 columns", "10"}},
      {head + "0 1 0 x 0 0 1 0 0 0\n", {"line 2", "x", "number"}},
      {head + "0 1 0 nan 0 0 1 0 0 0\n", {"line 2", "nan"}},
      {head + "0 2 0" + kPose + "\n", {"line 2", "valid", "2", "0", "1"}},
      {head + "0 1 0.5" + kPose + "\n", {"line 2", "button", "0.5", "0", "1"}},
      {head + "5 1 0" + kPose + "\n", {"line 2", "t_us", "5", "0"}},
      {head + good + good, {"line 3", "t_us", "0"}},
      {head + "0.5 1 0" + kPose + "\n", {"line 2", "0.5", "whole"}},
      {head + "0 1 0 0 0 0 1 1 0 0\n", {"line 2", "quaternion", "1.414214"}},
      {"liana-hand 1 vr\n0 1 1.5" + std::string(kPose) + " 1 0" + kPose + "\n",
       {"line 2", "right_trigger", "1.5", "0", "1"}},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = error_of(text);
    EXPECT_TRUE(names(message, expected)) << "for: " << text;
    EXPECT_TRUE(names(message, {"bad.hand"}));
  }
}

TEST(HandRecording, AFileOfTheOtherKindIsRefusedByName) {
  EXPECT_THROW(read_vr_recording(kRecordings + "/approach_hand.hand"), std::runtime_error);
  EXPECT_THROW(read_hand_controller_recording(kRecordings + "/panel_edge_vr.hand"), std::runtime_error);
  EXPECT_THROW(read_vr_recording(kRecordings + "/missing.hand"), std::runtime_error);
}

// Everything a playback of the shipped recording delivers, in intervals of 20 ms.
std::vector<BothHands> play(std::uint64_t seed, double lost_from_s = 1e9) {
  RecordedVr player(read_vr_recording(kRecordings + "/panel_edge_vr.hand"), {}, seed);
  std::vector<BothHands> all;
  for (int k = 0; k < 3000 && !player.finished(); ++k) {
    const double now_s = 0.02 * k;
    player.feel(now_s < lost_from_s || now_s > lost_from_s + 1.0, now_s);
    for (const BothHands& sample : player.advance(now_s, 0.02)) all.push_back(sample);
  }
  return all;
}

// req:A32
TEST(RecordedVr, PlaysEverySampleInOrderWithTwoJumpsAndTwoShortDropouts) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto samples = play(seed);
    EXPECT_EQ(samples.size(), read_vr_recording(kRecordings + "/panel_edge_vr.hand").size());
    int jumps = 0;
    double lost_s = 0.0, longest_s = 0.0;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      EXPECT_GT(samples[i].right.t_us, samples[i - 1].right.t_us);
      jumps += norm(subtract(samples[i].right.pose.position_m, samples[i - 1].right.pose.position_m)) > 0.15 ? 1 : 0;
      lost_s = samples[i].right.valid ? 0.0 : lost_s + 1.0 / 90.0;
      longest_s = std::max(longest_s, lost_s);
    }
    EXPECT_EQ(jumps, 4);
    EXPECT_GT(longest_s, 0.10);
    EXPECT_LT(longest_s, 0.25);
  }
}

TEST(RecordedVr, SeedChangesTheHandAndNothingElseDoes) {
  const auto a = play(3), b = play(3), c = play(4);
  EXPECT_EQ(a[100].right.pose.position_m, b[100].right.pose.position_m);
  EXPECT_NE(a[100].right.pose.position_m, c[100].right.pose.position_m);
}

TEST(RecordedVr, ReleasesAndGripsAgainWhenTheArmDoesNotFollow) {
  const auto samples = play(1, 10.0);
  int grips = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    grips += samples[i].right.trigger > 0.5 && samples[i - 1].right.trigger <= 0.5 ? 1 : 0;
  EXPECT_EQ(grips, 2);
}

}  // namespace
}  // namespace liana::simulated
