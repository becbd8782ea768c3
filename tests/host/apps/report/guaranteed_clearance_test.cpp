// Claims of clearance against the truth, slot by slot.
#include "host/apps/report/guaranteed_clearance.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

constexpr double kSlot_s = 0.004;

// True clearances of slots 0, 1, ...
TruthLog truth_with(const std::vector<double>& clearance_m) {
  const std::string path =
      testing::TempDir() + "liana-claims-" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".bin";
  std::ofstream out(path, std::ios::binary);
  out << Json{{"columns", {"slot", "clearance_m"}}}.dump() << '\n';
  for (std::size_t slot = 0; slot < clearance_m.size(); ++slot) {
    const double row[] = {static_cast<double>(slot), clearance_m[slot]};
    out.write(reinterpret_cast<const char*>(row), sizeof row);
  }
  out.close();
  TruthLog truth = TruthLog::load(path);
  std::filesystem::remove(path);
  return truth;
}

TEST(ClaimedClearance, AClaimStandsUntilTheNextOne) {
  const TruthLog truth = truth_with({0.020, 0.018, 0.016, 0.014, 0.012, 0.010});
  const auto claimed = verified_clearance(truth, 0, 5, {{0, 0.015}, {4, 0.009}}, kSlot_s);
  ASSERT_TRUE(claimed);
  EXPECT_DOUBLE_EQ(claimed->min_m, 0.009);
  EXPECT_DOUBLE_EQ(claimed->truth_min_m, 0.010);
  EXPECT_EQ(claimed->ticks_above_truth, 1u) << "slot 3: claimed 15 mm, true 14";
  EXPECT_NEAR(claimed->max_above_m, 0.001, 1e-12);
}

TEST(ClaimedClearance, AClaimThatHoldsIsNotAboveTheTruth) {
  const auto claimed = verified_clearance(truth_with({0.010, 0.010}), 0, 1, {{0, 0.010}}, kSlot_s);
  ASSERT_TRUE(claimed);
  EXPECT_EQ(claimed->ticks_above_truth, 0u);
  EXPECT_EQ(claimed->max_above_m, 0.0);
}

TEST(ClaimedClearance, BeforeTheFirstClaimAndLongAfterTheLastNothingIsClaimed) {
  std::vector<double> clearance_m(60, 0.001);
  clearance_m[10] = 0.02;
  const TruthLog truth = truth_with(clearance_m);
  const auto claimed = verified_clearance(truth, 0, 59, {{10, 0.015}}, kSlot_s);
  ASSERT_TRUE(claimed);
  EXPECT_EQ(claimed->ticks_above_truth, 25u) << "slots 11 to 35: a tenth of a second";
  EXPECT_FALSE(verified_clearance(truth, 0, 9, {{10, 0.015}}, kSlot_s));
  EXPECT_FALSE(verified_clearance(truth, 40, 59, {{10, 0.015}}, kSlot_s));
  EXPECT_FALSE(verified_clearance(truth, 0, 59, {}, kSlot_s));
}

}  // namespace
}  // namespace liana::report
