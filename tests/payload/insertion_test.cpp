// The whole bench of the payload installation behind a stand-in controller: force insertion over the wire.
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/payload/stand_in.hpp"
#include "tests/rounds.hpp"

namespace liana::test {
namespace {

struct Insertion {
  double captured_s = -1.0;
  double peak_N = 0.0, peak_Nm = 0.0, base_m = 0.0, insertion_m = 0.0;
  double after_1_s_N = 0.0;
};

nlohmann::json summary_of(const Stand& stand) {
  nlohmann::json summary;
  stand.plant.summarise(summary);
  return summary;
}

Insertion insert(Stand& stand) {
  stand.start();
  Insertion out;
  const double from_s = stand.now_s();
  while (!stand.heard.captured && stand.now_s() - from_s < 20.0) stand.press(30.0);
  if (!stand.heard.captured) return out;
  out.captured_s = stand.now_s() - from_s;
  for (int i = 0; i < 250; ++i) stand.press(0.0, true);
  for (int i = 0; i < 125; ++i) {
    stand.press(0.0, true);
    out.after_1_s_N = std::max(out.after_1_s_N, norm(stand.plant.wrist().force_N));
  }
  const auto peaks = summary_of(stand)["peaks"];
  out.peak_N = peaks["contact_N"];
  out.peak_Nm = peaks["joint_torque_Nm"];
  out.base_m = peaks["base_deflection_m"];
  out.insertion_m = peaks["insertion_m"];
  return out;
}

// req:B25
TEST(Insertion, AsTheTablesSayThePayloadIsCapturedAfterAboutSevenSeconds) {
  Stand stand(1, "[]", false);
  const Insertion out = insert(stand);
  std::printf("captured %.2f s, peak %.1f N, %.1f N m, base %.1f mm, in %.1f mm, 1 s after %.1f N\n", out.captured_s,
              out.peak_N, out.peak_Nm, 1e3 * out.base_m, 1e3 * out.insertion_m, out.after_1_s_N);
  EXPECT_GT(out.captured_s, 5.0);
  EXPECT_LT(out.captured_s, 9.0);
  EXPECT_LT(out.peak_N, 60.0);
  EXPECT_LT(out.peak_Nm, 100.0);
  EXPECT_NEAR(out.insertion_m, 0.0205, 0.0015);
}

// Seeds on which nothing was tuned. The stand-in does not slow down before the first contact: one heavy payload of 20
// meets stiff pins with more than 60 N.
// req:B2 req:B25
TEST(Insertion, WhateverTheSeedMakesOfArmPayloadAndAdapterItIsCaptured) {
  const int seeds = rounds(20);
  int captured = 0, soft = 0;
  for (int i = 0; i < seeds; ++i) {
    const std::uint64_t seed = 1001 + static_cast<std::uint64_t>(i);
    Stand stand(seed);
    const Insertion out = insert(stand);
    std::printf("seed %d: captured %.2f s, peak %.1f N, %.1f N m, base %.1f mm, 1 s after %.1f N\n",
                static_cast<int>(seed), out.captured_s, out.peak_N, out.peak_Nm, 1e3 * out.base_m, out.after_1_s_N);
    captured += out.captured_s > 0.0 ? 1 : 0;
    soft += out.peak_N < 60.0 ? 1 : 0;
    EXPECT_LT(out.peak_N, 90.0) << seed;
    EXPECT_LT(out.peak_Nm, 100.0) << seed;
  }
  EXPECT_EQ(captured, seeds);
  EXPECT_GE(soft, seeds - 1);
}

// A latch that does not close and a capture that nobody listens to: the force is held against the stop, once the base
// has swung out.
// req:B18
TEST(Insertion, TheForceIsHeldWithinOneNewton) {
  Stand stand(1, R"([{"kind":"latch_fails","at_slot":0}])", false);
  stand.start();
  for (int i = 0; i < 4500; ++i) stand.press(30.0);
  double least = 1e9, most = -1e9;
  for (int i = 0; i < 1250; ++i) {
    stand.press(30.0);
    const double pressed_N = -stand.plant.wrist().force_N.z;
    least = std::min(least, pressed_N), most = std::max(most, pressed_N);
  }
  std::printf("held %.2f to %.2f N\n", least, most);
  EXPECT_GT(least, 29.0);
  EXPECT_LT(most, 31.0);
  EXPECT_EQ(stand.heard.latch, 3) << "the latch says that it failed";
}

}  // namespace
}  // namespace liana::test
